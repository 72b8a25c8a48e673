#!/bin/sh
# sweep_pictures.sh ISOROLL - what `explain` tells of sweeps, and what `plot` draws of their results.
. "$(dirname "$0")/lib.sh"

scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >scene.yaml
cat >each.yaml <<'END'
scene: scene.yaml
vary: {k: [0.5, -0.75], start: [[0.4, 0.3]]}
measure: {state: {as: both}, frequencies: {}, splitting: {digits: double}, rotations: {}, backends: {}, error: {tolerance: 1.0e-10}}
until: {time: 400}
END
printf '{scene: scene.yaml, vary: {J1: [0.8, 1, 1.3], k: {from: -1.45, to: 0.8, count: 10}}, measure: {rotations: {}}}' \
    >flow.yaml

# --- explain
run 0 explain each.yaml
shows out '^  2 points in 2 chunks of 1; [0-9]* columns' '^  start: 1 value'
check "each quantity" test "$(grep -c ' a point, up to ' out)" -eq 6
check "time" grep -q 'of processor time; here, with [0-9]* threads, about ' out
run 0 explain flow.yaml
check "a sweep in braces" grep -q '^  30 points' out
sed 's/to: 0.8/to: 0.8x/' flow.yaml >wrong.yaml
refuses 3 "wrong.yaml:1:" explain wrong.yaml
for option in --backend=ball --method=taylor --tol=1e-9 --as=ball --t-end=3 --step=0.5; do
    refuses 2 "options are for scenes" explain flow.yaml "$option"
done

# --- pictures; the script of gnuplot is kept in script.gp
needs gnuplot "pictures"
# block NAME: the rows of a table in the script
block() { sed -n "/^\$$1 <</,/^EOD/p" script.gp | sed '1,2d;$d'; }
mkdir script
printf '#!/bin/sh\ntee script.gp | %s "$@"\n' "$(command -v gnuplot)" >script/gnuplot
chmod +x script/gnuplot
PATH=$PWD/script:$PATH
run 0 sweep each.yaml -o each.csv
run 0 plot each.csv -o curve.svg
check "a curve" grep -q '</svg>' curve.svg
run 0 plot each.csv -o curve.svg --value rotations_trace2
check "its name" grep -q 'trace of the rotation about axis 2' curve.svg
check_not "no raw name" grep -q rotations_trace curve.svg
refuses 3 "there is no such column" plot each.csv -o curve.svg --value nothing
refuses 3 "it varies" plot each.csv -o curve.svg --value k

printf 'scene: scene.yaml\nvary: {k: [-1, -0.5, 0.5, 1]}\nmeasure: {state: {}}\n' >signs.yaml
run 0 sweep signs.yaml -o signs.csv
run 0 plot signs.csv -o curve.svg --value state_n1
check "no curve across k = 0" test "$(block curve | grep -c '^$')" -eq 1
check "k = -1 and k = 1 are marked" test "$(block marks)" = "1 -1
1 1"
if "$isoroll" sweep signs.yaml -o signs.h5 2>err; then
    cp script.gp csv.gp
    run 0 plot signs.h5 -o curve.svg --value state_n1
    check "HDF5: the same curve" test "$(sed -n '/^\$curve/,$p' csv.gp)" = "$(sed -n '/^\$curve/,$p' script.gp)"
else
    skip "HDF5" "this build has none"
fi

run 0 sweep flow.yaml -o flow.csv
run 0 plot flow.csv -o map.svg
check "a cell of a grid reaches half way to its neighbours" test "$(block cells | awk '$1 == 20 { print $5, $6 }' |
    awk '{ printf "%.3f %.3f, ", $1, $2 }')" = "0.900 0.675, 1.150 0.675, 1.150 0.925, 0.900 0.925, 0.900 0.675, "
check "k = -1 is marked, on the vertical axis, k = 1 is not there" test "$(block marks)" = "2 -1"
check_not "no key of grey" grep -q 'no value' map.svg

# of three moments: cells that meet and do not overlap; two that fail are grey
printf 'scene: scene.yaml\nvary: {J: {triangle: 12, ordered: true}}\nmeasure: {rotations: {}}\n' >moments.yaml
run 0 sweep moments.yaml -o moments.csv
run 0 plot moments.csv -o map.svg
check "a cell for each point" test "$(block cells | awk 'NF { print $1 }' | sort -u | wc -l)" -eq 7
sed 's/, ordered: true//' moments.yaml >triangle.yaml
run 1 sweep triangle.yaml -o triangle.csv
run 0 plot triangle.csv -o map.svg
check "a key of grey" grep -q '>no value<' map.svg
check "grey cells are the points that failed" test "$(block cells | awk '$3 == 1 { print $1 }' | sort -u | wc -l)" -eq \
    "$(grep -c 'equal' triangle.csv)"

# --- what no picture shows
sed 's/^vary: .*/vary: {k: [0.5, 0.6], J1: [1, 2], l: [0.3, 0.4],\n  x: [0.1, 0.2]}/' signs.yaml >four.yaml
run 0 sweep four.yaml -o four.csv
refuses 3 "4 numbers vary" plot four.csv -o curve.svg --value state_t
run 0 sweep signs.yaml -o part.csv --shard 1/2
refuses 3 "merge the parts first" plot part.csv -o curve.svg
refuses 2 "of a sweep give --value NAME" plot signs.csv -o curve.svg --columns k,state_n1
run 0 run scene.yaml -o run.csv
refuses 2 "--value is for results of sweeps" plot run.csv -o curve.svg --value s
finish
