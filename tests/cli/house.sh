#!/bin/sh
# house.sh - the rules for the sources that a script can check: includes, public names, exported symbols, places of
# files, lengths. It reads the sources in $ISO_SOURCE and the shared library in $ISO_BUILD. Every complaint is a line.
#
# To add a rule: print one line for each place that breaks it, and pipe the lines into `complain "RULE"`.
set -u
: "${ISO_SOURCE:?}" "${ISO_BUILD:?}" "${CC:=cc}"
cd "$ISO_SOURCE" || exit 1
complaints=$(mktemp)
trap 'rm -f "$complaints"' EXIT

# complain RULE: each line of standard input is a place that breaks the rule
complain() {
    sed "s|^|FAIL $1: |" >>"$complaints"
}

public=$(sed -n 's/^#include "\(.*\)".*/lib\/\1/p' lib/isoroll.h | sort) # what a program includes; all else is private
[ -n "$public" ] || { echo "FAIL no headers in $PWD/lib"; exit 1; }

# What git leaves where a merge was not finished.
grep -rnE '^(<<<<<<<|>>>>>>>) ' README.md lib apps examples tests | complain "marks of an unfinished merge"

# Floors: a file of lib includes its own folder and lower floors only, and an instrument no other instrument; an example
# only the public headers; the programs of apps are part of the house and may include private ones. Sources and private
# headers write "floor/name.h"; public ones "../floor/name.h" or "name.h", so that they work where installed.
find lib apps examples -name '*.[ch]' ! -path lib/isoroll.h -exec awk -v public="$public" '
    BEGIN { m = split(public, list, "\n"); for (i = 1; i <= m; i++) is_public[list[i]] = 1
            n = split("base 0 model 1 map 2 method 2 exact 2 orbit 3 study 4 io 4 instrument 5 task 6 sweep 7 picture 8 api 9", f)
            for (i = 1; i < n; i += 2) floor[f[i]] = f[i + 1] }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
        split($0, quoted, "\""); split(FILENAME, from, "/"); path = quoted[2]; shape = "floor/name.h or floor/room/name.h"
        if (FILENAME in is_public) {
            shape = "../floor/name.h or name.h"
            room = FILENAME ~ /^lib\/[a-z]*\/[a-z0-9]*\// ? from[2] "/" from[3] : from[2]
            if (path !~ /\//) path = room "/" path
            else if (path ~ /^\.\.\/[^.]/ && room != from[2] && path !~ /^\.\.\/[a-z0-9]*\/[a-z0-9]*\//) sub(/^\.\./, from[2], path)
            else if (path ~ /^[a-z]/) path = from[2] "/" path
            else if (!sub(/^(\.\.\/)+/, "", path)) path = ""
            if (path ~ /_impl\.h$/) print FILENAME ":" FNR ": " quoted[2] " is private, " FILENAME " is not"
        }
        split(path, to, "/")
        if (from[1] != "lib") {
            if (from[1] == "examples" && quoted[2] ~ /\/.*_impl\.h$/) print FILENAME ":" FNR ": " quoted[2] " is private to lib"
        } else if (!(from[2] in floor)) print FILENAME ": lib/" from[2] " is no floor"
        else if (!(to[1] in floor) || path !~ /^[a-z]+\/([a-z][a-z0-9]*\/)?[a-z0-9_]+\.h$/)
            print FILENAME ":" FNR ": " quoted[2] " is not " shape
        else if (to[1] != from[2] && floor[to[1]] >= floor[from[2]])
            print FILENAME ":" FNR ": " from[2] " is not above " to[1]
        else if (from[2] == "instrument" && to[1] == from[2] && to[2] != from[3])
            print FILENAME ":" FNR ": the instrument " from[3] " includes " to[2] ": let it ask by iso_study_ask_text"
    }' {} + | complain "floors"
# Rooms: the folders of a floor, and the floor itself, do not include each other in a circle.
find lib -name '*.c' -exec grep -H '^#include "' {} + | awk -F '[:"]' '
    { from = substr($1, 5); to = $3
      split(from, f, "/"); split(to, t, "/")
      from = from ~ /\/.*\// ? f[1] "/" f[2] : f[1]; to = to ~ /\/.*\// ? t[1] "/" t[2] : t[1]
      if (f[1] == t[1] && from != to && t[1] ~ /^(task|io)$/) print from, to }' |
    sort -u | tsort 2>&1 >/dev/null | complain "rooms in a circle"
find apps examples -name '*.[ch]' -exec grep -HnE 'include <isoroll/.*_impl\.h>' {} + | complain "floors"

# Plain words: forms that lib/README.md puts out.
grep -rnE --include='*.[ch]' 'can be told[.,:]|is told the|whom it tells|nobody (is|has to)|so-and-so|[Gg]ives (how many|whether|their number|the status)' \
    lib apps | complain "plain words (lib/README.md)"

# Public headers need the C library alone, so a user needs nothing else to compile.
# shellcheck disable=SC2086 # $public is a list
grep -nE '^[ \t]*#[ \t]*include[ \t]*<' $public lib/isoroll.h |
    grep -vE '<(float|limits|math|stdarg|stdbool|stddef|stdint|stdio)\.h>' | complain "public headers include only C"

# Names. Macros are read as written; enumerators, types, functions and variables after the preprocessor.
# shellcheck disable=SC2086
grep -nE '^[ \t]*#[ \t]*define[ \t]' $public lib/isoroll.h |
    grep -vE '#[ \t]*define[ \t]+ISO(_|ROLL_H)' | complain "a macro begins with ISO_"
all=$(echo "$public" | sed 's|^lib/\(.*\)|#include "\1"|') # every public header
# Each declaration but types and static functions has ISO_API, so that it links; others stand in private headers.
echo "$all" | "$CC" -std=c11 -E -DISO_API=ISO_API_HERE -I lib -x c - | awk '
    function check(prefix, name, what) { if (index(name, prefix) != 1) print what " " name }
    function last_word(text) { gsub(/\[[^]]*\]/, "", text); gsub(/[^A-Za-z0-9_]+/, " ", text); sub(/ $/, "", text)
                               sub(/.* /, "", text); return text }
    /^# [0-9]+ "/ { ours = $3 ~ /^"lib\//; next }
    ours { text = text " " $0 }
    END {
        gsub(/__attribute__ *\(\([^)]*\)*/, "", text)
        while (match(text, /[{][^{}]*[}]/)) { # innermost braces first; only those of an enum have names to check
            body = substr(text, RSTART + 1, RLENGTH - 2); before = substr(text, 1, RSTART - 1)
            if (before ~ /enum *[A-Za-z0-9_]* *$/) {
                n = split(body, item, ",")
                for (i = 1; i <= n; i++)
                    if (match(item[i], /[A-Za-z_][A-Za-z0-9_]*/)) check("ISO_", substr(item[i], RSTART, RLENGTH), "enumerator")
                match(text, /[{][^{}]*[}]/)
            }
            end = before ~ /\) *$/ ? ";" : " " # the body of a function ends a declaration
            text = before end substr(text, length(body) + length(before) + 3)
        }
        n = split(text, statement, ";")
        for (i = 1; i <= n; i++) {
            s = statement[i]
            if (match(s, /(struct|enum|union) +[A-Za-z0-9_]+/)) check("iso_", last_word(substr(s, RSTART, RLENGTH)), "tag")
            if (s ~ /^ *(struct|enum|union) *[A-Za-z0-9_]* *$/ || s ~ /^ *$/) continue
            if (match(s, /^[^(]*\( *\*/)) s = substr(s, RLENGTH) # (*name)(...)
            else if (match(s, /\(/)) s = substr(s, 1, RSTART - 1)
            sub(/\).*/, "", s)
            check("iso_", last_word(s), "name")
            if (s !~ /^ *(ISO_API_HERE|typedef|static) /) print last_word(s) " has no ISO_API"
        }
    }' | complain "public declarations have ISO_API; their names begin with iso_, ISO_"

# --- exported symbols: the shared library exports what public headers mark with ISO_API, and nothing else -----------
library=$ISO_BUILD/libisoroll.so
exported=$(mktemp) marked=$(mktemp)
trap 'rm -f "$complaints" "$exported" "$marked"' EXIT
nm -D --defined-only "$library" | awk '{ print $NF }' | sort >"$exported"
echo "$all" | "$CC" -std=c11 -E -DISO_API=ISO_API_HERE -I lib -x c - | grep -v '^#' | tr '\n' ' ' |
    sed 's/ISO_API_HERE/\n&/g' | # one declaration a line; its name stands before the first ( [ or ;
    sed -n 's/^ISO_API_HERE \([^([;]*[^A-Za-z0-9_]\)\{0,1\}\([A-Za-z0-9_]\{1,\}\) *[([;].*/\2/p' | sort >"$marked"
[ "$(wc -l <"$exported")" -le 110 ] || echo "$(wc -l <"$exported"); 110 are enough" | complain "exported symbols"
[ -s "$exported" ] || echo "$library exports nothing" | complain "exported symbols"
uniq -d "$marked" | sed 's/$/ is declared twice/' | complain "exported symbols"
comm -23 "$exported" "$marked" | sed 's/$/ is exported, but no public header marks it/' | complain "exported symbols"
comm -13 "$exported" "$marked" | sed 's/$/ is marked with ISO_API, but not exported/' | complain "exported symbols"
grep -rlw ISO_API lib --include='*.c' --include='*_impl.h' | complain "ISO_API stands in public headers only"

# A public header compiles alone, in C and in C++.
alone() {
    for header in $public lib/isoroll.h; do
        printf '#include "%s"\ntypedef int iso_nothing;\n' "${header#lib/}" |
            "$@" -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I lib - 2>&1 |
            sed "s|^|$header: |"
    done
}
echo "$all" | "$CC" -std=c11 -fsyntax-only -I lib -x c - 2>&1 | grep error | complain "all public headers compile together"
alone "$CC" -std=c11 -x c | complain "a public header compiles alone in C"
cxx=
for name in c++ g++ clang++; do
    [ -n "$cxx" ] || ! command -v "$name" >/dev/null || cxx=$name
done
if [ -n "$cxx" ]; then
    alone "$cxx" -std=c++17 -x c++ | complain "a public header compiles alone in C++"
    for header in $public; do
        [ "$header" = lib/base/api.h ] || grep -q '^ISO_C_BEGIN$' "$header" || echo "$header"
    done | complain "a public header encloses its declarations by ISO_C_BEGIN and ISO_C_END"
else
    echo "SKIP house: public headers in C++: no C++ compiler is installed"
fi

# The umbrella header lists public headers that exist, bottom-up.
sed -n 's/^#include "\(.*\)".*/\1/p' lib/isoroll.h | while read -r header; do
    [ -e "lib/$header" ] || echo "$header is not there"
done | complain "lib/isoroll.h"
awk -F '["/]' '/^#include "/ { place = index("base io api", $2)
                              if (place < last) print $2 " stands too late"; last = place }' lib/isoroll.h |
    complain "lib/isoroll.h goes bottom-up"
