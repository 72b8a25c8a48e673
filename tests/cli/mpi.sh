#!/bin/sh
# mpi.sh ISOROLL - `isoroll-mpi sweep`: the bytes of `isoroll sweep` for any number of ranks; signals; ranks and whole
# runs that are killed, and gone on with by another number of ranks; files in the way.
. "$(dirname "$0")/lib.sh"
program=$(dirname "$isoroll")/isoroll-mpi
if ! [ -x "$program" ]; then
    skip "all" "isoroll-mpi is not built"
    exit 0
fi
mpirun=${ISO_MPIRUN:-mpirun} # that of the MPI of this build
has "$mpirun" "all" || exit 0

# Both MPIs let more ranks run than there are processors; Open MPI must be told, and must be told that root may.
# A single rank may use all processors.
options=
"$mpirun" --version 2>&1 | grep -q -i 'open *mpi\|openrte' && options='--oversubscribe --bind-to none'
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_orte_execute_quiet=1 # its option -q is none of Open MPI 5, where mpirun refuses it
export OMPI_MCA_mpi_yield_when_idle=1 # ranks that wait leave the processor to others
mkdir tmp && export TMPDIR="$work/tmp" # a killed mpirun leaves files with its number; one that gets that number again fails
export ASAN_OPTIONS=detect_leaks=0 # MPI keeps what it has got until the end

# ranks STATUS N ARGUMENT...: isoroll-mpi on N ranks; words in err
ranks() {
    wanted=$1 number=$2
    shift 2
    checks=$((checks + 1))
    # shellcheck disable=SC2086 # options is a list
    timeout -k 5 400 "$mpirun" $options -n "$number" "$program" "$@" >out 2>err </dev/null
    status=$?
    [ $status -eq "$wanted" ] || fail "$number ranks, $*: status $status, not $wanted"
}

# once WORDS: rank 0 alone says them
once() {
    checks=$((checks + 1))
    [ "$(grep -c -e "$1" err)" -eq 1 ] || fail "'$1' is not said once"
}

scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >scene.yaml
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
cat >long.yaml <<END
scene: scene.yaml
vary: {k: {from: 0.3, to: 0.9, count: 60}}
measure: {state: {}}
until: {time: $(slow 20000)}
chunk: 1
END

sed 's/time: .*}/time: 1000}/' long.yaml >quick.yaml

# --- the same bytes
run 1 sweep grid.yaml -o all.csv
run 0 sweep quick.yaml -o quick.h5
for number in $(length "1 3" "1 2 4 7"); do
    ranks 0 $number sweep quick.yaml -o again.h5
    check "$number ranks" cmp quick.h5 again.h5
    rm again.h5
done
ranks 1 4 sweep grid.yaml -o again.csv -j 2
once "6 of 30 points failed; the first is point 12: scene.yaml:1:14: k = 0"
check "rows that failed" cmp all.csv again.csv
ranks 0 3 sweep quick.yaml -o quick.h5 --resume
for shard in 1 2; do ranks 0 2 sweep quick.yaml -o part.$shard.h5 --shard $shard/2; done
ranks 0 2 sweep --merge part.?.h5 -o merged.h5
check "shards by ranks, merged" cmp quick.h5 merged.h5
check "no part stays" test "$(find . -name '*.part' | wc -l)" -eq 0

# --- what is refused is refused once, with the status of isoroll
echo "my thesis" >thesis.csv
cp thesis.csv thesis.copy
ranks 5 3 sweep grid.yaml -o thesis.csv --resume
once "is no result of a sweep: it is not overwritten"
check "a foreign file" cmp thesis.csv thesis.copy
ranks 5 3 sweep grid.yaml -o /dev/full
once "No space left"
ranks 5 3 sweep none.yaml -o new.csv
once "cannot open .none.yaml."
ranks 2 3 sweep grid.yaml -o new.csv --shard 7/3
once "expected i/n"
ranks 2 3 run scene.yaml
once "has the command 'sweep' alone"
ranks 2 2 sweep grid.yaml -o -
once "mpirun does not tell whether its output arrives: give -o FILE"
ranks 2 2 sweep - -o new.csv
once "a pipe reaches one rank alone: give a file"
# By a script, as the mpirun of Open MPI 5.0.7 crashes where one command line starts two programs.
echo 'case ${OMPI_COMM_WORLD_RANK-$PMI_RANK} in 2) exec "$@" --nothing ;; *) exec "$@" -o new.csv ;; esac' >by_rank
# shellcheck disable=SC2086
timeout 400 "$mpirun" $options -n 3 sh by_rank "$program" sweep grid.yaml >out 2>err </dev/null
check "a rank with other options ends all: status $?" test $? -eq 2
once "rank 2: sweep: unknown option --nothing"
ranks 0 3 --version
check "the version, once" test "$(grep -c '^isoroll' out)" -eq 1
check_not "nothing is written" test -e new.csv

