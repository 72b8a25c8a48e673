#!/bin/sh
# convert.sh ISOROLL - `isoroll convert`: there and back through files and pipes, and what it refuses.
. "$(dirname "$0")/lib.sh"
normal="0.36, 0.48, 0.8"
worst_state=0 worst_clock=0

# states FILE: a trajectory without its clocks, to be looked at apart
states() {
    awk -F, -v OFS=, '/^#/ { next } !n++ { for (i = 1; i <= NF; i++) if ($i !~ /^(t|tau|s)$/) keep[++m] = i }
        { for (j = 1; j <= m; j++) printf "%s%s", $keep[j], j < m ? "," : "\n" }' "$1"
}

# round_trip NAME K SCENE AS: run, convert to the other model and back through files and through pipes
round_trip() {
    case $4 in ball) other=point ;; *) other=ball ;; esac
    run 0 run "$3" --as "$4" -o a.csv
    quietly convert --quiet --to "$other" a.csv -o b.csv
    run 0 convert --to "$4" b.csv -o c.csv
    "$isoroll" convert --quiet --to "$other" <a.csv | "$isoroll" convert --quiet --to "$4" - >piped.csv
    check "$1: files and pipes" cmp c.csv piped.csv
    check "$1: the same columns and clock" test "$(columns a.csv)" = "$(columns c.csv)"
    check "$1: the same lines" test "$(grep '^# [kJhefl]' a.csv)" = "$(grep '^# [kJhefl]' c.csv)"
    states a.csv >a
    states c.csv >c
    bound=$(awk -v k="$2" 'BEGIN { k = k < 0 ? -k : k; x = 1 / (2 * k); print 4 * (x > 1 ? x : 1) }')
    error=$(difference a c 2.220446049250313e-16) # in units in the last place of the vector's size
    at_most "$1: states" "$error" "$bound"
    worst_state=$(larger "$worst_state" "$(awk -v e="$error" -v b="$bound" 'BEGIN { print e / b }')")
    error=$(difference a.csv c.csv)
    at_most "$1: with the clock" "$error" "${5:-1e-11}"
    worst_clock=$(larger "$worst_clock" "$error")
}

# (each k and kind of times: test_convert; units of any size: test_hard_units)
scene 0.5 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "$normal" 5 0.25 >scene.yaml
echo "effects: {field: {quadratic: [[1, 0.2, 0], [0.2, 2, 0], [0, 0, 0]]}, level: {c: 0.3}}" >>scene.yaml
round_trip "a field on a level" 0.5 scene.yaml ball
round_trip "a field on a level, from the point" 0.5 scene.yaml point
scene 0.6 "1e-3, 1, 1e3" "0.9, -0.3, -0.225" "$normal" 5 0.25 >scene.yaml
round_trip "J to 1e6" 0.6 scene.yaml ball 1e-8 # an ulp of s is 1e-10 of t where ds/dt is small, and s has some

# what `run` says of the other model is what `convert` makes of this one
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "$normal" 5 0.25 >scene.yaml
run 0 run scene.yaml --as both -o both.csv
run 0 run scene.yaml --as ball -o ball.csv
run 0 convert --to point ball.csv -o point.csv
check "a point file begins with s" test "$(columns point.csv)" = s,M1,M2,M3,gamma1,gamma2,gamma3
check "the line model: point" grep -qx '# model: point' point.csv
at_most "converted and integrated" "$(difference point.csv both.csv)" 1e-11
run 0 convert --to point both.csv
at_most "from a file with both" "$(difference out both.csv)" 1e-11
cp ball.csv place.csv
refuses 2 "would overwrite what is read" convert --to point place.csv -o place.csv
check "what is read is as it was" cmp place.csv ball.csv

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

# damage NUMBER COLUMN VALUE FILE: that file with another number in a row
damage() {
    awk -F, -v OFS=, -v CONVFMT=%.17g -v n="$1" -v c="$2" -v v="$3" '/^[0-9]/ && ++row == n { $c = v } { print }' "$4" >damaged.csv
}

