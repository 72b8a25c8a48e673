#!/bin/sh
# certify.sh ISOROLL - certified orbits: `run --certify` and `convert` of its files: rows, laws, numbers as they are
# written, the reference states, other ways to the same orbit, refusals.
. "$(dirname "$0")/lib.sh"

scene 0.5 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 2 0.5 >half.yaml
"$isoroll" run half.yaml --certify >/dev/null 2>err
if grep -q 'this build has no Arb' err; then
    refuses 2 "libflint-arb-dev; Debian 13: libflint-dev" run half.yaml --certify
    impossible "certified orbits" "this build has no Arb"
fi

# --- a file
quietly run half.yaml --certify --as both -o half.csv
shows half.csv '^# isoroll certified 1$' '^# k: 1/2$' '^# J: 7/5 21/10 3$' '^# digits: 30$'
check "rows" test "$(grep -vc '^[#t]' half.csv)" = 5
check "columns" grep -q '^t,t_radius,tau,tau_radius,s,s_radius,omega1,omega1_radius,.*,gamma3,gamma3_radius$' half.csv
prints -E ',0\.[0-9]{100,},[0-9.]+e-1[0-9][0-9],' run half.yaml --certify --digits 100 --t-end 0.5

# --- numbers are those that are written: in the 20th digit of n, of J, of k and of the last time
sed 's/0.36,/0.36000000000000000001,/' half.yaml >near.yaml
run 0 run near.yaml --certify -o near.csv
check_not "20 digits of n count" cmp -s half.csv near.csv
sed 's/k: 0.5/k: 1\/3/' half.yaml >third.yaml
run 0 run third.yaml --certify --t-end 0.5 -o third.csv
check "k = 1/3" grep -q '^# k: 1/3$' third.csv
sed 's/end: 2,/end: 2.00000000000000000001,/' half.yaml >end.yaml
prints '^2\.00000000000000000001' run end.yaml --certify --digits 25
cat >body.yaml <<END
ball: {mass: 6.8, radius: 0.1092, inertia: [0.0270, 0.0274, 0.0283]}
surface: {kind: shell, radius: 0.0546}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: -1, step: 1}
END
run 0 run body.yaml --certify
shows out '^# k: -1$' '^# J: 422217/3906250 ' '^-1.0*,0,'

