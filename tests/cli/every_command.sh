#!/bin/sh
# every_command.sh ISOROLL - the law of refusals: every command on every example and on every effect of the tables ends
# with 0, or with 3 and a reason that is true. A refusal that names an effect is true if the motion is another one
# without it. Commands and effects come from `isoroll --help` and `isoroll list`, so that new ones are tried as well.
# And the law of what is written: every table of states, of every command that writes one, passes `check` with the
# scene's own numbers; for examples, for random balls and points, on the level 0 and off it, and for every effect.
. "$(dirname "$0")/lib.sh"

# options of a command, so that it takes a moment
cheaply() {
    case $1 in
    run | compare) echo --t-end 0.5 ;;
    cost) echo --t-end 0.2 --backend ball --method taylor --tol 1e-6 ;;
    section) echo --crossings 2 --starts 1 ;;
    chaos) echo --turns 5 --starts 1 ;;
    periodic) echo --period 1 ;;
    splitting) echo --k 0.5 --digits double ;;
    prove) echo --digits 4 ;;
    integrals) echo --turns 2 ;;
    frequencies) echo --turns 20 ;;
    view | plot) echo -o page.out ;;
    esac
}

# SCENE: its effects, one a line
effects_of() {
    "$isoroll" explain "$1" 2>/dev/null | sed -n '/^effects/,/^$/p' | awk 'NR > 1 { print $1 }'
}

# EFFECT: its names as an expression, with that of scenes of points
names_of() {
    "$isoroll" list effects | awk -v name="$1" '
        /^  [a-z]/ { here = $1 == name; if (here) print name }
        here && /a point calls it/ { gsub("\047", "", $NF); print $NF }' | paste -s -d '|'
}

# moves SCENE EFFECT: the motion is another one without this effect
moves() {
    names=$(names_of "$2")
    [ "$2" != level ] || ! grep -q '^point:' "$1" || return 0
    sed -E "s/^( *)($names):.*/\1clock: {}/; s/($names): \{[^{}]*\}/clock: {}/" "$1" >without.yaml
    sed 's/^output:.*//' "$1" >with.yaml
    sed -i 's/^output:.*//' without.yaml
    for one in with without; do
        printf 'output: {columns: [omega1, omega2, omega3, n1, n2, n3]}\n' >>$one.yaml
        "$isoroll" run $one.yaml --t-end 0.5 -o $one.csv 2>/dev/null || return 0
        rows $one.csv >$one.rows
    done
    ! cmp -s with.rows without.rows
}

# true_reason COMMAND SCENE: the message of the last run. Reasons about no effect are about the start, about k, or
# about the question.
true_reason() {
    checks=$((checks + 1))
    named=$(effects_of "$2" | while read -r effect; do
        ! grep -q "'$effect'\|without $effect" err || echo "$effect"
    done)
    if [ -n "$named" ]; then
        for effect in $named; do
            moves "$2" "$effect" || fail "$1 $2 blames '$effect', which does not change the motion"
        done
        return
    fi
    case $1:$(cat err) in
    analogue:*"is a ball already"*) check_not "it is a ball" grep -q '^point:' "$2" ;;
    chaos:*"at rest"* | periodic:*"at rest"*) check "it is at rest" grep -q '\[0, *0, *0\]' "$2" ;;
    *"on a tilted plane"*) check "it is tilted" moves "$2" gravity ;;
    splitting:*"has no separatrix. Give a level above"*)
        awk '{ low = $(NF); split($0, part, "level "); split(part[2], here, ":")
               exit !(here[1] < low) }' err || fail "$1 $2: the level is above what is asked for" ;;
    prove:*"those of a body"*) check "it has a body" grep -q '^ball:' "$2" ;;
    prove:*"on the level H = 0"*) check "it is on another level" grep -Eq '^point:|level:' "$2" ;;
    prove:*"takes k exactly"*) check "k has many digits" grep -Eq 'k: -?[0-9.]{17}' "$2" ;;
    *) fail "$1 $2: a reason that nobody has looked at" ;;
    esac
}

# try COMMAND ARGUMENT... : of the scene in $scene
try() {
    checks=$((checks + 1))
    last=$*
    "$isoroll" "$@" >out 2>err
    status=$?
    case $status in
    0) ;;
    3) true_reason "$1" "$scene" ;;
    *) fail "isoroll $last ($scene): exit status $status" ;;
    esac
}

