#!/bin/sh
# hard_effects.sh ISOROLL - effects at their limits through the command: stiff contacts, rest, a ball without
# pressure.
. "$(dirname "$0")/lib.sh"
hard_topic "6d. Effects at their limits: the command"

# effect NUMBERS END: the ball of the others, with an effect
effect() {
    scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" "$2" "${2#-}" | sed 's/3.0]/3.0], D: 0.4/'
    echo "effects: {$1}"
}

# column NAME: of the last row in `out`
column() {
    grep -v '^#' out | awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } END { print $at[name] }'
}

hard_case "twist 1e12" "explicit methods refuse at once, with a way out" "steps of 1e-12 of a turn"
effect "twist: {resistance: 1.0e+12}" 5 >stiff.yaml
for method in taylor rk8pd adams msadams dormand_prince_7_4_5; do
    refuses 2 "take bdf or bsimp" run stiff.yaml --method $method
    hard_refused "this model is stiff" ball $method
done
run 0 run stiff.yaml
run 0 explain stiff.yaml
check "lambda is explained" grep -q 'lambda' out
run 3 compare stiff.yaml
check "compare says why" grep -q "breaks the isomorphism" err
sed 's/^time/solver: {method: taylor}\n&/' stiff.yaml >taylor.yaml
refuses 3 "taylor.yaml:3:18: this model is stiff" run taylor.yaml

hard_case "rest, t = 1e12" "|omega|, and rows" "w has left the doubles long before"
effect "rolling_resistance: {coefficient: 1}, twist: {resistance: 2}, attitude: {}, reactions: {}, clock: {}" 1.0e+12 >rest.yaml
for method in auto taylor rk8pd bsimp bdf adams; do
    run 0 run rest.yaml --method $method --tol 1e-10
    hard_hold "$(column omega1 | tr -d -)" 0 ball $method
    check "$method: numbers" sh -c '! grep -i -q -e nan -e inf out'
done
effect "rolling_resistance: {coefficient: 1}" 200 >fading.yaml
run 0 run fading.yaml --step 1 -o fading.csv
run 0 check fading.csv --max 1e-9

hard_case "backwards" "status 4, and why" "resistance drives the ball"
effect "rolling_resistance: {coefficient: 1}" -1000 >back.yaml
for method in taylor rk8pd bsimp bdf; do
    run 4 run back.yaml --method $method -o part.csv
    check "$method: says why" grep -q "backwards in time resistance drives the ball" err
    hard_refused "backwards in time resistance drives the ball" ball $method
done

hard_case "an upright plane" "losses of contact" "pressure is 0 but for rounding"
effect "gravity: {mgb: 1, up: [0.8, -0.6, 0]}, reactions: {}" 50 | sed 's/k: -1/k: 1/' >wall.yaml
for method in taylor rk8pd bsimp bdf adams; do
    run 0 run wall.yaml --method $method
    hard_hold "$(wc -l <err)" 0 ball $method
done

# All at once, each tiny: the ball with none of them but the twist.
hard_case "all effects of 1e-300" "(omega, n) against the classical ball" "their units differ by 1e300 from those of the ball"
effect "twist: {resistance: 0}" 5 >none.yaml
effect "gravity: {mgb: -1.0e-300, up: [0, 0.6, 0.8]}, field: {linear: [0, 0, 1.0e-300]}, level: {c: 1.0e-300}, twist: {resistance: 1.0e-300}, \
rolling_resistance: {coefficient: 1.0e-300}, attitude: {}, clock: {}" 5 >tiny.yaml
for method in taylor rk8pd bsimp adams; do
    run 0 run none.yaml --method $method -o none.csv
    run 0 run tiny.yaml --method $method -o tiny.csv
    hard_hold "$(difference none.csv tiny.csv)" 1e-9 ball $method
done
finish
