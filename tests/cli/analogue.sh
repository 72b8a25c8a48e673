#!/bin/sh
# analogue.sh ISOROLL - `isoroll analogue`: it prints a report and a scene, or refuses. That this scene gives the
# orbit of the problem: study/test_analogue.c.
. "$(dirname "$0")/lib.sh"

# reports WORDS: the last output has them in its # lines
reports() {
    checks=$((checks + 1))
    grep '^#' out | grep -F -q -e "$1" || fail "isoroll $last: expected the words '$1' in the report"
}

# agrees NAME: the scene in `out` is taken by compare, whose backends agree (its orbit is that of the problem:
# test_analogue)
agrees() {
    silent
    cp out ball.yaml
    prints '^the same orbit: ' compare ball.yaml
    cp ball.yaml out
}

# finds NAME WORDS ARGUMENT...: a report with these words, and a scene
finds() {
    of=$1 words=$2
    shift 2
    run 0 analogue "$@"
    reports "$words"
    agrees "$of"
}

# readable NAME ARGUMENT...: the scene's mass, radius and end are 1, 2 or 5 times a power of ten; its angular velocity is of
# order one; its end is 10 to 100 turns away at this velocity
readable() {
    of=$1
    shift
    run 0 analogue "$@"
    sed -n 's/^ball: *{mass: \([^,]*\), radius: \([^,]*\),.*/\1 \2/p; s/^time: *{end: \([^}]*\)}/\1/p' out | tr ' ' '\n' >round
    check "$of: mass, radius and end" test "$(wc -l <round)" -eq 3
    check "$of: round: $(tr '\n' ' ' <round)" test "$(grep -cxE '(0\.0*|)[125](0*|e[-+]?[0-9]+)' round)" -eq 3
    omega=$(sed -n 's/^ *angular_velocity: \[\(.*\)\]}/\1/p' out | awk -F, '{ print sqrt($1 * $1 + $2 * $2 + $3 * $3) }')
    at_most "$of: angular velocity" "$omega" 3
    at_most "$of: angular velocity $omega, at least 0.3" 0.3 "$omega"
    turns=$(awk -v omega="$omega" 'END { print omega * $1 / 6.2831853 }' round)
    at_most "$of: turns" "$turns" 100
    at_most "$of: turns $turns, at least 10" 10 "$turns"
}

# --- every branch
readable "large numbers" --neumann 1e10,2e10,2.5e10 --energy 2e10
readable "a level" --neumann 1,2,4 --energy 2.25 --level
readable "outside" --k 0.7 --J 1.4,2.1,3 --eps 6.5 --energy 2
prints -E '^ball: *\{mass: 3, radius: [0-9.]*, inertia' analogue --neumann 1,2,2.5 --energy 2 --mass 3
finds "free Neumann" "ball: free: on the sphere V = E - eps (gamma, J gamma) with the ball's J = 2 E - c" --neumann 1,2,2.5 --energy 2
finds "a stated body" "ball: free" --neumann 1,2,2.5 --energy 2 --mass 1 --radius 1
check "2 E - c" grep -qx '# reduced: k = -1, J = 3 2 1.5' out
reports "h = eps k^2/det J = 0.05555555555555555" # 1/(2 x 9)
check "B = 2 A" grep -qx 'surface: {kind: shell, radius: 0.5}' out
# J1 + J2 - J3 = 0.5, twice D: J times 4, less D = 1
check "the body" grep -qx 'ball: {mass: 1, radius: 1, inertia: \[11, 7, 5\]}' out
finds "free Neumann of no body" "triangle inequality: J1 + J2 - J3 = -0.5" --neumann 1,2,4 --energy 2.25
reports "--level gives one that has a body"
check "k and J" grep -qx 'reduced: {k: -1, J: \[3.5, 2.5, 0.5\]}' out
finds "at rest" "energy M^2/2 + V = 0.5; V is between 0.5 and 1.5" --neumann 1,2,3 --energy 0.5
check "a ball at rest" grep -q '^ *angular_velocity: \[0, 0, 0\]}$' out
finds "outside" "body: outside, m = 3, B = 0.1, A = 0.2333333333" --k 0.7 --J 1.4,2.1,3 --eps 6.5 --energy 2 --mass 3 --radius 0.1
finds "k and J alone" "no body:" --k 2 --J 1.4,2.1,4 --eps 1.5
check "no body" grep -qx 'reduced: {k: 2, J: \[1.4, 2.1, 4\]}' out

# --- a scene's start
# carries NAME ENERGY EPS SECTIONS [ARGUMENT...]: a scene with these sections and its start
carries() {
    of=$1 energy=$2 eps=$3
    printf '%s\n' "$4" 'initial: {gamma: [0.6, 0, 0.8], M: [0.64, 1.0, -0.48]}' 'time: {end: 20, step: 0.5}' >point.yaml
    shift 4
    finds "$of" "eps = $eps" point.yaml "$@"
    reports "energy M^2/2 + V = $energy;"
    reports "start: the scene's"
}
carries "E > 0" 0.41 0.25 'point: {k: -1, J: [1, 1.5, 2], eps: 0.25}'
carries "a level stated" 0.3 0.3170731707 'point: {k: -1, J: [1, 1.5, 2]}
effects: {level: {c: 0.1}}'
cp point.yaml level.yaml
"$isoroll" analogue <point.yaml >piped 2>err
check "from standard input" cmp piped ball.yaml
sed 's/^effects.*/effects: {level: {c: 0.1}, attitude: {}, clock: {}}/' point.yaml >more.yaml
run 0 analogue more.yaml
check "what acts on nothing is left out" cmp out ball.yaml

# --- refusals
refuses 2 "--neumann has k = -1" analogue --neumann 1,2,3 --k 2
refuses 2 "--eps is missing" analogue --k 1 --J 1,2,3
refuses 2 "'point.yaml' and a problem in options" analogue --neumann 1,2,3 point.yaml
refuses 2 "--energy needs --neumann" analogue --energy 1 point.yaml
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 5 0.25 >ball.yaml
refuses 3 "ball.yaml: this scene is a ball already" analogue ball.yaml
sed 's/^effects.*/effects: {field: {linear: [1, 0, 0]}}/' level.yaml >field.yaml
refuses 3 "field.yaml:2:" analogue field.yaml
says "is more than V = -eps"
finish
