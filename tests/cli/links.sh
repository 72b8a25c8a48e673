#!/bin/sh
# links.sh ISOROLL - every file that `-o` and the like name may be a symbolic link: what it leads to is replaced, or
# made if it is not there. It is refused, before anything is computed, where its folder is missing, where links go
# round, and where it is a folder.
. "$(dirname "$0")/lib.sh"
scene -1 "2, 3, 4" "0, 1, 0" "0.6, 0, 0.8" 10 0.1 >ball.yaml
printf 'scene: ball.yaml\nvary: {k: [-1, 1, 2]}\nmeasure: {state: {}}\nuntil: {time: 1}\n' >sweep.yaml
mkdir there folder chain
run 0 run ball.yaml -o ball.csv
h5=
! "$isoroll" run ball.yaml -o probe.h5 2>err || h5=h5

# writes NAME ARGUMENT...: NAME is a link of each kind, and the last argument
writes() {
    made=$1
    shift
    for there in "" old; do
        rm -f there/* chain/* "$made"
        ln -s "$PWD/there/$made" chain/next # absolute, behind a relative one
        ln -s chain/next "$made"
        case $there$1 in oldsweep) continue ;; esac # its own files alone are not refused
        [ -z "$there" ] || { echo old >"there/$made" && chmod 640 "there/$made"; }
        run 0 "$@" "$made"
        check "$last ($there): the link stays" test -h "$made" -a -h chain/next
        check "$last ($there): its end is a file" test -f "there/$made" -a ! -h "there/$made" -a -s "there/$made"
        check_not "$last ($there): it is as before" grep -qx old "there/$made"
        [ -z "$there" ] || check "$last: its permissions" test "$(stat -c %a "there/$made")" = 640
        check "$last ($there): nothing else is left" test "$(ls -A there chain . | grep -c 'part$')" -eq 0
    done
    rm -f "$made" there/*
    ln -s missing/file "$made"
    refuses 5 "missing/file" "$@" "$made"
    check "$last: the link stays" test -h "$made"
    rm "$made" && ln -s round "$made" && rm -f round && ln -s "$made" round
    refuses 5 "Too many levels of symbolic links" "$@" "$made"
    check "$last: the links stay" test -h "$made" -a -h round
    rm "$made" && ln -s folder "$made"
    run 5 "$@" "$made"
    check "$last: words" grep -q "cannot write '.*': \(Is a directory\|it is not a regular file\)" err
    check "$last: the folder stays" rmdir folder
    mkdir folder
    rm "$made" round
}
for ending in csv $h5; do
    writes "orbit.$ending" run ball.yaml -o
    writes "point.$ending" convert --to point ball.csv -o
    writes "rows.$ending" section ball.yaml --starts 2 --crossings 5 --quiet -o
    writes "result.$ending" sweep sweep.yaml -o
done
writes text.txt manual run -o
! command -v gnuplot >/dev/null || writes picture.svg plot ball.csv -o
"$isoroll" view ball.csv -o - >/dev/null 2>&1 && writes page.html view ball.csv -o

# a sweep's part stands beside the result, not beside the link
ln -s there/far.csv near.csv
run 0 sweep sweep.yaml -o near.csv
check "the result" test -f there/far.csv -a -h near.csv -a ! -e there/far.csv.part

# to what is no regular file: text goes there, HDF5 cannot
mkfifo pipe
ln -s pipe pipe.csv
cat pipe >read & run 0 run ball.yaml -o pipe.csv
wait $!
check "through a fifo" cmp read ball.csv
ln -s /dev/stdout out.csv
checks=$((checks + 1))
{ echo first; "$isoroll" run ball.yaml -o out.csv; } >whole 2>err || fail "a link to /dev/stdout"
check "behind what stands in standard output" test "$(head -n 1 whole)" = first
check "all rows, in standard output" test "$(sed 1d whole | cksum)" = "$(cksum <ball.csv)"
if [ -c /dev/full ]; then
    ln -s /dev/full full.csv
    refuses 5 "No space left on device" run ball.yaml -o full.csv
fi
if [ -n "$h5" ]; then
    mknod null c 1 3 2>/dev/null || mkfifo null
    for to in pipe null; do
        ln -s $to $to.h5
        refuses 5 "cannot write '$to.h5': it is not a regular file" run ball.yaml -o $to.h5
        check "$to is still there" test -p $to -o -c $to
    done
fi
finish
