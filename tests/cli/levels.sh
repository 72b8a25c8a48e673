#!/bin/sh
# levels.sh ISOROLL - `section`, `chaos`, `check` and `sweep` off the level H = 0: reference crossings of points and of
# balls, the energy of every row, refusals.
. "$(dirname "$0")/lib.sh"

# field FILE N: the N-th number of the last row
field() {
    tail -n 1 "$1" | cut -d, -f "$2"
}

# near NAME A B BOUND: |A - B| <= BOUND (1 + |B|)
near() {
    checks=$((checks + 1))
    awk -v a="$2" -v b="$3" -v e="$4" 'BEGIN { d = a - b; if (d < 0) d = -d; m = b < 0 ? -b : b
        exit !(d <= e * (1 + m)) }' || fail "$1: $2, not $3 to $4"
}

# --- crossings in quadruple precision, by both models; the bound is 1e-11 and what 20 returns make of it
count=0
while IFS=, read -r id k J1 J2 J3 eps M1 M2 M3 g1 g2 g3 H axis crossing s t Mc1 Mc2 Mc3 gc1 gc2 gc3; do
    case $id in lev*) ;; *) continue ;; esac
    count=$((count + 1))
    cat >ref.yaml <<END
point: {k: $k, J: [$J1, $J2, $J3], eps: $eps}
initial: {gamma: [$g1, $g2, $g3], M: [$M1, $M2, $M3], project: true}
time: {end: 1}
END
    for model in ball point; do
        run 0 section ref.yaml --model "$model" --crossings "$crossing" --as point --quiet -o ref.csv
        silent
        check "$id, $model: axis" grep -q "^# axis: $axis\$" ref.csv
        check "$id, $model: global" grep -q "^# section: n$axis = 0, increasing; global\$" ref.csv
        near "$id, $model: t" "$(field ref.csv 3)" "$t" 1e-10
        near "$id, $model: s" "$(field ref.csv 5)" "$s" 1e-10
        near "$id, $model: M1" "$(field ref.csv 8)" "$Mc1" 1e-10
        near "$id, $model: M2" "$(field ref.csv 9)" "$Mc2" 1e-10
        near "$id, $model: M3" "$(field ref.csv 10)" "$Mc3" 1e-10
        near "$id, $model: gamma1" "$(field ref.csv 11)" "$gc1" 1e-10
        near "$id, $model: gamma2" "$(field ref.csv 12)" "$gc2" 1e-10
        near "$id, $model: gamma3" "$(field ref.csv 13)" "$gc3" 1e-10
    done
done <"$source/tests/reference/levels.csv"
check "reference rows" test "$count" -eq 18

# --- all orbits of a section have the H of the scene: once the further ones had 0
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
for scene in off ball; do
    for model in ball point both; do
        run 0 section $scene.yaml --starts 5 --at "0.1,0.2;3,-0.5" --crossings 4 --model $model --as both -o rows.csv
        check "$scene by $model: 8 orbits" test "$(rows rows.csv | wc -l)" -eq 32
        rows rows.csv | awk -F, -v OFMT=%.17g '{ q = 1.4 * $(17) ^ 2 + 2.1 * $(18) ^ 2 + 3 * $(19) ^ 2
            print ($(14) ^ 2 + $(15) ^ 2 + $(16) ^ 2) / 2 - 1 / q ^ 2 }' >H
        check "$scene by $model: H of 32 rows" test "$(wc -l <H)" -eq 32
        for H in $(sort -g H | sed -n '1p;$p'); do near "$scene by $model: H" "$H" -0.045190286355368 1e-12; done
    done
done
run 0 chaos off.yaml --starts 5 --turns 100
check "chaos: a turn is a return" grep -q "a turn is a return to the section n_3 = 0" out
run 0 explain off.yaml
check "explain: the section and its level" grep -q "n_3 = 0 is global on the level H = -0.04519" out

# --- where the circle of l is closed
sed 's/M: .*/M: [0, 0.1, 0]}/; s/gamma: .*, M/gamma: [1, 0, 0], M/; s/J: [^]]*/J: [1, 2, 5/' off.yaml >low.yaml
run 0 section low.yaml --starts 3 --crossings 3
refuses 3 "n_3 = 0 is closed at l = 1.5 on the level H = " section low.yaml --at 1.5,0
refuses 3 "n_1 = 0 is closed everywhere on the level" section low.yaml --axis 1 --starts 2

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
rows levels.csv | head -n 3 | awk -F, -v OFMT=%.17g -v names="$(columns levels.csv)" '
    BEGIN { n = split(names, name, ","); for (i = 1; i <= n; i++) at[name[i]] = i }
    { for (i = 1; i <= 3; i++) { M[i] = $(at["state_M" i]); g[i] = $(at["state_gamma" i]) }
      q = 1.4 * g[1] ^ 2 + 2.1 * g[2] ^ 2 + 3 * g[3] ^ 2
      print ((M[1] ^ 2 + M[2] ^ 2 + M[3] ^ 2) / 2 - 1 / q ^ 2) * 2.1 ^ 2 }' >found
near "level -0.1" "$(sed -n 1p found)" -0.1 1e-11
near "level 0" "$(sed -n 2p found)" 0 1e-11
near "level 2" "$(sed -n 3p found)" 2 1e-11
sed 's/off.yaml/ball.yaml/; s/as: point/as: both/' levels.yaml >balls.yaml
run 1 sweep balls.yaml -o balls.csv
check "the ball's points" test "$(rows balls.csv | wc -l)" -eq 4
sed '/^effects/d' ball.yaml >free.yaml
sed 's/off.yaml/free.yaml/' levels.yaml >free_sweep.yaml
refuses 3 "'level' needs 'effects: {level: {c: 1}}'" sweep free_sweep.yaml
finish
