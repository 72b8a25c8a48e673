#!/bin/sh
# documents.sh ISOROLL - the documents: how long they are, whether their links lead somewhere, whether they cite what the
# bibliography has, whether the commands of the README work, and whether the gallery shows every example.
. "$(dirname "$0")/lib.sh"
: "${ISO_BUILD:?}"
documents=$(cd "$source" && find . -name '*.md' ! -path './.build/*' ! -path './.git/*' | sort)
check "there are documents" test "$(echo "$documents" | wc -l)" -ge 5

# --- no line is longer than 100 characters; the README has at most 130 lines
for document in $documents; do
    long=$(awk 'length($0) > 100 { print FNR; exit }' "$source/$document")
    check "$document: line $long has at most 100 characters" test -z "$long"
done
lines=$(wc -l <"$source/README.md")
check "README.md has at most 130 lines, not $lines" test "$lines" -le 130

# --- links within the project: [text](path) and src="path"
for document in $documents; do
    folder=$source/$(dirname "$document")
    links=$(sed 's/](/\n](/g; s/src="/\nsrc="/g' "$source/$document" |
        sed -n 's/^](\([^)#]*\)[^)]*).*/\1/p; s/^src="\([^"]*\)".*/\1/p' | grep -v '^[a-z]*:')
    for link in $links; do check "$document: there is $link" test -e "$folder/$link"; done
done

# --- every work that is cited is in the bibliography, and no other; no formula has an escape that Markdown takes away
bibliography=$source/lib/doc/references.bib
sed -n 's/^@[a-z]*{\([^,]*\),$/\1/p' "$bibliography" | sort >works
for document in $documents; do sed 's/`[^`]*`//g; /^    /d' "$source/$document"; done >text
grep -o '\[@[^]]*\]' text | tr -d '[]@ ' | tr ';' '\n' | sort -u >cited
check "there are works" test -s works
check "lib/doc/references.bib has the works that documents cite: $(diff works cited | sed -n 's/^[<>].*/&;/p')" cmp -s works cited
check "formulas: no \\{ \\} \\, \\; \\! in a document" awk '/\\[{},;!]/ { exit 1 }' text

# --- what archives read states the version of the command
for file in CITATION.cff examples/paper/codemeta.json; do
    stated=$(sed -n 's/^ *"\{0,1\}version"\{0,1\}: *"\{0,1\}\([0-9.]*\).*/\1/p' "$source/$file")
    check "$file: version $stated" test "isoroll $stated" = "$("$isoroll" --version | head -n 1)"
done

# --- the gallery shows every example, each picture is at most 150 kB
for folder in "$source"/examples/[0-9]*/; do
    example=$(basename "$folder")
    check "examples/README.md shows $example" grep -qx "## $example" "$source/examples/README.md"
done
for picture in "$source"/examples/*/*.svg; do
    size=$(wc -c <"$picture")
    check "$picture has $size bytes, at most 150000" test "$size" -le 150000
done

# --- the README, line by line
find_python numpy
[ -n "$python" ] || skip "the README's lines" "python3-numpy is not installed"
if has gnuplot "the README's lines" && has pkg-config "the README's lines" && [ -n "$python" ]; then
    mkdir bin && ln -s "$(command -v "$python")" bin/python3
    PATH=$PWD/bin:$PATH && export PATH
    check "the README's lines run" sh "$source/tests/readme.sh" "$ISO_BUILD"
fi

# --- the README's scene
sed -n '/^## A scene/,/^## Where/s/^    //p' "$source/README.md" >scene.yaml
run 0 run scene.yaml -o scene.csv
finish
