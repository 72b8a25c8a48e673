#!/bin/sh
# run.sh ISOROLL - `isoroll run`: what it writes, at which times, and that its numbers depend on the scene alone.
. "$(dirname "$0")/lib.sh"
ball=t,omega1,omega2,omega3,n1,n2,n3
point=s,M1,M2,M3,gamma1,gamma2,gamma3
both=t,tau,s,omega1,omega2,omega3,n1,n2,n3,M1,M2,M3,gamma1,gamma2,gamma3
J="1.4, 2.1, 3.0" omega="0.9, -0.3, -0.225" normal="0.36, 0.48, 0.8"
scene -1 "$J" "$omega" "$normal" 10 1 >scene.yaml

# header SCENE COLUMNS [OPTION...]: the header line
header() {
    input=$1 wanted_columns=$2
    shift 2
    quietly run "$input" "$@"
    check "columns of $last" test "$(columns out)" = "$wanted_columns"
}

# --- columns and lines
header scene.yaml "$ball"
cp out ball.csv
header scene.yaml "$ball" --as ball
check "--as ball is a ball's default" cmp out ball.csv
header scene.yaml "$point" --as point
cp out point.csv
header scene.yaml "$both" --as both
cp out both.csv
{ cat scene.yaml; echo "output: {columns: [s, n3, t, gamma1, omega2]}"; } >columns.yaml
header columns.yaml s,n3,t,gamma1,omega2
cp out columns.csv
header columns.yaml "$point" --as point
at_most "chosen columns are those of both" "$(difference both.csv columns.csv)" 1e-11
check "first line" test "$(head -n 1 ball.csv)" = "# isoroll trajectory 1"
check "comment lines" test "$(sed -n 's/^# \([a-zA-Z]*\): .*/\1/p' ball.csv | tr '\n' ' ')" = \
    "model k J h eps backend method tolerance isoroll "
check "J is what was given" grep -qx '# J: 1.4 2.1 3' ball.csv
check "version" grep -qx "# isoroll: $("$isoroll" --version | sed -n 's/^isoroll //p')" ball.csv
check "the line model: both" grep -qx '# model: both' both.csv
check "11 rows" test "$(rows ball.csv | wc -l)" -eq 11
check "the start stands in the first row" test "$(rows ball.csv | head -n 1)" = \
    "0,0.90000000000000002,-0.29999999999999999,-0.22500000000000001,0.35999999999999999,0.47999999999999998,0.80000000000000004"

# --- a point's scene, and a ball's by the other backend
cat >point.yaml <<END
point: {k: -1, J: [$J]}
initial: {gamma: [0.6, 0, 0.8], M: [0, 2.5, 0]}
time: {end: 5}
END
header point.yaml "$point"
check "101 rows without a step" test "$(rows out | wc -l)" -eq 101
header point.yaml "$ball" --as ball
prints -x '# backend: point' run scene.yaml --backend point --as both
prints -x '# backend: point' run scene.yaml --method kahan_li8 --as both
refuses 2 'kahan_li8 is for the point' run scene.yaml --method kahan_li8 --backend ball

# --- times
printf '5 1,5\t-3 0 # 99\n\n2,,7 \r\n# 4\n10' >asked # unsorted, repeated, both directions
run 0 run scene.yaml --times asked
check "rows in the order asked" test "$(rows out | cut -d, -f1 | tr '\n' ' ')" = "5 1 5 -3 0 2 7 10 "
prints "few and far" explain scene.yaml --t-end 1e5 --step 1e4
echo 7 | "$isoroll" run scene.yaml --times - | rows /dev/stdin >a
rows ball.csv | grep "^7," >b
check "times from standard input" cmp a b

