# lib.sh - what the scripts here share. Each begins with `. "$(dirname "$0")/lib.sh"` and ends with `finish`.
# shellcheck shell=sh disable=SC2034 # the scripts that include it use its variables
# A script works in a folder of its own, which is removed at the end.
set -u
case ${1:?usage: sh SCRIPT ISOROLL} in
/*) isoroll=$1 ;;
*) isoroll=$PWD/$1 ;;
esac
here=$(cd "$(dirname "$0")" && pwd)
source=${ISO_SOURCE:-$here/../..}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
cd "$work" || exit 1
checks=0 failures=0 skipped=0
export LC_ALL=C

# fail WORDS: counts a failed check, and shows the messages of the last `run`
fail() {
    failures=$((failures + 1))
    echo "FAIL $*" >&2
    [ ! -s err ] || sed 's/^/    /' err | head -n 5 >&2
}

# length SHORT FULL: one of the two, see tests/shared/length.h
length() {
    if [ "${ISO_TEST_LENGTH-}" = full ]; then echo "$2"; else echo "$1"; fi
}

# --- events in programs that run. A condition is a command that gets the program's number as its last argument.

# written BYTES PID: the program has a file of this folder open that has so many bytes
written() {
    for opened in "/proc/$2/fd"/*; do
        case $(readlink "$opened") in
        "$(pwd -P)"/*) [ "$(stat -L -c %s "$opened" 2>/dev/null || echo 0)" -lt "$1" ] || return 0 ;;
        esac
    done
    return 1
}

# computed N PID: for N hundredths of a second of processor time
computed() {
    sed 's/.*) //' "/proc/$2/stat" 2>/dev/null | awk -v least="$1" 'END { exit !NR || $12 + $13 < least }'
}

# worked N PID: the same, and it catches SIGUSR1
worked() {
    case $(sed -n 's/^SigCgt:.*\(.\)..$/\1/p' "/proc/$2/status" 2>/dev/null) in
    [2367abef]) computed "$1" "$2" ;;
    *) false ;;
    esac
}

# part_of FILE: where the rows of a sweep into FILE are until all are there
part_of() {
    case $1 in *.h5) echo "$1.csv.part" ;; *) echo "$1.part" ;; esac
}

# in_part FILE BYTES PID: the part of the sweep into FILE is there, and has more bytes
in_part() {
    [ "$(cat "$(part_of "$1")" 2>/dev/null | wc -c)" -gt "$2" ]
}

# await CONDITION... PID: waits until it is so, or the program has ended
await() {
    for awaited; do :; done
    until "$@" || ! kill -0 "$awaited" 2>/dev/null; do sleep 0.01; done
}

# signalled SIGNAL "CONDITION" ARGUMENT...: runs isoroll, which gets the signal when it is so. Leaves its exit status in
# $status, its messages in err. It runs in the foreground: in the background SIGINT is ignored.
signalled() {
    signal=$1 condition=$2
    shift 2
    rm -f pid
    last="$* <- $signal"
    (
        until [ -s pid ]; do sleep 0.01; done
        # shellcheck disable=SC2086 # a command and its arguments
        await $condition "$(cat pid)"
        kill -s "$signal" "$(cat pid)"
    ) 2>/dev/null &
    sh -c 'echo $$ >pid && exec "$@"' sh "$isoroll" "$@" >out 2>err
    status=$?
    wait $!
}

# held FILE ARGUMENT...: starts isoroll with a sweep into FILE, and stops it (SIGSTOP) when its part has begun; from
# the beginning if it has ended by then. Its number is in $pid.
held() {
    into=$1
    shift
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        rm -f "$into"
        "$isoroll" "$@" -o "$into" 2>err &
        pid=$!
        await in_part "$into" 800 $pid
        kill -STOP $pid 2>/dev/null
        [ -e "$into" ] || return 0
        kill -CONT $pid 2>/dev/null
        wait $pid
    done
    fail "isoroll $*: too fast to be stopped"
}

# interrupted_when "DONE" ARGUMENT...: runs isoroll again and again, and presses Ctrl-C each time after twice the
# processor time, until the command DONE finds that something was done by then. Leaves $status, `out`, err.
interrupted_when() {
    done=$1 hundredths=4
    shift
    while
        signalled INT "worked $hundredths" "$@"
        ! $done && grep -q interrupted err && [ $hundredths -lt 100000 ]
    do
        hundredths=$((hundredths * 2))
    done
    checks=$((checks + 1))
    [ "$status" -eq 1 ] || fail "$last: exit status $status, not 1"
}

# slow N: N, or a fifth of it if sanitizers make the programs slow: times of runs that are to take a while
slow() {
    if [ "${ISO_SANITIZE-0}" = 1 ]; then echo $(($1 / 5)); else echo "$1"; fi
}

# skip NAME REASON: this cannot be tried on this machine. run.sh repeats these lines at its end.
skip() {
    skipped=$((skipped + 1))
    echo "SKIP $(basename "$0" .sh): $1: $2"
}

# impossible NAME REASON: nothing of the script can be tried here: it ends, and to skip is no failure
impossible() {
    skip "$1" "$2"
    checks=1
    finish
    exit
}

# has TOOL NAME: the tool is installed; if it is not, NAME is skipped
has() {
    command -v "$1" >/dev/null || { skip "$2" "$1 is not installed"; return 1; }
}

# needs TOOL NAME: the tool is installed; if it is not, nothing of the script can be tried
needs() {
    command -v "$1" >/dev/null || impossible "$2" "$1 is not installed"
}

# interruptible NAME: SIGINT can reach a program started here; if it is ignored (as in a background job), NAME is
# skipped
interruptible() {
    case $(sed -n 's/^SigIgn:.*\(.\)$/\1/p' /proc/self/status 2>/dev/null) in
    [2367abefABEF]) skip "$1" "SIGINT is ignored here" && return 1 ;;
    esac
}

# find_python MODULE: $python is one that has this module, $ISO_PYTHON first; else it is empty
find_python() {
    python=
    for candidate in ${ISO_PYTHON-} python3 /usr/bin/python3; do
        [ -n "$python" ] || ! "$candidate" -c "import $1" 2>/dev/null || python=$candidate
    done
}

# check NAME COMMAND...: the command succeeds
check() {
    name=$1
    shift
    checks=$((checks + 1))
    "$@" >/dev/null 2>&1 || fail "$name: $*"
}

# in_browser SCRIPT: a script of Python here that drives Chromium; it prints "PASS WORDS" or "FAIL WORDS" for each check
in_browser() {
    python3 -B "$here/$1" "$isoroll" "$source" "$work" >results 2>err || fail "$1 ended early"
    while read -r verdict words; do
        case $verdict in
        PASS) checks=$((checks + 1)) ;;
        FAIL) checks=$((checks + 1)) && fail "$words" ;;
        *) echo "$verdict $words" ;;
        esac
    done <results
    check "$1 came to its end" grep -q '^PASS the end' results
}

# check_not NAME COMMAND...: the command fails
check_not() {
    name=$1
    shift
    checks=$((checks + 1))
    if "$@" >/dev/null 2>&1; then fail "$name: should fail: $*"; fi
}

# run STATUS ARGUMENT...: isoroll ends with this exit status. Its output goes to `out`, its messages to `err`
run() {
    wanted=$1
    shift
    checks=$((checks + 1))
    last=$*
    "$isoroll" "$@" >out 2>err
    status=$?
    [ "$status" -eq "$wanted" ] || fail "isoroll $last: exit status $status, not $wanted"
}

# says WORDS: the last run printed one message. It begins with "isoroll: " and contains these words
says() {
    checks=$((checks + 1))
    [ "$(wc -l <err)" -eq 1 ] || fail "isoroll $last: expected one line on stderr"
    case $(cat err) in
    "isoroll: "*) ;;
    *) fail "isoroll $last: expected 'isoroll: ...' on stderr" ;;
    esac
    grep -F -q -e "$1" err || fail "isoroll $last: expected the words '$1'"
}

# refuses STATUS WORDS ARGUMENT...: isoroll ends with this status and message, and prints nothing on standard output
refuses() {
    words=$2
    wanted=$1
    shift 2
    run "$wanted" "$@"
    says "$words"
    check "isoroll $last: nothing on stdout" test ! -s out
}

# refuses_changed FILE SCRIPT WORDS ARGUMENT...: isoroll refuses bad.csv, its last argument: FILE changed by sed
refuses_changed() {
    sed "$2" "$1" >bad.csv
    message=$3
    check_not "sed $2 changes $1" cmp -s "$1" bad.csv
    shift 3
    refuses 3 "$message" "$@" bad.csv
}

# quietly ARGUMENT...: isoroll ends with 0 and prints no message
quietly() {
    run 0 "$@"
    silent
}

# shows [-OPTIONS] FILE PATTERN...: the file has a line for each of the patterns of grep, which gets the options
shows() {
    how=-q
    case $1 in -?*) how=-q${1#-} && shift ;; esac
    shown=$1
    shift
    for pattern; do check "isoroll ${last-}: $shown has '$pattern'" grep "$how" -e "$pattern" "$shown"; done
}

# prints [-OPTIONS] PATTERN ARGUMENT...: isoroll ends with 0, and its output has a line for this pattern
prints() {
    asked=
    case $1 in -[xFE]*) asked=$1 && shift ;; esac
    wished=$1
    shift
    run 0 "$@"
    shows ${asked:+"$asked"} out "$wished"
}

# interrupted WORDS "CONDITION" ARGUMENT...: isoroll gets Ctrl-C when it is so, ends with 1 and says these words
interrupted() {
    said=$1
    shift
    signalled INT "$@"
    check "$last: exit status $status, not 1" test "$status" -eq 1
    shows err "$said"
}

# silent: the last run printed no message
silent() {
    check "isoroll $last: nothing on stderr" test ! -s err
}

# at_most NAME VALUE BOUND: VALUE is a number and not above BOUND
at_most() {
    checks=$((checks + 1))
    awk -v x="$2" -v bound="$3" 'BEGIN { exit !(x ~ /^[-+0-9.eE]+$/ && x + 0 <= bound + 0) }' ||
        fail "$1: $2 is above $3"
}

# near NAME VALUE WANTED BOUND: VALUE is a number, and WANTED within BOUND
near() {
    at_most "$1: $2 for $3" "$(awk -v a="$2" -v b="$3" 'BEGIN { d = a - b; print (a == "" ? "none" : d < 0 ? -d : d) }')" "$4"
}

# stand_in: makes bin/gnuplot, which keeps its input in `script` and draws nothing
stand_in() {
    mkdir bin && printf '#!/bin/sh\ncat >"%s/script"\necho "<svg></svg>"\n' "$work" >bin/gnuplot && chmod +x bin/gnuplot
}

# steady FILE: no piece of a text in the picture begins or ends with a blank: some renderers of SVG drop it, and what
# follows shifts
steady() {
    check_not "$1: a blank beside a change of height or font" \
        grep -qE '<tspan[^>]* dy="[^" ]*">(( | )[^<]*|[^<]* )</tspan>|"[ ]?>[^<]* </tspan><tspan' "$1"
}

# rows FILE: the rows of a trajectory, without header and # lines
rows() {
    grep -v '^#' "$1" | tail -n +2
}

# columns FILE: its header line
columns() {
    grep -v '^#' "$1" | head -n 1
}

# cell FILE ROW NAME: a number of a table; its rows are counted from 0, from the last one with -1, -2
cell() {
    grep -v '^#' "$1" | awk -F, -v row="$2" -v name="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i; next }
        { line[NR - 2] = at ? $at : "no column " name } END { print line[row < 0 ? NR - 1 + row : row] }'
}

# difference A B [UNIT]: the largest difference of the common columns of two trajectories, in units of UNIT. It is
# relative to the length of the vector; for a clock, to its largest value. Prints a number. Prints words if the
# numbers of rows differ, or if the files have no common column besides the clocks.
difference() {
    awk -F, -v unit="${3:-1}" '
        function size(x, i) { x = 0; for (i in v) { w = v[i] < 0 ? -v[i] : v[i]; if (w > x) x = w } return x }
        function abs(x) { return x < 0 ? -x : x }
        FNR == 1 { file++; header = 0 }
        /^#/ { next }
        !header { header = 1; for (i = 1; i <= NF; i++) at[file, $i] = i; next }
        file == 1 { a[++rows] = $0; next }
        {
            n++
            split(a[n], x, ",")
            for (c in at) {
                split(c, key, SUBSEP)
                name = key[2]
                if (key[1] != 1 || !((2, name) in at)) continue
                p = x[at[1, name]] + 0; q = $at[2, name] + 0
                vector = name; sub(/[123]$/, "", vector)
                if (name == "t" || name == "s" || name == "tau") {
                    clock[name] = 1
                    if (abs(p - q) > apart[name]) apart[name] = abs(p - q)
                    if (abs(p) > largest[name]) largest[name] = abs(p)
                } else {
                    common++
                    if (abs(p - q) > d[vector, n]) d[vector, n] = abs(p - q)
                    if (abs(p) > s[vector, n]) s[vector, n] = abs(p)
                }
            }
        }
        END {
            if (n != rows || n == 0 || !common) { print "rows", rows + 0, n + 0, "common columns", common + 0; exit }
            for (c in d) if (d[c] > worst * s[c]) worst = d[c] / s[c]
            for (c in apart) if (apart[c] > worst * largest[c]) worst = apart[c] / largest[c]
            printf "%.3g\n", worst / unit
        }' "$1" "$2"
}

# scene K J OMEGA NORMAL END STEP: a reduced scene, vectors as "x, y, z"
scene() {
    cat <<END
reduced: {k: $1, J: [$2]}
initial: {normal: [$4], angular_velocity: [$3]}
time: {end: $5, step: $6}
END
}

# The book of the hard cases, as shared/hard.h keeps it, for scripts that begin with hard_topic TITLE.
hard_topic() {
    topic=$1
    table=${ISO_BUILD:-$work}/tests/$(basename "$0" .sh).tsv
    [ -d "$(dirname "$table")" ] || table=$work/hard.tsv
    : >"$table"
}

# hard_case NAME QUANTITY WHY
hard_case() {
    case=$1
    printf '%s\t%s\tcase\t%s\t%s\t\t0\n' "$topic" "$case" "$2" "$3" >>"$table"
}

# hard_hold VALUE BOUND [BACKEND METHOD]
hard_hold() {
    printf '%s\t%s\thold\t%s\t%s\t%s\t%s\n' "$topic" "$case" "${3-}" "${4-}" "$1" "$2" >>"$table"
    at_most "$case ${3-} ${4-}" "$1" "$2"
}

# hard_skip REASON: the case cannot be tried on this machine
hard_skip() {
    printf '%s\t%s\tskipped\t\t\t%s\t0\n' "$topic" "$case" "$1" >>"$table"
    skip "$case" "$1"
}

# hard_naive HOW VALUE BOUND: the naive formula must break the bound
hard_naive() {
    printf '%s\t%s\tnaive\t%s\t\t%s\t%s\n' "$topic" "$case" "$1" "$2" "$3" >>"$table"
    checks=$((checks + 1))
    awk -v x="$2" -v bound="$3" 'BEGIN { exit !(x !~ /^[-+0-9.eE]+$/ || x + 0 > bound + 0) }' ||
        fail "$case: naive ($1) holds: $2 is not above $3"
}

# is_json: the brackets in `out` close
is_json() {
    tr -cd '{}[]' <out | awk '{ n = gsub(/{/, "") - gsub(/}/, ""); m = gsub(/\[/, "") - gsub(/]/, ""); exit n || m }'
}

# value KEY [N]: the N-th (default: first) number or word of that name in the JSON in `out`
value() {
    sed -n "s/.*\"$1\": \"\{0,1\}\([^][\",{}]\{1,\}\).*/\1/p" out | sed -n "${2-1}p"
}

# between X LOW HIGH
between() {
    awk -v x="$1" -v low="$2" -v high="$3" 'BEGIN { exit !(x != "" && x + 0 >= low && x + 0 <= high) }'
}

# finish: the counts, and the exit status
finish() {
    echo "$(basename "$0" .sh): $checks checks, $failures failures, $skipped skipped"
    [ "$checks" -gt 0 ] && [ "$failures" -eq 0 ]
}
