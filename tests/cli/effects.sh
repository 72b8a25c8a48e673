#!/bin/sh
# effects.sh ISOROLL - the effects through the command: columns, lines, check, conversion to the other model and back,
# loss of contact, refusals with their place. Reference orbits are in reference.sh, mistakes in scenes in
# bad_effects.txt.
. "$(dirname "$0")/lib.sh"
ball=omega1,omega2,omega3,n1,n2,n3 point=M1,M2,M3,gamma1,gamma2,gamma3
gravity="gravity: {g: 9.81, up: [0.6, 0, 0.8]}"
field="field: {quadratic: [[1, 0.2, 0], [0.2, 2, 0.1], [0, 0.1, 0]], linear: [0.1, 0.2, 0.3]}"
level="level: {c: 0.3}"
twist="twist: {resistance: 3}"
resistance="rolling_resistance: {coefficient: 0.1}"
rotor="rotor: {momentum: [0.3, -0.2, 0.5]}"
attitude="attitude: {quaternion: [0.5, 0.5, -0.5, 0.5]}"

# physical KIND RADIUS EFFECT...: a ball and a surface; RADIUS - for a plane
physical() {
    case $2 in -) surface="{kind: $1}" ;; *) surface="{kind: $1, radius: $2}" ;; esac
    cat <<END
ball: {mass: 2, radius: 1, inertia: [0.7, 0.8, 0.9]}
surface: $surface
initial: {normal: [0.6, 0, 0.8], angular_velocity: [0.24, 0.7, -0.18]}
time: {end: 2, step: 0.25}
END
    shift 2
    [ $# -eq 0 ] || echo "effects:"
    for line; do echo "  $line"; done
}

# has COLUMNS [OPTION...]: the header line that scene.yaml gives
has() {
    wanted_columns=$1
    shift
    run 0 run scene.yaml "$@"
    check "columns of $(sed -n '6,$p' scene.yaml | tr '\n' ' ')$*: $(columns out)" test "$(columns out)" = "$wanted_columns"
}

# --- columns, and the lines that say what was simulated
e=e1,e2,e3 stands=q0,q1,q2,q3,contact1,contact2,contact3,trace1,trace2,trace3,centre1,centre2,centre3
pressed=N1,N2,N3,pressure,friction,mu,lambda
physical outside 3 >scene.yaml
has t,$ball
physical outside 3 "$gravity" >scene.yaml
has t,$ball,$e
has t,$ball,$e --as ball
physical outside 3 "$field" "$level" "$twist" "$resistance" "$rotor" >scene.yaml
has t,$ball
physical outside 3 "attitude: {}" >scene.yaml
has t,$ball,$stands
check "the quaternion at the start, unless given" test "$(rows out | head -n 1 | cut -d, -f8-11)" = 1,0,0,0
physical outside 3 "$gravity" "attitude: {}" >scene.yaml
run 0 run scene.yaml
check "with gravity the file states an attitude in which axis 3 is up" awk '
    $2 == "gravity.up:" { split($0, x, " "); for (i = 1; i <= 3; i++) u[i] = x[i + 2] }
    $2 == "attitude.quaternion:" { split($0, x, " "); for (i = 0; i < 4; i++) q[i] = x[i + 3] }
    END {
        for (i = 1; i <= 3; i++) { j = i % 3 + 1; k = j % 3 + 1; b[i] = q[j] * u[k] - q[k] * u[j]; along += q[i] * u[i] }
        square = q[0] ^ 2 - q[1] ^ 2 - q[2] ^ 2 - q[3] ^ 2
        for (i = 1; i <= 3; i++) s[i] = square * u[i] + 2 * along * q[i] + 2 * q[0] * b[i]
        exit !(s[1] ^ 2 + s[2] ^ 2 + (s[3] - 1) ^ 2 < 1e-30)
    }' out
