#!/bin/sh
# handbook.sh ISOROLL - the manual of apps/manual: every link and every formula, the names of all calls, what the
# search finds, how wide its pages are, the text of the PDF; the same bytes again. At full length.
. "$(dirname "$0")/lib.sh"
[ "$(length short full)" = full ] || impossible "the manual in HTML and PDF" "it is built at full length only"
for tool in pandoc python3; do
    command -v $tool >/dev/null || impossible "the manual in HTML and PDF" "$tool is not installed"
done
[ -s "$ISO_BUILD/python/_instruments.pyi" ] || impossible "the manual in HTML and PDF" "Python has no NumPy"
browser=
for name in chromium chromium-browser google-chrome chrome; do
    [ -n "$browser" ] || browser=$(command -v "$name")
done

# manual SOURCES MAN FOLDER [CHROMIUM]: builds a manual of these sources
manual() {
    from=$1 pages=$2
    shift 2
    ISO_STUB=$ISO_BUILD/python/_instruments.pyi python3 -B "$here/../../apps/manual/build.py" "$from" "$pages" "$isoroll" 9.9.9 "$@" >out 2>err
}

# --- the sources, and a document with formulas and a citation
mkdir sources
(cd "$source" && tar -cf - README.md LICENSE CITATION.cff .packages apps examples lib tests/*.md tests/*/*.md \
    tests/extend) | tar -C sources -xf -
cat >sources/lib/doc/extra.md <<'END'
# Extra

A formula $q = (\gamma, J \gamma)^{-1/k}$ in a line. It costs \$5, and `$HOME` is no formula.

$$M' = \frac{2\varepsilon}{k}\, q^{-1-1/k}\, \gamma \times J\gamma, \qquad \dot\gamma = \gamma\times M \tag{24}$$

$$\begin{pmatrix} a & b \\ c & d \end{pmatrix}
\begin{aligned} x &= \sqrt{\det J} \\ y &= \sum_{i=1}^3 \hat J_i \end{aligned}$$

| $k$ | name |
|---|---|
| $-1$ | Neumann, see [@tested, p. 3] |

[theory](theory.md#3-the-map), [scene](../../examples/15_two_spheres/scene.yaml), [a folder](../../examples).
END
cat >>sources/lib/doc/references.bib <<'END'
@article{tested, author = {Tester, Anna}, title = {On tests}, journal = {J. Tests}, year = {2001}, pages = {1--9}}
END
checks=1
manual sources "$ISO_BUILD/man" one "$browser" || fail "the manual cannot be built"
check "nothing is printed" test ! -s out -a ! -s err
check "a picture is there" test -s one/files/examples/16_sections/orbit.svg
scene=examples/15_two_spheres/scene.yaml
check "the scene is there" cmp "one/files/$scene.txt" "$source/$scene"

# --- what handbook.py reads in the pages; what the search finds, in node
in_browser handbook.py

# finds QUESTION ADDRESS: among the first three results
finds() {
    cat one/entries.js one/search.js >both.js
    echo 'for (const found of search(process.argv[2]).slice(0, 3)) console.log(found.address);' >>both.js
    node both.js "$1" >found 2>err
    check "'$1' finds $2, not $(tr '\n' ' ' <found)" grep -qxF "$2" found
}
if has node "the search of the manual"; then
    finds "unit of level.c" formats.html#formats.effects
    finds "exit 4" apps.html
    finds "what does exit status 4 mean" apps.html
    finds "how is share defined" formats.html#formats.the-share
    finds "how to add an effect" lib.html#lib.an-effect
    finds "iso_solution_at" c-api.html#c-api.iso_solution_at
    finds "--exponent-turns" isoroll-chaos.html#isoroll-chaos.options
    finds "poincare section" python-calls.html#python-calls.section
fi

# --- the PDF
if [ -n "$browser" ] && has pdftotext "the text of the PDF"; then
    pdftotext -layout one/isoroll.pdf text
    shows text "Theory: a rolling ball" "isoroll chaos" "iso_solution_create" "Tester, Anna"
    check "it has no address of this machine" test -z "$(grep -a -c "$work" one/isoroll.pdf | grep -v '^0$')"
    check "its pages have numbers" grep -qx ' *10' text
fi

# --- elsewhere and later: the same bytes
check_not "no path of this machine" grep -rqF "$work" one
mkdir elsewhere && mv sources elsewhere
manual elsewhere/sources "$ISO_BUILD/man" two || fail "a second time"
check "the same bytes again" diff -r -x isoroll.pdf -x index.html one two # they speak of the PDF, see below

# --- a manual of few documents: the same PDF again; what is wrong ends the build, in words
mkdir -p few/lib/doc few/apps/python few/lib/base none
printf '# Few\n\n[extra](lib/doc/extra.md)\n' >few/README.md
printf '# Library\n\n| floor | folder |\n|---|---|\n| 0 | `base` |\n' >few/lib/README.md
printf '# Theory\n\n## 3. The map\n' >few/lib/doc/theory.md
cp elsewhere/sources/lib/isoroll.h few/lib
cp elsewhere/sources/lib/doc/extra.md elsewhere/sources/lib/doc/references.bib few/lib/doc
cp -r elsewhere/sources/apps/python/isoroll few/apps/python
cp -r elsewhere/sources/examples few && rm -r few/examples/README.md few/examples/tutorials few/examples/paper
if [ -n "$browser" ]; then
    manual few none three "$browser" || fail "few documents"
    sleep 1
    manual few none four "$browser" || fail "few documents again"
    check "there is a PDF" test -s three/isoroll.pdf
    check "the same bytes again, with a PDF" diff -r three four
fi

# wrong LINE WORDS: with this line in a document there is no manual, and this is said
wrong() {
    cp elsewhere/sources/lib/doc/extra.md few/lib/doc
    printf '\n%s\n' "$1" >>few/lib/doc/extra.md
    check_not "a manual with $1" manual few none five
    check "'$2' is said, not $(tail -n 1 err)" grep -qF "$2" err
}
wrong '$\frac{1}{$' 'frac{1}{'
wrong '[nowhere](absent.md)' "lib/doc/extra.md: there is no file absent.md"
wrong '[nowhere](theory.md#absent)' "no section 'theory.absent'"
wrong '[@unknown]' "unknown"
finish