# --- rotor, level, the point; rows that hold fewer digits
cat >rotor.yaml <<END
reduced: {k: -1/3, J: [1, 2, 5]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
effects: {rotor: {momentum: [0.3, 0.4, 0.5]}}
time: {end: 1.5, step: 0.5}
output: {as: both}
END
sed 's/rotor: .*/level: {c: 0.3}}/' rotor.yaml >level.yaml
cat >point.yaml <<END
point: {k: 0.75, J: [1.4, 2.1, 3.0], eps: 2.5}
initial: {gamma: [0.6, 0, 0.8], M: [0.8, 0.7, -0.6]}
effects: {magnetic: {momentum: [0.1, 0, 0.2]}}
time: {end: 1, step: 0.25}
output: {as: both}
END
sed 's/k: 0.5/k: 1/; s/end: 2/end: 1/' half.yaml >plane.yaml
sed 's/k: 0.5/k: -1/; s/end: 2/end: 1/' half.yaml >shell.yaml
for name in rotor level point plane shell; do
    run 0 run $name.yaml --certify --backend ball --as both -o $name.ball.csv
    run 0 run $name.yaml --certify --backend point --as both --digits 40 -o $name.point.csv
    run 0 run $name.yaml --certify --as point -o point.csv
    quietly convert --to ball --quiet point.csv -o $name.back.csv
done
run 0 convert --to point half.csv -o half.point.csv
check "convert says how many" grep -q '^isoroll: half.csv: 5 rows, all enclosed$' err
shows half.point.csv '^# model: point$' '^# start: ball$'
run 4 run half.yaml --certify --digits 30 --work-digits 30 -o few.csv
check "how far they hold" grep -Eq '^isoroll: the enclosures hold 30 digits until t = [0-9.]+: computed with 30 digits$' err
check "the rows are counted" grep -Eq '^isoroll: [0-4] of 5 rows were written$' err
check "the file is there" grep -q '^t,t_radius' few.csv
sed 's/end: 2, step: 0.5/end: 1000000, step: 500000/' half.yaml >far.yaml
interruptible "rows are kept" && {
    signalled INT "worked 20" run far.yaml --certify -o far.csv
    check "it is interrupted" grep -q '^isoroll: interrupted: [01] of 3 rows were written$' err
    check "its status" test "$status" = 1
    check "and has a file" grep -q '^# isoroll certified 1$' far.csv
}

# --- a step can take hours, and have 1e8 rows: it is stopped within. What follows needs at most a few seconds each.
ulimit -S -t 30 # of processor time
interruptible "a step ends" && {
    signalled TERM "worked 100" run half.yaml --certify --digits 1000 --work-digits 6000 -o step.csv
    check "within a step" grep -q '^isoroll: interrupted: 0 of 5 rows were written$' err
    check "its status" test "$status" = 1
    check "and a file" grep -q '^# digits: 1000$' step.csv
    signalled TERM "worked 100" run half.yaml --certify --t-end 0.1 --step 1e-9 --digits 5 -o dense.csv
    check "between the rows of a step" grep -q '^isoroll: interrupted: [1-9][0-9]* of 100000001 rows were written$' err
    check "their status" test "$status" = 1
}

# --- work without an end is refused by itself. hopeless WORDS K J OPTION...
hopeless() {
    words=$1
    scene "$2" "$3" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 2 0.5 >hopeless.yaml
    shift 3
    run 4 run hopeless.yaml --certify -o hopeless.csv "$@"
    check "$last: $words" grep -qF "$words" err
    check "$last: the rows before" grep -Eq '^isoroll: [01] of 5 rows were written$' err
    check "$last: a file" grep -q '^t,t_radius' hopeless.csv
}
hopeless "too much work: 0 steps came to t = 0; t = 2 needs steps that are too short for a double: take an earlier end" \
    0.5 "1e-300, 2.1, 3e200"
hopeless "t = 2 needs about" 0.5 "1e-10, 2.1, 3e10" --digits 100
hopeless "no step from t = 0 can be enclosed, with 44 digits or with" 0.5 "1e-300, 2.1, 3"
ulimit -S -t "$(ulimit -H -t)"

# --- laws, the states of the reference, an integrator that shares nothing
find_python mpmath
# python SCRIPT ARGUMENT...: a script in tests/prove; its last line says how much it has looked at
judged() {
    script=$1
    shift
    checks=$((checks + 1))
    "$python" -B "$source/tests/prove/$script" "$@" >out 2>err || fail "$script $*: $(tail -n 3 out)"
}
if [ -z "$python" ]; then
    skip "laws, references, other orbits" "python3-mpmath is not installed"
else
    judged enclosures.py laws half.csv ./*.ball.csv ./*.point.csv ./*.back.csv
    for name in rotor level point plane shell; do echo $name.ball.csv $name.point.csv $name.ball.csv $name.back.csv; done >pairs
    # shellcheck disable=SC2046 # a list of files
    judged enclosures.py overlap $(cat pairs)
    sed 's/^\(1.50*,0,[^,]*,[^,]*,[^,]*,[^,]*\),0\./\1,0.1/' half.csv >false.csv
    "$python" -B "$source/tests/prove/enclosures.py" laws false.csv >out 2>err
    check "a wrong number breaks a law" grep -q '^FAIL false.csv, row 3' out
    judged enclosures.py reference "$isoroll" "$source/tests/reference" "$(length 1 6)"
    judged orbits.py "$isoroll" --count "$(length 2 6)" --digits 80
    judged orbits.py "$isoroll" --count 1 --digits 90 --change 1e-30
fi

# --- refusals
refuses 2 "--tol: --certify has no use for it" run half.yaml --certify --tol 1e-9
refuses 2 "--output: --certify has no use for it" run half.yaml --certify -o half.h5
refuses 2 "--digits: this is for --certify" run half.yaml --digits 20
refuses 2 "a whole number from 1 to 1000" run half.yaml --certify --digits 1001
refuses 2 "from 30 (--digits) to 10000" run half.yaml --certify --work-digits 20
refuses 2 "the closed solution is not enclosed" run half.yaml --certify --backend exact
sed 's/rotor: .*/gravity: {mgb: 1, up: [0, 0, 1]}}/' rotor.yaml >gravity.yaml
refuses 3 "gravity.yaml:3:20: --certify encloses the free ball, with a rotor or on a level: remove 'gravity'" \
    run gravity.yaml --certify
sed 's/as: both/columns: [t, n1]/' rotor.yaml >columns.yaml
refuses 3 "remove 'columns'" run columns.yaml --certify
refuses 3 "which become the point's" convert --to point half.point.csv
refuses 2 "--tol: a certified orbit has all numbers in its file" convert --to point half.csv --tol 1e-9
refuses 3 "'half.csv' is a certified orbit, which is for: convert" check half.csv
run 3 convert --to point - <half.csv
says "convert takes them from a file, by its name"
# broken FILE SED WORDS: the file with this change is refused with the place
broken() {
    sed "$1" half.csv >broken.csv
    run 3 convert --to point broken.csv
    says "$2"
}
broken '/^# k:/d' "broken.csv:10:1: expected lines '# k: 1/2'"
broken 's/^0.50*,0,/0.5x,0,/' "broken.csv:13:1: expected a decimal number"
broken 's/^0.50*,0,/0.5,-1,/' "broken.csv:13:5: expected a radius >= 0"
broken 's/^\(0.50*,0,[^s]*e-[0-9]*,\)0\.8925[0-9]*,/\10.8,/' "broken.csv:13:1: this is no state"
broken 's/^t,t_radius,/x,t_radius,/' "expected the clocks and the columns of the ball"
finish
