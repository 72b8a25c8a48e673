#!/bin/sh
# convert.sh ISOROLL - `isoroll convert`: through files and pipes, lines that its rows do not confirm, and what it
# refuses. (States, clocks and origins there and back: test_convert; every effect: every_command.)
. "$(dirname "$0")/lib.sh"
normal="0.36, 0.48, 0.8"

# what `run` says of the other model is what `convert` makes of this one
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "$normal" 5 0.25 >scene.yaml
run 0 run scene.yaml --as both -o both.csv
run 0 run scene.yaml --as ball -o ball.csv
run 0 convert --to point ball.csv -o point.csv
check "a point file begins with s" test "$(columns point.csv)" = s,M1,M2,M3,gamma1,gamma2,gamma3
"$isoroll" convert --quiet --to point <ball.csv >piped.csv
check "files and pipes" cmp point.csv piped.csv
check "the line model: point" grep -qx '# model: point' point.csv
at_most "converted and integrated" "$(difference point.csv both.csv)" 1e-11
run 0 convert --to point both.csv
at_most "from a file with both" "$(difference out both.csv)" 1e-11

# without lines (other kinds of files: test_trajectory)
grep -v '^#' ball.csv >bare.csv
run 0 convert --to point bare.csv --k -1 --J 1.4,2.1,3
at_most "a bare file" "$(difference point.csv out)" 1e-15
grep -v '^#' point.csv >bare_point.csv
run 0 convert --to ball bare_point.csv --k=-1 --J 1.4,2.1,3
at_most "a bare point" "$(difference ball.csv out)" 1e-11
run 0 convert --to ball bare_point.csv --k=-1 --J 1.4,2.1,3 --eps 6.50419875
run 0 convert --to ball bare_point.csv --k=-1 --J 1.4,2.1,3 --h 0.7374375
run 0 convert --to point ball.csv --k -1 # says what the file says
awk -F, -v OFS=, '/^#/ { print; next } { print $2, $3, $4, $5, $6, $7 }' ball.csv >timeless.csv
run 0 convert --to point timeless.csv
check "no clock, no clock" test "$(columns out)" = M1,M2,M3,gamma1,gamma2,gamma3

# --- refusals
refuses 2 "--to ball or --to point is missing" convert ball.csv
refuses 2 "expected ball or point" convert --to both ball.csv
refuses 2 "expected three numbers" convert --to point --J 1,2 ball.csv
refuses 2 "[1e-15, 0.1]" convert --to point --tol 1 ball.csv
refuses 3 "--k contradicts the file, which says '# k: -1'" convert --to point --k 1 ball.csv
refuses 3 "--J contradicts" convert --to point --J 1,2,3 ball.csv
sed 's/k: -1/k: 0.5/' scene.yaml >other.yaml
refuses 3 "--scene has k = 0.5, and the file or an option says '# k: -1'" convert --to point --scene other.yaml ball.csv
{ cat scene.yaml && echo "effects: {level: {c: 1}}"; } >level.yaml
run 0 run level.yaml --as ball -o level.csv
sed 's/c: 1/c: 2/' level.yaml >other_level.yaml
refuses 3 "--scene has level.c = 2, and the file says '# level.c: 1'" convert --to point --scene other_level.yaml level.csv
refuses 3 "--scene has k = 0.5" check --scene other.yaml ball.csv
for line in h eps tolerance t0; do
    { echo "# $line: abc"; grep -v "^# $line:" ball.csv; } >wrong.csv
    refuses 3 "'$line: abc' should be 1 finite number" convert --to point wrong.csv -o none.csv
done
refuses 3 "k" convert --to point bare.csv
refuses 3 "--J" convert --to point bare.csv --k 1
refuses 3 "k = 0" convert --to point bare.csv --k 0 --J 1,2,3
refuses 3 "already" convert --to ball ball.csv
refuses 3 "already" convert --to point point.csv
# a ball's h and eps are not needed, so wrong ones do no harm and do not travel on
sed -e 's/^# h: .*/# h: 5/' -e 's/^# eps: .*/# eps: 7/' ball.csv >wrong.csv
check "wrong h and eps" "$isoroll" convert --to point wrong.csv -o wrong_point.csv
check "do not travel on" "$isoroll" convert --to ball wrong_point.csv
# A line that the first row does not confirm is named, at any size above rounding, and the row's own takes its place:
# so what is written passes check. On every level; for k = -1, too, a shifted J.
# off KEY FACTOR FILE: that file with the number of a line times FACTOR
off() {
    awk -v k="# $1:" -v f="$2" 'index($0, k) == 1 { printf "%s %.17g\n", k, $3 * f; next } { print }' "$3" >off.csv
}
scene 0.5 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "$normal" 2 0.25 >flat.yaml
{ cat flat.yaml; echo 'effects: {level: {c: 0.1}}'; } >level.yaml
for lines in flat level; do
    for as in ball point; do
        case $as in ball) to=point ;; *) to=ball ;; esac
        run 0 run $lines.yaml --as $as --tol 1e-14 -o good.csv
        quietly convert --quiet --to $to good.csv -o turned.csv
        run 0 check turned.csv --max 1e-11
        for key in h eps level.c; do
            grep -q "^# $key" good.csv || continue
            for factor in 1.0000000001 1.5; do
                off $key $factor good.csv
                run 0 convert --quiet --to $to off.csv -o turned.csv
                says "off.csv: # $key: "
                run 0 check turned.csv --max 1e-11
                run 1 check off.csv --max 1e-11
                check "$lines, $as: check names # $key" grep -q "^  # $key .*ABOVE" out
            done
        done
    done
