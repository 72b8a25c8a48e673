#!/bin/sh
# exact.sh ISOROLL - the closed solution through the command: run, compare, explain, and scenes that have none.
# Reference states: exact/test_exact.c.
. "$(dirname "$0")/lib.sh"

# --- run
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 100 10 >scene.yaml
{ cat scene.yaml && echo "solver: {backend: exact}"; } >exact.yaml
run 0 run scene.yaml --backend exact --as both
cp out exact.csv
shows -x out '# backend: exact' '# method: exact'
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
check "what steps would not reach" grep -q 'error not known: taylor_extended stopped after' err
run 0 run exact.yaml --verbose
check "its error" grep -q 'error of (omega, n) at most' err

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
prints '"no_exact": ".*k = 0.5' compare half.yaml --json
run 0 explain half.yaml
check "explain: the closed solution" grep -F 'closed solution (--backend exact)' out
check "explain: why not" grep -q '^  .*k = 0.5.*take backend point' out
prints '^  any time at the same cost: ' explain scene.yaml
prints '^evaluated: backend exact, ' explain exact.yaml
check_not "explain: no right-hand side" grep -q '^cost of a right-hand side' out

# effect COLUMN NUMBERS WAY: the effect's value stands there
effect() {
    { cat exact.yaml && echo "effects: {$2}"; } >effect.yaml
    refuses 3 "effect.yaml:5:$1: " run effect.yaml
    says "$3"
}
effect 20 "gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}" "take backend ball"
effect 18 "field: {linear: [0, 0, 0.1]}" "take backend point"
effect 18 "rotor: {momentum: [0.3, 0.4, 0.5]}" "with 'rotor' there is a closed solution only where"
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
