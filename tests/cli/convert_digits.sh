#!/bin/sh
# convert_digits.sh ISOROLL - rows with few digits: --row-tolerance, the words about bad rows, how many are named.
. "$(dirname "$0")/lib.sh"
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 20 0.05 >scene.yaml
run 0 run scene.yaml --as both --tol 1e-15 -o both.csv
run 0 run scene.yaml --as ball --tol 1e-15 -o ball.csv
run 0 run scene.yaml --as point --backend ball --tol 1e-15 -o point.csv

# round_states DIGITS FILE: all numbers but the clock, rounded
round_states() {
    awk -F, -v OFS=, -v form="%.${1}g" '/^#/ || /^[a-z]/ { print; next }
        { for (i = 2; i <= NF; i++) $i = sprintf(form, $i) + 0; print }' "$2"
}

# Each number is within 5/10^digits of itself. The map (18) makes that at most a few times larger: max J/min J is 2.1.
for digits in 3 5; do
    for model in ball point; do
        case $model in ball) other=point ;; *) other=ball ;; esac
        what="$digits digits of a $model"
        tolerance=$(awk -v d=$digits 'BEGIN { print 10 * 10^-d }')
        bound=$(awk -v d=$digits 'BEGIN { print 20 * 10^-d }')
        round_states $digits $model.csv >few.csv
        quietly convert --quiet --to $other few.csv --row-tolerance "$tolerance" -o other.csv
        check "$what: all rows" test "$(rows other.csv | grep -c -v -e nan -e '^#')" -eq 401
        check_not "$what: no level is made of rounding" grep -q '^# effects' other.csv
        check "$what: h is the file's" test "$(grep '^# h' other.csv)" = "$(grep '^# h' ball.csv)"
        at_most "$what: states and clock" "$(difference other.csv both.csv)" "$bound"
        run 0 check few.csv --row-tolerance "$tolerance" --max "$(awk -v b="$bound" 'BEGIN { print 3 * b }')"
        [ $digits = 5 ] || refuses 3 "is expected; --row-tolerance 0." check few.csv
    done
done
round_states 3 ball.csv >few.csv
refuses 3 "a unit vector to 1e-05 is expected; --row-tolerance 0." plot few.csv -o few.svg
if command -v gnuplot >/dev/null; then run 0 plot few.csv --row-tolerance 0.01 -o few.svg; fi


# --- the words name the bound, and a tolerance that takes the row
# change ROW EXPRESSION: bad.csv, without its clock: what stands beside the row says nothing of it
change() {
    awk -F, -v OFS=, -v OFMT=%.17g "/^[0-9]/ && ++row == $1 { $2 } /^#/ { print; next }
        { print \$2, \$3, \$4, \$5, \$6, \$7 }" ball.csv >bad.csv
}
change 7 'for (i = 5; i <= 7; i++) $i *= 1.0012'
run 1 convert --to point bad.csv -o other.csv
check "the bound of a row" grep -qx \
    "isoroll: bad.csv:18: |n| = 1.0012: a unit vector to 1e-05 is expected; --row-tolerance 0.01 takes it" err
check_not "no advice for scenes" grep -q "write \[" err
quietly convert --quiet --to point bad.csv -o other.csv --row-tolerance 0.01
run 1 convert --quiet --to point bad.csv -o other.csv --row-tolerance 0.001
check "its own bound" grep -q "a unit vector to 0.001 is expected; --row-tolerance 0.01 takes it$" err
change 7 '$2 += 0.003 * $5; $3 += 0.003 * $6; $4 += 0.003 * $7'
run 1 convert --quiet --to point bad.csv -o other.csv
check "a spin" grep -q \
    "omega has a part .* along n: .* (a right angle to 1e-05 is expected; --row-tolerance 0.01 takes it)$" err
run 0 convert --quiet --to point bad.csv -o other.csv --row-tolerance 0.01
for wrong in 0 1 -1e-3 1e-16 nan x; do
    refuses 2 "expected a number in [1e-15, 0.1]" convert --to point ball.csv --row-tolerance=$wrong
done

# --- twenty bad rows are named, the others counted
for count in 20 21 400; do
    awk -v last=$count '/^[0-9]/ && ++row > 1 && row <= last + 1 { $0 = row % 2 ? "no row" : "1,2,3,4,5,6,7" }
        { print }' ball.csv >bad.csv
    run 1 convert --quiet --to point bad.csv -o other.csv
    check "$count bad rows: 20 are named" test "$(grep -c '^isoroll: bad.csv:[0-9]' err)" -eq 20
    check "the first 20" test "$(sed -n '20s/^isoroll: bad.csv:\([0-9]*\):.*/\1/p' err)" -eq 32
    check "all are marked" test "$(rows other.csv | grep -c '^nan')" -eq $count
    check "all are counted" grep -q "^isoroll: bad.csv: $count of 401 rows could not be converted" err
    case $count in
    20) check_not "none is unnamed" grep -q "are not named" err ;;
    *) check "the others are counted" grep -q "^isoroll: bad.csv: $((count - 20)) more rows are not named$" err ;;
    esac
    check "no more lines" test "$(wc -l <err)" -le 22
done
finish
