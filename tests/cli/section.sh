#!/bin/sh
# section.sh ISOROLL - `isoroll section`: files, pictures, messages and refusals. Crossings in quadruple precision, by
# both models: test_crossings.
. "$(dirname "$0")/lib.sh"

# --- the file
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >wild.yaml
scene -1 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >tame.yaml
run 0 section tame.yaml --crossings 30 --starts 9 --at "0.5,0.1;-1,0.2" --at 2,-0.5 -o tame.csv
check "columns" test "$(columns tame.csv)" = "orbit,crossing,t,tau,s,l,x"
check "rows: 1 + 9 + 3 orbits" test "$(rows tame.csv | wc -l)" -eq 390
check "first line" test "$(head -n 1 tame.csv)" = "# isoroll section 1"
shows -x tame.csv "# model: both" "# k: -1" "# J: 1 2 5" "# axis: 1" "# section: n1 = 0, increasing; global" \
    "# crossings: 30" "# starts: 9" "# seed: 0" "# backend: ball"
for key in h eps initial.normal initial.angular_velocity at tolerance isoroll; do
    check "line of $key" grep -q "^# $key: " tame.csv
done
shows err "each by itself: 390 crossings both" "n_1 = 0 is global" \
    "largest distance of the two in (l, x).*: [0-9.]*e-1[0-9], at orbit"
check_not "k = -1: nothing parts" grep -q "orbits part" err
check "orbits and crossings in order" awk -F, '/^[0-9]/ {
    if ($1 != int(n / 30) || $2 != n % 30 + 1) exit 1; n++ }' tame.csv
quietly section wild.yaml --starts 20 --crossings 100 --quiet --threads 1 -o one.csv
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
at_most "an event: its value" "$(tail -n 1 out | awk -F, '{ d = $9 - 0.1; print (d < 0 ? -d : d) }')" 1e-13
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
prints "q0,q1,q2,q3" section gravity.yaml --event q0=0.5 --crossings 3 --as ball --quiet

# --- an orbit that does not come to the section: no failure, and the words name what it crosses
cat >away.yaml <<END
reduced: {k: -2, J: [1, 1.05, 5]}
initial: {normal: [0.6, 0, 0.8], angular_velocity: [-0.8, 0, 0.6]}
time: {end: 1}
END
for model in $(length ball "ball point"); do
    refuses 3 "_3 = 0 upwards within 10000 turns after the start" section away.yaml --axis 3 --model $model --quiet
    check "$model: another axis" grep -q "it crosses n_1 = 0: take axis 1" err
done
run 1 section away.yaml --axis 3 --at 0,0 --model ball --crossings 3 -o some.csv
check "another orbit goes on" test "$(rows some.csv | wc -l)" -eq 3
refuses 3 "omega1 is between -0.8 and 0.8; give a value in between" section away.yaml --event omega1=9 --model ball --quiet
cat >barrier.yaml <<END
reduced: {k: 1, J: [1, 2, 5]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 1}
effects: {potential: {U: 0.02/n1^2 + 0.03/n2^2 + 0.05/n3^2}}
END
times >before
refuses 3 "it crosses no other n_a = 0 either" section barrier.yaml --axis 3 --model ball --quiet
times >between
refuses 3 "does not pass n_3 = 0 upwards" section barrier.yaml --axis 3 --quiet
times >after
# the point would take four times as long as the ball, and have nothing to compare
check "the second model is not asked" awk 'FNR == 2 { split($1, t, /[ms]/); at[++n] = 60 * t[1] + t[2] }
    END { exit !(at[3] - at[2] < 2 * (at[2] - at[1])) }' before between after
event=$(sed -n 's/.*use an event instead of an axis, for example \(n3=[0-9.]*\)$/\1/p' err)
run 0 section barrier.yaml --event "$event" --model ball --crossings 2 --quiet
check "the event that the message names" test "$(rows out | wc -l)" -eq 2

