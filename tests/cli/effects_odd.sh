#!/bin/sh
# effects_odd.sh ISOROLL - scenes with effects on which the command once hung, or gave a wrong answer without a
# message.
. "$(dirname "$0")/lib.sh"

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
    for method in rk8pd bsimp dormand_prince taylor; do
        run 0 run near.yaml --method $method --tol 1e-13
        check "k = $k by $method" test "$(rows out | tail -n 1 | awk -F, '{ d = $2 - 4.03580775; print (d * d < 1e-15) }')" = 1
    done
done

# Nothing presses the ball at the start, and a moment later the support would have to pull.
cat >grazing.yaml <<'END'
reduced: {k: 0.5, J: [1.5, 1.5, 1.5], D: 1}
initial: {normal: [0, 0, 1], angular_velocity: [1, 0, 0]}
time: {end: 5}
effects: {gravity: {mgb: 0.5, up: [0, 0, 1]}, reactions: {}}
END
run 0 run grazing.yaml
says "contact is lost at 0"
check "one row" test "$(rows out | wc -l)" -eq 1

# Files: reactions on a horizontal plane, a level with attitude, rounded rows off the level, a lost line.
cat >level_plane.yaml <<'END'
reduced: {k: 1, J: [1.4, 1.5, 1.6], D: 1}
initial: {normal: [0, 0, 1], angular_velocity: [1, 0.3, 0]}
time: {end: 10}
effects: {gravity: {mgb: 1, up: [0, 0, 1]}, reactions: {}}
END
run 0 run level_plane.yaml -o file.csv
run 0 check file.csv --max 1e-9
run 0 explain level_plane.yaml
check "the horizontal plane is reported" grep -q "'gravity' has no torque here" out
cat >off.yaml <<'END'
point: {k: -1, J: [1, 2, 2.5], eps: 0.5}
initial: {gamma: [0.6, 0, 0.8], M: [0, 0.3, 0]}
time: {end: 20, step: 1}
effects: {attitude: {}}
END
run 0 run off.yaml --as both -o file.csv
run 0 check file.csv --max 1e-9
run 0 run off.yaml --as point -o file.csv
awk -F, -v OFS=, '/^[0-9]/ { for (i = 1; i <= NF; i++) $i = sprintf("%.6g", $i) } 1' file.csv >rounded.csv
run 1 check rounded.csv --max 1e-7
run 0 check rounded.csv --max 1e-3
run 0 run near.yaml -o file.csv
grep -v '^# effects' file.csv >lost.csv
run 3 convert --to point lost.csv
says "no line '# effects' that names 'gravity'"
finish
