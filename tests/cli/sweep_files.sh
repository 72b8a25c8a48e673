#!/bin/sh
# sweep_files.sh ISOROLL - files of sweeps that are damaged, cut short, changed by hand, or in the way: words and
# status 5, never a crash, a wrong row, or a file that is overwritten. Parts that are gone on with after a full disk, kill -9 and
# signals.
. "$(dirname "$0")/lib.sh"

scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >scene.yaml
cat >sweep.yaml <<'END'
scene: scene.yaml
vary: {k: {from: 0.3, to: 0.9, count: 12}}
measure: {state: {}}
until: {time: 10}
chunk: 2
END
run 0 sweep sweep.yaml -o all.csv
run 0 sweep sweep.yaml -o one.csv --shard 1/2
run 0 sweep sweep.yaml -o two.csv --shard 2/2

sed -n 's/^# scene | //p' all.csv >kept.yaml
check "the result has the scene's text" cmp kept.yaml scene.yaml
sed -n 's/^# | //p' all.csv >kept.yaml
check "the result has the sweep's text" cmp kept.yaml sweep.yaml

# --- heads that say what cannot be
# head LINE: the line of one.csv that has this key becomes LINE
head_of() {
    sed "s/^# ${1%%:*}: .*/# $1/" one.csv >bad.csv
    refuses 5 "its head is damaged" sweep --merge bad.csv two.csv -o new.csv
}
for size in 0 18446744073709551615 9223372036854775807 -1; do
    head_of "points: $size"
    head_of "chunk: $size"
done
head_of "part: 3 of 2"
head_of "part: 1 of 18446744073709551615"
{ sed '/^# names/,$d' one.csv; printf '# names:'; awk 'BEGIN { for (i = 0; i < 5000; i++) printf " a/b" }'
    echo; sed '1,/^# names/d' one.csv; } >bad.csv
refuses 5 "is no result of a sweep" sweep --merge bad.csv two.csv -o new.csv
refuses 2 "at most 1000000" sweep sweep.yaml -o new.csv --shard 1/1000001
# --- rows that were moved, taken away, written twice, or added
# rows_of SCRIPT WORDS: one.csv changed by this script of awk, whose rows have number n
rows_of() {
    awk "/^[#p]/ { print; next } { n++ } $1" one.csv >bad.csv
    refuses 5 "$2" sweep --merge bad.csv two.csv -o new.csv
}
rows_of 'n != 6' "moved or damaged"
rows_of '{ print } n == 6 { print }' "its end is missing, or there is more behind it"
sed '$a\# more' all.csv >bad.csv
has gnuplot "a curve of a file with too many lines" &&
    refuses 5 "its end is missing, or there is more behind it" plot bad.csv -o bad.svg
# --- ends of lines of other systems, and a last line without one; but no row that was cut short
sed 's/$/\r/' one.csv >other.csv
run 0 sweep --merge other.csv two.csv -o crlf.csv
check "lines with CR LF" cmp crlf.csv all.csv
bytes=$(wc -c <two.csv)
head -c $((bytes - 1)) two.csv >other.csv
run 0 sweep --merge one.csv other.csv -o unended.csv
check "a last line without end" cmp unended.csv all.csv
for less in 2 24; do
    head -c $((bytes - less)) two.csv >other.csv
    refuses 5 "its end is missing" sweep --merge one.csv other.csv -o new.csv
done
for less in 25 60; do
    head -c $((bytes - less)) two.csv >other.csv
    refuses 5 "cannot read 'other.csv'" sweep --merge one.csv other.csv -o new.csv
