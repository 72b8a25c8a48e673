#!/bin/sh
# Full disks, closed pipes and streams, signals, and no memory. In each case the command must give the whole result or
# a clear error. The file must be the old one or the new one, whole. Half a file is wrong; so is success without the
# file.
. "$(dirname "$0")/lib.sh"
# ISO_NO_MEMORY: no_memory.so, made from no_memory.c; empty under sanitizers, which have a malloc of their own
: "${ISO_NO_MEMORY=}"

hard_topic "12. Faults"
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >scene.yaml
scene 0.5 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >open.yaml
cat >effects.yaml <<'END'
reduced: {k: 0.5, J: [1.4, 2.1, 3.0], D: 0.4}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 2, step: 1}
effects: {gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}, twist: {resistance: 1.0e+6}, attitude: {}, reactions: {}}
END
"$isoroll" run scene.yaml -o ball.csv

# timeless FILE: without what a clock has measured
timeless() {
    sed -E 's/[0-9.e+-]+ (ms|us|ns|s)\b/TIME/g; s/"seconds": .*//; s/^cost of .*//' "$1"
}

# is_picture: `made` is a whole picture. It need not be that of other runs: gnuplot has no memory either and leaves out
# a font, and what was computed until a failure is drawn.
is_picture() {
    tail -n 2 made | grep -qx '</svg>'
}

# whole: after success the output `out` and the file `made` are the same as `good.out` and `good`
whole() {
    cmp -s out good.out || { timeless out >out.plain && timeless good.out | cmp -s - out.plain; } || return 1
    [ ! -h made.svg ] || { is_picture && return; }
    [ ! -e good ] || cmp -s made good || { timeless made >made.plain && timeless good | cmp -s - made.plain; }
}

