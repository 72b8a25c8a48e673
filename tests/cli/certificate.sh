#!/bin/sh
# certificate.sh ISOROLL - the second checker of certificates (tests/prove/check.py), in another language and another
# arithmetic: it verifies a certificate from the file alone, and refuses false ones. And the residues of the theorem
# (tests/prove/third_variation.py), in whole fractions.
. "$(dirname "$0")/lib.sh"
prove=$source/tests/prove
find_python mpmath
python() { "$python" -B "$@" >out 2>err; }

# refused NAME: the file `false` is refused, and the line is told
refused() {
    checks=$((checks + 1))
    python "$prove/check.py" false
    [ $? -eq 1 ] || fail "$1: not refused"
    check "$1: the line" grep -q '^refused: line [0-9]' out
}

if [ -z "$python" ]; then
    skip "certificates" "python3-mpmath is not installed"
else
    check "it is verified" python "$prove/check.py" "$prove/half.cert"
    check "what was verified" grep -q '^verified: 484 steps; m is in 0.006147088298301[0-9]* .*: positive$' out
    check "false copies are refused" python "$prove/changes.py" "$prove/half.cert" "$(length 2 40)"
    check "all of them" grep -q ', 0 not refused$' out

    # by hand: the claim alone, the end, words
    sed 's/^sign positive/sign negative/' "$prove/half.cert" >false
    refused "a wrong sign"
    head -n 700 "$prove/half.cert" >false
    refused "half a file"
    sed 's/^moments .*/moments 3 21\/10 14\/10/' "$prove/half.cert" >false
    refused "moments in another order"
    sed 's/^k .*/k 1\/3 1\/2/' "$prove/half.cert" >false
    refused "an interval of k"
fi
for candidate in $python python3; do
    command -v "$candidate" >/dev/null || continue
    # shellcheck disable=SC2046
    check "residues" "$candidate" -B "$prove/third_variation.py" $(length "1 3 5 7" "1 3 5 7 9 11 13 15")
    break
done
finish
