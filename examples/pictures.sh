#!/bin/sh
# pictures.sh BUILD [NAME...] - draws the pictures of examples/README.md: examples/NN_name/picture.svg (.png of 16, 20 and
# 22), lane.svg of 01, and others.
#     cmake -S . -B .build/release && cmake --build .build/release -j 2 && sh examples/pictures.sh .build/release
# BUILD is a folder that cmake has built, with the tests. A NAME is one of the functions draw_NAME below; without names
# all are drawn but `cost`. Times and steps are shortened to keep the files small.
# `cost` (cost.svg of 02) shows times of this machine: draw it on a quiet one.
set -eu
[ $# -ge 1 ] || { echo "usage: pictures.sh BUILD [NAME...]" >&2; exit 2; }
build=$(cd "$1" && pwd)
shift
isoroll=$build/isoroll
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

draw_cost() {
    "$isoroll" cost 02_neumann_shell/scene.yaml --plot 02_neumann_shell/cost.svg >"$work/out"
}

# one orbit on both spheres, and its two clocks
draw_spheres() {
    for name in 01_bowling_ball 02_neumann_shell 03_outside 04_inside 05_equal_radii 06_braden_reduced 07_neumann_point \
        12_neumann_off_level 15_two_spheres; do
        "$isoroll" compare $name/scene.yaml --plot $name/picture.svg >"$work/out"
    done
    "$isoroll" compare 16_sections/scene.yaml --plot 16_sections/orbit.svg >"$work/out"
    "$isoroll" run 23_written_effects/scene.yaml -o "$work/valley.csv"
    "$isoroll" plot "$work/valley.csv" -o 23_written_effects/valley.png
}

# a trajectory of somebody else
draw_foreign() {
    "$isoroll" plot --scene 14_from_python/scene.yaml 14_from_python/orbit.txt -o 14_from_python/picture.svg
}

# seen NAME SCENE OPTION...: the path in space, from above and from the side
seen() {
    picture=$1
    shift
    "$isoroll" run "$@" -o "$work/path.csv" 2>"$work/out"
    "$isoroll" plot "$work/path.csv" -o "$picture.svg" 2>"$work/out"
}

draw_paths() {
    seen 01_bowling_ball/lane 01_bowling_ball/lane.yaml --t-end 42 --step 0.12 --tol 1e-14
    seen 09_off_the_top/picture 09_off_the_top/scene.yaml --step 0.01
    seen 10_bowl/picture 10_bowl/scene.yaml --t-end 3.2 --step 0.0125
}

# Charts of the others. $1: the picture; gnuplot's commands are the standard input.
chart() {
    { echo "set terminal svg size 640,400 background 'white' font 'DejaVu Sans,Helvetica,Arial,sans-serif,13'"
        echo "set output '$1'; set border 3; set tics nomirror out"
        cat; } | gnuplot
}

draw_contacts() {
    scene=11_rubber_and_marble/scene.yaml
    sed '/resistance: 10/d' "$scene" | "$isoroll" run - -o "$work/rubber.csv"
    "$isoroll" run "$scene" -o "$work/ten.csv"
    sed 's/resistance: 10/resistance: 0/' "$scene" | "$isoroll" run - -o "$work/marble.csv"
    chart 11_rubber_and_marble/picture.svg <<EOF
set datafile separator ","; set xlabel 't'; set ylabel 'n_3: the normal along axis 3 of the ball'
set title 'one throw, three contacts        k = 3/4, J = (1.4, 2.1, 3)'
set key outside bottom center horizontal Left reverse samplen 2
plot '$work/rubber.csv' using 't':'n3' with lines lw 2 lc rgb '#0072B2' title 'rubber: no twist', \
     '$work/ten.csv' using 't':'n3' with lines lw 2 dt (8,3) lc rgb '#E8AA00' title 'it resists twist: c = 10', \
     '$work/marble.csv' using 't':'n3' with lines lw 2 dt (2,3) lc rgb '#D55E00' title 'twists freely: c = 0'
EOF
}

# the crossings of 16_sections, for two pictures
wild=$work/wild.csv
draw_sections() {
    "$isoroll" section 16_sections/scene.yaml --starts 80 --crossings 400 -o "$wild" --plot 16_sections/picture.png \
        2>"$work/out" # a .svg would hold an image
    "$isoroll" section 16_sections/integrable.yaml --starts 40 --crossings 300 -o "$work/tame.csv" \
        --plot 16_sections/integrable.png 2>"$work/out"
    "$isoroll" section 20_rotor/scene.yaml --starts 60 --crossings 300 -o "$work/rotor.csv" \
        --plot 20_rotor/picture.png 2>"$work/out"
}

# one orbit in a potential that separates, and with another coefficient
draw_separable() {
    for c in 1:curve 1.05:sea; do
        sed "s/{c: 1}/{c: ${c%:*}}/" 24_separable/scene.yaml >"$work/separable.yaml"
        "$isoroll" section "$work/separable.yaml" --axis 3 --crossings 1500 -o "$work/separable.csv" \
            --plot "24_separable/${c#*:}.png" 2>"$work/out"
    done
}

# what is in the chaos of 16_sections: periodic orbits, and the curves of the unstable rotation
draw_tangle() {
    [ -e "$wild" ] || draw_sections
    "$isoroll" periodic 16_sections/scene.yaml --period 4 -o "$work/orbits.csv" >"$work/out"
    "$isoroll" splitting 16_sections/scene.yaml --k 1/2 --digits double -o "$work/curves.csv" >"$work/out"
    "$isoroll" plot "$wild" --over "$work/orbits.csv" --over "$work/curves.csv" --window 0:3.1416,-0.5:0.5 \
        --size 1200x690px -o 16_sections/tangle.png
}

# takes minutes: many values of k need 128 bits
draw_splitting() {
    scene=17_why_only_one
    "$isoroll" splitting $scene/scene.yaml --k=-3:-1/8:1/8,1/8:3:1/8 --plot $scene/picture.svg >"$work/out"
}

# about a minute each
draw_sweeps() {
    for sweep in 18_chaotic_share 19_atlas 21_levels; do
        "$isoroll" sweep $sweep/sweep.yaml -o "$work/$sweep.csv"
        "$isoroll" plot "$work/$sweep.csv" -o $sweep/picture.svg
    done
}

# six minutes of one core
draw_rotor_map() {
    "$isoroll" sweep 20_rotor/many.yaml -o "$work/rotors.csv"
    "$isoroll" plot "$work/rotors.csv" --title "A rotor along axis 2" -o 20_rotor/many.svg
}

# half an hour of one core
draw_many() {
    "$isoroll" sweep 18_chaotic_share/many.yaml -o "$work/many.h5"
    "$isoroll" plot "$work/many.h5" -o 18_chaotic_share/many.svg
}

# there is no ball with k = 0: the curve has a gap
draw_chaos() {
    "$build/tests/example_13_chaos" >"$work/orbits.txt"
    awk 'NR > 2 { if (last < 0 && $1 > 0) print ""; print $1, $2; last = $1 }' "$work/orbits.txt" >"$work/chaos.txt"
    chart 13_chaos/picture.svg <<EOF
set title 'chaotic orbits of one energy, by k        J = (1, 2, 5)'
set xlabel 'k (dashed: ±1, integrable; no ball has k = 0)'; set ylabel 'chaotic orbits, of 200'; unset key; set yrange [-3:]; set xrange [-1.1:1.6]
do for [k=-1:1:2] { set arrow from k, graph 0 to k, graph 1 nohead dt (4,3) lc rgb '#404040' }
plot '$work/chaos.txt' using 1:2 with linespoints pt 7 ps 0.8 lw 1.5 lc rgb '#0072B2'
EOF
}

# from Python, with the library of this build
draw_tutorial() {
    python3 -c "import numpy, matplotlib" 2>"$work/out" || { echo "tutorial: no numpy or matplotlib: left out" >&2; return; }
    tutorial=$PWD/22_tutorial
    (cd "$work" && PYTHONPATH=$tutorial/../../apps/python ISOROLL_LIBRARY=$build/libisoroll.so.0 \
        python3 -B "$tutorial/tutorial.py" >out && mv figure.png "$tutorial/picture.png")
}

[ $# -gt 0 ] || set -- spheres foreign paths contacts sections separable tangle splitting sweeps rotor_map many chaos tutorial
for picture; do
    "draw_$picture"
done
ls -l ./*/picture.*
