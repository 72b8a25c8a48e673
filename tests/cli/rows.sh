#!/bin/sh
# rows.sh ISOROLL - long trajectories: what comes out does not depend on the pieces in which they arrive; mistakes keep
# their places. `check` finds one wrong number among rows that are near each other; it and `plot` pass over rows of nan.
. "$(dirname "$0")/lib.sh"
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" "$(length 60 300)" 0.01 >scene.yaml
for as in ball point both; do run 0 run scene.yaml --as "$as" -o "$as.csv"; done
count=$(rows ball.csv | wc -l)

# --- a file or a pipe, in pieces of any size
run 0 convert --quiet --to point ball.csv -o wanted.csv
for size in 1 7 4096; do
    head -n 300 ball.csv | dd bs=$size 2>/dev/null | "$isoroll" convert --quiet --to point >piped.csv
    head -n 300 ball.csv | "$isoroll" convert --quiet --to point >whole.csv
    check "pieces of $size" cmp piped.csv whole.csv
done
"$isoroll" convert --quiet --to point <ball.csv | "$isoroll" convert --quiet --to ball | rows /dev/stdin | wc -l >lines
check "all rows go through two pipes" test "$(cat lines)" -eq "$count"
printf %s "$(cat ball.csv)" | "$isoroll" convert --quiet --to point >unended.csv # without the last newline
check "no newline at the end" cmp unended.csv wanted.csv
awk '/^[0-9]/ && ++n % 1000 == 0 { print "# note: " n; print ""; print " " } { print }' ball.csv | sed 's/$/\r/' >odd.csv
run 0 convert --quiet --to point odd.csv
check "lines of #, empty lines, CRLF" cmp out wanted.csv

# --- rows that come slowly are passed on before the input ends
mkfifo slow
"$isoroll" convert --quiet --to point <slow >passed.csv &
exec 3>slow
head -n "$(grep -n '^t,' ball.csv | cut -d: -f1)" ball.csv >&3
seen=0
for row in $(rows ball.csv | head -n 400); do
    echo "$row" >&3
    sleep 0.15
    seen=$(rows passed.csv | wc -l)
    test "$seen" -gt 0 && break
done
exec 3>&-
wait
check "slow rows are passed on" test "$seen" -gt 0

# --- mistakes far behind the first rows
line=$(($(grep -n '^t,' ball.csv | cut -d: -f1) + count - 100))
# spoil SED: that line is changed
spoil() {
    sed "${line}$1" ball.csv >bad.csv
}
# at COLUMN WORDS: it is refused there by both readers
at() {
    refuses 3 "bad.csv:$line:$1: $2" check bad.csv
    run 1 convert --quiet --to point bad.csv
    check "$2: is named" grep -F -q "bad.csv:$line:$1: $2" err
    check "$2: one row is marked" test "$(grep -c '^nan,nan' out)" -eq 1
    check "$2: the others" test "$(rows out | wc -l)" -eq "$(rows wanted.csv | wc -l)"
}
spoil 's/,/;/'
at 1 "expected a finite number for t"
spoil 's/,[^,]*$//'
at "$(sed -n "${line}p" bad.csv | wc -c)" "expected 7 numbers, one for each column, found 6"
{ head -n $((line - 1)) ball.csv && head -c 200000 /dev/zero | tr '\0' 1 && echo && tail -n +$((line + 1)) ball.csv; } >bad.csv
at 1 "this line is longer than 64 KiB"

# --- check: the same residuals by quadrature as by integration; one number of one row is found
residual=$(length 1e-13 1e-12) # times near 1000 are rounded to 1e-13
for as in ball point both; do
    quietly check --max "$residual" "$as.csv"
    "$isoroll" check --max "$residual" <"$as.csv" >piped
    check "$as: from a pipe" cmp piped out
done
# (every number of every column, every line, one orbit in far rows: test_check)
row=$((count / 2))
awk -F, -v OFS=, -v CONVFMT=%.17g -v row=$row '/^[0-9]/ && ++n == row { $3 *= 1.0000000001 } { print }' both.csv >damaged.csv
run 1 check --max 1e-12 damaged.csv
for residual in "point flow" "clock t" "clock tau"; do
    check "$residual: the row" grep -Eq "^  $residual  *[0-9.e-]* *($row|$((row + 1))) .*ABOVE THE BOUND" out
done
# two damages: the smaller one does not hide the larger one
awk -F, -v OFS=, -v CONVFMT=%.17g '/^[0-9]/ { n++; if (n == 100) $6 += 1e-6; if (n == 200) $6 += 3e-6; if (n == 300) $6 += 1e-6 } { print }' \
    ball.csv >damaged.csv
run 1 check --max 1e-9 damaged.csv
check "the worst of three" grep -Eq '^  ball flow  *[0-9.e-]* *(200|201) ' out

# --- rows of nan
awk -F, -v OFS=, '/^[0-9]/ && (++n == 50 || n == 51 || n == 3000) { $3 = "x" } { print }' ball.csv >bad.csv
run 1 convert --quiet --to point bad.csv -o marked.csv
check "three marks" test "$(grep -c '^nan' marked.csv)" -eq 3
prints -x "$count rows, 3 of nan passed over" check --max 1e-11 marked.csv
silent
awk -F, -v OFS=, -v CONVFMT=%.17g '/^[0-9]/ { n++; if (n == 48) $5 *= 1.000001 } { print }' marked.csv >damaged.csv
run 1 check --max 1e-9 damaged.csv
check "rows keep their numbers" grep -Eq '^  point [|]gamma[|]  *[0-9.e-]* *48 ' out
awk '/^[0-9]/ { gsub(/[^,]+/, "nan") } { print }' ball.csv >damaged.csv
refuses 3 "all rows of the trajectory are nan" check damaged.csv
if has gnuplot "plot of rows of nan"; then
    run 0 plot marked.csv -o marked.svg
    says "3 rows of nan were passed over"
fi
refuses 3 "expected a finite number for s, not 'nan'" convert --strict --to ball marked.csv -o none.csv
finish