physical outside 3 "clock: {}" >scene.yaml
has t,tau,s,$ball
physical outside 3 "$gravity" "reactions: {}" >scene.yaml
has t,$ball,$e,$pressed
physical plane - "reactions: {two_sided: true}" >scene.yaml
has t,$ball,N1,N2,N3,pressure,friction,lambda
physical inside 3 "$field" "$level" "$rotor" "$attitude" "clock: {}" >scene.yaml
has t,tau,s,$ball,$point,$stands --as both
physical inside 3 "clock: {}" "reactions: {two_sided: true}" "$attitude" "$rotor" "$resistance" "$twist" "$level" "$field" "$gravity" >scene.yaml
has t,tau,s,$ball,$e,$stands,$pressed
check "the lines, whatever the order in the scene" test "$(sed -n 's/^# \([a-zA-Z_.]*\): .*/\1/p' out | tr '\n' ' ')" = \
    "model k J D radius gravity.mgb gravity.up field.quadratic field.linear level.c twist.resistance \
rolling_resistance.coefficient rotor.momentum attitude.quaternion effects backend method tolerance isoroll "
check "the line effects" grep -qx '# effects: gravity field level twist rolling_resistance rotor attitude reactions' out
check "mgb has the sign of b" grep -qx '# gravity.mgb: -19.62[0-9]*' out
check "9 rows" test "$(rows out | wc -l)" -eq 9
cp out everything.csv
run 0 run scene.yaml --t-end 1 --step 0.5
rows out >a
rows everything.csv | awk -F, '$1 == 0 || $1 == 0.5 || $1 == 1' >b
check "rows do not depend on the others" cmp a b
echo "1.5 -1 0.5, 2 -0.25 0 1.5" >asked
run 0 run scene.yaml --times asked
check "times in the order asked" test "$(rows out | cut -d, -f1 | tr '\n' ' ')" = "1.5 -1 0.5 2 -0.25 0 1.5 "
for t in 0 0.5 1.5 2; do
    rows out | grep "^$t," | sort -u >a
    rows everything.csv | grep "^$t," >b
    check "t = $t in any order" cmp a b
done

# --- a ball one can hold, and the same by k, J and D: lengths are in |b|, forces in energy/|b|
cat >physical.yaml <<END
ball: {mass: 8, radius: 0.5, inertia: [2, 3, 4]}
surface: {kind: inside, radius: 1.5}
initial: {normal: [0.6, 0, 0.8], angular_velocity: [0.24, 0.7, -0.18]}
time: {end: 2, step: 0.25}
effects: {gravity: {g: 9.75, up: [-0.6, 0, -0.8]}, attitude: {}, reactions: {}, $twist}
END
scene 1.5 "4, 5, 6" "0.24, 0.7, -0.18" "0.6, 0, 0.8" 2 0.25 >reduced.yaml
echo "effects: {gravity: {mgb: -39, up: [-0.6, 0, -0.8]}, attitude: {}, reactions: {}, twist: {resistance: 3, D: 2}}" >>reduced.yaml
run 0 run physical.yaml -o physical.csv
run 0 run reduced.yaml -o reduced.csv
awk -F, -v OFS=, -v CONVFMT=%.17g '/^#/ { print; next } !n++ { for (i = 1; i <= NF; i++) name[i] = $i; print; next }
    { for (i = 1; i <= NF; i++) {
        if (name[i] ~ /^(contact|trace|centre)/) $i /= 2
        if (name[i] ~ /^(N.|pressure|friction)$/) $i *= 2
    } print }' reduced.csv >scaled.csv
at_most "physical and reduced" "$(difference physical.csv scaled.csv)" 1e-14
sed 's/, D: 2}/}/; s/reduced: {/reduced: {D: 2, /' reduced.yaml >elsewhere.yaml
run 0 run elsewhere.yaml
check "D in 'reduced' or in the effect" cmp out reduced.csv

