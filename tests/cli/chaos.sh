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
quietly chaos regular.yaml
check "regular" grep -q '^this orbit: regular$' out
prints '^this orbit: undecided$' chaos regular.yaml --turns 50
run 0 chaos chaotic.yaml --model point
check "one model" test "$(grep -c '^  \(ball\|point\) ' out)" -eq 1
refuses 3 "take n_3 = 0, which is global" chaos chaotic.yaml --axis 2

# --- JSON (exponents, MEGNO, GALI: test_chaos, test_indicators)
run 0 chaos chaotic.yaml --json
check "at the verdict no error is known" test "$(grep -c '"t": null' out)" -eq 2
prints 'too short to know this error; --exponent-turns' chaos chaotic.yaml
prints 'the exponents are from 1000 turns' chaos chaotic.yaml --exponent-turns 1000
quietly chaos chaotic.yaml --exponent-turns 1000 --json
check "JSON" is_json
check "exponent_turns" test "$(value exponent_turns)" = 1000
check "verdicts" test "$(grep -c '"verdict": "chaotic"' out)" -eq 3
check "turns" between "$(value turns)" 90 3000
check_not "no share" grep -q '"share"' out

# --- shares: other starts for other seeds (which shares, whatever the threads: test_chaos)
run 0 chaos chaotic.yaml --starts 40 --turns 600 --json
check "asked and followed" test "$(value starts)/$(value followed)" = 40/40
run 0 chaos chaotic.yaml --starts 10 --turns 150 --csv starts.csv
check "CSV: a row for each" test "$(grep -c '^[0-9]' starts.csv)" -eq 11
run 0 chaos chaotic.yaml --starts 10 --turns 150 --csv - --seed 1
check "CSV alone on standard output" grep -q '^orbit,l,x,verdict,disagree,ball_status,ball_verdict' out
check_not "another seed, other starts" cmp -s starts.csv out

# --- undecided orbits: beside the share, never in it without a word
run 0 chaos chaotic.yaml --starts 16 --turns 60 --json
check "some are undecided" test "$(value undecided_starts)" -gt 0
parts="$(value chaotic_starts) $(value regular_starts) $(value undecided_starts) $(value followed)"
check "the parts are 1" awk -v c="$(value chaotic)" -v r="$(value regular)" -v u="$(value undecided)" -v n="$parts" \
    'BEGIN { split(n, k); exit !((c + r + u - 1)^2 < 1e-20 && (c - k[1] / k[4])^2 < 1e-20) }'
middle=$(echo "$parts" | awk '{ printf "%.4f", ($1 + $3 / 2) / $4 }')
prints "the middle of what is possible is $middle\$" chaos chaotic.yaml --starts 16 --turns 60

# --- effects that keep the energy; refusals
{ cat chaotic.yaml; echo "effects: {gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}}"; } >gravity.yaml
prints '^a turn is a step of' chaos gravity.yaml
scene 0.5 "1, 2, 5" "0, 0, 2" "0.6, 0.8, 0" 10 0.5 >plane.yaml
prints "rotation about axis 3 in a principal plane, which is periodic" chaos plane.yaml
run 0 chaos plane.yaml --json
check "nothing is told of deviations that are not followed" test "$(grep -c '"gali2": null' out)" -eq 2
refuses 2 "--turns '0'" chaos chaotic.yaml --turns 0
refuses 2 "--exponent-turns '-5'" chaos chaotic.yaml --exponent-turns -5
refuses 2 "--starts '-1'" chaos chaotic.yaml --starts -1
refuses 2 "room for one" chaos chaotic.yaml --json --csv -

# --- pictures
if has gnuplot pictures; then
    run 0 chaos chaotic.yaml --plot indicators.svg
    check "indicators" grep -q 'MEGNO' indicators.svg
    run 0 chaos chaotic.yaml --starts 30 --turns 300 --plot section.svg
    check "exponents" grep -q 'exponent per turn' section.svg
    run 0 chaos regular.yaml --starts 5 --turns 400 --plot none.svg
    run 0 chaos plane.yaml --starts 5 --turns 400 --plot around.svg
    check "the section around a rotation" grep -q 'exponent per turn' around.svg
fi
run 3 chaos plane.yaml --plot plane.svg
says "no picture: a rotation in a principal plane"
check_not "and no file" test -e plane.svg
refuses 2 "must end in .svg" chaos chaotic.yaml --plot x.gif

# --- where an additional integral is known, undecided orbits are not chaotic
run 0 chaos regular.yaml --starts 40 --turns 20 --json
check "all are undecided" test "$(value undecided_starts)" = 40
check "and none of them may be chaotic" between "$(sed -n 's/^ *"high": \([0-9.e-]*\),*$/\1/p' out)" 0 0.1
prints "undecided ones are not chaotic: the integral excludes it" chaos regular.yaml --starts 4 --turns 2

# --- an exponent that does not fit a double is not known
scene 0.003 "1, 2, 5" "$spin" "$normal" 10 0.5 >extreme.yaml
run 0 chaos extreme.yaml
check_not "no infinite exponent" grep -qw inf out

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
    check "those that nobody followed do not count" between "$(value followed)" 0 20000
    check "the undecided are possible" between "$(value undecided_starts)" 0 "$(value followed)"
fi
finish
