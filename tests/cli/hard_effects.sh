#!/bin/sh
# hard_effects.sh ISOROLL - effects at their limits through the command: stiff contacts, rest, tiny effects, and scenes
# on which the command once hung, or gave a wrong answer without a message.
. "$(dirname "$0")/lib.sh"
hard_topic "6d. Effects at their limits: the command"

# effect NUMBERS END: the ball of the others, with an effect
effect() {
    scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" "$2" "${2#-}" | sed 's/3.0]/3.0], D: 0.4/'
    echo "effects: {$1}"
}

# Orbits at these limits are in C (test_hard_twist, test_hard_rest, test_hard_contact); here is how the command ends.
effect "twist: {resistance: 1.0e+12}" 5 >stiff.yaml
refuses 2 "take bdf or bsimp" run stiff.yaml --method taylor
run 0 run stiff.yaml
prints 'lambda' explain stiff.yaml
run 3 compare stiff.yaml
check "compare says why" grep -q "breaks the isomorphism" err
sed 's/^time/solver: {method: taylor}\n&/' stiff.yaml >taylor.yaml
refuses 3 "taylor.yaml:3:18: this model is stiff" run taylor.yaml

hard_case "rest, t = 1e12" "|omega|, and rows" "w has left the doubles long before"
effect "rolling_resistance: {coefficient: 1}, twist: {resistance: 2}, attitude: {}, reactions: {}, clock: {}" 1.0e+12 >rest.yaml
for method in auto bdf; do # others: test_hard_rest
    run 0 run rest.yaml --method $method --tol 1e-10
    hard_hold "$(cell out -1 omega1 | tr -d -)" 0 ball $method
    check "$method: numbers" sh -c '! grep -i -q -e nan -e inf out'
done
effect "rolling_resistance: {coefficient: 1}" -1000 >back.yaml
run 4 run back.yaml -o part.csv
check "it says why" grep -q "backwards in time resistance drives the ball" err

# All at once, each tiny: the ball with none of them but the twist.
hard_case "all effects of 1e-300" "(omega, n) against the classical ball" "their units differ by 1e300 from those of the ball"
effect "twist: {resistance: 0}" 5 >none.yaml
effect "gravity: {mgb: -1.0e-300, up: [0, 0.6, 0.8]}, field: {linear: [0, 0, 1.0e-300]}, level: {c: 1.0e-300}, twist: {resistance: 1.0e-300}, \
rolling_resistance: {coefficient: 1.0e-300}, attitude: {}, clock: {}" 5 >tiny.yaml
for method in taylor bsimp; do
    run 0 run none.yaml --method $method -o none.csv
    run 0 run tiny.yaml --method $method -o tiny.csv
    hard_hold "$(difference none.csv tiny.csv)" 1e-9 ball $method
done

# --- once wrong

# A homogeneous ball whose stiff contact has nothing left to do: leaps within a step of bdf never ended.
cat >stiff.yaml <<'END'
reduced: {k: 1, J: [1, 1, 1], D: 0.5}
initial:
  normal: [0.06148025313978745, 0.5389296736699947, 0.8401041386367725]
  angular_velocity: [-0.4466900645489276, 1.7251531591612337, 0.1646798923234616]
time: {end: 5, step: 0.02}
effects: {twist: {resistance: 1.0e8}}
END
run 0 run stiff.yaml -o stiff.csv
check "all rows" test "$(rows stiff.csv | wc -l)" -eq 251

# Next to k = 1 the weight's potential is a large constant: it is no measure of the energy.
for k in 0.999999999999999 1.000000000001 0.9999999999; do
    cat >near.yaml <<END
reduced: {k: $k, J: [1.4, 1.5, 1.6], D: 1}
initial: {normal: [0, 0, 1], angular_velocity: [1, 0.3, 0]}
time: {end: 5, step: 5}
effects: {gravity: {mgb: 1, up: [0.6, 0.8, 0]}}
END
    for method in rk8pd taylor; do
        run 0 run near.yaml --method $method --tol 1e-13
        check "k = $k by $method" test "$(rows out | tail -n 1 | awk -F, '{ d = $2 - 4.03580775; print (d * d < 1e-15) }')" = 1
    done
done

finish