# --- check: what solves its model passes
# (each number and column of each effect: test_check)
run 0 check --max 1e-11 everything.csv
silent
sed '/^# effects/d' everything.csv >damaged.csv
"$isoroll" check --max 1e-6 damaged.csv >out 2>err
check "without its line effects it is another motion" test $? -ne 0
for kind in "plane -" "outside 3" "inside 3" "shell 0.6"; do
    # shellcheck disable=SC2086 # two words
    physical $kind "gravity: {g: 9.81, up: [0.48, 0.6, 0.64]}" "$field" "$level" >scene.yaml
    run 0 run scene.yaml -o a.csv
    run 0 check --max 1e-11 a.csv
    sed 's/^# field.linear: 0.1/&01/' a.csv >damaged.csv
    run 1 check --max 1e-6 damaged.csv
    check "$kind: a residual is named" grep -q "ABOVE THE BOUND" out
    # shellcheck disable=SC2086
    physical $kind "$twist" "$resistance" >scene.yaml
    run 0 run scene.yaml --t-end -1 --step 0.125 -o a.csv
    run 0 check --max 1e-11 a.csv
done
physical outside 3 "$gravity" "$twist" "$attitude" >scene.yaml
for method in msbdf bsimp verner_8_5_6; do
    run 0 run scene.yaml --method $method --tol 1e-13 -o $method.csv
    run 0 check --max 1e-8 $method.csv
done
physical outside 3 "$attitude" >scene.yaml
run 0 run scene.yaml -o stands.csv
run 0 check --max 1e-12 stands.csv
awk -F, -v OFS=, -v CONVFMT=%.17g '/^[0-9]/ && ++row == 3 { $8 *= 1 + 1e-6 } { print }' stands.csv >damaged.csv
run 1 check --max 1e-9 damaged.csv
check "a quaternion that is not unit" grep -q '^  ball |q|  *[0-9.e-]*  *3 .*ABOVE' out

# conserved INTEGRAL FILE: `check` looks at it
conserved() {
    run 0 check --max 1e-11 "$2"
    check "$2: $1 is checked" grep -qF "ball $1 " out
}
physical outside 3 "$gravity" >scene.yaml
run 0 run scene.yaml -o heavy.csv
conserved h heavy.csv
conserved "|e|" heavy.csv
physical plane - "gravity: {g: 9.81, up: [0.48, 0.6, 0.64]}" "attitude: {}" >scene.yaml
run 0 run scene.yaml -o tilted.csv
conserved h tilted.csv # its potential is the height of the centre
conserved e.n tilted.csv
physical shell 0.6 "twist: {resistance: 0}" >scene.yaml
run 0 run scene.yaml -o classical.csv
conserved K.K classical.csv
conserved h classical.csv
check_not "classical.csv: no AK.n but at k = -1" grep -qF "ball AK.n " out
physical shell 0.5 "twist: {resistance: 0}" >scene.yaml
run 0 run scene.yaml -o marble.csv
conserved AK.n marble.csv
run 0 explain scene.yaml
check "AK.n is explained" sh -c "sed '/^integrals that do not/q' out | grep -q AK.n"
physical shell 0.6 "$resistance" >scene.yaml
run 0 run scene.yaml -o slower.csv
run 0 check slower.csv
check_not "under resistance no energy is checked" grep -q '^ball h ' out

# a file's lines are read with their mistakes
sed 's/^# effects: .*/# effects: gravity wind/' heavy.csv >bad.csv
refuses 3 "bad.csv: there is no effect 'wind'" check bad.csv
sed '/^# gravity.mgb/d' heavy.csv >bad.csv
refuses 3 "effect 'gravity' needs a line '# gravity.mgb: ...'" check bad.csv
sed 's/^# gravity.up: .*/# gravity.up: 0 1/' heavy.csv >bad.csv
refuses 3 "'gravity.up: 0 1' should be 3 finite numbers" check bad.csv
sed '/^#/!s/e3/z3/' heavy.csv >bad.csv
refuses 3 "unknown column 'z3'" check bad.csv
awk -F, -v OFS=, '/^#/ { print; next } { print $1, $2, $3, $4, $5, $6, $7 }' heavy.csv >bad.csv
refuses 3 "no column 'e1', without which 'gravity' is not known" check bad.csv
sed '/^# D:/d' everything.csv >bad.csv
refuses 3 "'twist' needs the ball's mass and radius" check bad.csv