# --- refusals
refuses 2 "expected auto, 1, 2 or 3" section wild.yaml --axis x
refuses 3 "the boundary of the section" section wild.yaml --at "0.5,0.5;0.5,-1"
for wrong in 0.5 0.5, ,1 "0.5,nan" "1;2" x; do refuses 2 "expected l,x" section wild.yaml --at "$wrong"; done
scene 0.5 "1, 2, 5" "0, 0, 0" "0.36, 0.48, 0.8" 10 0.5 >rest.yaml
refuses 3 "rest.yaml:2:56: a ball at rest comes back to no section" section rest.yaml
scene 0.5 "1, 2, 5" "0, 0, 2" "0.6, 0.8, 0" 10 0.5 >plane.yaml
refuses 3 "the boundary of the section" section plane.yaml
run 1 section plane.yaml --starts 3 --crossings 2
check "the others of a scene on the boundary" test "$(grep -c '^[0-9]' out)" -eq 6
check "and why it has none" grep -q "1 of 4 orbits did not get to the end; orbit 0: .*boundary" err
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
    interrupted "interrupted: [0-9]* crossings were written" "written 4096" section wild.yaml --starts 100000 -o stopped.csv
    shows err "interrupted: $(rows stopped.csv | wc -l) crossings"
    interrupted "interrupted: orbits are missing" "worked 4" section tame.yaml --area --starts 100 --crossings 1000000
fi

# --- areas: kept by a free motion, not by a ball that loses energy
quietly section wild.yaml --area --starts 3 --crossings 50
check "both models keep it" test "$(grep -cE '^(ball|point): the area is kept: 4 of 4 orbits keep it' out)" -eq 2
run 0 section wild.yaml --area --starts 3 --crossings 50 -j 1 -o area.csv
check "a row for each orbit and model" test "$(grep -c ',kept,' area.csv)" -eq 8
sed "s/^effects:.*/effects: {rolling_resistance: {coefficient: 1e-4}}/" gravity.yaml >losing.yaml
run 1 section losing.yaml --area --crossings 20
check "rolling resistance is found out" grep -qE '^ball: the area is not kept: 0 of 1 orbits' out
sed "s/^effects:.*/effects: {field: {linear: [0.1, 0.1, 0.05]}}/" gravity.yaml >field.yaml
prints -E '^point: the area is kept: 1 of 1 orbits' section field.yaml --area --crossings 20
refuses 3 "gravity.yaml:4:" section gravity.yaml --area
refuses 2 "--area draws no picture" section wild.yaml --area --plot none.svg
refuses 2 "no option --cloud any more: section --area" section wild.yaml --cloud 1024
refuses 2 "crossings '1e300'" section wild.yaml --crossings 1e300

# --- pictures
if has gnuplot "--plot"; then
    quietly section wild.yaml --starts 30 --crossings 100 -o wild.csv --plot wild.svg --quiet
    shows wild.svg ">chaotic<" "in the units of the scene"
    run 0 section tame.yaml --starts 20 --crossings 200 -o tame.csv --plot tame.svg --quiet
    check_not "k = -1: none is chaotic" grep -q ">chaotic<" tame.svg
    shows tame.svg "<image" ">rotation number: turns from crossing to crossing<"
    run 5 section tame.yaml --crossings 5 -o kept.csv --plot absent/a.svg
    check "rows are kept without the picture" test "$(rows kept.csv | wc -l)" -eq 5
    stand_in
    PATH=$work/bin:$PATH
    run 0 plot tame.csv -o look.svg --script look.gp --window=0.2:0.9,-0.1:0.5
    run 0 plot tame.csv -o look.svg --script whole.gp --window=-3.1416:3.1416,-1:1
    check "a pi in few digits" grep -q "^point_x0 = -3.14159265358979" whole.gp
    check "the axes of a window" grep -q "^point_x1 = 0.[89]" look.gp
    PATH=${PATH#*:}

    # periodic orbits and a splitting over it (which spots, images, windows: test_section_picture)
    run 0 section wild.yaml --starts 10 --crossings 60 -o wild.csv --quiet
    run 0 periodic wild.yaml --period 2 -o orbits.csv
    run 0 splitting wild.yaml --k 0.5,0.6 --digits double -o splitting.csv
    run 0 plot wild.csv -o look.svg --over orbits.csv --over splitting.csv
    shows look.svg ">stable periodic orbit<" ">unstable periodic orbit<" ">leaves the unstable rotation<" ">enters it<"
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
fi
finish
