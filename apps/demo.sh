#!/bin/sh
# demo.sh [--view] - builds the command, with all set-up, and computes three scenes. Each orbit is computed in both
# models, as a rolling ball and as a point on a sphere. Prints a table and draws a picture of each. With --view it also
# makes two pages in which ball and point move: a scene, and a section of many orbits.
set -eu
cd "$(dirname "$0")/.."
view=
case ${1-} in
--view) view=yes && shift ;;
esac
[ $# -eq 0 ] || { echo "usage: sh apps/demo.sh [--view]" >&2; exit 2; }
sh .ci/packages.sh

mkdir -p .build
log=.build/demo.log
echo "compiling in .build/demo; messages go to $log"
{ cmake -S . -B .build/demo -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF &&
    cmake --build .build/demo -j "$(nproc 2>/dev/null || echo 2)"; } >"$log" 2>&1 || { cat "$log"; exit 1; }

for name in 15_two_spheres 01_bowling_ball 02_neumann_shell; do
    echo "== examples/$name/scene.yaml"
    .build/demo/isoroll compare "examples/$name/scene.yaml" --plot ".build/demo/$name.svg"
    echo
done
if [ -n "$view" ]; then
    page=.build/demo/16_sections
    .build/demo/isoroll view examples/15_two_spheres/scene.yaml -o .build/demo/15_two_spheres.html
    .build/demo/isoroll section examples/16_sections/scene.yaml --starts 80 --crossings 400 --quiet -o $page.csv
    .build/demo/isoroll view $page.csv -o $page.html
    echo "pages, for a browser:"
    ls "$PWD"/.build/demo/*.html
fi
echo "pictures:"
ls "$PWD"/.build/demo/*.svg
echo "the command: $PWD/.build/demo/isoroll --help"
