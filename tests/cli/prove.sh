#!/bin/sh
# prove.sh ISOROLL - `isoroll prove`: words, JSON, exit statuses, numbers as they are written, certificates, refusals.
. "$(dirname "$0")/lib.sh"

scene 0.5 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >half.yaml
"$isoroll" prove half.yaml --digits 4 >/dev/null 2>err
if grep -q 'this build has no Arb' err; then
    refuses 2 "libflint-arb-dev; Debian 13: libflint-dev" prove half.yaml
    impossible "proofs" "this build has no Arb"
fi

# --- words
quietly prove half.yaml --digits 10
shows out '^k = 1/2, J = 7/5, 21/10, 3$' 'on the section n_3 = 0:' '^m = 0.00614708829.* +/- ' \
    '^proved: m is not 0, so the manifolds cross, and there is no further real-analytic integral'

# --- k = 1 is integrable: nothing can be proved. More digits enclose 0 in less
prints '^undecided at 6 digits: 0 is in the enclosure of m' prove half.yaml --digits 6 --k 1

# --- JSON, and k as it is written: 1/3 is one third
sed 's/k: 0.5/k: 1\/3/' half.yaml >third.yaml
check "a scene with a fraction" grep -q 'k: 1/3' third.yaml
quietly prove third.yaml --digits 10 --json
check "statement" grep -q '"statement": "proved: m is not 0' out
check "k is exact" test "$(value exact)" = 1/3
grep -A 2 '"m": {' out | head -n 3 >m
low=$(sed -n 's/.*"low": \([^,]*\).*/\1/p' m) high=$(sed -n 's/.*"high": \([^,]*\).*/\1/p' m)
check "it is narrow" between "$(awk -v a="$low" -v b="$high" 'BEGIN { printf "%.3e", b - a }')" 0 1e-9
prints '0.333333333333333' splitting third.yaml --digits double
m=$(awk '/^ *0.333/ { print $4 }' out)
check "the splitting measures this m" between "$m" "$low" "$high"
run 0 prove half.yaml --digits 4 --k 0.999999999999999 --json
check "k of 15 digits is whole" test "$(value exact)" = 999999999999999/1000000000000000

# --- an interval
prints '^proved for all these k: m is not 0' prove half.yaml --k 0.5:0.50001 -o interval.cert
shows interval.cert '^parts 8$' '^middle '

run 0 prove half.yaml --k 0.5:0.5003 --pieces 4
check "no more pieces than it may try" grep -q 'it stopped after 4 pieces: --pieces allows more' err
check "what is left is undecided" grep -q '^undecided: a share of 0\.[0-9]* of the interval' out


# --- it ends: after so many half returns, or before they begin
refuses 4 "undecided at 18 digits: it takes more than the 200 half returns of --half-returns" prove half.yaml \
    --half-returns 200
sed 's/1.4, 2.1, 3.0/1, 2, 5/' half.yaml >wide.yaml
refuses 4 "half returns, more than the 1000 of --half-returns; |m| should be about 1e-" prove wide.yaml --k 10 \
    --half-returns 1000
refuses 2 "a whole number from 1 on" prove half.yaml --half-returns 0

# --- a certificate (lib/doc/prove.md)
run 0 prove half.yaml --digits 6 -o half.cert
check "it begins" test "$(head -n 1 half.cert)" = "isoroll certificate 1"
check "it ends" test "$(tail -n 1 half.cert)" = end
shows half.cert '^moments 7/5 21/10 3$' '^sign positive$'
check "a half return of a set and of its centre each time" test "$(grep -c '^half set' half.cert)" -eq \
    "$(grep -c '^half centre' half.cert)"

# --- orbits found another way lie inside each step; those of a ball with another J, by 1e-30, do not
find_python mpmath
if [ -n "$python" ]; then
    halves=$(length 2 10)
    run 0 prove half.yaml --digits 20 -o fine.cert
    "$python" "$source/tests/cli/prove_orbits.py" fine.cert "$halves" 0 >out 2>err || fail "prove_orbits.py"
    check "numbers were compared" test "$(cut -d ' ' -f 1 out)" -ge $((halves * 50))
    check "all lie inside" test "$(cut -d ' ' -f 2 out)" -eq 0
    "$python" "$source/tests/cli/prove_orbits.py" fine.cert "$halves" 1e-30 >out 2>err || fail "prove_orbits.py"
    check "those of another ball do not" test "$(cut -d ' ' -f 2 out)" -ge 20

    # --- another program verifies the certificate of an interval, and refuses false ones (certificate.sh has more)
    "$python" -B "$source/tests/prove/changes.py" interval.cert "$(length 1 8)" >out 2>err || fail "changes.py"
    check "false copies are refused" grep -q ', 0 not refused$' out
else
    skip "orbits inside enclosures, and the certificate of an interval" "mpmath is not installed"
fi

# --- refusals
refuses 2 "prove: a certificate needs a file" prove half.yaml -o -
refuses 2 "a whole number from 1 to 400" prove half.yaml --digits 0
refuses 2 "A < B also as doubles" prove half.yaml \
    --k 999999999999998/999999999999999:999999999999999/1000000000000000
sed 's/1.4, 2.1, 3.0/1, 1.00000000000001, 3/' half.yaml >equal.yaml
refuses 4 "undecided at 1 digits: " prove equal.yaml --digits 1 --k 0.5
sed 's/k: 0.5/k: 0.33333333333333333/' half.yaml >long.yaml
refuses 3 "long.yaml:1:14: prove takes k exactly: write a number with at most 15 digits" prove long.yaml
cat >body.yaml <<'END'
ball: {mass: 2, radius: 1, inertia: [2, 3, 4]}
surface: {kind: plane}
initial: {normal: [0.6, 0, 0.8], angular_velocity: [0, 1, 0]}
time: {end: 10, step: 0.1}
END
refuses 3 "body.yaml:1:37: prove takes k and J exactly" prove body.yaml
finish
