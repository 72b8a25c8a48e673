#!/bin/sh
# section.sh ISOROLL - `isoroll section`: reference crossings by each model, files, pictures, messages and refusals.
. "$(dirname "$0")/lib.sh"

# field FILE N: the N-th number of the last row
field() {
    tail -n 1 "$1" | cut -d, -f "$2"
}

# apart A B: their difference, of angles modulo a turn
apart() {
    awk -v a="$1" -v b="$2" 'BEGIN {
        pi = atan2(0, -1); d = a - b; while (d > pi) d -= 2 * pi; while (d < -pi) d += 2 * pi
        printf "%.3g\n", d < 0 ? -d : d }'
}

# relative A B
relative() {
    awk -v a="$1" -v b="$2" 'BEGIN { d = a / b - 1; printf "%.3g\n", d < 0 ? -d : d }'
}

# --- crossings in quadruple precision
count=0
# shellcheck disable=SC2034 # L and err are not needed
while IFS=, read -r id k J1 J2 J3 n1 n2 n3 w1 w2 w3 axis crossing t s l x L err; do
    case $id in s*) ;; *) continue ;; esac
    count=$((count + 1))
    cat >ref.yaml <<END
reduced: {k: $k, J: [$J1, $J2, $J3]}
initial: {normal: [$n1, $n2, $n3], angular_velocity: [$w1, $w2, $w3], project: true}
time: {end: 1}
END
    for model in ball point; do
        run 0 section ref.yaml --model "$model" --crossings "$crossing" --quiet
        silent
        check "$id, $model: crossing" test "$(field out 2)" = "$crossing"
        check "$id, $model: axis" grep -q "^# axis: $axis\$" out
        at_most "$id, $model: t" "$(relative "$(field out 3)" "$t")" 1e-11
        at_most "$id, $model: s" "$(relative "$(field out 5)" "$s")" 1e-11
        at_most "$id, $model: l" "$(apart "$(field out 6)" "$l")" 1e-11
        at_most "$id, $model: x" "$(apart "$(field out 7)" "$x")" 1e-11
    done
done <"$source/tests/reference/section.csv"
check "reference rows" test "$count" -eq 10

# --- the file
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >wild.yaml
scene -1 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >tame.yaml
run 0 section tame.yaml --crossings 30 --starts 9 --at "0.5,0.1;-1,0.2" --at 2,-0.5 -o tame.csv
check "columns" test "$(columns tame.csv)" = "orbit,crossing,t,tau,s,l,x"
check "rows: 1 + 9 + 3 orbits" test "$(rows tame.csv | wc -l)" -eq 390
check "first line" test "$(head -n 1 tame.csv)" = "# isoroll section 1"
for line in "model: both" "k: -1" "J: 1 2 5" "axis: 1" "section: n1 = 0, increasing; global" "crossings: 30" \
    "starts: 9" "seed: 0" "backend: ball"; do
    check "line $line" grep -q "^# $line\$" tame.csv
done
for key in h eps initial.normal initial.angular_velocity at tolerance isoroll; do
    check "line of $key" grep -q "^# $key: " tame.csv
done
check "summary: counts" grep -q "each by itself: 390 crossings both" err
check "summary: global" grep -q "n_1 = 0 is global" err
check "summary: distance" grep -q "largest distance of the two in (l, x).*: [0-9.]*e-1[0-9], at orbit" err
check_not "k = -1: nothing parts" grep -q "orbits part" err
check "orbits and crossings in order" awk -F, '/^[0-9]/ {
    if ($1 != int(n / 30) || $2 != n % 30 + 1) exit 1; n++ }' tame.csv
run 0 section wild.yaml --starts 20 --crossings 100 --quiet --threads 1 -o one.csv
silent
run 0 section wild.yaml --starts 20 --crossings 100 --quiet -j 2 -o two.csv
check "threads change nothing" cmp one.csv two.csv
run 0 section wild.yaml --starts 20 --crossings 100 --seed 7 -o seven.csv
check "k = 0.5: chaotic orbits part" grep -q "of 21 orbits part" err
check_not "another seed" cmp one.csv seven.csv
run 0 section wild.yaml --crossings 3 --as both --model point --quiet
check "states of both" test "$(columns out | tr -cd , | wc -c)" -eq 18
check "by the point" grep -q "^# backend: point" out
run 0 section - --crossings 2 --quiet --tol 1e-6 <wild.yaml
check "a scene from standard input" grep -q "^# tolerance: 1e-06\|^# tolerance: 9.99.*e-07" out