# bad_times TEXT PLACE WORDS
bad_times() {
    printf "$1" >asked
    refuses 3 "asked:$2: $3" run scene.yaml --times asked
}
bad_times '1 2\n3,x\n' 2:3 "'x' is not a time"
bad_times '1\n\n  nan' 3:3 "'nan'"
bad_times '0x10' 1:1 "'0x10'"
bad_times '1\n 5\0006\n' 2:2 "'5' is not a time" # a NUL byte
bad_times '# \303\251\n1 #\303\251\n 2 x' 3:4 "'x' is not a time"
bad_times '' 1:1 "no times"
refuses 5 "cannot open 'absent'" run scene.yaml --times absent
refuses 3 "/dev/zero:1:1" run scene.yaml --times /dev/zero
refuses 2 "not both" run - --times -

# --- --t-end and --step
run 0 run scene.yaml --t-end -4
check "backwards" test "$(rows out | cut -d, -f1 | tr '\n' ' ')" = "0 -1 -2 -3 -4 "
run 0 run scene.yaml --t-end 2.5 --step 0.5
check "--t-end and --step" test "$(rows out | cut -d, -f1 | tr '\n' ' ')" = "0 0.5 1 1.5 2 2.5 "
run 0 run scene.yaml --t-end 2.25
check "the last row is the end" test "$(rows out | cut -d, -f1 | tr '\n' ' ')" = "0 1 2 2.25 "
run 0 run scene.yaml --step 100
check "a step beyond the end" test "$(rows out | cut -d, -f1 | tr '\n' ' ')" = "0 10 "
run 0 run scene.yaml --t-end 0
check "end: 0 is one row" test "$(rows out | cut -d, -f1)" = 0
run 0 run scene.yaml --t-end 5e-324 --step 100
check "two rows to the end of one ulp" test "$(rows out | cut -d, -f1 | tr '\n' ' ')" = "0 4.9406564584124654e-324 "

# --- where it is written
"$isoroll" run - <scene.yaml >a
check "a scene from standard input" cmp a ball.csv
run 0 run scene.yaml -o file.csv
check "-o FILE has what standard output has" cmp file.csv ball.csv
check "nothing else was printed" test ! -s out
run 0 run scene.yaml -o -
check "-o -" cmp out ball.csv
mkdir folder
long=folder/$(printf '%0150d' 1)$(printf '\303\251\377').csv # a long name that is not UTF-8
run 0 run scene.yaml -o "$long"
check "a name that is not UTF-8" cmp "$long" ball.csv
check "no temporary file" test "$(ls -A folder | wc -l)" -eq 1

# --- methods (all of them: test_method; how good estimates are: test_error, test_run)
prints -x '# method: dormand_prince_7_4_5' run scene.yaml --method dormand
run 0 run scene.yaml --method auto --verbose
check "--verbose says how it went" grep -q "^isoroll: 11 rows; backend point, method taylor: " err
check "--verbose changes nothing in the file" cmp out ball.csv

# estimate WHAT: the error of WHAT that the last run has told
estimate() {
    sed -n "s/^isoroll: error of $1 at most \([^,]*\), .*/\1/p" err
}

at_most "estimate at 1e-12" "$(estimate '(omega, n)')" 1e-11
check "how it was found" grep -q "^isoroll: errors are relative, in 11 rows: from the same orbit by taylor_extended" err
run 0 run scene.yaml --tol 1e-3 --as both --verbose
for what in "(omega, n)" "(M, gamma)" tau s; do
    check "an estimate of $what (how good it is: test_error)" test -n "$(estimate "$what")"
done
at_most "the estimate at 1e-3 is large" 1e-6 "$(estimate '(omega, n)')"

# --- what only a run can refuse
refuses 2 "1e8 rows" run scene.yaml --step 1e-9
# methods that cannot be projected say when they have lost the energy, which they do on a very long body's point
scene -0.61 "1e-6, 1, 1" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 100 10 >thin.yaml
run 4 run thin.yaml --backend point --method adams --tol 1e-12
check "lost energy is said" grep -q "^isoroll: adams has lost the energy" err
finish
