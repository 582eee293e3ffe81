#!/usr/bin/env bash
# The prompt inside tmux, over a pseudo-terminal as ssh gives one: typed, completed, resized, stopped, pictures drawn.
source "$(dirname "$0")/common.sh"
command -v tmux >/dev/null || { echo "tmux is not installed: nothing tested"; exit 0; }

export HOME=$PWD XDG_STATE_HOME=$PWD/state XDG_CONFIG_HOME=$PWD/config LC_ALL=C.UTF-8 INPUTRC=/dev/null
unset TMUX
server=(tmux -f /dev/null -S "$PWD/socket")
trap '"${server[@]}" kill-server 2>/dev/null' EXIT
"${server[@]}" new-session -d -x 80 -y 30 "$tunica -q -i patterning/sheet cells=60" || { wrong "tmux does not start"; finish; }

screen() { "${server[@]}" capture-pane -p -S -200; }
# shows TEXT: waits until the pane holds it.
shows() {
  for _ in $(seq 100); do
    screen >screen.txt
    grep -qF -- "$1" screen.txt && return
    sleep 0.1
  done
  wrong "the pane does not show '$1' but:"
  cat screen.txt
}
keys() { "${server[@]}" send-keys "$@"; }

shows '>'
keys '1 + 41' Enter; shows '42'
keys 'tissue:count_p' Tab; shows 'tissue:count_peaks'
keys C-u 'run { by = 1 }' Enter; shows 'now at t = 1'
keys 'while true do end' Enter; sleep 0.3; keys C-c; shows 'interrupted'
# The terminal is asked what it can show: keys typed meanwhile would be taken for its answer.
keys 'show()' Enter
for _ in $(seq 100); do
  sleep 0.1
  [ "$(screen | grep -v '^ *$' | tail -n 1)" = '>' ] && break
done
keys '"after" .. "wards"' Enter; shows '"afterwards"'
screen | grep -q 'error' && { wrong "show() inside tmux:"; screen; }
# A narrower window: what comes then fits it; a line being typed stays whole.
keys 'local a_long_name_to_be_typed = "some text that'
sleep 0.2
"${server[@]}" resize-window -x 40 -y 30
sleep 0.3
keys ' goes on after it" #a_long_name_to_be_typed' Enter
keys 'width = 17 width' C-a C-k 'a_long_name_to_be_typed' Enter; shows 'goes on after it'
keys 'P' Enter; shows 'diffusion'
keys C-l 'help "tissue:divide"' Enter; shows 'example'
"${server[@]}" capture-pane -p >screen.txt
awk 'length($0) > 40 { bad = 1 } END { exit bad }' screen.txt || wrong "lines wider than the window"
keys 'quit' Enter
for _ in $(seq 50); do "${server[@]}" has-session 2>/dev/null || break; sleep 0.1; done
"${server[@]}" has-session 2>/dev/null && wrong "quit does not end the program"
finish
