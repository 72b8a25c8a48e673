#!/bin/sh
# sweep_pictures.sh ISOROLL - what `explain` tells of sweeps, and what `plot` draws of their results.
. "$(dirname "$0")/lib.sh"

scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >scene.yaml
sweep_of_all >each.yaml
printf '{scene: scene.yaml, vary: {J1: [0.8, 1, 1.3], k: {from: -1.45, to: 0.8, count: 10}}, measure: {rotations: {}}}' \
    >flow.yaml

# --- explain
run 0 explain each.yaml
check "points" grep -q '^  2 points in 2 chunks of 1; [0-9]* columns' out
check "what varies" grep -q '^  start: 1 value' out
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
has gnuplot "pictures" || { finish && exit; }
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
check "no curve across k = 0" test "$(sed -n '/^\$curve <</,/^EOD/p' script.gp | grep -c '^$')" -eq 1
check "k = 1 is marked" grep -q '^set arrow from first 1, graph 0 ' script.gp
if "$isoroll" sweep signs.yaml -o signs.h5 2>err; then
    cp script.gp csv.gp
    run 0 plot signs.h5 -o curve.svg --value state_n1
    check "HDF5: the same curve" test "$(sed -n '/^\$curve/,$p' csv.gp)" = "$(sed -n '/^\$curve/,$p' script.gp |
        sed 's/signs.h5/signs.csv/')"
else
    skip "HDF5" "this build has none"
fi

run 0 sweep flow.yaml -o flow.csv
run 0 plot flow.csv -o map.svg
check "a grid is drawn as cells" test "$(grep -c 'boxxyerror fs solid' script.gp)" -eq 1
check "a cell reaches half way to its neighbours" grep -q '^1 0.8[0-9]* [^ ]* 0.9[0-9]* 1.1[0-9]* 0.67[0-9]* 0.92[0-9]*$' script.gp
check "k = -1 is marked, on the vertical axis" grep -q '^set arrow from graph 0, first -1 ' script.gp
check_not "k = 1 is not: it is not there" grep -q 'first 1' script.gp

# of three moments: squares that do not overlap
printf 'scene: scene.yaml\nvary: {J: {triangle: 12, ordered: true}}\nmeasure: {rotations: {}}\n' >moments.yaml
run 0 sweep moments.yaml -o moments.csv
run 0 plot moments.csv -o map.svg
sed -n '/^\$value0 <</,/^EOD/p' script.gp | awk 'NF == 7 && $1 != "NaN"' >squares
check "squares" test "$(wc -l <squares)" -gt 5
check "no two overlap" test "$(awk '
    { for (i = 1; i < NR; i++) n += $4 + 1e-9 < r[i] && $5 > l[i] + 1e-9 && $6 + 1e-9 < t[i] && $7 > b[i] + 1e-9
      l[NR] = $4; r[NR] = $5; b[NR] = $6; t[NR] = $7; empty += !($5 > $4 && $7 > $6) }
    END { print n + empty }' squares)" -eq 0

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
