#!/usr/bin/env bash
# Each folder of src/ includes only itself and the folders before it; only lua/ and shell/ see Lua's headers; the kernel
# neither exits nor prints nor takes signals.
set -u
cd "$(dirname "$0")/../../src" || exit 1
order=(base tissue shape rule solve field mechanics light view sweep capi lua shell)
failed=0
wrong() { echo "$1"; failed=1; }

rank_of() { for i in "${!order[@]}"; do [ "${order[$i]}" = "$1" ] && { echo "$i"; return; }; done; echo -1; }

for folder in */; do
  folder=${folder%/}
  rank=$(rank_of "$folder")
  [ "$rank" -ge 0 ] || { wrong "src/$folder has no place in the order: ${order[*]}"; continue; }
  while IFS=: read -r file line text; do
    used=$(sed -E 's/.*#include "([^/"]*)\/.*/\1/' <<<"$text")
    [ "$(rank_of "$used")" -ge 0 ] || { wrong "src/$file:$line: \"$used/...\" is no folder of src"; continue; }
    [ "$(rank_of "$used")" -le "$rank" ] || wrong "src/$file:$line: $folder may not include $used"
  done < <(grep -rn '#include "[^"]*/' "$folder")
  while IFS=: read -r file line text; do
    [[ $text == *"/"* ]] || wrong "src/$file:$line: name the folder, as in \"$folder/...\": $text"
  done < <(grep -rnE '#include "[^/"]+"' "$folder")
  [ "$folder" = lua ] || [ "$folder" = shell ] && continue
  while read -r hit; do wrong "src/$hit: only lua and shell know Lua"; done < <(
    grep -rnE '#include [<"](lua|lauxlib|lualib|luajit)(\.h|\.hpp)' "$folder")
  while read -r hit; do wrong "src/$hit: not the library's business"; done < <(
    grep -rnE '(^|[^_[:alnum:]:.>])(std::)?(exit|abort|signal|sigaction|printf|puts|srand|rand) *\(|std::(cout|cerr)' "$folder")
done
exit $failed