done
# --- numbers that were changed: the sum of the rows tells
sed '$ y/0123456789abcdef/123456789abcdef0/' one.csv >bad.csv
refuses 5 "its rows were changed after it was written" sweep --merge bad.csv two.csv -o new.csv
# --- texts and heads that were changed under the old hash; both parts alike, so that they go together
# changed SCRIPT: by this script of sed
changed() {
    for part in one two all; do sed "$1" $part.csv >changed.$part.csv; done
    check_not "$1 changes something" cmp one.csv changed.one.csv
    refuses 5 "its texts or its head do not fit its hash: they were changed, or another version wrote them" \
        sweep --merge changed.one.csv changed.two.csv -o new.csv
    ! command -v gnuplot >/dev/null || refuses 5 "do not fit its hash" plot changed.all.csv -o bad.svg
}
for script in '/^# scene | /s/0[.]5/0.6/' '/^# | /s/time: 10/time: 11/' '/^# scene | time/s/$/ /' '/^# scene | /d' \
    '/^# hash: /y/0123456789/1234567890/' 's/^# vectors: .*/# vectors: other/' 's/^# isoroll: .*/# isoroll: 0.1.9/' \
    's/^# names: vary.k/# names: vary\/h/; s/^point,k/point,h/' '/^# isoroll: /d'; do
    changed "$script"
done
# a text with other ends of lines, and without the last one, has one hash in CSV, HDF5 and the memory
sed 's/$/\r/' scene.yaml >crlf.yaml
printf 'scene: crlf.yaml\r\nvary: {k: [0.5, 0.6]}\r\nmeasure: {state: {}}' >ends.yaml
for kind in csv h5; do
    [ $kind = csv ] || "$isoroll" run scene.yaml -o probe.h5 2>/dev/null || continue
    run 0 sweep ends.yaml -o ends.1.$kind --shard 1/2
    run 0 sweep ends.yaml -o ends.2.$kind --shard 2/2
    run 0 sweep --merge ends.1.$kind ends.2.$kind -o ends.$kind
    quietly sweep ends.yaml -o ends.$kind --resume
done
if "$isoroll" sweep sweep.yaml -o one.h5 --shard 1/2 2>err; then
    run 0 sweep sweep.yaml -o two.h5 --shard 2/2
    bytes=$(wc -c <one.h5)
    # numbers stand as they are in memory: 0.3 is the first value of k
    at=$(LC_ALL=C grep -obUaP '\x33\x33\x33\x33\x33\x33\xd3\x3f' one.h5 | head -n 1 | cut -d: -f1)
    check "0.3 stands in the file of $bytes bytes" test -n "$at"
    printf '\064' | dd of=one.h5 bs=1 seek="$at" conv=notrunc 2>/dev/null
    refuses 5 "its rows were changed after it was written" sweep --merge one.h5 two.h5 -o new.h5
    check_not "nothing was written" test -e new.h5
    rm one.h5
    run 0 sweep sweep.yaml -o one.h5 --shard 1/2
    for file in one two; do sed 's/time: 10/time: 11/' $file.h5 >$file.changed.h5; done
    refuses 5 "do not fit its hash" sweep --merge one.changed.h5 two.changed.h5 -o new.h5
fi

run 0 sweep sweep.yaml -o empty.csv --shard 7/7
for i in 1 2 3 4 5 6; do run 0 sweep sweep.yaml -o seventh.$i.csv --shard $i/7; done
run 0 sweep --merge seventh.?.csv empty.csv -o sevenths.csv
check "a share without chunks" cmp sevenths.csv all.csv
echo "0,0.3,1,2,3,0," >>empty.csv
refuses 5 "its end is missing, or there is more behind it" sweep --merge seventh.?.csv empty.csv -o new.csv
check_not "nothing was written" test -e new.csv
# --- the same bytes from another folder, where a point fails
printf 'scene: scene.yaml\nvary: {k: [0, 0.5]}\nmeasure: {state: {}}\n' >fails.yaml
{ printf 'scene:\n' && sed 's/^/  /' scene.yaml && printf 'vary: {k: [0, 0.5]}\nmeasure: {state: {}}\n'; } >inside.yaml
mkdir below
for kind in fails inside; do
    run 1 sweep $kind.yaml -o $kind.csv
    run 1 sweep "$PWD/$kind.yaml" -o absolute.csv
    check "$kind: an absolute path" cmp absolute.csv $kind.csv
    (cd below && "$isoroll" sweep ../$kind.yaml -o below.csv 2>/dev/null)
    check "$kind: another folder" cmp below/below.csv $kind.csv
    rm absolute.csv below/below.csv
