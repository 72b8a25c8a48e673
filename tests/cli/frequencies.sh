#!/bin/sh
# frequencies.sh ISOROLL - `isoroll frequencies`: closed or estimated, table, JSON, pictures, refusals. (Every example:
# every_command.sh; the numbers: test_frequencies.)
. "$(dirname "$0")/lib.sh"

quietly frequencies "$source/examples/02_neumann_shell/scene.yaml" --json
check "closed: JSON" is_json
shows out '"solution": "closed'

# --- a rotation: exact periods
scene -1 "1, 2, 3" "0, 0, 2" "0.6, 0.8, 0" 10 0.5 >plane.yaml
run 0 frequencies plane.yaml
shows out '^  period  *3.14159265358979 ' '^the orbit is closed'


# --- an estimate says so, and agrees with the closed solution
scene 0.7 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >estimate.yaml
run 0 frequencies estimate.yaml
check "two angles, t, tau and s" test "$(grep -c '^  frequency  *[0-9.e+-]* ' out)" -eq 2
shows out '^ESTIMATED from an orbit: regular' 'no closed solution: k = 0'
prints '^ESTIMATED from an orbit: undecided' frequencies estimate.yaml --turns 20
run 0 frequencies estimate.yaml --json --t-end 1000 --samples 5000
check "estimated: JSON" is_json
check "samples are a power of two" test "$(value samples)" -eq 8192
check "--t-end" test "$(value length)" = 1000.0

# --- an integrable motion is never called chaotic, whether its closed solution is found or not
cat >extreme.yaml <<END
point: {k: 1, J: [1e-12, 1, 1.1]}
initial: {gamma: [0.28, 0.96, 0], M: [0.96, -0.28, 0.1]}
time: {end: 1}
END
run 0 frequencies extreme.yaml --turns 100
if grep -q '^ESTIMATED' out; then
    shows out '^ESTIMATED from an orbit: integrable; ' '^  the closed solution was not resolved: '
fi

# --- refusals
for wrong in "--turns 0" "--turns x" "--samples 2.5"; do
    # shellcheck disable=SC2086 # an option and its value
    refuses 2 "expected" frequencies estimate.yaml $wrong
done
refuses 2 "expected a positive number" frequencies estimate.yaml --t-end -1
for short in "--turns 1e-300" "--turns 19.9" "--t-end 1e-300" "--t-end 184"; do
    # shellcheck disable=SC2086 # an option and its value
    refuses 2 "turns: frequencies are estimated from 20 or more" frequencies estimate.yaml $short
done

# --- pictures: maps for k = -1 and 1, lines for others
if has gnuplot "--plot"; then
    quietly frequencies "$source/examples/02_neumann_shell/scene.yaml" --plot map.svg
    check "a map" grep -q 'rotation about axis 2, separatrix' map.svg
    steady map.svg
    for symmetric in "-1 1,1,2" "1 1,2,2"; do # the first part is empty
        scene "${symmetric% *}" "${symmetric#* }" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >symmetric.yaml
        run 0 frequencies symmetric.yaml --plot symmetric.svg
        check "a map for $symmetric" grep -q 'this orbit' symmetric.svg
    done
    quietly frequencies estimate.yaml --turns 200 --plot lines.svg
    check "lines" grep -q 'amplitude' lines.svg
    steady lines.svg
    check_not "no warning" grep -q "is chaotic" lines.svg
    run 0 frequencies "$source/examples/16_sections/scene.yaml" --turns 100 --plot lines.svg
    check "a warning on an orbit that is not decided" grep -q "it is not decided" lines.svg
    run 0 frequencies "$source/examples/16_sections/scene.yaml" --plot lines.svg
    check "a warning on a chaotic orbit" grep -q "this orbit is chaotic" lines.svg
    check_not "and no combinations" grep -q ">1,0<" lines.svg
    run 5 frequencies estimate.yaml --turns 50 --plot absent/a.svg
fi

# On a level: the ball with the potential of the level and its point have the same frequencies in every clock.
for k in $(length 0.5 "0.5 -0.6"); do
    cat >ball_level.yaml <<END
reduced: {k: $k, J: [1.4, 2.1, 3.0]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 1, step: 1}
effects: {level: {c: 0.02}}
END
    run 0 run ball_level.yaml --as point -o start.csv
    rows start.csv | head -n 1 | awk -F, -v k="$k" -v eps="$(sed -n 's/^# eps: //p' start.csv)" '{
        print "point: {k: " k ", J: [1.4, 2.1, 3.0], eps: " eps "}"
        print "initial: {M: [" $2 ", " $3 ", " $4 "], gamma: [" $5 ", " $6 ", " $7 "]}"
        print "time: {end: 1}" }' >point_level.yaml
    for model in ball point; do
        run 0 frequencies ${model}_level.yaml --turns 200
        awk '$1 == "frequency" && $2 ~ /^[0-9]/ { print $2, $3, $4 }' out >$model.frequencies
        check "$model: two angles" test "$(wc -l <$model.frequencies)" -eq 2
    done
    at_most "k = $k: ball and point on a level" "$(paste ball.frequencies point.frequencies | awk '
        { for (i = 1; i < 4; i++) { d = $i / $(i + 3) - 1; if (d < 0) d = -d; if (d > most) most = d } }
        END { print most + 0 }')" 1e-9
done

# --- an interruption says so
if interruptible "Ctrl-C"; then
    interrupted "interrupted: no frequencies" "worked 4" frequencies "$source/examples/16_sections/scene.yaml" --turns 100000
fi

finish
