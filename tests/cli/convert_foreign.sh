#!/bin/sh
# convert_foreign.sh ISOROLL - files of other programs, damaged files, files with a wrong description, and HDF5.
. "$(dirname "$0")/lib.sh"
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 50 0.05 >scene.yaml
run 0 run scene.yaml -o ball.csv
run 0 convert --quiet --to point ball.csv -o point.csv
grep -v '^#' ball.csv >bare.csv
ball="--k=-1 --J 1.4,2.1,3"

# foreign NAME FILE [OPTION...]: is converted to what ball.csv is
foreign() {
    name=$1 file=$2
    shift 2
    # shellcheck disable=SC2086 # $ball is options
    quietly convert --quiet --to point "$file" $ball "$@"
    at_most "$name" "$(difference point.csv out)" 1e-13
}
# (separators, ends of lines, exponents, names in quotes and behind #: test_trajectory)
sed 's/[^,]*/"&"/g' bare.csv >spreadsheet.csv
foreign "quoted numbers" spreadsheet.csv
tail -n +2 bare.csv >nameless.csv
foreign "no names" nameless.csv --columns t,omega1,omega2,omega3,n1,n2,n3
awk -F, -v OFS=, '{ print "x" NR, $0, NR == 1 ? "kind" : "solid" }' bare.csv | sed '1s/.*/id,T,wx,wy,wz,nx,ny,nz,kind/' >renamed.csv
foreign "other names and columns" renamed.csv --columns -,t,omega1,omega2,omega3,n1,n2,n3,-
# shellcheck disable=SC2086
awk -F, -v OFS=, 'NR == 1 { print $0, "energy", "omgea4"; next } { print $0, 1, 2 }' bare.csv >more.csv
# shellcheck disable=SC2086
run 0 convert --to point more.csv $ball -o /dev/null
check "are named" grep -q "passed over: 'energy', 'omgea4' (did you mean 'omega1'?)" err
run 0 convert --quiet --to point -p hex ball.csv -o hex.csv
check "hexadecimal numbers" grep -q '^0x1' hex.csv
run 0 convert --quiet --to ball hex.csv -o from_hex.csv
run 0 convert --quiet --to ball point.csv -o from_point.csv
check "read back exactly" cmp from_hex.csv from_point.csv
run 0 convert --quiet --to point -p 6 ball.csv
at_most "six digits" "$(difference point.csv out)" 1e-5
check "six digits are six" awk -F, '/^[-0-9]/ { for (i = 1; i <= NF; i++) if (sprintf("%.6g", $i) != $i "") exit 1 }' out
run 0 convert --quiet --to point bare.csv --k=-2/2 --J 7/5,2.1,6/2
at_most "parameters as fractions" "$(difference point.csv out)" 1e-13
refuses 2 "--k '1/0': expected a number" convert --to point bare.csv --k 1/0 --J 1,2,3
run 0 convert --quiet --to point bare.csv --scene scene.yaml
at_most "parameters from a scene" "$(difference point.csv out)" 1e-13
refuses 2 "expected 1 to 17, or hex" convert --to point -p 18 ball.csv
refuses 2 "unknown column 'omega4'" convert --to point bare.csv --k=-1 --J 1,2,3 --columns t,omega4
refuses 3 "has no column 'n3'" convert --to point bare.csv --k=-1 --J 1,2,3 --columns t,omega1,omega2,omega3,n1,n2,-
refuses 2 "leave one of them out" convert --to ball point.csv --eps 1 --h 1