# --- field and level: both models, there and back
states() {
    awk -F, -v OFS=, '/^#/ { next } !n++ { for (i = 1; i <= NF; i++) if ($i !~ /^(t|tau|s)$/) keep[++m] = i }
        { for (j = 1; j <= m; j++) printf "%s%s", $keep[j], j < m ? "," : "\n" }' "$1"
}
worst_states=0 worst_clock=0 worst_backends=0

# round_trip NAME K FROM: scene.yaml by both backends; its file of model FROM to the other model and back
round_trip() {
    case $3 in ball) other=point ;; *) other=ball ;; esac
    run 0 run scene.yaml --as both -o both.csv
    run 0 run scene.yaml --as both --backend "$other" -o other.csv
    error=$(difference both.csv other.csv)
    at_most "$1: backends" "$error" 1e-9
    worst_backends=$(larger "$worst_backends" "$error")
    run 0 run scene.yaml --as "$3" -o a.csv
    run 0 convert --quiet --to $other a.csv -o b.csv
    silent
    run 0 convert --quiet --to "$3" b.csv -o c.csv
    check "$1: the same columns" test "$(columns a.csv)" = "$(columns c.csv)"
    check "$1: the same lines" test "$(grep '^# [kJhefl]' a.csv)" = "$(grep '^# [kJhefl]' c.csv)"
    states a.csv >a
    states c.csv >c
    error=$(difference a c 2.220446049250313e-16)
    at_most "$1: states, ulp" "$error" "$(awk -v k="$2" 'BEGIN { k = k < 0 ? -k : k; x = 1 / (2 * k); print 4 * (x > 1 ? x : 1) }')"
    worst_states=$(larger "$worst_states" "$error")
    error=$(difference a.csv c.csv)
    at_most "$1: with the clock" "$error" 1e-11
    worst_clock=$(larger "$worst_clock" "$error")
    at_most "$1: converted and integrated" "$(difference b.csv both.csv)" 1e-9
    run 0 check --max 1e-10 b.csv
    run 0 check --max 1e-10 both.csv
}

for k in 1 -1 0.5 -0.4 3; do
    for effects in "$level" "$field" "$field, $level" "level: {c: -2}" "$field, attitude: {}, clock: {}"; do
        scene $k "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 4 0.5 >scene.yaml
        echo "effects: {$effects}" >>scene.yaml
        case $effects in *attitude*) ;; *) round_trip "k = $k, $effects" $k ball ;; esac
        run 0 compare scene.yaml
        at_most "k = $k, $effects: compare" "$(sed -n '$s/^the same orbit: .* agree to //p' out)" 1e-10
    done
    for effects in "$field" "$level" "level: {}" "$field, level: {c: -0.7}"; do
        cat >scene.yaml <<END
point: {k: $k, J: [1.4, 2.1, 3.0]}
initial: {gamma: [0.6, 0, 0.8], M: [0.64, 1, -0.48]}
time: {end: 3, step: 0.25}
effects: {$effects}
END
        round_trip "point, k = $k, $effects" $k point
    done
done
echo "there and back: states $worst_states ulp, clock $worst_clock; backends $worst_backends"

# a rest is a start where a potential moves the ball
scene 0.5 "1.4, 2.1, 3.0" "0, 0, 0" "0.36, 0.48, 0.8" 2 0.5 >scene.yaml
echo "effects: {$field}" >>scene.yaml
run 0 run scene.yaml --as both -o both.csv
run 0 check --max 1e-10 both.csv
run 0 run scene.yaml --as both --backend point -o other.csv
at_most "from rest: backends" "$(difference both.csv other.csv)" 1e-11
check "it moves" awk -F, '/^[1-9]/ && $4 ^ 2 + $5 ^ 2 + $6 ^ 2 < 1e-4 { bad = 1 } END { exit bad }' both.csv