done
# a wrong k beside a level: every row is refused; the lines that no row confirms were once told for each of them
run 0 run level.yaml --as point -o good.csv
sed 's/^# k: .*/# k: 0.5005/' good.csv >off.csv
run 3 convert --to ball off.csv -o none.csv
check "the reason comes last" sh -c 'tail -n 1 err | grep -q "off.csv: level: this point has the energy of c = "'
check_not "a wrong k leaves no file" test -e none.csv
# a piece behind the start has the error of the steps to it: its own energy is taken, and no line is off
run 0 run flat.yaml --t-end 200 --tol 1e-7 -o good.csv
awk -F, -v OFS=, -v CONVFMT=%.17g '/^[0-9]/ { for (i = 2; i < 5; i++) $i *= 1 + 1e-9 } { print }' good.csv >whole.csv
awk '/^[0-9]/ && ++n < 700 { next } { print }' whole.csv >late.csv
run 0 convert --quiet --to point whole.csv
check "a whole file: both lines are off" test "$(grep -c 'does not fit the first row (off by 2e-09' err)" -eq 2
quietly convert --quiet --to point late.csv -o turned.csv
check "the energy of a later row" test "$(grep '^# h' turned.csv)" != "$(grep '^# h' good.csv)"
refuses 3 "bare_point.csv:3: the energy of this point is not that of the rows before" convert --strict --to ball bare_point.csv --k=-1 --J 1.4,2.1,3 --eps 3 -o none.csv
run 3 convert --to ball bare_point.csv --k=-1 --J 1.4,2.1,3 --eps 3 -o none.csv
check_not "an eps of another orbit leaves no file" test -e none.csv
# the first row of a point has 1.5 times its M: the rows behind it have the energy of the lines
awk -F, -v OFS=, -v CONVFMT=%.17g '/^[0-9]/ && !row++ { $2 *= 1.5; $3 *= 1.5; $4 *= 1.5 } { print }' point.csv >first.csv
refuses 3 "line $(grep -n '^[0-9]' first.csv | head -1 | cut -d: -f1) has another one: leave out that row" \
    convert --strict --to ball first.csv -o none.csv
sed 's/^[0-9].*/0,0,0,0,0.6,0,0.8/' ball.csv | awk '!/^0/ || !n++' >rest.csv
refuses 3 "at rest" convert --strict --to point rest.csv
run 3 convert --to point rest.csv
# (more kinds of damage: convert_foreign.sh, convert_digits.sh)
# a row that the orbit of the row before misses is converted as it stands; so is the next one, which its orbit misses
awk -F, -v OFS=, '/^[0-9]/ && ++row == 4 { $1 = 0.1 } { print }' ball.csv >damaged.csv
refuses 3 "damaged.csv:15: t turns back" convert --strict --to point damaged.csv -o none.csv
check_not "a time that turns back, --strict: no file" test -e none.csv
run 1 convert --to point damaged.csv -o damaged_point.csv
shows err "damaged.csv:15: t turns back" "damaged.csv:16: this row is" "or before it in time: 2, the farthest by"
check "the states of all rows" test "$(rows damaged_point.csv | cut -d, -f2-)" = "$(rows point.csv | cut -d, -f2-)"
# the other clock comes from the rows alone, where they are too far apart by integration; a file with its clock keeps it
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "$normal" 100 0.05 >scene.yaml
run 0 run scene.yaml -o ball.csv
for every in 1 200; do
    awk -v n=$every '/^#/ || /^t/ || i++ % n == 0' ball.csv >ball.some
    run 0 convert --quiet --to point ball.some -o point.csv
    case $every in 1) done="2000 intervals by two-point Taylor quadrature, 0" ;; *) done="0 intervals by two-point Taylor quadrature, 10" ;; esac
    shows -x point.csv "# s.from: the rows, $done by integration"
done
run 0 convert --quiet --to point both.csv -o kept.csv
check_not "a clock that is there is not computed" grep -q '^# s.from' kept.csv
finish