# the model that rows.csv does not have
other_model() {
    if grep -q '^# model: ball' rows.csv; then echo point; else echo ball; fi
}

# passes COMMAND...: the table of states that it writes of the scene passes
passes() {
    rm -f written.csv
    try "$@" -o written.csv
    # refused; no orbit was found; a scene that chooses other columns
    [ "$status" -eq 0 ] && grep -q '^[0-9-]' written.csv && columns written.csv | grep -q 'n3\|gamma3' || return 0
    passed=$((passed + 1))
    "$isoroll" check --max 1e-9 written.csv >out 2>err || fail "isoroll $last ($scene): $(tail -n 1 out)"
}

# pass_there_and_back: as a ball and as a point, each converted to the other
pass_there_and_back() {
    for model in ball point; do
        other=$([ $model = ball ] && echo point || echo ball)
        passes run "$scene" --t-end 1 --as $model
        [ -s written.csv ] && mv written.csv rows.csv && passes convert rows.csv --to $other
    done
}

# pass_all: by every command that writes states
pass_all() {
    pass_there_and_back
    for model in ball point; do
        passes section "$scene" --crossings 5 --starts 2 --as $model
    done
    passes run "$scene" --t-end 1 --as both
    passes periodic "$scene" --period 2 --all --grid 12
}

try_all() {
    for command in $of_scenes; do
        # shellcheck disable=SC2046
        try "$command" "$scene" $(cheaply "$command")
    done
    "$isoroll" run "$scene" --t-end 0.5 -o rows.csv 2>/dev/null
    for command in $of_files; do
        case $command in
        convert) try convert rows.csv --to "$(other_model)" ;;
        plot) command -v gnuplot >/dev/null || continue ;;
        *) # shellcheck disable=SC2046
            try "$command" rows.csv $(cheaply "$command") ;;
        esac
    done
}

# commands MARK: those whose argument is this
commands() {
    "$isoroll" --help | awk -v mark="$1" '$2 == mark || $2 == "[" mark "]" { print $1 }'
}
of_scenes=$(commands SCENE)
of_files=$(commands FILE)
"$isoroll" view --help 2>/dev/null | grep -q Chromium || of_files=$(echo "$of_files" | grep -v '^view$')
check "there are commands" test "$(echo "$of_scenes" | wc -l)" -ge 8
check "and those of files" test "$(echo "$of_files" | wc -l)" -ge 3