sed -n 's/^#include "\(.*\)".*/\1/p' lib/isoroll.h | grep '_impl\.h' | complain "lib/isoroll.h lists public headers only"

# A library does not print (a file called "-" may be stdout), end the program, or change its locale. Comments are left
# out.
find lib -name '*.[ch]' | while read -r file; do
    sed -e 's|/\*.*\*/||' -e '/^ *\/\*/,/\*\//d' "$file" |
        grep -oE '(^|[^A-Za-z0-9_])(printf|puts|putchar|perror|exit|_Exit|abort|assert|setlocale|signal) *\(|\bstderr\b' |
        sed "s|^|$file: |"
done | complain "the library does not print, end the program or set the locale"

# A long comment stands above what it describes: one that begins behind code ends on its line.
find lib apps tests examples -name '*.[ch]' -exec awk '
    FNR == 1 { open = 0 }
    { i = index($0, "/*"); rest = substr($0, i + 2); behind = substr($0, 1, i - 1)
      if (!open && i > 0 && behind ~ /[^ \t]/ && behind !~ /"/ && !index(rest, "*/")) print FILENAME ":" FNR
      for (s = $0; i = index(s, open ? "*/" : "/*"); open = !open) s = substr(s, i + 2) }' {} + |
    complain "a comment behind code is one line"

# Places and lengths of files.
ls -A | grep -vxE '\..*|lib|apps|tests|examples|CMakeLists\.txt|README\.md|LICENSE|CITATION\.cff' | complain "nothing else at the top"
for entry in lib apps tests examples CMakeLists.txt README.md LICENSE; do
    [ -e "$entry" ] || echo "$entry"
done | complain "missing at the top"
find lib apps tests CMakeLists.txt -type f \( -name '*.[ch]' -o -name '*.sh' -o -name '*.txt' -o -name '*.in' \) |
    while read -r file; do echo "$(wc -l <"$file") $file"; done | awk '
    $1 > 450 { print $2 ": " $1 " lines" }
    $1 > 400 { print "warning: " $2 " has " $1 " lines" >"/dev/stderr" }' | complain "a file has at most 450 lines"

# An example says in its first ten lines what it is for.
for folder in examples/*/; do
    case ${folder#examples/} in
    [0-9][0-9]_*) ;;
    tutorials/ | paper/) continue ;;
    *) echo "$folder is not called NN_name" ;;
    esac
    found=
    for file in "$folder"main.c "$folder"scene.yaml "$folder"tutorial.py; do
        [ -f "$file" ] || continue
        found=yes
        head -n 10 "$file" |
            grep -qE '(/\*|//|#|^ \*).*[A-Za-z]+ [a-z]+ [a-z]+' || echo "$file has no comment on its purpose"
    done
    [ -n "$found" ] || echo "$folder has no main.c, scene.yaml or tutorial.py"
done | complain "examples"

cat "$complaints"
[ ! -s "$complaints" ]
