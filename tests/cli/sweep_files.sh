#!/bin/sh
# sweep_files.sh ISOROLL - files of sweeps that are damaged, cut short, changed by hand, or in the way: words and
# status 5, never a crash, a wrong row, or a file that is overwritten.
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
run 0 sweep --merge one.csv two.csv -o merged.csv
check "two shards" cmp merged.csv all.csv

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
head_of "chunk: 9007199254740992"
head_of "part: 3 of 2"
head_of "part: 1 of 2305843009213693952"
head_of "part: 1 of 18446744073709551615"
{ sed '/^# columns/,$d' one.csv; printf '# columns:'; awk 'BEGIN { for (i = 0; i < 5000; i++) printf " a/b" }'
    echo; sed '1,/^# columns/d' one.csv; } >bad.csv
refuses 5 "is no result of a sweep" sweep --merge bad.csv two.csv -o new.csv
refuses 2 "at most 1000000" sweep sweep.yaml -o new.csv --shard 1/1000001
# --- rows that were moved, taken away, written twice, or added
# rows_of SCRIPT WORDS: one.csv changed by this script of awk, whose rows have number n
rows_of() {
    awk "/^[#p]/ { print; next } { n++ } $1" one.csv >bad.csv
    refuses 5 "$2" sweep --merge bad.csv two.csv -o new.csv
}
rows_of 'n == 2 { kept = $0; next } { print } n == 3 { print kept }' "moved or damaged"
rows_of 'n != 6' "moved or damaged"
rows_of '{ print } n == 6 { print }' "its end is missing, or there is more behind it"
rows_of '{ print } n == 2 { print }' "moved or damaged"
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
for less in 2 3 9 24; do
    head -c $((bytes - less)) two.csv >other.csv
    refuses 5 "its end is missing" sweep --merge one.csv other.csv -o new.csv
done
for less in 25 26 30 60; do
    head -c $((bytes - less)) two.csv >other.csv
    refuses 5 "cannot read 'other.csv'" sweep --merge one.csv other.csv -o new.csv
done
# --- numbers that were changed: the sum of the rows tells
sed '$ y/0123456789abcdef/123456789abcdef0/' one.csv >bad.csv
refuses 5 "its rows were changed after it was written" sweep --merge bad.csv two.csv -o new.csv
awk -F, 'BEGIN { OFS = "," } /^[1-9]/ && !done { $2 = 1 $2; done = 1 } { print }' one.csv >bad.csv
refuses 5 "its rows were changed after it was written" sweep --merge bad.csv two.csv -o new.csv
if "$isoroll" sweep sweep.yaml -o one.h5 --shard 1/2 2>err; then
    run 0 sweep sweep.yaml -o two.h5 --shard 2/2
    bytes=$(wc -c <one.h5)
    # numbers stand as they are in memory: 0.3 is the first value of k
    at=$(LC_ALL=C grep -obUaP '\x33\x33\x33\x33\x33\x33\xd3\x3f' one.h5 | head -n 1 | cut -d: -f1)
    check "0.3 stands in the file of $bytes bytes" test -n "$at"
    printf '\064' | dd of=one.h5 bs=1 seek="$at" conv=notrunc 2>/dev/null
    refuses 5 "its rows were changed after it was written" sweep --merge one.h5 two.h5 -o new.h5
    check_not "nothing was written" test -e new.h5
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
    run 1 sweep below/../$kind.yaml -o detour.csv
    check "$kind: a detour" cmp detour.csv $kind.csv
    (cd below && "$isoroll" sweep ../$kind.yaml -o below.csv 2>/dev/null)
    check "$kind: another folder" cmp below/below.csv $kind.csv
    rm absolute.csv detour.csv below/below.csv
done
check "the reason names the scene" grep -q '"scene.yaml:1:14: k = 0' fails.csv
check "the reason names the sweep" grep -q '"<sweep>:2:16: k = 0' inside.csv
# --- a file that appears while the sweep runs stays, and so does the journal
h5=h5
"$isoroll" sweep sweep.yaml -o all.h5 2>err || { h5=csv && skip "HDF5" "this build has none"; }
sed 's/time: 10/time: 20000/' sweep.yaml >long.yaml
for kind in csv $h5; do
    held late.$kind sweep long.yaml -j 1
    echo "my thesis" >late.$kind
    kill -CONT $pid
    wait $pid
    check "$kind: a file has appeared: status $?" test $? -eq 5
    check "$kind: words" grep -q "late.$kind' has appeared: it is not overwritten" err
    check "$kind: it stays" grep -q "my thesis" late.$kind
    check "$kind: the journal stays" test -s late.$kind.part
    rm late.$kind
    run 0 sweep long.yaml -o late.$kind --resume
    check "$kind: nothing is left over" test "$(find . -name '.isoroll*' -o -name '*.part' | wc -l)" -eq 0
done
# --- journals: a damaged length in the middle costs no chunk behind it; zeros at the end are a record cut short
(ulimit -f 3 && "$isoroll" sweep long.yaml -o stopped.csv -j 1 2>err)
bytes=$(wc -c <stopped.csv.part)
check "a journal of some chunks: $bytes bytes" test "$bytes" -gt 600
for length in 1 3 200; do
    cp stopped.csv.part damaged.csv.part
    # behind the head of 96 bytes: the number of a chunk, then a length
    printf "\\$length" | dd of=damaged.csv.part bs=1 seek=$((96 + 8 + length % 2 * 6)) conv=notrunc 2>/dev/null
    cp damaged.csv.part damaged.copy
    refuses 5 "is damaged" sweep long.yaml -o damaged.csv --resume
    check "a damaged length $length: it stays" cmp damaged.csv.part damaged.copy
done
run 0 sweep long.yaml -o long.csv
for zeros in 1 30 10000; do
    cp stopped.csv.part zeros.csv.part
    head -c $zeros /dev/zero >>zeros.csv.part
    run 0 sweep long.yaml -o zeros.csv --resume
    check "$zeros zeros behind the last record" cmp zeros.csv long.csv
    rm zeros.csv
done
# --- journals where files cannot be locked, and one that is removed between opening and locking it
cc=${CC:-cc}
if [ -z "${ISO_NO_MEMORY-none}" ]; then
    skip "locks" "sanitizers do not let flock be replaced"
elif has "$cc" "locks"; then
    "$cc" -D_GNU_SOURCE -shared -fPIC "$here/no_lock.c" -o no_lock.so -ldl 2>err || fail "no_lock.c"
    checks=$((checks + 1))
    ISO_LOCK=none LD_PRELOAD=$PWD/no_lock.so "$isoroll" sweep long.yaml -o unlocked.csv 2>err || fail "without locks"
    check "a file system without locks" cmp unlocked.csv long.csv
    cp stopped.csv.part gone.csv.part
    (ulimit -f 3 && ISO_LOCK=gone.csv.part LD_PRELOAD=$PWD/no_lock.so "$isoroll" sweep long.yaml -o gone.csv -j 1 \
        --resume 2>err)
    check "removed before it was locked: a journal is there" test -s gone.csv.part
    run 0 sweep long.yaml -o gone.csv --resume
    check "it can be resumed" cmp gone.csv long.csv
fi
finish