# --- every example ------------------------------------------------------------------------------------------------
passed=0
for scene in "$source"/examples/*/*.yaml; do
    grep -q '^scene:' "$scene" && continue
    try_all
    pass_all
    passes run "$scene" # to its end
done
check "examples write tables" test "$passed" -ge 60

# --- random points and balls, most of them off the level 0
# random SEED: point.yaml and ball.yaml, with the same k and J, a unit vector and one across it
random() {
    awk -v seed="$1" 'function u(a, b) { return a + (b - a) * rand() }
        function three(a, b, c) { return sprintf("[%.17g, %.17g, %.17g]", a, b, c) }
        BEGIN {
            srand(seed)
            k = u(-2, 2); if (k * k < 0.04) k = 0.3
            body = sprintf("{k: %.6f, J: [%.6f, %.6f, %.6f]", k, u(1, 3), u(1, 3), u(1, 3))
            x = u(-1, 1); y = u(-1, 1); z = u(-1, 1); r = sqrt(x * x + y * y + z * z)
            x /= r; y /= r; z /= r
            a = u(-1, 1); b = u(-1, 1); c = u(-1, 1)
            unit = three(x, y, z); across = three(b * z - c * y, c * x - a * z, a * y - b * x)
            rest = "project: true}\ntime: {end: 1, step: 0.25}"
            printf "point: %s, eps: 1}\ninitial: {gamma: %s, M: %s, %s\n", body, unit, across, rest >"point.yaml"
            printf "reduced: %s}\ninitial: {normal: %s, angular_velocity: %s, %s\neffects: {level: {c: %.6f}}\n",
                body, unit, across, rest, u(-0.5, 0.5) >"ball.yaml"
        }'
}

passed=0
for seed in $(seq "$(length 3 15)"); do
    random "$seed"
    for scene in point.yaml ball.yaml; do pass_all; done
done
check "random scenes write tables" test "$passed" -ge "$(length 30 150)"

# --- every effect of the table, with the numbers that it asks for -------------------------------------------------
# Three numbers are a unit vector. A number that is missed is added.
numbers_of() {
    "$isoroll" list effects | awk -v name="$1" '
        /^  [a-z]/ { here = $1 == name }
        here && $1 == "numbers:" { for (i = 2; i <= NF; i++) print $i }'
}

value_of() {
    case $1 in
    *\(3x3\)*) echo '[[0.1, 0, 0], [0, 0.2, 0], [0, 0, -0.1]]' ;;
    *\(3\)*) echo "$2" ;;
    *\(4\)*) echo '[1, 0, 0, 0]' ;;
    U) echo '"n1^2 + n2/2"' ;;
    F) echo '"n1 + omega2"' ;;
    M) echo '["0.1*n1", "0", "-0.2*omega3"]' ;;
    *) echo 0.1 ;;
    esac
}

# scene_of EFFECT K UP MORE: an effect with what its row requires and what the program misses
scene_of() {
    given=
    for number in $(numbers_of "$1" | grep -v '^\['); do
        given="$given${given:+, }${number%%(*}: $(value_of "$number" "$3")"
    done
    for attempt in 1 2 3; do
        cat >"$1.yaml" <<END
reduced: {k: $2, J: [1.4, 2.1, 3.0], D: 0.5}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 1, step: 0.5}
effects: {$1: {$given}$4}
END
        "$isoroll" explain "$1.yaml" >out 2>err && return
        missing=$(sed -n "s/.*missing '\([a-zA-Z_]*\)'.*/\1/p" err)
        [ -n "$missing" ] || missing=$(numbers_of "$1" | sed -n 's/^\[\([a-z]*\)(3.*/\1/p' | head -n "$attempt" | tail -n 1)
        number=$(numbers_of "$1" | grep "^\[*$missing[](]" | head -n 1)
        given="$given${given:+, }$missing: $(value_of "$number" "$3")"
    done
    fail "no scene of the effect $1"
}

for effect in $("$isoroll" list effects | sed -n 's/^  \([a-z_]*\) .*/\1/p'); do
    scene_of "$effect" 0.5 '[0, 0.6, 0.8]' ''
    scene=$effect.yaml
    try_all
    [ "$effect" = integrals ] || pass_there_and_back # what the scene claims here is no integral
done

# --- weight on a plane: a tilted one, and a level one, where it only observes ------------------------------------
scene_of gravity 1 '[0, 0.6, 0.8]' ', reactions: {}'
scene=gravity.yaml
try_all
scene_of gravity 1 '[0.36, 0.48, 0.8]' ', reactions: {}, attitude: {}'
for command in $of_scenes; do
    [ "$command" != analogue ] || continue
    # shellcheck disable=SC2046
    run 0 "$command" gravity.yaml $(cheaply "$command")
done
run 0 run gravity.yaml --as both -o both.csv
run 0 check --max 1e-11 both.csv
run 0 convert --to point both.csv -o point.csv
run 0 check --max 1e-11 point.csv
sed 's/^effects:.*//' gravity.yaml >free.yaml
for one in gravity free; do
    run 0 section $one.yaml --crossings 20 --starts 2 -o $one.csv
    rows $one.csv >$one.rows
    run 0 integrals $one.yaml --turns 2
    cp out $one.integrals
done
check "a horizontal plane and no weight give the same section" cmp gravity.rows free.rows
check "and the same integrals" cmp gravity.integrals free.integrals

# a point whose other numbers say that it is off the level, on which the potential of three equal moments is constant
for numbers in "1, J: [1.4, 2.1, 3]" "-1, J: [1.4, 2.1, 3]" "0.5, J: [1.4, 2.1, 3]" "0.5, J: [2, 2, 2]"; do
    cat >point.yaml <<END
point: {k: $numbers, eps: 1}
initial: {gamma: [0.6, 0, 0.8], M: [0, 0.5, 0]}
time: {end: 1, step: 0.5}
END
    scene=point.yaml
    case $numbers in *"[2, 2, 2]") pass_there_and_back ;; *) try_all ;; esac
done
finish
