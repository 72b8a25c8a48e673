#!/bin/sh
# rotor.sh ISOROLL - a ball with a rotor, and its point in a magnetic field, through the commands. Laws of the motion
# are in orbit/test_rotor.c, mistakes in scenes in bad_effects.txt.
. "$(dirname "$0")/lib.sh"

# rotor k K: a ball with this momentum of the rotor
rotor() {
    cat <<END
reduced: {k: $1, J: [1, 2, 5]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 10, step: 1}
effects: {rotor: {momentum: [$2]}}
END
}

# --- a run by both backends, its files, the point's own scene
rotor -1 "0.3, 0.4, 0.5" >scene.yaml
quietly run scene.yaml --as both -o ball.csv
check "the line of the rotor" grep -qx '# rotor.momentum: 0.3 0.4 0.5' ball.csv
run 0 check --max 1e-11 ball.csv
sed 's/^# rotor.momentum: 0.3/&01/' ball.csv >damaged.csv
run 1 check --max 1e-6 damaged.csv
check "another rotor is another motion" grep -q "ABOVE THE BOUND" out
run 0 run scene.yaml -o a.csv
run 0 convert --to point a.csv -o b.csv
run 0 check --max 1e-9 b.csv
run 0 convert --to ball b.csv -o c.csv
at_most "there and back" "$(difference a.csv c.csv)" 1e-9
{
    echo "point: {k: -1, J: [1, 2, 5]}"
    awk -F, '/^0,/ { printf "initial: {M: [%s, %s, %s], gamma: [%s, %s, %s]}\n", $10, $11, $12, $13, $14, $15 }' ball.csv
    echo "time: {end: 2, step: 0.5}"
    echo "effects: {magnetic: {momentum: [0.3, 0.4, 0.5]}}"
} >point.yaml
run 0 run point.yaml --as both -o p.csv
run 0 check --max 1e-11 p.csv
sed 's/magnetic/rotor/' point.yaml >other.yaml
run 0 run other.yaml --as both -o q.csv
check "a rotor is the same" cmp p.csv q.csv

# --- what is known of it, and what is refused by name
run 0 explain scene.yaml
shows -F out "in the magnetic field of 'rotor'" "n_1 = 0 is not known to be global: 'rotor' acts on the ball" \
    "holds: (18) of the theory carries the states"
rotor 1 "0.3, 0.4, 0.5" >plane.yaml
run 0 explain plane.yaml
check "an integral on a plane" sh -c "sed '/^integrals that do not/q' out | grep -c F_rotor | grep -qx 2"
refuses 3 "4:18: with 'rotor' there is a closed solution only where" run scene.yaml --backend exact

# --- three equal moments: the closed solution, for every k
rotor 0.3 "0.3, 0.4, 0.5" | sed 's/1, 2, 5/2, 2, 2/' >round.yaml
run 0 run round.yaml --backend exact -o exact.csv # (its numbers: test_exact_rotor)
prints "any time at the same cost" explain round.yaml
for method in strang kahan_li8; do
    refuses 2 "'rotor' is a magnetic field; take taylor" run scene.yaml --method $method
done
refuses 3 "scene.yaml:4:18: " periodic scene.yaml
says "remove 'rotor'"

# --- the section has its chart, and the mirror images that are left
run 0 section scene.yaml --starts 4 --crossings 20 -o section.csv
check "not global" grep -q '^# section: n1 = 0, increasing; not known to be global' section.csv
check "starts are on the section" test "$(rows section.csv | wc -l)" -eq 100
prints '^  chaotic  *0\.[1-9]' chaos scene.yaml --starts 8
prints '^  chaotic  *0\.0000' chaos plane.yaml --starts 8
if has gnuplot "mirror images"; then
    # points FILE: how many the picture has. All three reversors hold without a rotor, S1 and S3 with K along axis 1.
    points() {
        run 0 plot "$1" -o picture.png --script picture.gp
        grep -c '^ *-\{0,1\}[0-9.]* ' picture.gp
    }
    for K in "0.001, 0.001, 0.001" "0.001, 0, 0" "0, 0, 0"; do
        rotor 1 "$K" >near.yaml
        run 0 section near.yaml --starts 3 --crossings 100 -o near.csv
        points near.csv
    done >counts
    check "more mirrors, more images" awk 'NR > 1 && $1 < 1.5 * last { exit 1 } { last = $1 }' counts
fi

sed 's/^effects.*//' scene.yaml >free.yaml
run 0 periodic free.yaml --period 1 -o orbits.csv
if has gnuplot "what is drawn over a section"; then
    refuses 3 "the section must be of a free ball" plot section.csv --over orbits.csv -o over.svg
fi

# --- a sweep over K
cat >sweep.yaml <<END
scene: scene.yaml
vary:
  k: [1, -1]
  rotor.momentum3: [0, 0.5]
measure: {state: {}}
END
run 0 sweep sweep.yaml -o sweep.csv
check "four points" test "$(rows sweep.csv | wc -l)" -eq 4
finish
