#!/bin/sh
# demo.sh [--view] - builds the command, with all set-up, and computes three scenes. Each orbit is computed in both
# models, as a rolling ball and as a point on a sphere. Says the result of each, and where its table and its picture are.
# With --view it also makes two pages in which ball and point move: a scene, and a section of many orbits.
# Beside an installed isoroll (/usr/share/doc/isoroll) nothing is built: it takes `isoroll`, and writes into the
# folder isoroll-demo, here.
set -eu
here=$PWD
cd "$(dirname "$0")/.."
view=
case ${1-} in
--view) view=yes && shift ;;
esac
[ $# -eq 0 ] || { echo "usage: sh apps/demo.sh [--view]" >&2; exit 2; }

if [ -e CMakeLists.txt ]; then
    sh .ci/packages.sh
    to=$PWD/.build/demo
    isoroll=$to/isoroll
    log=.build/demo.log
    mkdir -p .build
    echo "compiling in .build/demo, three minutes of one processor; messages go to $log"
    cmake -S . -B .build/demo -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF >"$log" 2>&1 || { cat "$log"; exit 1; }
    { cmake --build .build/demo -j "$(nproc 2>/dev/null || echo 2)" 2>&1 || echo "cannot compile"; } | {
        tens=0
        while IFS= read -r line; do
            echo "$line" >>"$log"
            case $line in
            "cannot compile") exit 1 ;;
            \[*%\]*) percent=${line%%%*} && percent=${percent#\[} ;;
            *) continue ;;
            esac
            [ $((percent / 10)) -le $tens ] || { tens=$((percent / 10)) && echo "  $((tens * 10)) %"; }
        done
    } || { cat "$log"; exit 1; }
else
    to=$here/isoroll-demo
    isoroll=isoroll
    mkdir -p "$to"
fi

names="15_two_spheres 01_bowling_ball 02_neumann_shell"
for name in $names; do
    echo "examples/$name/scene.yaml"
    "$isoroll" compare "examples/$name/scene.yaml" --plot "$to/$name.svg" >"$to/$name.txt"
    tail -n 1 "$to/$name.txt" | sed 's/^/  /'
    grep -q '^the same orbit: ' "$to/$name.txt" || { echo "this is not what the demo shows: see $to/$name.txt" >&2; exit 1; }
done
if [ -n "$view" ]; then
    page=$to/16_sections
    "$isoroll" view examples/15_two_spheres/scene.yaml -o "$to/15_two_spheres.html"
    "$isoroll" section examples/16_sections/scene.yaml --starts 80 --crossings 400 --quiet -o "$page.csv"
    "$isoroll" view "$page.csv" -o "$page.html"
fi
cat <<END

Each of three orbits was computed twice: as a ball that rolls without slip and
twist, and as a point that moves on a sphere in a potential. The map between the
two carries each state of one computation to that of the other, to the digits
above. So both models have the same orbits: what is known of one holds for both.

END
echo "pictures:" && for name in $names; do echo "$to/$name.svg"; done
echo "what was computed:" && for name in $names; do echo "$to/$name.txt"; done
[ -z "$view" ] || printf 'pages, for a browser:\n%s\n%s\n' "$to/15_two_spheres.html" "$page.html"
echo "the command: $isoroll --help"