# where the potential passes 0, next to nothing of the energy moves the ball: a method must not be held up by that
scene 0.75 "1.4, 2.1, 3.0" "0, 0, 0" "0.36, 0.48, 0.8" 1 0.5 >scene.yaml
echo "effects: {gravity: {mgb: 1, up: [0.8, -0.6, 0]}}" >>scene.yaml
run 0 run scene.yaml --tol 1e-12 -o falls.csv
for method in bdf adams bsimp; do
    run 0 run scene.yaml --method $method --tol 1e-10 -o a.csv
    at_most "from rest, $method" "$(difference falls.csv a.csv)" 1e-6
done

# --- loss of contact: the ball rolls down the outside of a sphere
physical outside 3 "$gravity" "reactions: {}" >loss.yaml
run 0 run loss.yaml --t-end 3 -o loss.csv
says "contact is lost at t = 1.95"
lost=$(sed -n 's/.*lost at t = \([0-9.]*\): there is a row there.*/\1/p' err)
check "the last row is there" test "$(tail -n 1 loss.csv | cut -d, -f1)" = "$lost"
check "and the rows before" test "$(rows loss.csv | wc -l)" -eq 9
at_most "0 at the end" "$(tail -n 1 loss.csv | awk -F, '{ print $14 ^ 2 }')" 1e-24
run 0 run loss.yaml --t-end 3 --step 0.001 -o fine.csv
check "the same moment from other rows" grep -qF "lost at t = ${lost%????}" err
run 0 check --max 1e-11 loss.csv
run 0 run loss.yaml --t-end 1.9
silent
run 0 run loss.yaml --t-end -3 -o back.csv
says "contact is lost at t = -1.95"
at_most "0 at the end backwards" "$(tail -n 1 back.csv | awk -F, '{ print $14 ^ 2 }')" 1e-24
physical outside 3 "$gravity" "reactions: {two_sided: true}" >on.yaml
run 0 run on.yaml --t-end 3 -o on.csv
silent
check "two_sided goes on" test "$(tail -n 1 on.csv | cut -d, -f1)" = 3
check "where the support pulls" awk -F, '/^[0-9]/ && $14 < -10 { pulled = 1 } END { exit !pulled }' on.csv
rows loss.csv | sed '$d' >a
rows on.csv | head -n 8 >b
check "the rows before are the same" cmp a b
echo "1.5 0.25 -1 0.5 2.5" >asked
run 0 run loss.yaml --times asked
says "lost at t = ${lost%????}"
check "unsorted, to the loss" test "$(rows out | cut -d, -f1 | tr '\n' ' ' | cut -c 1-30)" = "$(echo "1.5 0.25 -1 0.5 $lost" | cut -c 1-30)"
rows out | grep '^0.25,' >a
rows on.csv | grep '^0.25,' >b
check "unsorted, the same bits" cmp a b
physical outside 3 "gravity: {g: 9.81, up: [-0.6, 0, -0.8]}" "reactions: {}" >scene.yaml
run 0 run scene.yaml -o below.csv
says "the support would have to pull the ball from the start (pressure -19.9"
check "it is the two-sided motion" test "$(rows below.csv | wc -l)" -eq 9

