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
run 0 section - --crossings 2 --quiet --tol 1e-6 <wild.yaml
check "a scene from standard input" grep -q "^# tolerance: 1e-06\|^# tolerance: 9.99.*e-07" out

run 0 section wild.yaml --starts 20 --crossings 100 -o wild.csv
check "k = 0.5: chaotic orbits part" grep -q "of 21 orbits part" err

# --- states on the section pass `check` as a file of states
run 0 section tame.yaml --crossings 50 --as ball --model ball --quiet -o states.csv
run 0 check states.csv --k -1 --J 1,2,5 --max 1e-9

# --- sections that are not global say so
run 0 section wild.yaml --axis 1 --crossings 5
check "axis 1" grep -q "n_1 = 0 is not global: orbits can stay away from it; n_3 = 0 is global" err
run 0 section wild.yaml --event gamma1=0.1 --crossings 5 --as point
check "an event" grep -q "not known to be a global section" err
check "an event: columns" test "$(columns out)" = "orbit,crossing,t,tau,s,M1,M2,M3,gamma1,gamma2,gamma3"
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

# --- an orbit that does not come to the section: the words name what it crosses
cat >away.yaml <<END
reduced: {k: -2, J: [1, 1.05, 5]}
initial: {normal: [0.6, 0, 0.8], angular_velocity: [-0.8, 0, 0.6]}
time: {end: 1}
END
refuses 3 "_3 = 0 upwards within 10000 turns after the start" section away.yaml --axis 3 --model ball --quiet
check "another axis" grep -q "it crosses n_1 = 0: take axis 1" err
refuses 3 "omega1 is between -0.8 and 0.8; give a value in between" section away.yaml --event omega1=9 --model ball --quiet
cat >barrier.yaml <<END
reduced: {k: 1, J: [1, 2, 5]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 1}
effects: {potential: {U: 0.02/n1^2 + 0.03/n2^2 + 0.05/n3^2}}
END
refuses 3 "it crosses no other n_a = 0 either" section barrier.yaml --axis 3 --model ball --quiet
event=$(sed -n 's/.*use an event instead of an axis, for example \(n3=[0-9.]*\)$/\1/p' err)
run 0 section barrier.yaml --event "$event" --model ball --crossings 2 --quiet
check "the event that the message names" test "$(rows out | wc -l)" -eq 2

# --- refusals (others: test_refusals, test_section_run)
scene 0.5 "1, 2, 5" "0, 0, 2" "0.6, 0.8, 0" 10 0.5 >plane.yaml
run 1 section plane.yaml --starts 3 --crossings 2
check "the others of a scene on the boundary" test "$(grep -c '^[0-9]' out)" -eq 6
check "and why it has none" grep -q "1 of 4 orbits did not get to the end; orbit 0: .*boundary" err
sed 's/^effects:.*/effects: {level: {c: 0.3}}/' gravity.yaml >level.yaml
run 0 section level.yaml --starts 2 --crossings 2
check "global off the level H = 0" grep -q "is global on the level H = " err
refuses 2 "passes each value only once" section wild.yaml --event t=3
refuses 2 "an event has no coordinates" section wild.yaml --event omega1=0.1 --plot a.png
for wrong in "--threads 0" "--model exact"; do
    # shellcheck disable=SC2086 # an option and its value
    refuses 2 "expected" section wild.yaml $wrong
done

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
refuses 3 "gravity.yaml:4:" section gravity.yaml --area
refuses 2 "--area draws no picture" section wild.yaml --area --plot none.svg

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
    { cat wild.yaml && echo "effects: {rotor: {momentum: [0.3, 0.4, 0.5]}}"; } >rotor.yaml
    run 0 section rotor.yaml --starts 4 --crossings 20 -o rotor.csv --quiet
    refuses 3 "the section must be of a free ball" plot rotor.csv -o look.svg --over orbits.csv
    for window in 1 0:1,0:2 1:0,0:1 0:1,0:1,2 a:b,0:1; do
        refuses 2 "expected two ranges" plot wild.csv -o look.svg --window="$window"
    done
    refuses 2 "--window is about a picture" section wild.yaml --window=0:1,0:1
fi
finish
