#!/bin/sh
# bad_files.sh ISOROLL - every sweep of the tables bad_*.txt, and scenes of them and of bad/, whose bytes no table can
# have, are refused with status 3 and nothing on standard output. (Every scene: test_scene.) The first line of a file is
# `# expect LINE:COLUMN WORDS`: the place of the mistake, and a part of the message.
# bad_files.sh --write FOLDER only makes the files, for test_scene and test_hard_input.
here=$(cd "$(dirname "$0")" && pwd)

# write FOLDER: all files
write() {
    cp "$here"/bad/*.yaml "$1" && awk -v to="$1" '
        function put(    i, file) {
            if (name == "") return
            file = to "/" name ".yaml"
            printf "# expect %s\n%s", expected, after[1] >file
            for (i = 2; i <= most || i in line || i in after; i++)
                printf "%s%s", i in line ? line[i] "\n" : "", after[i] >file
            close(file)
            name = ""
        }
        /^#/ { next }
        $1 == "base" || $1 == "bad" {
            put()
            base = $2
            split("", after)
            split("", line)
            if ($1 == "base") { most = 0; last[base] = 1; next }
            name = $3
            expected = $0
            sub(/^bad [^ ]* [^ ]* /, "", expected)
            most = last[base]
            for (i = 2; i <= most; i++) line[i] = right[base, i]
            next
        }
        { at = $1 + 0; text = substr($0, length($1) + 2) }
        name == "" { right[base, at] = text; last[base] = at; next }
        $1 ~ /-$/ { delete line[at]; next }
        $1 ~ /\+$/ { after[at] = after[at] text "\n"; next }
        { line[at] = text }
        END { put() }' "$here/bad_files.txt" "$here"/bad_e*.txt
}

if [ "$1" = --write ]; then
    mkdir -p "$2" && write "$2"
    exit
fi
. "$here/lib.sh"
mkdir bad && write bad
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >bad/scene.yaml
{ cat bad/scene.yaml && echo 'solver: {tolerance: 1.0e-9}'; } >bad/solver.yaml
files=0
for file in bad/*_*.yaml; do
    files=$((files + 1))
    case $file in *_sweep_*) command=sweep ;; *) command=run ;; esac
    [ $command = sweep ] || [ $((files % $(length 8 1))) -eq 0 ] || continue
    expected=$(sed -n '1s/^# expect //p' "$file")
    refuses 3 "$file:${expected%% *}: " $command "$file" </dev/null
    check "$file: $expected" grep -F -q -e "${expected#* }" err
done
check "$files bad files" test "$files" -ge 237
finish