# --- signals to mpirun, and to one rank
# pids MPIRUN: of its ranks, one a line; rank 0 is the first. MPICH has a process between.
pids() {
    ps -e -o pid=,ppid=,comm= | awk -v top="$1" '
        { above[$1] = $2; name[$1] = $3 }
        END { for (i in name) if (name[i] ~ /^isoroll-mpi/) for (j = i; j > 1; j = above[j]) if (j == top) print i }' |
        sort -n
}
# start N FILE [CHUNKS]: a run in the background, of $pid; it goes on when so many further chunks are in the part
start() {
    begin=$(cat "$(part_of "$2")" 2>/dev/null | wc -c)
    [ "$begin" -gt 0 ] || begin=800 # the header
    # shellcheck disable=SC2086
    "$mpirun" $options -n "$1" "$program" sweep long.yaml -o "$2" --resume >out 2>err </dev/null &
    pid=$!
    await in_part "$2" $((begin + ${3-2} * 100)) $pid
}
# midway N FILE COMMAND: start, then COMMAND, then its end, with $status; again if the run was done before
midway() {
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        rm -f "$2"
        start "$1" "$2"
        $3 2>/dev/null
        wait $pid
        status=$?
        [ -e "$2" ] || break
    done
}
to_all() { kill -USR1 $pid; }
to_last() { kill -TERM "$(pids $pid | tail -n 1)"; }
full_disk() { prlimit --pid "$(pids $pid | head -n 1)" --fsize=100; }
if has ps "signals and kills"; then
    run 0 sweep long.yaml -o long.h5
    midway 3 stopped.h5 to_all
    check "USR1 to all" test $status -eq 0
    once "stopped by SIGTERM or SIGUSR1: .* of 60 chunks are in 'stopped.h5.csv.part'"
    midway 3 stopped.h5 to_last
    check "TERM to the last rank" test $status -eq 0
    once "stopped by SIGTERM or SIGUSR1: .* of 60 chunks are in 'stopped.h5.csv.part'"
    ranks 0 2 sweep long.yaml -o stopped.h5 --resume
    check "after signals" cmp stopped.h5 long.h5

    # --- a full disk, as far as rank 0 can see
    if has prlimit "a full disk"; then
        midway 3 full.h5 full_disk
        check "a full disk" test $status -eq 5
        once "cannot write 'full.h5.csv.part': File too large"
        ranks 0 4 sweep long.yaml -o full.h5 --resume
        check "after a full disk" cmp full.h5 long.h5
    fi

    # --- kill -9 of a rank, or of everything, when some chunks more are there; then another number of ranks
    tries=0 kills=3 # each way; 1 to 3 ranks
    while [ $tries -lt "$kills" ]; do
        start $((tries % 4 + 1)) killed.h5 $((tries % 5))
        list=$(pids $pid)
        case $((tries % 3)) in
        0) kill -9 $(echo "$list" | tail -n 1) 2>/dev/null ;; # the last rank
        1) kill -9 $(echo "$list" | head -n 1) 2>/dev/null ;; # rank 0
        2) kill -9 $pid $list 2>/dev/null ;;
        esac
        wait $pid 2>/dev/null
        for one in $list; do while kill -0 "$one" 2>/dev/null; do sleep 0.05; done; done
        tries=$((tries + 1))
        [ ! -e killed.h5 ] || { check "killed" cmp killed.h5 long.h5; rm -f killed.h5; }
    done
    ranks 0 2 sweep long.yaml -o killed.h5 --resume
    check "killed $kills times" cmp killed.h5 long.h5
fi
finish
