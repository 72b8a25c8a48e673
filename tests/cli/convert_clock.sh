#!/bin/sh
# convert_clock.sh ISOROLL - `isoroll convert`: the other clock from samples alone, against reference states in
# quadruple precision, and its own estimate of the error.
. "$(dirname "$0")/lib.sh"
reference=$here/../reference/free_ball.csv
worst=0

# field FILE KEY: the value of a line "# KEY: value"
field() {
    sed -n "s/^# $2: //p" "$1"
}

# from_samples SAMPLES K J NORMAL OMEGA T S: rows at so many samples a turn; s of the last against S
from_samples() {
    step=$(awk -v k="$2" -v w="$5" -v n="$1" 'BEGIN { split(w, x, ", "); w = sqrt(x[1]^2 + x[2]^2 + x[3]^2)
        k = k < 0 ? -k : k; print 6.283185307179586 / (k * w * n) }')
    scene "$2" "$3" "$5" "$4" "$6" "$step" | sed 's/^initial: {/&project: true, /' >scene.yaml
    run 0 run scene.yaml --tol 1e-15 -o ball.csv
    run 0 convert --quiet --to point ball.csv -o point.csv
    s=$(rows point.csv | grep -v '^#' | tail -n 1 | cut -d, -f1)
    error=$(awk -v a="$s" -v b="$7" 'BEGIN { d = (a - b) / b; printf "%.3g", d < 0 ? -d : d }')
    at_most "$1 samples, k = $2, t = $6: s" "$error" 1e-12
    at_most "$1 samples, k = $2, t = $6: the estimate covers the error" "$error" \
        "$(awk -v e="$(field point.csv s.error)" -v s="$s" 'BEGIN { print e / s }')"
    worst=$(larger "$worst" "$error")
}

# the states of the reference up to t = 100, where the file has its 26 free balls; 1000 samples of the short ones
for samples in $(length "10 33" "10 33 100 1000"); do
    grep '^[a-z]*[0-9]*,' "$reference" | awk -F, '$1 != "id" && $12 + 0 <= 100' |
        while IFS=, read -r _ k J1 J2 J3 n1 n2 n3 w1 w2 w3 t _ _ _ _ _ _ s _; do
            echo "$k|$J1, $J2, $J3|$n1, $n2, $n3|$w1, $w2, $w3|$t|$s"
        done >balls
    while IFS='|' read -r k J n w t s; do
        if [ "$samples" = 1000 ] && awk -v t="$t" 'BEGIN { exit !(t > 20) }'; then continue; fi
        from_samples "$samples" "$k" "$J" "$n" "$w" "$t" "$s"
    done <balls
done
echo "worst relative error of s: $worst"

# too far apart for the quadrature: integrated, and the file says so
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 100 0.05 >scene.yaml
run 0 run scene.yaml --as both --tol 1e-15 -o both.csv
awk -F, -v OFS=, '/^#/ { print; next } { print $1, $4, $5, $6, $7, $8, $9 }' both.csv >ball.csv
check "the columns of a ball" test "$(columns ball.csv)" = t,omega1,omega2,omega3,n1,n2,n3
run 0 convert --quiet --to point ball.csv -o dense.csv
check "close rows: quadrature" grep -q '^# s.from: the rows, 2000 intervals by two-point Taylor quadrature, 0 by integration$' dense.csv
at_most "close rows" "$(difference dense.csv both.csv)" 1e-13
awk '/^#/ || /^t/ || n++ % 200 == 0' ball.csv >wide.csv
awk '/^#/ || /^t/ || n++ % 200 == 0' both.csv >wide_both.csv
run 0 convert --quiet --to point wide.csv -o wide_point.csv
check "wide rows: integration" grep -q '^# s.from: the rows, 0 intervals by two-point Taylor quadrature, 10 by integration$' wide_point.csv
at_most "wide rows" "$(difference wide_point.csv wide_both.csv)" 1e-12
# a file with its clock keeps it
run 0 convert --quiet --to point both.csv -o kept.csv
check "a clock that is there is not computed" test -z "$(field kept.csv s.from)"

# a million rows there and back would be the same: twenty thousand, through files and through a pipe
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 200 0.01 >scene.yaml
run 0 run scene.yaml -o ball.csv
run 0 convert --quiet --to point ball.csv -o point.csv
run 0 convert --quiet --to ball point.csv -o back.csv
"$isoroll" convert --quiet --to point ball.csv | "$isoroll" convert --quiet --to ball >piped.csv
check "the same through a pipe" cmp back.csv piped.csv
paste -d, ball.csv back.csv | awk -F, '/^[0-9]/ {
        d = $1 - $8; if (d < 0) d = -d; if (d > time) time = d; end = $1
        for (i = 2; i <= 7; i++) { d = ($i - $(i + 7)) / $i / 2.220446049250313e-16; if (d < 0) d = -d; if (d > ulp) ulp = d } n++ }
    END { print ulp + 0, time / end, n + 0 }' >result
read -r ulps times count <result
at_most "states there and back, in units of 2^-52" "$ulps" 8
at_most "times there and back" "$times" 1e-13
check "all rows" test "$count" -eq 20001
echo "there and back: $ulps units of 2^-52, times $times"
finish
