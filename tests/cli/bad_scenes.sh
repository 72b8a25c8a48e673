#!/bin/sh
# bad_scenes.sh ISOROLL - every scene in bad/ is refused with exit status 3 and nothing on standard output. Place
# and words of the message are in the first line of the scene (`# expect LINE:COLUMN part of the message`).
isoroll=${1:?usage: bad_scenes.sh ISOROLL}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
files=0 failures=0

complain() {
    echo "FAIL $name: $1" >&2
    sed 's/^/    /' "$work/err" >&2
    bad=1
}

for file in "$here"/bad/*.yaml; do
    [ -f "$file" ] || continue
    files=$((files + 1)) bad=0 name=${file##*/}
    expected=$(head -n 1 "$file")
    expected=${expected#"# expect "}
    place=${expected%% *} words=${expected#* }
    "$isoroll" run "$file" >"$work/out" 2>"$work/err" </dev/null
    status=$?
    [ "$status" -eq 3 ] || complain "exit status $status, not 3"
    [ -s "$work/out" ] && complain "something on standard output"
    message=$(head -n 1 "$work/err")
    case $message in
    "isoroll: $file:$place: "*) ;;
    *) complain "expected 'isoroll: $file:$place: ...'" ;;
    esac
    grep -F -q -e "$words" "$work/err" || complain "expected the words '$words'"
    failures=$((failures + bad))
done

echo "$files bad scenes, $failures failures"
[ "$files" -ge 200 ] && [ "$failures" -eq 0 ]
