#!/bin/sh
# reference_effects.sh ISOROLL - orbits under gravity, finite twist resistance and with the attitude, known to 1e-26
# (reference/{gravity,finite_twist,attitude}.csv), through `isoroll run`: every row at tolerance 1e-13 by all kinds of
# methods.
. "$(dirname "$0")/lib.sh"

# error HEADER LINE: largest difference of the last row of `out` from a reference row, of omega relative to |omega|,
# of s to max(1, s). Prints words if a column is missing.
error() {
    { columns out && tail -n 1 out; } | awk -F, -v header="$1" -v line="$2" '
        function abs(x) { return x < 0 ? -x : x }
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        {
            count = split(header, names, ","); split(line, values, ",")
            for (i = 1; i <= count; i++) if (names[i] ~ /^w[123]$/) square += values[i] ^ 2
            for (i = 1; i <= count; i++) {
                name = names[i]
                if (name !~ /^(t|s|[wne][123]|Q[0-3])$/) continue
                sub(/^w/, "omega", name); sub(/^Q/, "q", name)
                if (!(name in at)) { print "no column", name; exit }
                unit = name ~ /^omega/ ? sqrt(square) : name == "s" && values[i] > 1 ? values[i] : 1
                x = abs($at[name] - values[i]) / unit
                if (x > worst) worst = x
                compared++
            }
            if (compared < 7) { print "compared", compared; exit }
            printf "%.3g\n", worst
        }'
}

# effect FILE LINE: the scene of one row; the reference's columns in their order
effect() {
    IFS=, read -r id k J1 J2 J3 n1 n2 n3 w1 w2 w3 t a b c d rest <<END
$2
END
    scene "$k" "$J1, $J2, $J3" "$w1, $w2, $w3" "$n1, $n2, $n3" "$t" "$t"
    case $1 in
    gravity)
        echo "effects: {gravity: {mgb: $a, up: [$b, $c, $d]}}"
        echo "output: {columns: [t, s, omega1, omega2, omega3, n1, n2, n3, e1, e2, e3]}"
        ;;
    finite_twist) echo "effects: {twist: {resistance: $a, D: $b}}" ;;
    attitude)
        echo "effects: {attitude: {}}"
        echo "output: {columns: [t, s, omega1, omega2, omega3, n1, n2, n3, q0, q1, q2, q3]}"
        ;;
    esac
}

# orbit FILE LINE METHOD BOUND: one orbit; leaves its error in $last_error
orbit() {
    effect "$1" "$2" >scene.yaml
    run 0 run scene.yaml --method "$3" --tol 1e-13
    silent
    last_error=$(error "$(grep '^id,' "$source/tests/reference/$1.csv")" "$2")
    at_most "${2%%,*}, $3" "$last_error" "$4"
}

# orbits METHOD BOUND: all of them; raises $worst to the largest error
orbits() {
    rows=0
    for file in gravity finite_twist attitude; do
        grep '^open' "$source/tests/reference/$file.csv" >lines
        while read -r line; do
            rows=$((rows + 1))
            orbit $file "$line" "$1" "$2"
            worst=$(larger "$worst" "$last_error")
        done <lines
    done
    check "12 rows in the references" test "$rows" -eq 12
}

each_method orbits <<END
auto 1e-12
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
finish
