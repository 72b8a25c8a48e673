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
prints '^  30 points' explain flow.yaml
refuses_changed flow.yaml 's/to: 0.8/to: 0.8x/' "bad.csv:1:" explain
for option in --backend=ball --method=taylor --tol=1e-9 --as=ball --t-end=3 --step=0.5; do
    refuses 2 "options are for scenes" explain flow.yaml "$option"
done

# --- pictures (curves, maps, cells, what is grey: test_tables)
needs gnuplot "pictures"
run 0 sweep each.yaml -o each.csv
run 0 plot each.csv -o curve.svg
run 0 plot each.csv -o curve.svg --value rotations_trace2
check "its name" grep -q 'trace of the rotation about axis 2' curve.svg
refuses 3 "there is no such column" plot each.csv -o curve.svg --value nothing
refuses 3 "it varies" plot each.csv -o curve.svg --value k

printf 'scene: scene.yaml\nvary: {k: [-1, -0.5, 0.5, 1]}\nmeasure: {state: {}}\n' >signs.yaml
run 0 sweep signs.yaml -o signs.csv
run 0 plot signs.csv -o curve.svg --value state_n1

# --- what no picture shows
sed 's/^vary: .*/vary: {k: [0.5, 0.6], J1: [1, 2], l: [0.3, 0.4],\n  x: [0.1, 0.2]}/' signs.yaml >four.yaml
run 0 sweep four.yaml -o four.csv
refuses 3 "4 numbers vary" plot four.csv -o curve.svg --value state_t
run 0 sweep signs.yaml -o part.csv --shard 1/2
refuses 3 "merge the parts first" plot part.csv -o curve.svg
refuses 2 "--window is for sections" plot signs.csv -o curve.svg --window 0:1,0:1
refuses 2 "of a sweep give --value NAME" plot signs.csv -o curve.svg --columns k,state_n1
run 0 run scene.yaml -o run.csv
refuses 2 "--value is for results of sweeps" plot run.csv -o curve.svg --value s
finish