done
check "the reason names the scene" grep -q '"scene.yaml:1:14: k = 0' fails.csv
check "the reason names the sweep" grep -q '"<sweep>:2:16: k = 0' inside.csv
# --- files that are in the way: words, status 5, and not a byte is changed
h5=h5
"$isoroll" sweep sweep.yaml -o all.h5 2>err || { h5=csv && skip "HDF5" "this build has none"; }
echo "my thesis" >thesis.csv
cp thesis.csv thesis.copy
refuses 5 "is no result of a sweep: it is not overwritten" sweep sweep.yaml -o thesis.csv
refuses 5 "is no result of a sweep: it is not overwritten" sweep sweep.yaml -o thesis.csv --resume
refuses 5 "is there already" sweep sweep.yaml -o all.$h5
refuses 5 "is the result of another sweep" sweep fails.yaml -o all.$h5 --resume
cp all.$h5 before.$h5
quietly sweep sweep.yaml -o all.$h5 --resume
check "a result that is there stays" cmp all.$h5 before.$h5
cp thesis.csv new.csv.part
refuses 5 "is no file of a sweep: it would be overwritten" sweep sweep.yaml -o new.csv --resume
check "the thesis" cmp thesis.csv thesis.copy
check "the thesis, as a part" cmp new.csv.part thesis.copy
printf 'isoroll sweep journal\n\0\0\0' >new.csv.journal
refuses 5 "'new.csv.journal' is the journal of an older version of isoroll, which cannot be gone on with" \
    sweep sweep.yaml -o new.csv --resume
rm new.csv.part new.csv.journal
refuses 5 "cannot write" sweep sweep.yaml -o /nowhere/new.csv
run 5 sweep sweep.yaml -o /dev/full
check "a full disk" grep -q "No space left" err
# --- a file that appears while the sweep runs stays, and so do the rows
cat >long.yaml <<END
scene: scene.yaml
vary: {k: {from: 0.3, to: 0.9, count: 60}}
measure: {state: {}}
until: {time: $(slow 10000)}
chunk: 1
END
run 0 sweep long.yaml -o long.csv
run 0 sweep long.yaml -o long.$h5 --resume
quietly sweep long.yaml -o long.$h5 --resume
for kind in csv $h5; do
    held late.$kind sweep long.yaml -j 1
    echo "my thesis" >late.$kind
    kill -CONT $pid
    wait $pid
    check "$kind: a file has appeared: status $?" test $? -eq 5
    check "$kind: words" grep -q "late.$kind' has appeared: it is not overwritten" err
    check "$kind: it stays" grep -q "my thesis" late.$kind
    check "$kind: the rows stay" test -s "$(part_of late.$kind)"
    rm late.$kind
    run 0 sweep long.yaml -o late.$kind --resume
    check "$kind: it goes on" cmp late.$kind long.$kind
    check "$kind: nothing is left over" test "$(find . -name '*.part' | wc -l)" -eq 0
done
# --- a full disk; what is cut short or damaged behind the last whole chunk is computed again
checks=$((checks + 1))
(ulimit -f 4 && "$isoroll" sweep long.yaml -o full.$h5 -j 1 2>err)
[ $? -eq 5 ] || fail "a full disk: not status 5"
part=$(part_of full.$h5)
check "a full disk: words" grep -q "cannot write '$part': File too large" err
check "a part with some chunks" test "$(grep -c '^[0-9]' "$part")" -gt 3
refuses 5 "add --resume to go on with it" sweep long.yaml -o full.$h5
refuses 5 "has chunks of another sweep" sweep sweep.yaml -o full.$h5 --resume
refuses 5 "has chunks of another sweep" sweep long.yaml -o full.$h5 --resume --shard 1/2
cp "$part" part
run 0 sweep long.yaml -o full.$h5 --resume
check "after a full disk" cmp full.$h5 long.$h5
cp part "$(part_of long.$h5)"
run 0 sweep long.yaml -o long.$h5 --resume
check_not "a part that outlived its result is removed" test -e "$(part_of long.$h5)"
# torn WORDS: the part that is in `torn` is gone on with, to the same bytes
torn() {
    cp torn "$(part_of torn.$h5)"
    run 0 sweep long.yaml -o torn.$h5 --resume
    check "$1" cmp torn.$h5 long.$h5
    rm torn.$h5
}
for more in 1 10000 words; do
    case $more in words) printf '7,0.3' ;; *) head -c $more /dev/zero ;; esac | cat part - >torn
    torn "$more behind the last chunk"