# --- states on the section pass `check` as a file of states
run 0 section tame.yaml --crossings 50 --as ball --model ball --quiet -o states.csv
run 0 check states.csv --k -1 --J 1,2,5 --max 1e-9
if "$isoroll" section tame.yaml --crossings 50 --as both --quiet -o states.h5 2>err; then
    check "HDF5" test "$(head -c 4 states.h5 | tail -c 3)" = HDF
    if has h5ls "columns in HDF5"; then
        h5ls -r states.h5 >list
        for set in orbit crossing l x; do check "/section/$set" grep -q "^/section/$set  *Dataset {50/Inf}" list; done
        check "/ball/omega" grep -q "^/ball/omega  *Dataset {50/Inf, 3}" list
    fi
else
    check "no HDF5 in this build" grep -q "HDF5" err
fi

# --- sections that are not global say so
run 0 section wild.yaml --axis 1 --crossings 5
check "axis 1" grep -q "n_1 = 0 is not global: orbits can stay away from it; n_3 = 0 is global" err
run 0 section wild.yaml --event gamma1=0.1 --crossings 5 --as point
check "an event" grep -q "not known to be a global section" err
check "an event: columns" test "$(columns out)" = "orbit,crossing,t,tau,s,M1,M2,M3,gamma1,gamma2,gamma3"
at_most "an event: its value" "$(apart "$(field out 9)" 0.1)" 1e-13
run 0 section wild.yaml --event n3=0 --crossings 5 --quiet -o event.csv
run 0 section wild.yaml --axis 3 --crossings 5 --quiet -o axis.csv
check "n3 = 0 is axis 3" cmp event.csv axis.csv
cat >gravity.yaml <<END
reduced: {k: 0.5, J: [1, 2, 5]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 1}
effects: {gravity: {mgb: 0.3, up: [0, 0.6, 0.8]}, attitude: {}}
END
run 0 section gravity.yaml --crossings 5
check "gravity: columns" test "$(columns out)" = "orbit,crossing,t,l,x"
check "gravity: not global" grep -q "'gravity' acts on the ball" err
run 0 section gravity.yaml --event q0=0.5 --crossings 3 --as ball --quiet
check "the column of an observer" grep -q "q0,q1,q2,q3" out

# --- refusals
refuses 2 "expected auto, 1, 2 or 3" section wild.yaml --axis 4
refuses 2 "expected auto, 1, 2 or 3" section wild.yaml --axis x
refuses 3 "the boundary of the section" section wild.yaml --at 0.5,1
refuses 3 "the boundary of the section" section wild.yaml --at "0.5,0.5;0.5,-1"
refuses 3 "is outside the chart" section wild.yaml --at 0.5,1.5
for wrong in 0.5 0.5, ,1 "0.5,nan" "1,0.1;" "1;2" x; do
    [ "$wrong" = "1,0.1;" ] || refuses 2 "expected l,x" section wild.yaml --at "$wrong"
done
scene 0.5 "1, 2, 5" "0, 0, 0" "0.36, 0.48, 0.8" 10 0.5 >rest.yaml
refuses 3 "rest.yaml:2:56: a ball at rest comes back to no section" section rest.yaml
scene 0.5 "1, 2, 5" "0, 0, 2" "0.6, 0.8, 0" 10 0.5 >plane.yaml
refuses 3 "the boundary of the section" section plane.yaml
run 1 section plane.yaml --starts 3 --crossings 2
check "the others of a scene on the boundary" test "$(grep -c '^[0-9]' out)" -eq 6
check "and why it has none" grep -q "1 of 4 orbits did not get to the end; orbit 0: .*boundary" err
for effect in "rolling_resistance: {coefficient: 0.1}" "twist: {resistance: 10, D: 0.5}"; do
    sed "s/^effects:.*/effects: {$effect}/" gravity.yaml >losing.yaml
    refuses 3 "takes energy from the ball: a motion that comes to rest comes back to no section" section losing.yaml
done
refuses 3 "breaks the isomorphism" section gravity.yaml --model point
refuses 3 "no other starts can be given here" section gravity.yaml --starts 2
refuses 3 "no other starts can be given here" section wild.yaml --event omega1=0.1 --at 0,0
sed 's/^effects:.*/effects: {level: {c: 0.3}}/' gravity.yaml >level.yaml
run 0 section level.yaml --starts 2 --crossings 2
check "global off the level H = 0" grep -q "is global on the level H = " err
refuses 2 "there is no column" section wild.yaml --event omega=0.1
refuses 2 "expected COLUMN=VALUE" section wild.yaml --event omega1
refuses 2 "passes each value only once" section wild.yaml --event t=3
refuses 3 "needs the effect 'reactions'" section wild.yaml --event pressure=3
refuses 2 "an event has no coordinates" section wild.yaml --event omega1=0.1 --plot a.png
for wrong in "--crossings 0" "--starts -1" "--starts 1.5" "--seed -1" "--threads 0" "--model exact" "--tol 2"; do
    # shellcheck disable=SC2086 # an option and its value
    refuses 2 "expected" section wild.yaml $wrong