# --- there and back: the last row is a start, with its vertical, its quaternion and its spin
physical outside 3 "$gravity" "$field" "$twist" "$resistance" "$attitude" >scene.yaml
run 0 run scene.yaml --t-end -1 --step 0.5 -o back.csv
rows back.csv | tail -n 1 | tr , ' ' >last
read -r _ w1 w2 w3 n1 n2 n3 e1 e2 e3 q0 q1 q2 q3 rest <last
cat >return.yaml <<END
ball: {mass: 2, radius: 1, inertia: [0.7, 0.8, 0.9]}
surface: {kind: outside, radius: 3}
initial: {normal: [$n1, $n2, $n3], angular_velocity: [$w1, $w2, $w3]}
time: {end: 1, step: 0.5}
effects:
  gravity: {g: 9.81, up: [$e1, $e2, $e3]}
  $field
  $twist
  $resistance
  attitude: {quaternion: [$q0, $q1, $q2, $q3]}
END
run 0 run return.yaml -o return.csv
{ columns back.csv && rows back.csv | tac | sed 's/^[^,]*,/0,/'; } >a
{ columns return.csv && rows return.csv | sed 's/^[^,]*,/0,/'; } >b
at_most "there and back" "$(difference a b)" 1e-11

# --- explain: every state with its reason, every effect with its numbers
physical inside 3 "$gravity" "$field" "$level" "$twist" "$resistance" "$attitude" "reactions: {}" "clock: {}" >scene.yaml
run 0 explain scene.yaml
silent
for words in "integrated: backend ball, 15 states, in the clock t" "  e1 e2 e3               vertical in body axes" "torque of the weight" \
    "  q0 q1 q2 q3            how the ball stands, from body to space axes" "  tau s                  clock: a column, or the effect clock, asks for it" \
    "mgb = -19.62" "quadratic = 1 0.2 0 0.2 2 0.1 0 0.1 0" "linear = 0.1 0.2 0.3" "c = 0.3" "resistance = 3" "coefficient = 0.1" \
    "quaternion = 0.5 0.5 -0.5 0.5" "does not hold: 'gravity' breaks it: its torque depends on the vertical" "  ball  |e|" "  ball  |q|"; do
    check "explain: $words" grep -F -q -e "$words" out
done
check "explain: no energy" sh -c "sed '/^integrals that do not/q' out | grep -q 'ball  h ' && exit 1 || exit 0"
physical plane - "gravity: {g: 9.81, up: [0.48, 0.6, 0.64]}" "attitude: {}" >scene.yaml
run 0 explain scene.yaml
check "explain: the way on a plane" grep -q "^  q0 q1 q2 q3 x1 x2 x3 .*on a plane the way of the centre" out
check "explain: the energy" sh -c "sed '/^integrals that do not/q' out | grep -q 'ball  h '"
physical outside 3 "$field" >scene.yaml
run 0 explain scene.yaml
check "explain: the isomorphism holds" grep -q "holds: (18) of the theory carries the states" out
run 0 list effects
for effect in gravity field level twist rolling_resistance rotor potential torque attitude reactions clock; do
    check "list effects: $effect" grep -q "^ *$effect " out
done

# --- refused at the place of the effect: what has no point
# apart NAME EFFECT WORDS: not by backend point, not as a point, not compared
apart() {
    physical outside 3 "$2" >scene.yaml
    place="scene.yaml:6:$((5 + ${#1})): "
    for option in "--backend point" "--as point" "--as both"; do
        for command in run explain; do
            # shellcheck disable=SC2086 # two words
            refuses 3 "$place'$1' $3" $command scene.yaml $option
        done
    done
    refuses 3 "$place'$1' $3" compare scene.yaml
    run 0 run scene.yaml --as ball -o a.csv
    refuses 3 "a.csv: this trajectory was made with '$1', which $3" convert --to point a.csv
}
apart gravity "$gravity" "breaks the isomorphism: its torque depends on the vertical"
apart twist "$twist" "breaks the isomorphism: the ball is free to twist"
apart rolling_resistance "$resistance" "breaks the isomorphism: energy is lost"
for effect in attitude reactions; do
    physical outside 3 "$effect: {}" >scene.yaml
    refuses 3 "scene.yaml:6:$((5 + ${#effect})): '$effect' is the ball's: take backend ball" run scene.yaml --backend point
done
finish
