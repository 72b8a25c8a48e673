#!/bin/sh
# sweep.sh ISOROLL - `isoroll sweep`: the same bytes whichever way they are computed, every quantity as its own command
# gives it. Its files: sweep_files.sh.
. "$(dirname "$0")/lib.sh"

scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >scene.yaml

# --- HDF5, where the build has it
h5=h5 other=h5
"$isoroll" sweep - -o probe.h5 2>err <<'END'
scene: scene.yaml
vary: {k: 1}
measure: {state: {}}
END
if grep -q 'this build has no HDF5' err; then
    h5=csv other=
    skip "HDF5" "this build has none"
fi
rm -f probe.h5

# --- the same bytes: threads, shards, another chunk; points that fail are rows
cat >grid.yaml <<'END'
scene: scene.yaml
vary:
  k: {from: -1, to: 1, count: 5}
  J2/J1: [1.5, 2]
  start: {spread: 3, seed: 4}
measure:
  state: {as: both}
  backends: {}
chunk: 4
END
for kind in csv $other; do
    run 1 sweep grid.yaml -o "all.$kind"
    check "before it runs" test "$(head -n 1 err)" = "isoroll: sweep: 6 of 30 points have k = 0, where there is no ball: they will fail"
    check "after it" grep -q "6 of 30 points failed; the first is point 12: scene.yaml:1:14: k = 0" err
    check "no more words" test "$(wc -l <err)" -eq 2
    for shard in 1 2 3 4 5; do "$isoroll" sweep grid.yaml -o "part.$shard.$kind" --shard $shard/5 2>err; done
    run 1 sweep --merge part.5.$kind part.3.$kind part.1.$kind part.2.$kind part.4.$kind -o "merged.$kind"
    says "6 points failed; the first is point 12: scene.yaml:1:14: k = 0"
    check "$kind: five shards, in any order" cmp "all.$kind" "merged.$kind"
    refuses 5 "part 3 of 5 is missing" sweep --merge part.1.$kind part.2.$kind part.4.$kind part.5.$kind -o new.$kind
    refuses 5 "part 2 of 5 is there twice" sweep --merge part.2.$kind part.2.$kind -o new.$kind
    refuses 5 "is a whole sweep" sweep --merge all.$kind -o new.$kind
    refuses 5 "is no result of a sweep" sweep --merge scene.yaml -o new.$kind
    refuses 5 "is there: it is not overwritten" sweep --merge part.?.$kind -o merged.$kind
    check_not "nothing is written" test -e new.$kind
done
run 1 sweep grid.yaml
check "standard output" cmp out all.csv
sed 's/chunk: 4/chunk: 7/' grid.yaml >other.yaml
"$isoroll" sweep other.yaml -o other.2.csv --shard 2/5 2>err
refuses 5 "part of another sweep" sweep --merge part.1.$h5 other.2.csv -o new.$h5
check "no part stays" test "$(find . -name '*.part' | wc -l)" -eq 0

# --- shards of Slurm: arrays can begin anywhere, and go in steps
slurm() { SLURM_ARRAY_TASK_ID=$1 SLURM_ARRAY_TASK_COUNT=5 SLURM_ARRAY_TASK_MIN=$2 SLURM_ARRAY_TASK_STEP=$3 \
    "$isoroll" sweep grid.yaml -o "$4" --shard slurm 2>err; }
slurm 0 0 1 task.csv
check "task 0 of 0-4" cmp task.csv part.1.csv
slurm 17 11 3 task2.csv
check "task 17 of 11-23:3" cmp task2.csv part.3.csv
refuses 2 "this is no task of an array" sweep grid.yaml -o new.csv --shard slurm
# task 3 alone, submitted again; then tasks 2 and 4
SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_COUNT=1 SLURM_ARRAY_TASK_MIN=3 SLURM_ARRAY_TASK_MAX=3
export SLURM_ARRAY_TASK_ID SLURM_ARRAY_TASK_COUNT SLURM_ARRAY_TASK_MIN SLURM_ARRAY_TASK_MAX
refuses 2 "one task or gaps, so N is not known: give --shard slurm/N" sweep grid.yaml -o new.csv --shard slurm
run 0 sweep grid.yaml -o task3.csv --shard slurm/5
check "task 3, submitted again" cmp task3.csv part.3.csv
refuses 2 "a number from 1 to 2" sweep grid.yaml -o new.csv --shard slurm/2
refuses 2 "a number from 1 to x" sweep grid.yaml -o new.csv --shard slurm/x
SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_MIN=2 SLURM_ARRAY_TASK_MAX=4
refuses 2 "one task or gaps, so N is not known: give --shard slurm/N" sweep grid.yaml -o new.csv --shard slurm
unset SLURM_ARRAY_TASK_ID SLURM_ARRAY_TASK_COUNT SLURM_ARRAY_TASK_MIN SLURM_ARRAY_TASK_MAX
refuses 2 "expected i/n" sweep grid.yaml -o new.csv --shard 6/5
for option in "-o new.csv" --resume "--shard 1/2"; do
    refuses 2 "does nothing with --point" sweep grid.yaml --point 1 $option
