#!/bin/sh
# exact.sh ISOROLL - the closed solution through the command: reference states, run, compare, explain, and scenes
# that have none.
. "$(dirname "$0")/lib.sh"

# --- every reference orbit with k = 1 and k = -1, at once at its time
grep '^open' "$source/tests/reference/free_ball.csv" | awk -F, '$2 * $2 == 1' >lines
check "10 rows with k = 1 or -1" test "$(wc -l <lines)" -eq 10
worst=0 worst_clock=0
while IFS=, read -r id k J1 J2 J3 n1 n2 n3 w1 w2 w3 t rest; do
    scene "$k" "$J1, $J2, $J3" "$w1, $w2, $w3" "$n1, $n2, $n3" "$t" "$t" >scene.yaml
    run 0 run scene.yaml --backend exact --as both
    silent
    read -r error clock_error <<END
$(tail -n 1 out | awk -F, -v t="$t" -v rest="$rest" '
    { # t tau s omega1..3 n1..3; the rest of the line: w1..3 n1..3 s
        split(rest, r, ",")
        for (i = 1; i <= 6; i++) sum += ($(3 + i) - r[i]) ^ 2
        if ($1 + 0 != t + 0 || NF != 15) { print "not the row"; exit }
        printf "%.3g %.3g\n", sqrt(sum), $3 < r[7] ? 1 - $3 / r[7] : $3 / r[7] - 1
    }')
END
    at_most "$id: error of (w,n)" "$error" 1e-12
    at_most "$id: error of s" "$clock_error" 1e-12
    worst=$(larger "$worst" "$error")
    worst_clock=$(larger "$worst_clock" "$clock_error")
done <lines
echo "reference to t = 1000: (w,n) $worst, s $worst_clock"

# --- run
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 100 10 >scene.yaml
{ cat scene.yaml && echo "solver: {backend: exact}"; } >exact.yaml
run 0 run scene.yaml --backend exact --as both
cp out exact.csv
check "the file says which backend" grep -qx '# backend: exact' out
check "and which method" grep -qx '# method: exact' out
check_not "but no tolerance" grep -q '^# tolerance' out
run 0 run exact.yaml --as both
check "backend in the scene" cmp out exact.csv
run 0 run exact.yaml --method auto --as both
check "method auto" cmp out exact.csv
run 0 check exact.csv --max 1e-12

# any time, in any order, is asked at once
printf '1e12 50 -1e6 0 1e12\n' >times
run 0 run exact.yaml --as both --times times --verbose
check "states, and no steps" grep -q '5 rows; backend exact: 4 states$' err
check "the same row again" test "$(rows out | sed -n 1p)" = "$(rows out | sed -n 5p)"
check "the row among others" test "$(rows out | sed -n 2p)" = "$(sed -n '/^50,/p' exact.csv)"
check "what steps would not reach" grep -q 'error not known: taylor_extended stopped after' err
run 0 run exact.yaml --verbose
check "its error" grep -q 'error of (omega, n) at most' err
at_most "its error" "$(sed -n 's/.*(omega, n) at most \([^,]*\),.*/\1/p' err)" 1e-12

# --- compare
compared() {
    check "compare: rows of exact" test "$(grep -cE '^ +[-0-9.e+]+ +exact ' out)" -eq "$1"
}
run 0 compare scene.yaml
silent
compared 12
check "compare: its line" grep -q '^backend exact  the closed solution: 10 states, ' out
check "compare: drifts" test "$(grep -E '^  (of|ball +F_shell) ' out | grep -oE 'exact|[0-9.]+e-[0-9]+' | wc -l)" -eq 4
for backend in ball point; do check "compare: $backend from exact" grep -q "^  $backend, exact " out; done
run 0 compare exact.yaml --json
silent
for name in exact from_exact; do check "compare --json: $name" grep -q "\"$name\": {" out; done
check_not "compare --json: a reason" grep -q no_exact out
run 0 compare scene.yaml --method strang --tol 1e-3 --rows 2
compared 4

# --- where there is none
scene 0.5 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >half.yaml
cat >body.yaml <<END
solver: {backend: exact}
ball: {mass: 6.8, radius: 0.1092, inertia: [0.0270, 0.0274, 0.0283]}
surface: {kind: outside, radius: 0.3}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 100, step: 0.1}
END
refuses 3 "half.yaml:1:14: " run half.yaml --backend exact
for words in "k = 0.5" "only where two moments of inertia are equal, or in a principal plane" "take backend point"; do says "$words"; done
refuses 3 "body.yaml:3:10: " run body.yaml
refuses 3 "body.yaml:3:10: " explain body.yaml
run 0 run half.yaml --backend point
run 0 compare half.yaml
silent
compared 0
check "compare: why not" grep -q '^exact: .*k = 0.5' out
run 0 compare half.yaml --json
check "compare --json: why not" grep -q '"no_exact": ".*k = 0.5' out
run 0 explain half.yaml
check "explain: why not" grep -A 1 -F 'closed solution (--backend exact)' out
check "explain: why not" grep -q '^  .*k = 0.5.*take backend point' out
run 0 explain scene.yaml
check "explain: that there is one" grep -q '^  any time at the same cost: ' out
run 0 explain exact.yaml
check "explain: backend exact" grep -q '^evaluated: backend exact, ' out
check_not "explain: no right-hand side" grep -q '^cost of a right-hand side' out

# effect COLUMN NUMBERS WAY: the effect's value stands there
effect() {
    { cat exact.yaml && echo "effects: {$2}"; } >effect.yaml
    refuses 3 "effect.yaml:5:$1: " run effect.yaml
    says "$3"
}
effect 20 "gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}" "take backend ball"
effect 18 "field: {linear: [0, 0, 0.1]}" "take backend point"
{ cat exact.yaml && echo "effects: {clock: {}}"; } >clock.yaml
run 0 run clock.yaml
check "the clocks are no hindrance" test "$(columns out | cut -d, -f1-3)" = t,tau,s

# --- it is a backend, and nothing else
refuses 2 "leave the method out, or take backend point" run exact.yaml --method taylor
{ cat scene.yaml && echo "solver: {method: taylor}"; } >method.yaml
refuses 3 "method.yaml:4:18: backend exact does not integrate" run method.yaml --backend exact
run 0 run method.yaml --backend exact --method auto
refuses 2 "--to 'exact': expected ball or point" convert --to exact exact.csv
finish