# --- one row in a hundred is damaged: text, missing and added fields, numbers that are none, jumps, wrong signs
awk -F, -v OFS=, '/^#/ || /^t/ { print; next } ++n % 100 != 50 { print; next }
    { kind = int(n / 100) % 9 }
    kind == 0 { $0 = "no row at all" }
    kind == 1 { $7 = ""; sub(/,$/, "") }
    kind == 2 { $3 = "nan" }
    kind == 3 { $4 = $4 "x" }
    kind == 4 { $1 = $1 * 10 + 5 }
    kind == 5 { $1 = $1 / 3 - 1 }
    kind == 6 { $5 = 0.123 }
    kind == 7 { x = $2; $2 = $3; $3 = x }
    kind == 8 { $2 = -$2; $3 = -$3; $4 = -$4 }
    { print; print NR >"damaged_lines" }
    kind == 4 || kind == 5 || kind == 8 { print NR + 1 >"damaged_lines" }' ball.csv >damaged.csv # they miss the next
check "ten damaged lines, and three behind them" test "$(wc -l <damaged_lines)" -eq 13
run 1 convert --to point damaged.csv -o damaged_point.csv
sed -n '/rows away from/d; s/^isoroll: damaged.csv:\([0-9]*\):.*/\1/p' err | sort -n >named
check "all are named, and no others" cmp named damaged_lines
check "no states are marked in place" test "$(rows damaged_point.csv | grep -v '^#' | grep -c '^nan')" -eq 7
rows damaged_point.csv | grep -v '^#' >rows_damaged
rows point.csv | grep -v '^#' | paste -d, rows_damaged - | grep -v -e '^s' -e '^nan' |
    awk -F, '{ w = 0; for (i = 2; i <= 7; i++) { d = $i - $(i + 7); if (d < 0) d = -d; if (d > w) w = d } n += w < 1e-13 }
        { s = $1 - $8 } END { print n, s < 0 ? -s : s }' >result
read -r count error <result
check "the others are converted" test "$count" -eq 993 # all but one with states of another sign
at_most "the error of s holds" "$error" "$(sed -n 's/^# s.error: //p' damaged_point.csv)"
run 1 convert --quiet --to ball damaged_point.csv -o again.csv
check "marks are bad rows again" test "$(rows again.csv | grep -c '^nan')" -eq 7
run 3 convert --strict --to point damaged.csv -o strict.csv
check_not "--strict leaves no file" test -e strict.csv

# --- marks stand where the bad rows were, behind the first row, too
awk '/^t/ { head = NR } head && (NR == head + 2 || NR == head + 3) { $0 = "no row" } { print }' ball.csv >second.csv
run 1 convert --quiet --to point second.csv -o second_point.csv
check "in place" test "$(rows second_point.csv | sed -n '/^#/d; s/^nan.*/nan/; s/^[0-9].*/good/; p' | sed -n 1,4p | tr '\n' ' ')" = "good nan nan good "

# --- behind a row so fast that its orbit is not followed, the clock goes on without the time between, and says so
awk -F, -v OFS=, -v OFMT=%.17g -v CONVFMT=%.17g 'NR == 100 { for (i = 2; i <= 4; i++) $i *= 1e12 } { print }' ball.csv >fast.csv
run 1 convert --to point fast.csv -o fast_point.csv
check "a fast row" test "$(sed -n 's/^isoroll: fast.csv:\(1[0-9]*\): .*/\1/p' err | head -n 3 | tr '\n' ' ')" = "100 101 102 "
check "the row behind it is nan" test "$(rows fast_point.csv | grep -c '^nan')" -eq 1
check "the error of s is not known" grep -q '^# s.error: inf' fast_point.csv

# --- the other clock, where the file has it, is that of the rows
run 0 run scene.yaml --as both -o both.csv
run 0 convert --quiet --to point both.csv
run 0 convert --quiet --to ball both.csv
awk -F, -v OFS=, '/^#/ || /^t/ { print; next } NR == 100 { $3 += 1e-3 } { print }' both.csv >late.csv
run 1 convert --quiet --to point late.csv -o /dev/null
check "a wrong clock" grep -q "late.csv:100: this row is" err
awk -F, -v OFS=, -v CONVFMT=%.17g '/^#/ || /^t/ { print; next } { $3 *= 1.01; print }' both.csv >slow.csv
run 1 convert --quiet --to point slow.csv -o /dev/null
check "a clock that is slow" grep -q "do not solve the equations" err

