#!/bin/sh
# cost.sh ISOROLL - `isoroll cost`: table, words, CSV, JSON, pictures and choices agree and are right; refusals,
# failures, and interruptions.
. "$(dirname "$0")/lib.sh"
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >scene.yaml
scene 0.7 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >open.yaml

# fields FILE: those of a CSV without its comments, the last, quoted one apart, separated by blanks; - for empty ones
fields() {
    grep -v '^#' "$1" | sed 's/,"\(.*\)"$/,/' | awk -F, '{ for (i = 1; i < NF; i++) printf "%s ", $i == "" ? "-" : $i; print "" }'
}

# cells FILE: how many cells a table has
cells() {
    grep -cE '^  (ball|point|exact) .* %' "$1"
}

# --- everything at once
quietly cost scene.yaml --quick --csv table.csv
cp out table
check "against what" grep -q '^reference: the closed solution$' table
check "its uncertainty" grep -qE '^  uncertain by [0-9.]+e-1[4-9]: its distance from ' table
check "many cells" test "$(cells table)" -ge 70
shows -E table '^  exact +closed solution +- ' '^  ball +rk8pd .* 1\.[0-9]+ times  +[6-9]\.[0-9] of 8  '
sed -n 's|^  for 1e-[0-9]* *--backend \([a-z]*\) --method \([a-z0-9_]*\) --tol \([^:]*\): .*|\1 \2 \3|p' table >choices
check "choices in words" test "$(wc -l <choices)" -ge 2
sed '/^of those that take steps/,$d' table | sed -n 's/^  for 1e-[0-9]* *take \([a-z]*\)\/\([a-z0-9_]*\) at --tol \([^:]*\): .*/\1 \2 \3/p' |
    while read -r backend method tolerance; do
        grep -qE "^  $backend +$method +$tolerance +\*" table || echo "$backend $method $tolerance"
    done >astray
check "what is chosen is on the front" test ! -s astray
fields table.csv >rows
check "CSV: rows" test "$(wc -l <rows)" -gt 100

# --- JSON, and the one choice
quietly cost open.yaml --quick --method taylor --want 1e-8 --json
check "JSON" is_json
check "the reference" grep -q '"reference": "taylor_' out
shows out '^ "choice": {' # the cheapest that reaches it: test_cost
run 0 cost open.yaml --method taylor --want 1e-8
says "expected: error "
check "it reaches what is wanted" awk '/expected: error/ { found = 1; bad = !($4 + 0 <= 1e-8) } END { exit !found || bad }' err
check "options, and nothing else" grep -qxE -e '--backend (ball|point) --method taylor --tol 1e-[0-9]{2}' out # the cheapest, as timed
check "one line" test "$(wc -l <out)" -eq 1
# shellcheck disable=SC2046 # options
run 0 run open.yaml $(cat out)
run 1 cost open.yaml --quick --method rk4 --want 1e-15
says "nothing measured reaches an error of 1e-15"
check "no options" test ! -s out

# --- a ball at rest: no error is the least
scene 0.7 "1.4, 2.1, 3.0" "0, 0, 0" "0.36, 0.48, 0.8" 10 0.5 >rest.yaml
quietly cost rest.yaml --quick
check "its reference is borne out" grep -q '^  uncertain by 0.0e+00: its distance from ' out
check "as many digits as there are, and an end of words" test "$(sed -n '/^what to take/,/^$/p' out | grep -c ' for 1e-16 ')" -eq "$(sed -n '/^what to take/,/^$/p' out | grep -c '^  ')"
run 0 cost rest.yaml --quick --method taylor --want 1e-12
says "expected: error 0.0e+00, time "

# --- what fails is told, and the rest goes on
scene -0.61 "1e-6, 1, 1" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 100 10 >thin.yaml
run 1 cost thin.yaml --method adams --tol 1e-12 --csv thin.csv
shows -E out '^  point adams 1e-12  .*lost the energy' '^  ball +adams +1e-12 '
run 1 cost thin.yaml --method adams --backend point --tol 1e-12 --plot none.svg
says "no picture: nothing has been measured"
check "why, in CSV" grep -qE '^point,adams,.*,".*lost the energy.*"$' thin.csv

# --- refusals
refuses 2 "--want '0': expected a positive number" cost scene.yaml --want 0
refuses 2 "standard output has room for one" cost scene.yaml --csv - --json
refuses 3 "open.yaml:1:" cost open.yaml --backend exact
(ulimit -t 2 && "$isoroll" cost scene.yaml --csv absent/a.csv 2>err) # seconds of processor time; the work takes more
check "refused before the work" test $? -eq 5

# --- interruptions (closed pipes and full disks: hard_faults.sh)
if interruptible "SIGINT"; then
    mkdir stop
    some_cells() { [ "$(cells out)" -ge 5 ]; }
    interrupted_when some_cells cost "$source/examples/02_neumann_shell/scene.yaml" --csv stop/a.csv
    says "interrupted: "
    check "what has been measured" some_cells
    check "as many as it says" grep -q "^isoroll: interrupted: $(cells out) of " err
    check "the table as CSV, and no temporary file" test "$(ls -A stop)" = a.csv
    check "what has not" grep -q ',"not reached"$' stop/a.csv
fi
finish
