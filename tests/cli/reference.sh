#!/bin/sh
# reference.sh ISOROLL - the orbits of reference/free_ball.csv, known to 1e-26, by `isoroll run`: every row by both
# backends with rk8pd at tolerance 1e-13, some by other methods.
. "$(dirname "$0")/lib.sh"
reference=$source/tests/reference/free_ball.csv
worst_ball=0 worst_point=0 worst_long=0 worst_clock=0 rows=0

# errors LINE: |(w,n) - reference| and |s/reference - 1| of the last row of `out`
errors() {
    tail -n 1 out | awk -F, -v line="$1" '
        function abs(x) { return x < 0 ? -x : x }
        { # t tau s omega1..3 n1..3
            split(line, r, ",")
            for (i = 1; i <= 6; i++) sum += ($(3 + i) - r[12 + i]) ^ 2
            if ($1 + 0 != r[12] + 0 || NF != 15) { print "not the row"; exit }
            printf "%.3g %.3g\n", sqrt(sum), abs($3 / r[19] - 1)
        }'
}

# row LINE BACKEND METHOD BOUND TOLERANCE: one orbit; leaves its errors in $error and $clock_error
row() {
    IFS=, read -r id k J1 J2 J3 n1 n2 n3 w1 w2 w3 t rest <<END
$1
END
    [ -n "$rest" ] || fail "$id: short line"
    scene "$k" "$J1, $J2, $J3" "$w1, $w2, $w3" "$n1, $n2, $n3" "$t" "$t" >scene.yaml
    run 0 run scene.yaml --backend "$2" --method "$3" --tol "$5" --as both
    silent
    read -r error clock_error <<END
$(errors "$1")
END
    at_most "$id, backend $2, $3, error of (w,n)" "$error" "$4"
    at_most "$id, backend $2, $3, error of s" "$clock_error" 1e-9
}

# is_long LINE: to t = 1000
is_long() {
    case $1 in openlong*) return 0 ;; esac
    return 1
}

grep '^open' "$reference" >lines
while read -r line; do
    rows=$((rows + 1))
    for backend in ball point; do
        case $backend in ball) bound=1e-10 ;; point) bound=1e-9 ;; esac
        is_long "$line" && bound=1e-8
        row "$line" "$backend" rk8pd "$bound" 1e-13
        worst_clock=$(larger "$worst_clock" "$clock_error")
        if is_long "$line"; then
            worst_long=$(larger "$worst_long" "$error")
        elif [ "$backend" = ball ]; then
            worst_ball=$(larger "$worst_ball" "$error")
        else
            worst_point=$(larger "$worst_point" "$error")
        fi
    done
done <lines
check "29 rows in the reference" test "$rows" -eq 29
echo "rk8pd: (w,n) to t = 100: ball $worst_ball, point $worst_point; t = 1000: $worst_long; s $worst_clock"

# orbits FILE TOLERANCE METHOD BOUND: its lines, by both backends; raises $worst to the largest error of (w,n)
orbits() {
    while read -r line; do
        for backend in ball point; do
            row "$line" "$backend" "$3" "$4" "$2"
            worst=$(larger "$worst" "$error")
        done
    done <"$1"
}

# Taylor series at their finest, which auto takes, on every row to t = 100.
grep -v '^openlong' lines >short
each_method orbits short 1e-15 <<END
auto 1e-12
taylor 1e-12
taylor_extended 2e-13
END

# The other families, on the rows to t = 100 that are harder; BDF and Adams have larger constants at this tolerance.
grep -E '^open(002|005|011|014),' lines >harder
check "4 rows that are harder" test "$(wc -l <harder)" -eq 4
each_method orbits harder 1e-13 <<END
fehlberg_13_7_8 1e-9
verner_8_5_6 1e-9
dormand_prince_7_4_5 1e-9
rkf45 1e-9
bsimp 1e-9
adams 1e-8
msadams 1e-7
bdf 1e-7
END
finish
