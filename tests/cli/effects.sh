#!/bin/sh
# effects.sh ISOROLL - the effects through the command: columns, lines, loss of contact, refusals with their place.
# Orbits: test_forced, test_reference and others in ../orbit; every file of every effect: every_command.sh, test_check;
# mistakes in scenes: bad_effects.txt.
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

# --- D: of the reduced ball, or of the effect
scene 1.5 "4, 5, 6" "0.24, 0.7, -0.18" "0.6, 0, 0.8" 2 0.25 >reduced.yaml
echo "effects: {reactions: {}, twist: {resistance: 3, D: 2}}" >>reduced.yaml
run 0 run reduced.yaml -o reduced.csv
sed 's/, D: 2}/}/; s/reduced: {/reduced: {D: 2, /' reduced.yaml >elsewhere.yaml
run 0 run elsewhere.yaml
check "D in 'reduced' or in the effect" cmp out reduced.csv

# --- a file's lines are read with their mistakes
sed '/^# effects/d' everything.csv >damaged.csv
"$isoroll" check --max 1e-6 damaged.csv >out 2>err
check "without its line effects it is another motion" test $? -ne 0
physical outside 3 "$gravity" >scene.yaml
run 0 run scene.yaml -o heavy.csv
refuses_changed heavy.csv 's/^# effects: .*/# effects: gravity wind/' "bad.csv: there is no effect 'wind'" check
refuses_changed heavy.csv '/^# gravity.mgb/d' "effect 'gravity' needs a line '# gravity.mgb: ...'" check
refuses_changed heavy.csv '/^#/!s/e3/z3/' "unknown column 'z3'" check
awk -F, -v OFS=, '/^#/ { print; next } { print $1, $2, $3, $4, $5, $6, $7 }' heavy.csv >bad.csv
refuses 3 "no column 'e1', without which 'gravity' is not known" check bad.csv
refuses_changed everything.csv '/^# D:/d' "'twist' needs the ball's mass and radius" check

# --- loss of contact: words, and rows to the loss (where it is, and in which order: test_run)
physical outside 3 "$gravity" "reactions: {}" >loss.yaml
run 0 run loss.yaml --t-end 3 -o loss.csv
says "contact is lost at t = 1.95"
lost=$(sed -n 's/.*lost at t = \([0-9.]*\): there is a row there.*/\1/p' err)
check "the last row is there" test "$(tail -n 1 loss.csv | cut -d, -f1)" = "$lost"
physical outside 3 "$gravity" "reactions: {two_sided: true}" >on.yaml
quietly run on.yaml --t-end 3 -o on.csv
check "two_sided goes on" test "$(tail -n 1 on.csv | cut -d, -f1)" = 3
physical outside 3 "gravity: {g: 9.81, up: [-0.6, 0, -0.8]}" "reactions: {}" >scene.yaml
run 0 run scene.yaml -o below.csv
says "the support would have to pull the ball from the start (pressure -19.9"

# --- explain: every state with its reason, every effect with its numbers
physical inside 3 "$gravity" "$field" "$level" "$twist" "$resistance" "$attitude" "reactions: {}" "clock: {}" >scene.yaml
quietly explain scene.yaml
shows -F out "integrated: backend ball, 15 states, in the clock t" "  e1 e2 e3               vertical in body axes" \
    "torque of the weight" "  q0 q1 q2 q3            how the ball stands, from body to space axes" \
    "  tau s                  clock: a column, or the effect clock, asks for it" "mgb = -19.62" \
    "quadratic = 1 0.2 0 0.2 2 0.1 0 0.1 0" "linear = 0.1 0.2 0.3" "c = 0.3" "resistance = 3" "coefficient = 0.1" \
    "quaternion = 0.5 0.5 -0.5 0.5" "does not hold: 'gravity' breaks it: its torque depends on the vertical" \
    "  ball  |e|" "  ball  |q|"
check "explain: no energy" sh -c "sed '/^integrals that do not/q' out | grep -q 'ball  h ' && exit 1 || exit 0"
physical plane - "gravity: {g: 9.81, up: [0.48, 0.6, 0.64]}" "attitude: {}" >scene.yaml
prints "^  q0 q1 q2 q3 x1 x2 x3 .*on a plane the way of the centre" explain scene.yaml
check "explain: the energy" sh -c "sed '/^integrals that do not/q' out | grep -q 'ball  h '"
physical outside 3 "$field" >scene.yaml
prints "holds: (18) of the theory carries the states" explain scene.yaml

# --- refused at the place of the effect: what has no point
# apart NAME EFFECT WORDS: not by backend point, not as a point, not converted (not compared: test_refusals)
apart() {
    physical outside 3 "$2" >scene.yaml
    place="scene.yaml:6:$((5 + ${#1})): "
    refuses 3 "$place'$1' $3" run scene.yaml --backend point
    refuses 3 "$place'$1' $3" explain scene.yaml --as both
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
