#!/usr/bin/env bash
# What the editor uses of one core at rest, in a window on an X server of its own: with a still scene, and playing after all
# bodies have fallen asleep. tools/idle_cpu.sh [SCENE [SECONDS [PATIENCE]]]: it waits PATIENCE seconds for the bodies to sleep.
# Prints one line a state: the scene, the state, and percent of a core. Needs Xvfb and xdotool.
set -u
cd "$(dirname "$0")/.." || exit 4
scene=${1:-saves/welcome.txt} seconds=${2:-20} patience=${3:-60}
marchbox=${MARCHBOX:-build/marchbox}
for need in Xvfb xdotool "$marchbox"; do
    command -v "$need" >/dev/null || { echo "tools/idle_cpu.sh: there is no $need" >&2; exit 4; }
done
scratch=$(mktemp -d)
trap 'kill $editor $server 2>/dev/null; wait 2>/dev/null; rm -rf "$scratch"' EXIT
editor='' server=''
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>"$scratch/display" 2>/dev/null &
server=$!
until [ -s "$scratch/display" ]; do sleep 0.1; done
DISPLAY=:$(cat "$scratch/display")
export DISPLAY
unset WAYLAND_DISPLAY
"$marchbox" edit "$scene" &
editor=$!

# user and system time of all its threads so far, in clock ticks
ticks() { sed 's/.*) //' "/proc/$editor/stat" | awk '{print $12 + $13}'; }
# percent SECONDS: of one core over that time
percent() {
    local before after
    before=$(ticks); sleep "$1"; after=$(ticks)
    awk -v n=$((after - before)) -v hz="$(getconf CLK_TCK)" -v s="$1" 'BEGIN { printf "%.1f", 100 * n / hz / s }'
}
# settle MOST: until the editor has come to rest, or that many seconds have passed
settle() {
    local end=$((SECONDS + $1))
    while [ $SECONDS -lt $end ]; do
        awk -v p="$(percent 2)" 'BEGIN { exit !(p < 5) }' && return
    done
}
xdotool search --sync --onlyvisible --name marchbox windowfocus >/dev/null
settle 30
echo "$scene still: $(percent "$seconds") % of a core"
xdotool key space
sleep 2
settle "$patience"
echo "$scene playing, after up to $patience s: $(percent "$seconds") % of a core"
