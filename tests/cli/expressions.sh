#!/bin/sh
# expressions.sh ISOROLL - potentials and torques that a scene writes, through the commands. Laws of the motion are in
# orbit/test_written.c and model/test_effects.c, mistakes in bad_expressions.txt.
. "$(dirname "$0")/lib.sh"

# scene EFFECT...: a ball on which these act
scene() {
    cat <<END
reduced: {k: ${k:--1}, J: [1.4, 2.1, 3]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 10, step: 1}
effects:
END
    for effect; do echo "  $effect"; done
}

# --- the level, written (its motion, and that of other effects: test_written)
scene 'potential: {U: "c*n1^2 + 0.1*n1*n2 - n2^2/10 + 0.3*n3", parameters: {c: 0.3}}' >same.yaml
run 0 run same.yaml -o ball.csv
check "the line of U" grep -qxF '# potential.U: c*n1^2 + 0.1*n1*n2 - n2^2/10 + 0.3*n3' ball.csv
check "the line of c" grep -qx '# potential.c: 0.3' ball.csv

refuses_changed ball.csv 's/^# potential.U: .*/# potential.U: c*n4/' "U, column 3 of the text: unknown name 'n4'" check
refuses_changed ball.csv '/^# potential.U/d' "effect 'potential' needs a line '# potential.U: ...'" check
refuses_changed ball.csv '/^# potential.c/d' "U, column 1 of the text: unknown name 'c'" check
refuses_changed ball.csv '/^# effects/d' "there is a line '# potential.U'" check
sed 's/^# potential.c: 0.3/# potential.n1: 0.3/' ball.csv >damaged.csv
refuses 3 "'n1' cannot be a parameter: this name has a meaning of its own" check damaged.csv
for i in 1 2 3 4 5 6 7 8; do sed "s/^# potential.c: 0.3/&\n# potential.c$i: $i/" ball.csv >damaged.csv && mv damaged.csv ball.csv; done
refuses 3 "no room for more than 8 parameters" check ball.csv

# --- what is known of it, and what is refused by name
run 0 explain same.yaml
shows -F out "U = c*n1^2 + 0.1*n1*n2 - n2^2/10 + 0.3*n3" "c = 0.3" "holds: (18) of the theory carries the states" \
    "n_1 = 0 is not known to be global: 'potential' acts on the ball" "ball  h  "
run 0 list effects
shows out '^ *numbers: U \[parameters\]$' '^ *numbers: M \[parameters\] \[work\]$'
refuses 3 "same.yaml:5:14: the closed solution is for" run same.yaml --backend exact

run 0 chaos same.yaml

# --- a torque: what it says of the energy (each form: test_work)
k=0.5
scene 'torque: {M: ["-omega1 - omega2*exp(n1)", "omega1*exp(n1) - n3^2*omega2", "0"]}' >torque.yaml
prints 'work = lost' explain torque.yaml
scene 'torque: {M: ["-c*n3^2*omega1", "-c*n3^2*omega2", "-c*n3^2*omega3"], parameters: {c: 0.3}, work: lost}' >friction.yaml
run 0 run friction.yaml -o c.csv
check "its work is lost" grep -qx '# torque.work: lost' c.csv
refuses_changed c.csv 's/^# torque.work: .*/# torque.work: much/' "valid are any, none, lost" check
refuses 3 "friction.yaml:5:11: " section friction.yaml

# --- a false claim: an end with its place, and the rows before it (by every method, patches, true claims: test_work)
patch='3*exp(-2000*((n1 - 0.105)^2 + (n2 - 0.892)^2 + (n3 + 0.439)^2))'
M="\"-omega2 - $patch*omega1\", \"omega1 - $patch*omega2\", \"-$patch*omega3\""
scene "torque: {M: [$M], work: none}" >false.yaml
run 4 run false.yaml --t-end 12 -o false.csv
check "what" grep -q "'torque' does work, but the scene says 'work: none'; last good t = 2.76" err
check "where" grep -q "; there 'torque' takes energy, with omega = (0.93.*) and n = (0.13" err
check "the rows before it" test "$(rows false.csv | wc -l)" -eq 3
# --- expressions that are too long for the formulas together
product=$(printf 'exp(n1)*exp(n2)*%.0s' $(seq 14))n2
scene "potential: {U: \"$product\"}" "torque: {M: [\"$product\", \"${product}^2\", \"$product*n1\"]}" >two.yaml
refuses 3 "more lines than there is room for" run two.yaml

# --- where an expression is not defined: what was computed is written
scene 'potential: {U: "0.1*sqrt(n1 + 0.1)"}' >root.yaml
run 4 run root.yaml -o root.csv
check "the last good time" grep -q "last good t = 6.1.*; there U of 'potential' has, in column 5 of the text, sqrt of " err
check "the rows before it" test "$(rows root.csv | wc -l)" -eq 7

# --- not finite where the ball starts (the ways to get there: bad_expressions.txt): bad input, whoever asks
at="not a finite number where the ball starts, at"
scene 'torque: {M: ["0", "0.1/(omega1 - 0.9)", "n1"]}' >torque.yaml
scene 'potential: {U: "0.1*log(n1 - 0.36)"}' >potential.yaml
for command in "run --method rk8pd" section chaos frequencies explain "cost --quick"; do
    # shellcheck disable=SC2086
    refuses 3 "torque.yaml:5:15: M2 is $at omega = (0.9, -0.3, -0.225) and n = (0.36, 0.48, 0.8): in column 4 of" $command torque.yaml
    # shellcheck disable=SC2086
    refuses 3 "potential.yaml:5:18: U is $at n = (0.36, 0.48, 0.8): in column 5 of the text, log of 0" $command potential.yaml
