#!/bin/sh
# levels.sh ISOROLL - `section`, `chaos`, `check` and `sweep` off the level H = 0: words, files, refusals. Crossings,
# the energy of every row and shares: test_crossings_levels, test_levels_run.
. "$(dirname "$0")/lib.sh"

# --- a point, and a ball with its level
cat >off.yaml <<END
point: {k: 0.5, J: [1.4, 2.1, 3], eps: 1}
initial: {gamma: [0.6, 0, 0.8], M: [0, 0.5, 0]}
time: {end: 10}
END
run 0 run off.yaml -o off.csv
run 0 convert --to ball off.csv -o ball.csv
c=$(sed -n 's/^# level.c: //p' off.csv)
start=$(grep '^[0-9]' ball.csv | head -n 1)
omega=$(echo "$start" | cut -d, -f 2-4) normal=$(echo "$start" | cut -d, -f 5-7)
cat >ball.yaml <<END
reduced: {k: 0.5, J: [1.4, 2.1, 3]}
initial: {normal: [$normal], angular_velocity: [$omega], project: true}
time: {end: 10}
effects: {level: {c: $c}}
END
prints "a turn is a return to the section n_3 = 0" chaos off.yaml --starts 5 --turns 100
prints "n_3 = 0 is global on the level H = -0.04519" explain off.yaml

# --- where the circle of l is closed
sed 's/M: .*/M: [0, 0.1, 0]}/; s/gamma: .*, M/gamma: [1, 0, 0], M/; s/J: [^]]*/J: [1, 2, 5/' off.yaml >low.yaml
run 0 section low.yaml --starts 3 --crossings 3

# --- three equal moments: the potential of the level is a constant, and still the point has its H
sed 's/J: [^]]*/J: [2, 2, 2/' off.yaml >equal.yaml
run 0 run equal.yaml --as point -o equal.csv
run 0 convert --to ball equal.csv -o equal_ball.csv
for file in equal equal_ball; do run 0 check --max 1e-11 $file.csv; done
run 0 section equal.yaml --starts 2 --crossings 3

# --- sweeps over the level
cat >levels.yaml <<END
scene: off.yaml
vary: {level: [-0.1, 0, 2, -9]}
measure: {state: {as: point}}
END
run 1 sweep levels.yaml -o levels.csv
check "four points" test "$(rows levels.csv | wc -l)" -eq 4
sed 's/off.yaml/ball.yaml/; s/as: point/as: both/' levels.yaml >balls.yaml
run 1 sweep balls.yaml -o balls.csv
check "the ball's points" test "$(rows balls.csv | wc -l)" -eq 4
sed '/^effects/d' ball.yaml >free.yaml
refuses_changed levels.yaml 's/off.yaml/free.yaml/' "'level' needs 'effects: {level: {c: 1}}'" sweep
finish
