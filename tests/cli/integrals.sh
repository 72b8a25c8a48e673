#!/bin/sh
# integrals.sh ISOROLL - `isoroll integrals`: what is told of what is found and what is not, JSON, refusals,
# interruption. What is found: test_integral_search, test_integral_rotor.
. "$(dirname "$0")/lib.sh"

spin="0.8, 0.3, -0.6" normal="0.6, 0, 0.8"
scene 1 "1.4, 2.1, 3" "$spin" "$normal" 10 0.5 >plane.yaml

# --- what is known is found, and told by name
quietly integrals plane.yaml
shows out "^  F_plane = .*: found in degree 2, to " '^theory: integrable: a second integral is known$' \
    '^found: 1 independent integral beside the energy$' 'the energy, .*: found in degree 2' '^  *2  *50  *2  *1  *0 '
run 0 integrals plane.yaml --degree 4 --json
check "verdict" test "$(value verdict)" = found

# --- and nothing else
scene -0.5 "1.4, 2.1, 3" "$spin" "$normal" 10 0.5 >other.yaml
quietly integrals other.yaml --degree 4
check "none" grep -q '^none beside the energy up to degree 4 within 1e-10: the smallest value is ' out
check "theory" grep -q '^theory: no meromorphic integral: .*1/k no odd integer: a theorem of ours' out
run 0 integrals other.yaml --degree 4 --json
check "verdict" test "$(value verdict)" = none
check "theory in JSON" grep -q '"theory": "no meromorphic integral"' out
prints '^  F_plane = .*: not in this space$' integrals plane.yaml --coefficients 1
prints '^undecided: there are values between their error and 1e-10$' integrals plane.yaml --tol 1e-6
scene 0.5 "1, 1.0000001, 1.0000002" "$spin" "$normal" 10 0.5 >near.yaml
prints '^undecided: k and J are so near' integrals near.yaml

# --- the line of theory: 1/k odd, and where it is not known
for case in "1/3:no meromorphic integral: .*third variation" "1/21:no meromorphic integral" "1/23:open: .*see .isoroll prove"; do
    k=$(awk "BEGIN { printf \"%.17g\", ${case%%:*} }")
    scene "$k" "1.4, 2.1, 3" "$spin" "$normal" 10 0.5 >odd.yaml
    prints "^theory: ${case#*:}" integrals odd.yaml --degree 1
done
{ scene 0.5 "1.4, 2.1, 3" "$spin" "$normal" 10 0.5; echo "effects: {level: {c: 0.1}}"; } >level.yaml
prints '^theory: open: the theorem is about the level H = 0' integrals level.yaml --degree 1

# --- with a rotor, which is on the point a magnetic field
{ cat plane.yaml && echo "effects: {rotor: {momentum: [0.3, 0.4, 0.5]}}"; } >rotor.yaml
quietly integrals rotor.yaml
shows out "^  F_rotor = .*: found in degree 2, to " '^found: 1 independent integral beside the energy$' \
    'the energy, .*: found in degree 1$'
check "k = 1: its space" grep -qF 'functions v^c M^a gamma^b, v = q^(-1/(2k)), |a| + c <= degree' out

# --- extreme k
for k in 1000 -0.01; do
    scene $k "1.4, 2.1, 3" "$spin" "$normal" 10 0.5 >extreme.yaml
    prints '^none beside the energy up to degree 3 within 1e-10' integrals extreme.yaml --degree 3
done

# --- refusals
refuses 2 "degree 9 of the polynomials in M: give 1 to 8" integrals other.yaml --degree 9
refuses 2 "turns are not in" integrals other.yaml --turns 0.1

# --- Ctrl-C keeps the degrees that are done
if interruptible "integrals after SIGINT"; then
    one_degree() { grep -q '^  *1  *179 ' out; }
    interrupted_when one_degree integrals other.yaml --degree 8
    says "interrupted: "
    check "what is done" one_degree
    check "undecided" grep -q '^undecided: stopped after degree' out
fi
# Where powers of q do not fit a double, commands say so with the same words: k is to blame, not a stiff ball.
cat >near_zero.yaml <<'END'
reduced: {k: 0.001, J: [1, 2, 5]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 5}
END
for command in integrals "chaos --turns 50" "chaos --turns 50 --starts 2"; do
    # shellcheck disable=SC2086
    refuses 3 "k = 0.001 is too near 0 for these moments" $command near_zero.yaml
done
run 1 section near_zero.yaml --crossings 2 -o rows.csv
check "section says why it does not know how long a return takes" grep -q 'k is so near 0' err
check_not "and no length" grep -q 'a return takes' err

finish
