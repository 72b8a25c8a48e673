#!/bin/sh
# strangers.sh ISOROLL - files of HDF5 made to show other files of their reader, or to take his memory: every command
# that reads one refuses it by name, and opens no other file. strangers.c makes them from files of isoroll.
. "$(dirname "$0")/lib.sh"
scene -1 "2, 3, 4" "0, 1, 0" "0.6, 0, 0.8" 10 0.1 >ball.yaml
"$isoroll" run ball.yaml -o good.h5 2>err || impossible "files of strangers" "this build has no HDF5"
has "${CC:-cc}" "files of strangers" && has pkg-config "files of strangers" || { finish && exit; }
# shellcheck disable=SC2046 # flags
"${CC:-cc}" -std=c11 "$here/strangers.c" -o strangers $(pkg-config --cflags --libs hdf5) 2>err || {
    impossible "files of strangers" "strangers.c cannot be compiled with the HDF5 library"
}
printf 'scene: ball.yaml\nvary: {k: [-1, 1, 2]}\nmeasure: {state: {}}\nuntil: {time: 1}\n' >sweep.yaml
run 0 sweep sweep.yaml -o sweep.h5
run 0 sweep sweep.yaml -o one.h5 --shard 1/2
run 0 sweep sweep.yaml -o two.h5 --shard 2/2
run 0 section ball.yaml --starts 2 --crossings 20 --quiet -o section.h5
echo "root:x:0:0: secret words" >secret
mkfifo other.h5 # who opens it waits for ever
[ "${ISO_SANITIZE-0}" = 1 ] || ulimit -v 3000000

# stranger KIND FILE DATASET: bad.h5 is FILE with DATASET of this kind
stranger() {
    rm -f bad.h5
    cp "$2" bad.h5
    ./strangers "$1" bad.h5 "$3" 2>err || fail "strangers $*"
}
# none WORDS ARGUMENT...: refused by name, soon, and nothing is written
none() {
    words=$1
    shift
    last=$* checks=$((checks + 1))
    timeout -s KILL 20 "$isoroll" "$@" >out 2>err
    status=$?
    [ $status -eq 3 ] || [ $status -eq 5 ] || fail "isoroll $last: exit status $status"
    says "$words"
    check "$last: nothing on standard output" test ! -s out
    check_not "$last: a secret" grep -q "secret words" err
    check_not "$last: a file is written" ls made*
    rm -f made*
}
# kinds LIST FILE DATASET COMMAND...: each kind, by each command
kinds() {
    list=$1 file=$2 set=$3
    shift 3
    for kind in $list; do
        case $kind in
        external-link | external-group | soft-external) words="an external link, which leads to another file" ;;
        external-storage) words="external storage, whose rows would come from other files" ;;
        virtual) words="a virtual dataset, whose rows would come from other files" ;;
        user-link | dangling | round | group) words="this is no dataset, or it is damaged, or its link leads nowhere" ;;
        unwritten | unpacked | promised | endless) words="rows that were never written" ;;
        filter | scaled) words="no filters but deflate (gzip), shuffle and fletcher32" ;;
        twice) words="the same filter stands twice" ;;
        wide-chunk) words="more than 256 MiB for one chunk of each dataset" ;;
        reference) words="expected numbers or words for" ;;
        compound) words="expected numbers or words for" ;;
        long-words) words="words of at most 16 KiB" ;;
        lines) words="expected one line in the attribute potential.U" ;;
        both) words="it stands in a group and outside of it" ;;
        names) words="more than 1024 times the room of the file" ;;
        esac
        stranger "$kind" "$file" "$set"
        for command; do
            # shellcheck disable=SC2086 # a command and its arguments
            none "$words" $command
        done
    done
}
elsewhere="external-storage external-link external-group soft-external virtual user-link dangling round group"
large="unwritten unpacked promised endless filter scaled twice wide-chunk reference compound"
set -- "view bad.h5 -o made.html" "plot bad.h5 -o made.svg" "check bad.h5" "convert --to point bad.h5 -o made.csv"
kinds "$elsewhere $large names lines both" good.h5 /clock/t "check bad.h5"
kinds "external-storage external-link virtual unwritten" good.h5 /clock/t "$@"
kinds "external-link unpacked" section.h5 /section/l "view bad.h5 -o made.html"
kinds "$elsewhere $large" sweep.h5 /sweep/k "plot bad.h5 -o made.svg"
kinds "external-storage external-link unwritten" one.h5 "/sweep part/status" "sweep --merge bad.h5 two.h5 -o made.csv"
kinds "external-link long-words" sweep.h5 /sweep/reason "plot bad.h5 -o made.svg"
# older sweeps
for file in sweep sweep_1 sweep_2; do gunzip -c "$source/tests/upgrade/6_$file.h5.gz" >old_$file.h5; done
kinds "$elsewhere" old_sweep.h5 /vary/k "plot bad.h5 -o made.svg"
kinds "external-storage virtual unpacked" old_sweep_1.h5 /vary/k "sweep --merge bad.h5 old_sweep_2.h5 -o made.csv"
kinds "external-link long-words" old_sweep.h5 /failed/reason "plot bad.h5 -o made.svg"
# what is packed as others pack it is taken, with the same rows
run 0 convert --to point good.h5 -o plain.csv
for set in /clock/t /ball/omega; do
    stranger packed good.h5 $set
    run 0 convert --to point bad.h5 -o packed.csv
    check "packed $set: the same rows" test "$(grep -v '^#' packed.csv | cksum)" = "$(grep -v '^#' plain.csv | cksum)"
done
finish