# kept: after a failure `made` is the old file, or new and whole, or the message says how many rows it has; no other
# file is left
kept() {
    [ ! -e made.part ] && [ ! -e made.svg.part ] || { rm -f ./*.part; return 1; }
    [ "$(head -c 9 made 2>/dev/null)" = "old file" ] || { [ -e good ] && cmp -s made good; } ||
        grep -q 'rows were written' err || { [ -h made.svg ] && is_picture; }
}

# spoken: there is a message, and every message begins with "isoroll: "
spoken() {
    [ -s err ] && while IFS= read -r line; do
        case $line in "isoroll: "*) ;; *) return 1 ;; esac
    done <err
}

# --- memory: every call in turn, then every call and all after it

# starve STRIDE ARGUMENT...: every STRIDE-th call fails (short tests: fewer). `made` among the arguments is the file
# written. Adds to $starved and $wrong.
starve() {
    stride=$(($1 * $(length 8 1)))
    shift
    rm -f made good
    ISO_FAIL_COUNT=calls LD_PRELOAD=$ISO_NO_MEMORY "$isoroll" "$@" >good.out 2>err </dev/null ||
        fail "isoroll $*: with memory"
    [ ! -e made ] || mv made good
    calls=$(cat calls)
    check "isoroll $*: memory is asked for" test "$calls" -gt 0
    for how in AT FROM; do
        n=1
        while [ "$n" -le "$calls" ]; do
            echo "old file" >made
            if [ $how = AT ]; then
                ISO_FAIL_AT=$n LD_PRELOAD=$ISO_NO_MEMORY "$isoroll" "$@" >out 2>err </dev/null
            else
                ISO_FAIL_FROM=$n LD_PRELOAD=$ISO_NO_MEMORY "$isoroll" "$@" >out 2>err </dev/null
            fi
            status=$?
            starved=$((starved + 1))
            case $status in
            0) whole ;;
            4 | 5) kept && spoken ;;
            *) false ;;
            esac || { wrong=$((wrong + 1)) && fail "isoroll $*: call $n ($how): exit status $status"; }
            n=$((n + stride))
        done
    done
}

hard_case "memory" "runs that crash, tear a file, say nothing or succeed without the whole result, malloc failing at each call" \
    "libyaml and jansson leave out what they have no memory for; SUNDIALS and GSL do not survive a malloc of theirs that fails"
if [ -n "$ISO_NO_MEMORY" ]; then
    starved=0 wrong=0
    starve 1 run scene.yaml -o made
    starve 1 convert --to point ball.csv -o made
    starve 3 check ball.csv
    starve 8 explain scene.yaml
    starve 8 compare scene.yaml
    starve 1 list
    starve 8 frequencies scene.yaml
    starve 12 frequencies open.yaml --turns 30
    starve 8 analogue "$source/examples/07_neumann_point/scene.yaml"
    starve 12 run effects.yaml -o made
    starve 15 run scene.yaml --verbose -o made
    for method in bdf dormand_prince_7_4_5 bsimp; do # of each library
        starve 17 run scene.yaml --method $method --tol 1e-6 -o made
    done
    starve 17 run scene.yaml --backend exact -o made
    hard_hold $wrong 0
    crashed=0
    ISO_FAIL_COUNT=calls LD_PRELOAD=$ISO_NO_MEMORY "$isoroll" run scene.yaml --method bdf -o made >out 2>err
    n=$(cat calls)
    while [ $crashed -eq 0 ] && [ "$n" -gt 0 ]; do
        ISO_FAIL_ANY=$n LD_PRELOAD=$ISO_NO_MEMORY "$isoroll" run scene.yaml --method bdf -o made >out 2>err
        [ $? -lt 128 ] || crashed=1
        rm -f made made.part
        n=$((n - 5))
    done
    hard_naive "SUNDIALS where room has not been made sure of: crashes" $crashed 0
else
    hard_skip "a sanitizer has a malloc of its own"
fi

# --- disks

# torn FILE: prints 0 if the file is whole (as `good`), the old one or absent, else 1
torn() {
    if [ ! -e "$1" ] || cmp -s "$1" good || [ "$(head -c 8 "$1")" = "old file" ]; then echo 0; else echo 1; fi
}

# fill WORDS ARGUMENT...: runs with room for 1, 2, ... blocks of 512 bytes until it is enough. Adds to $wrong.
fill() {
    words=$1
    shift
    rm -f made made.svg good good.svg
    "$isoroll" "$@" >good.out 2>err || fail "isoroll $*: on a disk with room"
    if [ -e made.svg ]; then mv made.svg good; else mv made good; fi
    file=made
    [ "$words" != gnuplot ] || file=made.svg
    blocks=1 status=5
    while [ $blocks -lt 400 ] && [ "$status" -ne 0 ]; do
        echo "old file" >$file
        (ulimit -f $blocks && exec "$isoroll" "$@") >/dev/null 2>err
        status=$?
        case $status in
        0) [ "$(wc -l <$file)" -eq "$(wc -l <good)" ] ;; # times differ
        5) [ "$(torn $file)" -eq 0 ] && grep -q "$words" err ;;
        *) false ;;
        esac && [ -z "$(find . -name '*.part')" ] ||
            { wrong=$((wrong + 1)) && fail "isoroll $*: room for $blocks blocks: exit status $status"; }
        blocks=$((blocks * 3 / 2 + 1))
    done
    check "isoroll $*: with room for $blocks blocks it is written" test "$status" -eq 0
}

hard_case "disk full" "runs that tear a file, leave a temporary one, or succeed without all of it: with room for 1, 2, ... blocks" \
    "a write may fail late, when the buffer is flushed or the file is synced"
wrong=0
fill "File too large" run scene.yaml --step 0.02 -o made
fill "File too large" convert --to point ball.csv -o made
if has gnuplot "a full disk for a picture"; then fill gnuplot compare scene.yaml --plot made.svg; fi
hard_hold $wrong 0
"$isoroll" run scene.yaml --step 0.02 >good
(ulimit -f 4 && exec "$isoroll" run scene.yaml --step 0.02) >made 2>err
hard_naive "written where the shell puts it, run SCENE >FILE" "$(torn made)" 0

hard_case "tmpfs" "the same where a file system of 16 kB is full" "a full disk says so at other calls than a limit does"
# The answer is in the file `verdict`. It is absent where the file system cannot be set up, for whatever reason.
cat >tiny.sh <<'END'
mkdir tiny && mount -t tmpfs -o size=16k none tiny || exit
echo "old file" >tiny/made
"$1" run scene.yaml --step 0.02 -o tiny/made 2>err
if [ $? -eq 5 ] && grep -q "No space left" err && [ "$(cat tiny/made)" = "old file" ] && [ "$(ls -A tiny)" = made ]
then echo right; else echo wrong; fi >verdict
END
unshare -rm sh tiny.sh "$isoroll" 2>reason
case $(cat verdict 2>/dev/null) in
right) hard_hold 0 0 ;;
wrong) hard_hold 1 0 ;;
*) hard_skip "no file system can be mounted here ($(tail -n 1 reason))" ;;
esac

hard_case "closed streams" "commands that succeed, crash or talk where standard output is full, closed, or a pipe that nobody reads" \
    "what is printed last is written when the program ends"
wrong=0
mkfifo pipe
for arguments in "run scene.yaml --step 0.002" "convert --quiet --to point ball.csv" "compare scene.yaml --json" list --help --version \
    "check ball.csv" "explain scene.yaml" "frequencies scene.yaml" "frequencies scene.yaml --json" \
    "analogue $source/examples/07_neumann_point/scene.yaml" "cost scene.yaml --quick --method taylor --tol 1e-9"; do
    # shellcheck disable=SC2086 # a list
    {
        "$isoroll" $arguments >&- 2>err
        [ $? -eq 5 ] && spoken || { wrong=$((wrong + 1)) && fail "isoroll $arguments >&-"; }
        if [ -c /dev/full ]; then
            "$isoroll" $arguments >/dev/full 2>err
            [ $? -eq 5 ] && spoken || { wrong=$((wrong + 1)) && fail "isoroll $arguments >/dev/full"; }
        fi
        exec 4<>pipe 5>pipe 4>&- # now nobody reads
        "$isoroll" $arguments 2>err >&5
        status=$?
        exec 5>&-
        [ "$status" -eq 5 ] && [ ! -s err ] || { wrong=$((wrong + 1)) && fail "isoroll $arguments | :"; }
    }
done
hard_hold $wrong 0

# --- signals
# left: files in the folder `stop` besides the result
left() {
    ls -A stop | grep -cvx 'made\|made.h5\|made.svg'
}

# begun PID: it writes a file
begun() {
    ls -l "/proc/$1/fd" 2>/dev/null | grep -q '\.part'
}

# none_left WORDS: such a file is a fault; it is counted in $wrong
none_left() {
    [ "$(left)" -eq 0 ] || { wrong=$((wrong + 1)) && fail "$1: $(ls -A stop | tr '\n' ' ')"; }
}

hard_case "signals" "runs, ended by INT, TERM or KILL at a known point, after which the file is torn or lost, or another is left" \
    "the file is being written; after KILL nothing can be put in order"
wrong=0
mkdir stop
for signal in INT TERM KILL; do
    [ $signal != INT ] || interruptible "SIGINT" || continue
    for point in "worked 0" "written 100000"; do
        cp ball.csv stop/made
        signalled $signal "$point" run scene.yaml --t-end 1e8 --step 1 -o stop/made
        if [ $signal = KILL ]; then
            [ "$status" -eq 137 ] && cmp -s stop/made ball.csv
        else # a row at least, no half of one, and all of it an orbit
            [ "$status" -eq 1 ] && "$isoroll" check --max 1e-8 stop/made >/dev/null 2>&1
        fi || { wrong=$((wrong + 1)) && fail "$signal, $point: exit status $status"; }
        [ $signal = KILL ] || none_left "$signal, $point"
    done
done
rm -f stop/*
mkdir -p fake
printf '#!/bin/sh\nsleep 5\n' >fake/gnuplot
chmod +x fake/gnuplot
for signal in INT TERM HUP; do # a command that saves nothing
    [ $signal != INT ] || interruptible "SIGINT" || continue
    cp ball.csv stop/made.svg
    PATH=$PWD/fake:$PATH signalled $signal begun plot ball.csv -o stop/made.svg
    [ "$status" -gt 128 ] && cmp -s stop/made.svg ball.csv ||
        { wrong=$((wrong + 1)) && fail "$signal, plot: exit status $status"; }
    none_left "$signal, plot"
done
rm fake/gnuplot
hard_hold $wrong 0
bytes=$(($(head -n 100 ball.csv | wc -c) - 5)) # in the middle of a line
exec 4<>pipe # held open: the run waits in the pipe until it is killed
"$isoroll" run scene.yaml --t-end 1e8 --step 1 >pipe 2>err &
head -c "$bytes" <pipe >made
kill -KILL $!
wait $! 2>/dev/null
exec 4>&-
hard_naive "written where the shell puts it, run SCENE >FILE: half lines after KILL" "$(tail -c 1 made | tr -d '\n' | wc -c)" 0

hard_case "killed while writing" "a FILE.part that the next run does not replace; one of a running program that it does" \
    "a name beside the result outlives its program: only a lock tells whether that is still there"
wrong=0
# outlived NAME: killed twice while it writes; then a second one beside a first that is held; nothing stays
outlived() {
    rm -f stop/*
    for _ in 1 2; do
        "$isoroll" run scene.yaml --t-end 1e8 --step 1 -o "stop/$1" 2>err &
        await written 100000 $!
        kill -KILL $!
        wait $! 2>/dev/null
        [ "$(ls -A stop)" = "$1.part" ] || { wrong=$((wrong + 1)) && fail "$1, killed: $(ls -A stop)"; }
    done
    exec 4<>pipe
    "$isoroll" convert --to point - -o "stop/$1" <pipe 2>err 4>&- &
    first=$!
    cat ball.csv >&4
    await begun $first
    refuses 5 "'stop/$1.part' is in use: another program writes 'stop/$1'" run scene.yaml -o "stop/$1"
    [ "$(ls -A stop)" = "$1.part" ] || { wrong=$((wrong + 1)) && fail "$1, two at once: $(ls -A stop)"; }
    exec 4>&-
    wait $first
    [ $? -eq 0 ] && "$isoroll" check --max 1e-8 "stop/$1" 2>/dev/null | grep -q '^  point' ||
        { wrong=$((wrong + 1)) && fail "$1: the first of two"; }
    none_left "$1"
}
outlived made
if "$isoroll" convert --to point ball.csv -o made.h5 2>/dev/null; then outlived made.h5; fi
hard_hold $wrong 0

# --- names
hard_case "one file for two" "commands that write over what they read" \
    "a link, or another spelling of the path, is the same file"
wrong=0
cp scene.yaml scene.svg && cp ball.csv times.csv
ln -s scene.svg link.svg && ln scene.svg hard.svg
cp ball.csv late.csv.part && ln -s late.csv late.link
for arguments in "run scene.yaml -o ./scene.yaml" "run scene.yaml --times times.csv -o times.csv" \
    "convert --to point ball.csv -o ball.csv" "compare scene.svg --plot scene.svg" "compare scene.svg --plot link.svg" \
    "compare hard.svg --plot scene.svg" "frequencies scene.svg --plot $work/scene.svg" \
    "cost scene.svg --quick --plot scene.svg" "cost scene.svg --quick --csv scene.svg" \
    "cost scene.yaml --quick --csv a.svg --plot a.svg" "run - -o scene.yaml" \
    "convert --to point late.csv.part -o late.csv" "convert --to point ./late.csv.part -o late.link"; do
    # shellcheck disable=SC2086 # a list
    "$isoroll" $arguments >out 2>err <scene.yaml
    [ $? -eq 2 ] && spoken && cmp -s scene.yaml scene.svg && cmp -s ball.csv times.csv && cmp -s ball.csv late.csv.part && [ ! -e a.svg ] ||
        { wrong=$((wrong + 1)) && fail "isoroll $arguments"; }
done
hard_hold $wrong 0
apart=0
for path in ./scene.svg link.svg hard.svg "$work/scene.svg"; do [ "$path" = scene.svg ] || apart=$((apart + 1)); done
hard_naive "paths compared as text: pairs taken for two files" $apart 0

hard_case "long names" "names of 255 characters that cannot be written; longer ones that are not refused, or without a reason" \
    "a temporary file's name must fit where the file's own just does"
wrong=0
"$isoroll" run scene.yaml -o good
name=$(printf '%0251d.csv' 0)
"$isoroll" run scene.yaml -o "$name" && cmp -s "$name" good || wrong=$((wrong + 1))
for long in 0 "$(printf '%02000d' 0)/" "$(printf '%03900d' 0)/"; do
    refuses 5 "File name too long" run scene.yaml -o "$long$name"
done
hard_hold $wrong 0
(: >".$name.tmp") 2>/dev/null
hard_naive "a temporary name made from the file's, .NAME.tmp" "$(($? != 0))" 0
finish