done
refuses 3 "potential.yaml:5:18: U is $at n = " compare potential.yaml
printf 'scene: torque.yaml\nvary: {k: [0.5, 0.6]}\nmeasure: {chaos: {}}\nuntil: {turns: 2}\n' >sweep.yaml
run 1 sweep sweep.yaml -o starts.csv
check "the points of a sweep" test "$(rows starts.csv | grep -c "M2 is $at omega")" -eq 2

# --- a torque that drives the ball without end, forwards or backwards; one that feeds it up to a speed does not
scene 'torque: {M: ["-omega1", "5*omega2", "omega3"]}' >driven.yaml
for command in "run --t-end 1000 -o d.csv" "run --t-end -1000 --method rk8pd -o d.csv" chaos frequencies; do
    # shellcheck disable=SC2086
    run 4 $command driven.yaml
    words="'torque' drives the ball, without end: it turns more than 10000 times as fast as at the start; last good t = "
    check "$command: why" grep -q "$words" err
done
fed="(1 - omega1^2 - omega2^2 - omega3^2)"
scene "torque: {M: [\"omega1*$fed\", \"omega2*$fed\", \"omega3*$fed\"]}" |
    sed 's/angular_velocity.*/angular_velocity: [9e-6, -3e-6, -2.25e-6]}/' >fed.yaml
run 0 run fed.yaml --t-end 60 -o fed.csv
check "it turned 100000 times as slowly" awk -F, '/^60,/ { exit !($2 * $2 + $3 * $3 + $4 * $4 > 0.99) }' fed.csv
scene 'torque: {M: ["exp(60)*omega1", "0", "0"]}' >strong.yaml
for command in "run --method rk8pd -o d.csv" chaos frequencies; do
    # shellcheck disable=SC2086
    run 4 $command strong.yaml
    check "$command: which effect" grep -q "'torque'" err
done

# --- a constant in U; the point, which would lose its digits, says so
cat >constant.yaml <<END
point: {k: 0.5, J: [1.4, 2.1, 3]}
initial: {gamma: [0.6, 0, 0.8], M: [0, 1.3, 0]}
time: {end: 2, step: 1}
effects: {potential: {U: "1e12 + 0.1*n1"}}
END
quietly run constant.yaml -o constant.csv
refuses 4 "3.5e+12 times what can change of the energy: the point loses" run constant.yaml --backend point

# --- corners, of an even power under a root: where they are refused (which are: test_expression)
scene 'potential: {U: "n1*(n1^2)^(-0.5)"}' >corner.yaml
refuses 3 ": U: this is the root of an even power" run corner.yaml
{
    printf 'scene:\n'
    sed 's/^/  /' corner.yaml
    printf 'vary: {k: [0.5, 0.6]}\nmeasure: {state: {}}\n'
} >sweep.yaml
refuses 3 "sweep.yaml:6:30: U: this is the root of an even power" sweep sweep.yaml
scene 'potential: {U: "sqrt(n1^2 + 0.01)"}' >smooth.yaml
run 0 run smooth.yaml --t-end 1 -o smooth.csv
sed 's/ + 0.01)/)/' smooth.csv >corner.csv
refuses 3 "column 1 of the text: this is the root of an even power" check corner.csv

# --- integrals that the scene claims: the energy of the valley, and what is none
k=-1
energy="(J1*omega1^2 + J2*omega2^2 + J3*omega3^2)/2 + c*n1^2"
claims="integrals: {F: \"$energy\", F3: \"omega1^2\", parameters: {c: 0.3}}"
scene 'potential: {U: "c*n1^2", parameters: {c: 0.3}}' "$claims" >claims.yaml
run 0 run claims.yaml --as both -o both.csv
run 1 check --max 1e-9 both.csv
for model in ball point; do
    check "$model F" awk -v m=$model '$1 == m && $2 == "F" { found = $3 < 1e-13 } END { exit !found }' out
    check "$model F3" awk -v m=$model '$1 == m && $2 == "F3" { found = $3 > 1e-3 } END { exit !found }' out
done
run 0 run claims.yaml -o ball.csv
check "the line of F" grep -qxF "# integrals.F: $energy" ball.csv
check "not of F2" sh -c "! grep -q 'integrals.F2' ball.csv"
run 0 compare claims.yaml
check "compare: F" awk '$1 == "point" && $2 == "F" { found = $4 < 1e-13 && $5 < 1e-13 } END { exit !found }' out
prints -x "integrals that the scene claims" explain claims.yaml
check "explain: none holds" sh -c "sed -n '/^integrals that hold/,/^integrals that do not/p' out | grep -q 'F3' && exit 1 || exit 0"
refuses_changed claims.yaml 's/F: "[^"]*"/F: "n4"/' "bad.csv:6:19: F: unknown name 'n4'" run
refuses_changed claims.yaml 's/F: "[^"]*"/F: "3*c"/' "bad.csv:6:18: F is the same number at every state" run
refuses_changed claims.yaml 's/F: "[^"]*"/F4: "n1"/' "bad.csv:6:15: unknown key 'F4'" run

# --- a sweep over a parameter
cat >sweep.yaml <<END
scene: same.yaml
vary: {potential.c: [0.1, 0.2, 0.3]}
measure: {state: {}}
END
run 0 sweep sweep.yaml -o sweep.csv
check "three points" test "$(rows sweep.csv | wc -l)" -eq 3
refuses_changed sweep.yaml 's/potential.c/potential.d/' "did you mean 'potential.c'" sweep
finish
