#!/bin/sh
# chaos.sh ISOROLL - `isoroll chaos`: verdicts, JSON, shares, CSV, pictures, refusals, interruption.
. "$(dirname "$0")/lib.sh"

spin="0.9, -0.3, -0.225" normal="0.36, 0.48, 0.8"
scene 0.5 "1, 2, 5" "$spin" "$normal" 10 0.5 >chaotic.yaml
scene -1 "1.4, 2.1, 3" "$spin" "$normal" 10 0.5 >regular.yaml

# --- an additional integral excludes chaos, even where deviations grow by 1e5 next to a separatrix
printf '%s\n' 'reduced: {k: -1, J: [1.4, 2.1, 3.0]}' 'time: {end: 1, step: 1}' \
    'initial: {normal: [0.8, 0, 0.6], angular_velocity: [1.0e-5, 1, 1.0e-5], project: true}' >near.yaml
prints "F_shell is an additional integral: no orbit is chaotic" chaos near.yaml
check "never chaotic" sh -c '! grep -q "orbit: chaotic" out'
prints '"integral": "F_shell"' chaos near.yaml --json

# --- one orbit
quietly chaos chaotic.yaml
check "chaotic" grep -q '^this orbit: chaotic$' out
check "by both models" test "$(grep -c '^  \(ball\|point\) *chaotic ' out)" -eq 2
check "the section" grep -q 'section n_3 = 0' out
prints '^this orbit: undecided$' chaos regular.yaml --turns 50
run 0 chaos chaotic.yaml --model point
check "one model" test "$(grep -c '^  \(ball\|point\) ' out)" -eq 1

# --- JSON (exponents, MEGNO, GALI: test_chaos, test_indicators)
run 0 chaos chaotic.yaml --json
check "at the verdict no error is known" test "$(grep -c '"t": null' out)" -eq 2
prints 'too short to know this error; --exponent-turns' chaos chaotic.yaml
quietly chaos chaotic.yaml --exponent-turns 1000 --json
check "JSON" is_json
check_not "no share" grep -q '"share"' out

# --- shares (which, other seeds, whatever the threads: test_chaos, test_share)
run 0 chaos chaotic.yaml --starts 10 --turns 150 --csv starts.csv
check "CSV: a row for each" test "$(grep -c '^[0-9]' starts.csv)" -eq 11
run 0 chaos chaotic.yaml --starts 10 --turns 150 --csv -
check "CSV alone on standard output" grep -q '^orbit,l,x,verdict,disagree,ball_status,ball_verdict' out

# --- undecided orbits: beside the share, never in it without a word
run 0 chaos chaotic.yaml --starts 16 --turns 60 --json
check "some are undecided" test "$(value undecided_starts)" -gt 0
parts="$(value chaotic_starts) $(value regular_starts) $(value undecided_starts) $(value followed)"
check "the parts are 1" awk -v c="$(value chaotic)" -v r="$(value regular)" -v u="$(value undecided)" -v n="$parts" \
    'BEGIN { split(n, k); exit !((c + r + u - 1)^2 < 1e-20 && (c - k[1] / k[4])^2 < 1e-20) }'
middle=$(echo "$parts" | awk '{ printf "%.4f", ($1 + $3 / 2) / $4 }')
prints "the middle of what is possible is $middle\$" chaos chaotic.yaml --starts 16 --turns 60

# --- effects that keep the energy, with an integral too; planes
{ cat chaotic.yaml; echo "effects: {gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}}"; } >gravity.yaml
prints '^a turn is a step of' chaos gravity.yaml
sed 's/0.5, J: .1, 2/1, J: [1, 2/; s/effects:.*/effects: {rotor: {momentum: [0.3, 0.4, 0.5]}}/' gravity.yaml >rotor.yaml
prints '^  chaotic  *0\.0000' chaos rotor.yaml --starts 8
scene 0.5 "1, 2, 5" "0, 0, 2" "0.6, 0.8, 0" 10 0.5 >plane.yaml
prints "rotation about axis 3 in a principal plane, which is periodic" chaos plane.yaml
run 0 chaos plane.yaml --json
check "nothing is told of deviations that are not followed" test "$(grep -c '"gali2": null' out)" -eq 2

# --- pictures
if has gnuplot pictures; then
    run 0 chaos plane.yaml --starts 5 --turns 400 --plot around.svg
    check "the section around a rotation" grep -q 'exponent per turn' around.svg
fi
run 3 chaos plane.yaml --plot plane.svg
says "no picture: a rotation in a principal plane"
check_not "and no file" test -e plane.svg

# --- where an additional integral is known, undecided orbits are not chaotic
prints "undecided ones are not chaotic: the integral excludes it" chaos regular.yaml --starts 4 --turns 2

# --- Ctrl-C keeps what is known
if interruptible "chaos after SIGINT"; then
    judged() { grep -q '"verdict": "chaotic"' out; }
    interrupted_when judged chaos chaotic.yaml --starts 1000000 --json
    says "interrupted: "
    check "its JSON is whole" is_json
    check "and has the orbit's verdict" judged
    # Of 1000000 orbits few were followed, and none of these was followed to the end: anything is possible
    says "of 1000000 starts were followed"
    check "asked" test "$(value starts)" = 1000000
fi
finish
