#!/bin/sh
# written.sh ISOROLL - the law of what is written: every table of states, of every command that writes one, passes
# `check` with the scene's own numbers; for every example and for random balls and points, on the level 0 and off it.
. "$(dirname "$0")/lib.sh"
bound=1e-9

# passes SCENE COMMAND...: what the command writes of the scene passes. A refusal is an answer (every_command.sh asks
# for its reason), a failure is none.
passes() {
    scene_name=$1
    shift
    checks=$((checks + 1))
    "$isoroll" "$@" -o written.csv >out 2>err
    status=$?
    case $status in
    0) ;;
    3) return ;;
    *) fail "isoroll $* ($scene_name): exit status $status" && return ;;
    esac
    grep -q '^[0-9-]' written.csv || return 0 # no orbit was found
    passed=$((passed + 1))
    "$isoroll" check --max $bound written.csv >out 2>err || fail "isoroll $* ($scene_name): $(tail -n 1 out)"
}

# pass_all NAME SCENE: by every command that writes states
pass_all() {
    for model in ball point both; do
        passes "$1" run "$2" --t-end 1 --as $model
        [ $model = both ] || passes "$1" section "$2" --crossings 5 --starts 2 --as $model
    done
    passes "$1" periodic "$2" --period 2 --all --grid 12
    for model in ball point; do
        other=$([ $model = ball ] && echo point || echo ball)
        "$isoroll" run "$2" --t-end 1 --as $model -o rows.csv 2>/dev/null &&
            passes "$1" convert rows.csv --to $other
    done
}

passed=0
for scene in "$source"/examples/*/*.yaml; do
    grep -q '^scene:' "$scene" || pass_all "${scene#"$source"/examples/}" "$scene"
done
check "examples write tables" test "$passed" -ge 60

# --- random points and balls, most of them off the level 0
# random SEED: k, J, a unit vector and one across it
random() {
    awk -v seed="$1" 'function u(a, b) { return a + (b - a) * rand() }
        BEGIN {
            srand(seed)
            k = u(-2, 2); if (k * k < 0.04) k = 0.3
            printf "k: %.6f\nJ: [%.6f, %.6f, %.6f]\n", k, u(1, 3), u(1, 3), u(1, 3)
            x = u(-1, 1); y = u(-1, 1); z = u(-1, 1); r = sqrt(x * x + y * y + z * z)
            x /= r; y /= r; z /= r
            a = u(-1, 1); b = u(-1, 1); c = u(-1, 1)
            printf "unit: [%.17g, %.17g, %.17g]\n", x, y, z
            printf "across: [%.17g, %.17g, %.17g]\n", b * z - c * y, c * x - a * z, a * y - b * x
            printf "c: %.6f\n", u(-0.5, 0.5)
        }' >numbers
}

# number NAME: of the last random ones
number() {
    sed -n "s/^$1: //p" numbers
}

passed=0
seed=1
while [ $seed -le "$(length 5 15)" ]; do
    random $seed
    cat >point.yaml <<END
point: {k: $(number k), J: $(number J), eps: 1}
initial: {gamma: $(number unit), M: $(number across), project: true}
time: {end: 1, step: 0.25}
END
    cat >ball.yaml <<END
reduced: {k: $(number k), J: $(number J)}
initial: {normal: $(number unit), angular_velocity: $(number across), project: true}
time: {end: 1, step: 0.25}
effects: {level: {c: $(number c)}}
END
    pass_all "point $seed" point.yaml
    pass_all "ball $seed" ball.yaml
    seed=$((seed + 1))
done
check "random scenes write tables" test "$passed" -ge "$(length 60 180)"

# --- a number of a table that another scene has is found
run 0 section point.yaml --crossings 5 --starts 2 --as point -o one.csv
sed 's/^# h: .*/# h: 1.5/' one.csv >other.csv
run 1 check --max $bound other.csv
finish