# --- refusals
refuses 2 "--to ball or --to point is missing" convert ball.csv
refuses 2 "expected ball or point" convert --to both ball.csv
refuses 2 "expected three numbers" convert --to point --J 1,2 ball.csv
refuses 2 "[1e-15, 0.1]" convert --to point --tol 1 ball.csv
refuses 3 "--k contradicts the file, which says '# k: -1'" convert --to point --k 1 ball.csv
refuses 3 "--J contradicts" convert --to point --J 1,2,3 ball.csv
sed 's/k: -1/k: 0.5/' scene.yaml >other.yaml
refuses 3 "--scene contradicts the file, which says '# k: -1'" convert --to point --scene other.yaml ball.csv
refuses 3 "--scene contradicts the file" check --scene other.yaml ball.csv
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
{ cat flat.yaml; echo 'effects: {field: {linear: [0.2, -0.1, 0.15]}}'; } >field.yaml
for lines in flat level field; do
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
cat >shift.yaml <<'END'
point: {k: -1, J: [1.0, 1.5, 2.0], eps: 0.5}
initial: {gamma: [0.36, 0.48, 0.8], M: [1.6, -1.2, 0]}
time: {end: 2, step: 0.25}
END
run 0 run shift.yaml -o good.csv
quietly convert --quiet --to ball --shift-J good.csv -o turned.csv
run 0 check turned.csv --max 1e-9
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
refuses 5 "cannot open" convert --to ball absent.csv
refuses 5 "cannot read" convert --to ball .
sed 's/^[0-9].*/0,0,0,0,0.6,0,0.8/' ball.csv | awk '!/^0/ || !n++' >rest.csv
refuses 3 "at rest" convert --strict --to point rest.csv
run 3 convert --to point rest.csv
# (more kinds of damage: convert_foreign.sh)
# bad WORDS: damaged.csv is refused under --strict; else one row is marked, the others are converted, and the exit
# status is 1
bad() {
    refuses 3 "damaged.csv:$1" convert --strict --to point damaged.csv -o none.csv
    check_not "$1: no file" test -e none.csv
    run 1 convert --to point damaged.csv -o damaged_point.csv
    check "$1: is named" grep -q "^isoroll: damaged.csv:$1" err
    check "$1: one row is marked" test "$(grep -c '^nan,nan' damaged_point.csv)" -eq 1
    rows damaged_point.csv | grep -v '^#' | grep -v nan >others
    rows point.csv | grep -v '^#' | sed "$2d" >wanted
    check "$1: the others" test "$(cut -d, -f2- others)" = "$(cut -d, -f2- wanted)"
    at_most "$1: the clock of the others" "$(paste -d, others wanted | awk -F, '{ d = $1 - $8; if (d < 0) d = -d; if (d > w) w = d } END { print w + 0 }')" 1e-13
}
damage 3 5 0.5 ball.csv
bad "14: |n| = " 3
damage 4 3 1 ball.csv
bad "15: omega has a part" 4
# a row that the orbit of the row before misses is converted as it stands; so is the next one, which its orbit misses
damage 4 1 0.1 ball.csv
refuses 3 "damaged.csv:15: t turns back" convert --strict --to point damaged.csv -o none.csv
check_not "a time that turns back, --strict: no file" test -e none.csv
run 1 convert --to point damaged.csv -o damaged_point.csv
shows err "damaged.csv:15: t turns back" "damaged.csv:16: this row is" "or before it in time: 2, the farthest by"
check "the states of all rows" test "$(rows damaged_point.csv | cut -d, -f2-)" = "$(rows point.csv | cut -d, -f2-)"
# the other clock comes from the rows alone, where they are too far apart by integration; a file with its clock keeps it
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "$normal" 100 0.05 >scene.yaml
run 0 run scene.yaml --as both --tol 1e-15 -o both.csv
awk -F, -v OFS=, '/^#/ { print; next } { print $1, $4, $5, $6, $7, $8, $9 }' both.csv >ball.csv
for every in 1 200; do
    for file in both ball; do awk -v n=$every '/^#/ || /^t/ || i++ % n == 0' $file.csv >$file.some; done
    run 0 convert --quiet --to point ball.some -o point.csv
    case $every in 1) done="2000 intervals by two-point Taylor quadrature, 0" ;; *) done="0 intervals by two-point Taylor quadrature, 10" ;; esac
    shows -x point.csv "# s.from: the rows, $done by integration"
    at_most "s of every $every. row (states of the reference: test_convert)" "$(difference point.csv both.some)" 1e-12
done
run 0 convert --quiet --to point both.csv -o kept.csv
check_not "a clock that is there is not computed" grep -q '^# s.from' kept.csv
echo "worst state, in parts of 4 max(1, 1/|2k|) ulp: $worst_state; with the clock: $worst_clock"
finish
