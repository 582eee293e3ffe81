#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The Jacobian of every shipped model is exact: held against complex steps.
set -euo pipefail
tunica=$1
here=$(cd "$(dirname "$0")" && pwd)

while read -r path; do
  printf '%s: ' "$(basename "$path" .lua)"
  MODEL=$path "$tunica" -q "$here/../scripts/jacobian_of.lua"
done < <(grep -rl --include='*.lua' 'tunica\.model' "$here/../../scripts" | sort)  # others have no rates