# --- not what it says: the equations of another ball
refused_as_other() {
    run 1 convert --to point bare.csv "$@" -o other.csv
    check "$*: is told" grep -q "do not solve the equations that are stated for them" err
}
refused_as_other --k 1 --J 1.4,2.1,3
refused_as_other --k=-1.001 --J 1.4,2.1,3
refused_as_other --k=-1 --J 1.4,2.1,3.1
run 0 convert --quiet --to point bare.csv --k=-1 --J 2.8,4.2,6 -o other.csv # a common factor of J is a unit
run 0 convert --quiet --max-defect 1e-10 --to point ball.csv
run 1 convert --max-defect 1e-16 --to point ball.csv -o other.csv
check "--max-defect names the row" grep -q "ball.csv:[0-9]*: this row is .* away" err
run 0 run scene.yaml --tol 1e-3 -o loose.csv
run 0 convert --quiet --max-defect 1e-2 --to point loose.csv
run 1 convert --max-defect 1e-9 --to point loose.csv -o other.csv

# --- off the zero level: a ball in a potential, or for k = -1 a free one of other moments
cat >off.yaml <<'END'
point: {k: -1, J: [1.0, 1.5, 2.0], eps: 0.5}
initial: {gamma: [0.36, 0.48, 0.8], M: [1.6, -1.2, 0]}
time: {end: 20, step: 0.05}
END
run 0 run off.yaml -o off.csv
run 0 convert --quiet --to ball off.csv -o level.csv
check "a level" grep -q '^# effects: level' level.csv
run 0 convert --quiet --to ball --shift-J off.csv -o free.csv
check_not "no level" grep -q '^# effects' free.csv
run 0 check free.csv --max 1e-9
run 0 convert --quiet --to point free.csv -o off_again.csv
at_most "and back: the same point" "$(difference off.csv off_again.csv)" 1e-12
run 0 run "$source/examples/12_neumann_off_level/scene.yaml" -o low.csv
refuses 3 "no free ball has this energy" convert --strict --to ball --shift-J low.csv -o none.csv
refuses 2 "for a point with k = -1 alone" convert --to point --shift-J ball.csv

# --- HDF5
if "$isoroll" run scene.yaml -o ball.h5 2>/dev/null; then
    run 0 convert --quiet --to point ball.h5 -o point.h5
    run 0 check point.h5 --max 1e-9
    run 1 convert --quiet --to point damaged.csv -o damaged.h5
    run 1 convert --quiet --to ball damaged.h5 -o from_damaged.csv
    check "marks in HDF5" test "$(rows from_damaged.csv | grep -c '^nan')" -eq 7
    check "an older file stays where a conversion fails" cp point.h5 older.h5
    run 3 convert --strict --to point damaged.csv -o older.h5
    check "as it was" cmp point.h5 older.h5
else
    refuses 2 "no HDF5" run scene.yaml -o ball.h5
    skip "HDF5 files" "this build has no HDF5"
fi
# of a line that is off, the other lines say which
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.1 >scene.yaml
echo 'effects: {level: {c: 0.1}}' >>scene.yaml
run 0 run scene.yaml -o level.csv
run 0 convert --quiet --to point level.csv -o point.csv
sed 's/^# level.c: .*/# level.c: 0.1001/' point.csv >other.csv
run 0 convert --quiet --to ball other.csv -o back.csv # h and eps say c: the line is off
says "other.csv: # level.c: 0.1001 does not fit the first row"
at_most "c" "$(sed -n 's/^# level.c: //p' back.csv | awk '{ print ($1 > 0.1 ? $1 - 0.1 : 0.1 - $1) }')" 1e-6
sed '/^# h/d' other.csv >unknown.csv # of eps and c one is off, and nothing says which
run 3 convert --quiet --to ball unknown.csv
sed 's/^t,/info,/' level.csv | sed 's/^# isoroll trajectory.*//' >info.csv
run 0 convert --quiet --to point info.csv
finish
