#!/bin/sh
# Builds the command, with all set-up, and computes three scenes. Each orbit is computed in both models, as a rolling ball
# and as a point on a sphere. Prints a table and draws a picture of each.
set -eu
cd "$(dirname "$0")/.."
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
echo "pictures:"
ls "$PWD"/.build/demo/*.svg
echo "the command: $PWD/.build/demo/isoroll --help"
