#!/bin/sh
# reference.sh ISOROLL - orbits known to 1e-26 (reference/*.csv) by `isoroll run`: balls under gravity, with finite twist
# resistance and with the attitude, by all kinds of methods (the free ball: orbit/test_reference.c).
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
    esac
    [ "$1" = finite_twist ] || echo "output: {columns: [t, s, omega1, omega2, omega3, n1, n2, n3$shown]}"
}

# orbits FILE LINES METHOD BOUND: these lines of it, at tolerance 1e-13. Leaves out extended series where the compiler cannot
# make them.
orbits() {
    header=$(grep '^id,' "$source/tests/reference/$1.csv")
    "$isoroll" list methods | grep -q -w "$3" || [ "$3" = auto ] || return 0
    while read -r line; do
        scene_of "$1" "$line" >scene.yaml
        quietly run scene.yaml --method "$3" --tol 1e-13
        read -r this of_s <<END
$(error "$header" "$line")
END
        at_most "$1 ${line%%,*}, $3" "$this" "$4"
        at_most "$1 ${line%%,*}, $3: s" "$of_s" "$4"
    done <"$2"
}

for file in gravity finite_twist attitude; do
    grep '^open' "$source/tests/reference/$file.csv" >lines
    check "4 rows of $file" test "$(wc -l <lines)" -eq 4
    orbits $file lines auto 1e-12
    sed "$(length '2,3d' '')" lines >some
    while read -r method bound; do orbits $file some "$method" "$bound"; done <<END
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