done
for option in "--point 1" --resume "--shard 1/2"; do
    refuses 2 "does nothing with --merge" sweep --merge part.1.csv part.2.csv -o new.csv $option
done

# --- what is no study is what its own command gives for the scene of the point (studies, backends, MEGNO: test_sweep)
# equal NAME CELL VALUE: the same number
equal() {
    check "$1: $2 is $3" awk -v a="$2" -v b="$3" 'BEGIN { number = "^[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?$"
        exit !(a ~ number && b ~ number && a + 0 == b + 0) }'
}
printf 'scene: scene.yaml\nvary: {k: [0.5, -0.75], start: [[0.4, 0.3]]}\nmeasure: %s\nuntil: {time: 40}\n' \
    '{state: {as: both}, error: {tolerance: 1.0e-10}}' >each.yaml
run 0 sweep each.yaml -o each.csv
for point in 1; do
    run 0 sweep each.yaml --point $point
    cp out point.yaml
    run 0 run point.yaml --as both --t-end 40 --backend point -o run.csv # as auto for one row
    for name in t s omega1 n3 M2 gamma1; do
        equal "state $name" "$(cell each.csv $point state_$name)" "$(cell run.csv -1 $name)"
    done
    run 0 run point.yaml --as ball --t-end 40 --tol 1e-10 --verbose -o run.csv
    worst=$(sed -n 's/.*error of (omega, n) at most \([^,]*\),.*/\1/p' err)
    at_most "error, which run rounds up" "$(cell each.csv $point error_ball)" "$worst"
    at_most "error, not below a tenth" "$(awk -v x="$worst" 'BEGIN { print x / 1.11 }')" "$(cell each.csv $point error_ball)"
done

# --- studies have their own options and names (every study: test_sweep)
cat >studies.yaml <<'END'
scene: scene.yaml
vary: {k: [0.5, -0.75]}
measure:
  section: {crossings: 9, as: both}
  periodic: {period: 2, all: false}
  chaos: {turns: 70, exponent_turns: 80, at: [0.4, 0.3]}
  compare: {t-end: 4}
END
sed 's/crossings/crosings/' studies.yaml >bad.yaml
refuses 3 "bad.yaml:4:13: section has no option 'crosings'; did you mean 'crossings'?" sweep bad.yaml
refuses_changed studies.yaml 's/crossings: 9/threads: 2/' "bad.csv:4:13: 'threads' changes no number" sweep
sed 's/period: 2/steps: 2/' studies.yaml >bad.yaml
refuses 3 "bad.yaml:5:3: periodic: periodic: --steps goes with --chart" sweep bad.yaml
sed 's/all: false/chart: J2, steps: 2/;s/period: 2, //' studies.yaml >bad.yaml
run 1 sweep bad.yaml -o chart.csv
says "with these options it has no numbers of one scene"

# --- levels
printf 'scene: {point: {k: 0.5, J: [1.4, 2.1, 3], eps: 1}, initial: {gamma: [0.6, 0, 0.8], M: [0, 0.5, 0]}, time: {end: 1}}
vary: {level: [-0.1, 0, 2, -9]}\nmeasure: {state: {as: point}}\n' >levels.yaml
run 1 sweep levels.yaml -o levels.csv
check "three levels, and one below the potential" test "$(grep -c ',"' levels.csv)" -eq 1
printf 'scene: scene.yaml\nvary: {level: [0, 1]}\nmeasure: {state: {}}\n' >levels.yaml
refuses 3 "'level' needs 'effects: {level: {c: 1}}'" sweep levels.yaml

# --- a bad scene inside; other bad files are in bad_files.txt
refuses 3 "<stdin>:1:" sweep - <<'END'
scene: {reduced: {k: 1, J: [1, 2, -5]}, initial: {normal: [1, 0, 0], angular_velocity: [0, 1, 0]}, time: {end: 1}}
vary: {k: [1, 2]}
measure: {state: {}}
END
finish
