#!/bin/sh
# readme.sh [BUILD] - runs the code of README.md (but its scene) line by line, as a newcomer types it, in one shell. With
# BUILD, a folder in which isoroll is built, it installs that one in place of the demo's, in a home of its own, and leaves
# out `cost`, which takes a minute, and what this build lacks. Prints each line; ends with 1 at the first that fails.
set -eu
cd "$(dirname "$0")/.."
lines=$(mktemp)
trap 'rm -rf "$lines" ${scratch+"$scratch"}' EXIT
sed '/^## A scene/,/^## Where/d' README.md | sed -n 's/^    //p' >"$lines"
if [ $# -gt 0 ]; then
    HOME=$(mktemp -d) && export HOME scratch="$HOME"
    sed -i "/apps\/demo\.sh/d; /isoroll cost/d; s|\.build/demo|$(cd "$1" && pwd)|" "$lines"
fi
no_live=
[ $# -eq 0 ] || no_live=$(sed -n 's/^ISO_LIVE:BOOL=OFF$/yes/p' "$1/CMakeCache.txt")
for needed in 'cmake --install' 'isoroll run' 'isoroll view --live' python3 'pkg-config'; do
    grep -q -e "$needed" "$lines" || { echo "README.md has no line with '$needed'" >&2; exit 1; }
done
start=$(date +%s)
[ -z "$no_live" ] || sed -i '/view --live/d' "$lines"
while IFS= read -r line <&3; do
    echo "\$ $line"
    eval "$line" </dev/null || { echo "this line of README.md fails: $line" >&2; exit 1; }
done 3<"$lines"
echo "every line of README.md runs: $(wc -l <"$lines") lines, $(($(date +%s) - start)) s"
