#!/bin/sh
# reference.sh ISOROLL - orbits known to 1e-26 (reference/*.csv) by `isoroll run`: the free ball by both backends, and
# balls under gravity, with finite twist resistance and with the attitude, by all kinds of methods.
. "$(dirname "$0")/lib.sh"

# error HEADER LINE: distance of the last row of `out` from a reference row, omega to min(1, |omega|); and that of s,
# relative. Words if it is another time, or if a column is missing.
error() {
    { columns out && tail -n 1 out; } | awk -F, -v header="$1" -v line="$2" '
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        {
            count = split(header, names, ","); split(line, values, ",")
            for (i = 1; i <= count; i++) if (names[i] ~ /^w[123]$/) square += values[i] ^ 2
            for (i = 1; i <= count; i++) {
                name = names[i]
                if (name == "t" && $at["t"] + 0 != values[i] + 0) { print "not the row"; exit }
                if (name !~ /^(s|[wne][123]|Q[0-3])$/) continue
                sub(/^w/, "omega", name); sub(/^Q/, "q", name)
                if (!(name in at)) { print "no column", name; exit }
                compared++
                unit = name == "s" ? values[i] : name ~ /^omega/ && square < 1 ? sqrt(square) : 1
                off = (($at[name] - values[i]) / unit) ^ 2
                if (name == "s") clock = off; else sum += off
            }
            if (compared < 6) { print "compared", compared; exit }
            printf "%.3g %.3g\n", sqrt(sum), sqrt(clock)
        }'
}

# scene_of FILE LINE: the scene of one row; a to d: what the file has behind t
scene_of() {
    IFS=, read -r id k J1 J2 J3 n1 n2 n3 w1 w2 w3 t a b c d rest <<END
$2
END
    scene "$k" "$J1, $J2, $J3" "$w1, $w2, $w3" "$n1, $n2, $n3" "$t" "$t"
    case $1 in
    gravity) shown=", e1, e2, e3" && echo "effects: {gravity: {mgb: $a, up: [$b, $c, $d]}}" ;;
    finite_twist) shown= && echo "effects: {twist: {resistance: $a, D: $b}}" ;;
    attitude) shown=", q0, q1, q2, q3" && echo "effects: {attitude: {}}" ;;
    *) shown=", M1, M2, M3, gamma1, gamma2, gamma3" ;;
    esac
    [ "$1" = finite_twist ] || echo "output: {columns: [t, s, omega1, omega2, omega3, n1, n2, n3$shown]}"
}

# orbits FILE LINES TOLERANCE METHOD BOUND: these lines of it, a free ball by both backends; raises $worst to the largest
# error
orbits() {
    header=$(grep '^id,' "$source/tests/reference/$1.csv")
    case $1 in free_ball) backends="ball point" clock=1e-9 ;; *) backends=auto clock=$5 ;; esac
    while read -r line; do
        scene_of "$1" "$line" >scene.yaml
        for backend in $backends; do
            run 0 run scene.yaml --backend "$backend" --method "$4" --tol "$3"
            silent
            read -r this of_s <<END
$(error "$header" "$line")
END
            at_most "$1 ${line%%,*}, $backend, $4" "$this" "$5"
            at_most "$1 ${line%%,*}, $backend, $4: s" "$of_s" "$clock"
            worst=$(larger "$worst" "$this")
        done
    done <"$2"
}

# --- the free ball
grep '^open' "$source/tests/reference/free_ball.csv" >lines
check "29 rows of the free ball" test "$(wc -l <lines)" -eq 29
grep -v '^openlong' lines >short
grep '^openlong' lines >long # to t = 1000
grep -E '^open(002|005|011|014),' lines >harder
check "4 rows that are harder" test "$(wc -l <harder)" -eq 4
echo "rk8pd 1e-10" | each_method orbits free_ball short 1e-13
echo "rk8pd 1e-8" | each_method orbits free_ball long 1e-13
# Taylor series at their finest, which auto takes
each_method orbits free_ball short 1e-15 <<END
auto 1e-12
taylor 1e-12
taylor_extended 2e-13
END
# the other families; BDF and Adams have larger constants at this tolerance
each_method orbits free_ball harder 1e-13 <<END
fehlberg_13_7_8 1e-9
verner_8_5_6 1e-9
dormand_prince_7_4_5 1e-9
rkf45 1e-9
bsimp 1e-9
adams 1e-8
msadams 1e-7
bdf 1e-7
END

# --- effects
for file in gravity finite_twist attitude; do
    grep '^open' "$source/tests/reference/$file.csv" >lines
    check "4 rows of $file" test "$(wc -l <lines)" -eq 4
    sed "$(length '2,3d' '')" lines >some
    echo "auto 1e-12" | each_method orbits $file lines 1e-13
    each_method orbits $file some 1e-13 <<END
taylor 1e-12
taylor_extended 1e-14
rk8pd 1e-12
fehlberg_13_7_8 1e-11
verner_8_5_6 1e-11
dormand_prince_7_4_5 1e-11
rkf45 1e-11
bsimp 1e-11
adams 1e-9
msadams 1e-9
bdf 1e-8
END
done
finish
