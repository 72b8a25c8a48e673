#!/bin/sh
# demo.sh [--view] - builds the command, with all set-up, and computes three scenes. Each orbit is computed in both
# models, as a rolling ball and as a point on a sphere. Prints a table and draws a picture of each. With --view it also
# makes two pages in which ball and point move: a scene, and a section of many orbits.
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
    echo "compiling in .build/demo; messages go to $log"
    { cmake -S . -B .build/demo -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF &&
        cmake --build .build/demo -j "$(nproc 2>/dev/null || echo 2)"; } >"$log" 2>&1 || { cat "$log"; exit 1; }
else
    to=$here/isoroll-demo
    isoroll=isoroll
    mkdir -p "$to"
fi

for name in 15_two_spheres 01_bowling_ball 02_neumann_shell; do
    echo "== examples/$name/scene.yaml"
    "$isoroll" compare "examples/$name/scene.yaml" --plot "$to/$name.svg"
    echo
done
if [ -n "$view" ]; then
    page=$to/16_sections
    "$isoroll" view examples/15_two_spheres/scene.yaml -o "$to/15_two_spheres.html"
    "$isoroll" section examples/16_sections/scene.yaml --starts 80 --crossings 400 --quiet -o "$page.csv"
    "$isoroll" view "$page.csv" -o "$page.html"
    echo "pages, for a browser:"
    ls "$to"/*.html
fi
echo "pictures:"
ls "$to"/*.svg
echo "the command: $isoroll --help"