done
refuses 2 "--axis or --event, not both" section wild.yaml --axis 1 --event n1=0
refuses 2 ".svg, .png or .pdf" section wild.yaml --plot a.gif
refuses 5 "No such file or directory" section wild.yaml --crossings 1 -o absent/a.csv

# --- an interruption keeps what there is
if interruptible "Ctrl-C"; then
    signalled INT "written 4096" section wild.yaml --starts 100000 -o stopped.csv
    check "interrupted: exit status 1" test $status -eq 1
    check "interrupted: says so" grep -q "interrupted: [0-9]* crossings were written" err
    check "interrupted: all rows there are" grep -q "interrupted: $(rows stopped.csv | wc -l) crossings" err
    signalled INT "worked 4" section wild.yaml --cloud 1000000
    check "interrupted clouds: exit status 1" test $status -eq 1
    check "interrupted clouds: says so" grep -q "interrupted: clouds are missing" err
fi

# --- clouds: the free flow and the returns keep the measure, a ball that loses energy does not
run 0 section wild.yaml --cloud 2048
silent
check "three clouds" test "$(grep -c '^  \(flow in [ts]\|returns\)  *kept  *[0-9.e-]*  ' out)" -eq 3
run 0 section wild.yaml --cloud 2048 --seed 3 -j 1
sed "s/^effects:.*/effects: {rolling_resistance: {coefficient: 0.1}}/" gravity.yaml >losing.yaml
run 1 section losing.yaml --cloud 1024
check "rolling resistance is found out" test "$(grep -c 'not kept' out)" -ge 2
sed "s/^effects:.*/effects: {field: {linear: [0.1, 0.1, 0.05]}}/" gravity.yaml >field.yaml
run 0 section field.yaml --cloud 1024
check "returns in a field" grep -q "^  returns  *not tried: " out
refuses 3 "gravity.yaml:4:" section gravity.yaml --cloud 1024
refuses 2 "512" section wild.yaml --cloud 100
refuses 2 "--cloud takes no --output" section wild.yaml --cloud 1024 -o cloud.csv
refuses 2 "--cloud takes no --at" section wild.yaml --cloud 1024 --at 0.5,0.2
refuses 2 "crossings '1e300'" section wild.yaml --crossings 1e300