done
size=$(wc -c <part)
for less in 0 5 40 200; do # also in the header
    head -c $((size - less * less / 4)) part >torn
    torn "cut short by $less"
done
awk '/^[0-9]/ && ++n == 3 { sub(/,0,$/, ",x,") } { print }' part >torn
torn "a damaged row"
grep -v '^1,' part >torn
torn "a row that is missing"
# --- kill -9 when some chunks more are in the part, then another number of threads; SIGTERM and SIGINT
tries=0 kills=$(length 4 20)
while [ $tries -lt "$kills" ]; do
    begin=$(cat "$(part_of killed.$h5)" 2>/dev/null | wc -c)
    "$isoroll" sweep long.yaml -o killed.$h5 --resume -j $((tries % 3 + 1)) 2>/dev/null &
    pid=$!
    await in_part killed.$h5 $((begin + tries % 7 * 100)) $pid
    kill -9 $pid 2>/dev/null
    wait $pid 2>/dev/null
    tries=$((tries + 1))
    [ ! -e killed.$h5 ] || { check "killed" cmp killed.$h5 long.$h5; rm -f killed.$h5; }
done
run 0 sweep long.yaml -o killed.$h5 --resume
check "killed $kills times" cmp killed.$h5 long.$h5

# stopped SIGNAL STATUS WORDS
stopped() {
    for _ in 1 2 3 4 5 6 7 8 9 10; do # again if it was done before the signal came
        rm -f stopped.$h5
        signalled "$1" "in_part stopped.$h5 800" sweep long.yaml -o stopped.$h5 -j 1
        [ -e stopped.$h5 ] || break
    done
    check "$1: status $status" test $status -eq "$2"
    check "$1: words" grep -q "$3: .* of 60 chunks are in '$(part_of stopped.$h5)'; go on with: .* --resume" err
    run 0 sweep long.yaml -o stopped.$h5 --resume
    check "$1" cmp stopped.$h5 long.$h5
    rm stopped.$h5
}
stopped TERM 0 "stopped by SIGTERM or SIGUSR1"
stopped USR1 0 "stopped by SIGTERM or SIGUSR1"
interruptible "Ctrl-C" && stopped INT 1 "interrupted"

# --- one result, one program
held twice.$h5 sweep long.yaml -j 1
refuses 5 "is in use: another program writes" sweep long.yaml -o twice.$h5 --resume
kill -CONT $pid
wait $pid
check "the first one goes on" cmp twice.$h5 long.$h5

# --- where files cannot be locked, and where a part is removed between opening and locking it
cc=${CC:-cc}
if [ -z "${ISO_NO_MEMORY-none}" ]; then
    skip "locks" "sanitizers do not let flock be replaced"
elif has "$cc" "locks"; then
    "$cc" -D_GNU_SOURCE -shared -fPIC "$here/no_lock.c" -o no_lock.so -ldl 2>err || fail "no_lock.c"
    checks=$((checks + 1))
    ISO_LOCK=none LD_PRELOAD=$PWD/no_lock.so "$isoroll" sweep long.yaml -o unlocked.csv 2>err || fail "without locks"
    check "a file system without locks" cmp unlocked.csv long.csv
    sed '/^#.*/!q' part >gone.csv.part
    (ulimit -f 4 && ISO_LOCK=gone.csv.part LD_PRELOAD=$PWD/no_lock.so "$isoroll" sweep long.yaml -o gone.csv -j 1 \
        --resume 2>err)
    check "removed before it was locked: a part is there" test -s gone.csv.part
    run 0 sweep long.yaml -o gone.csv --resume
    check "it can be resumed" cmp gone.csv long.csv
fi
finish