# --- pictures
if has gnuplot "--plot"; then
    run 0 section wild.yaml --starts 30 --crossings 100 -o wild.csv --plot wild.svg --quiet
    silent
    check "a picture of both: chaotic orbits" grep -q ">chaotic<" wild.svg
    # each orbit has the verdict of its own: for J = 1, 2, 5 those with |omega3| > 0.6 |omega| are regular
    stand_in
    PATH=$PWD/bin:$PATH "$isoroll" section wild.yaml --starts 30 --crossings 100 -o wild.csv --plot none.svg --quiet
    sed -n '/^\$ball <</,/^EOD/p' script | awk 'NF == 4 && $2 * $2 > 0.36 { n[$4]++ } END { print n[0] + 0, n[1] + 0 }' >a
    check "outside of the sea all orbits are in colours" grep -q '^[1-9][0-9]* 0$' a
    run 0 section tame.yaml --starts 30 --crossings 100 -o tame.csv --plot tame.svg --quiet
    check_not "k = -1: none is chaotic" grep -q ">chaotic<" tame.svg
    run 0 plot tame.csv -o look.svg --script whole.gp --window=-3.1416:3.1416,-1:1
    check "a pi in few digits" grep -q "^set xrange \[-3.14159265358979[0-9]*:3.14159265358979[0-9]*\]" whole.gp
    check "its axes" grep -q "in the units of the scene" wild.svg
    run 0 section tame.yaml --starts 5 --crossings 20 --model ball -o tame.csv --plot tame.png --quiet
    check "a picture of one" test "$(head -c 4 tame.png | tail -c 3)" = PNG
    run 5 section tame.yaml --crossings 5 -o kept.csv --plot absent/a.svg
    check "rows are kept without the picture" test "$(rows kept.csv | wc -l)" -eq 5

    # the script of a picture: spots of both sides as "place height colour shade"
    block() {
        awk -v head="\$$1 << EOD" '
            $0 == head { inside = 1; next }
            $0 == "EOD" { inside = 0 }
            inside && $1 != "NaN"' look.gp
    }
    spots() { block "$1" | awk 'NF == 4'; }
    run 0 plot tame.csv -o look.svg --script look.gp
    run 0 section tame.yaml --starts 20 --crossings 200 -o tame.csv --plot look.svg --script look.gp --quiet
    check "a scale of rotation numbers" grep -q ">rotation number: turns from crossing to crossing<" look.svg
    check "many colours" test "$(spots ball | awk '{ print $3 }' | sort -u | wc -l)" -gt 10
    # mirror images: to each spot of a regular orbit one with l, x and the others' signs, in the same colour
    spots point | awk '$4 == 0 { printf "%.3f %.2f %d\n", ($1 < 0 ? -$1 : $1), ($2 < 0 ? -$2 : $2), $3 }' |
        sort | uniq -c | awk '{ n[$1 % 4]++ } END { print n[0] + 0, n[1] + n[2] + n[3] + 0 }' >a
    check "four or eight spots of each" awk '{ exit !($1 > 100 && $2 * 20 < $1) }' a

    # only a part
    run 0 plot tame.csv -o look.svg --script look.gp --window=0.2:0.9,-0.1:0.5
    check "spots in the window" test "$(spots point | wc -l)" -gt 20
    check "none outside of it" test "$(spots point | awk '$1 < 0.1999 || $1 > 0.9001' | wc -l)" -eq 0
    run 0 plot tame.csv -o look.svg --script whole.gp --window=-3.1416:3.1416,-1:1
    check "a pi in few digits" grep -q "^set xrange \[-3.14159265358979[0-9]*:3.14159265358979[0-9]*\]" whole.gp
    check "its axes" grep -q "^set xrange \[0.2[0-9]*:0.[89][0-9]*\]" look.gp

    # periodic orbits and a splitting over it
    run 0 section wild.yaml --starts 10 --crossings 60 -o wild.csv --quiet
    run 0 periodic wild.yaml --period 2 -o orbits.csv
    run 0 splitting wild.yaml --k 0.5,0.6 --digits double -o splitting.csv
    run 0 plot wild.csv -o look.svg --script look.gp --over orbits.csv --over splitting.csv
    for words in "stable periodic orbit" "unstable periodic orbit" "leaves the unstable rotation" "enters it"; do
        check "the key: $words" grep -q ">$words<" look.svg
    done
    # the stable orbits of the file with their images; x times G(l) upward, with signs
    { columns orbits.csv; rows orbits.csv; } | awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        $at["stability"] == "stable" { n += 8 } END { print n + 0 }' >a
    block point0 | grep -c . >b
    check "as many as there are" sh -c 'test $(cat a) -gt 0 && test $(cat a) -eq $(cat b)'
    for kind in 2 3; do block point$kind | awk 'NF == 2 {
        printf "%.3f %.2f\n", ($1 < 0 ? -$1 : $1), ($2 < 0 ? -$2 : $2) }' | sort -u >curve$kind; done
    check "both curves are mirror images" sh -c 'test -s curve2 && cmp curve2 curve3'
    run 0 section wild.yaml --starts 5 --crossings 60 -o wild.csv --plot look.png --over orbits.csv --quiet
    sed 's/^0\.5,/0.55,/' splitting.csv >other.csv
    refuses 3 "no row has the k and the level of the section" plot wild.csv -o look.svg --over other.csv
    refuses 3 "it has other k or J" plot tame.csv -o look.svg --over orbits.csv
    refuses 3 "what 'periodic -o' or 'splitting -o' writes" plot wild.csv -o look.svg --over tame.csv
    refuses 2 "--over is for sections" plot orbits.csv -o look.svg --over orbits.csv
    cp orbits.csv orbits.svg
    refuses 2 "would overwrite what is read" plot wild.csv -o orbits.svg --over orbits.svg
    for window in 1 0:1 0:1,0:2 1:0,0:1 0:4,0:1 0:1,0:1,2 a:b,0:1; do
        refuses 2 "expected two ranges" plot wild.csv -o look.svg --window="$window"
    done
    refuses 2 "--window is about a picture" section wild.yaml --window=0:1,0:1
else
    echo "gnuplot is not installed: no pictures"
fi
finish
