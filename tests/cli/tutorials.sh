#!/bin/sh
# tutorials.sh ISOROLL - the pages of examples/tutorials, followed as a new user would: each command ends with exit
# status 0 and prints what the page quotes.
. "$(dirname "$0")/lib.sh"
mkdir bin && ln -s "$isoroll" bin/isoroll
export PATH="$work/bin:$PATH" COLUMNS=80 # the pages quote a terminal of this width

# steps PAGE: files 1.command, 1.quoted, 2.command, ... A command is "$ COMMAND" in an indented block; lines after a
# "\" or up to the END of a "<<END" belong to it, the rest of the block is quoted output.
steps() {
    rm -f ./*.command ./*.quoted
    awk '
        !/^    / { inside = 0; next }
        { line = substr($0, 5) }
        line ~ /^\$ / && !more { n++; inside = 1; to = n ".command"; line = substr(line, 3); printf "" >(n ".quoted")
                                 here = line ~ /<<END/ }
        inside { print line >to; more = here ? line != "END" : to ~ /command/ && line ~ /\\$/
                 if (!more) { to = n ".quoted"; here = 0 } }' "$1"
}

# quoted FILE OUTPUT: the lines of FILE are lines of OUTPUT, in this order. "..." stands for lines, or for the end of a
# line; a word that ends so has this beginning. Numbers agree to a millionth; below 1e-8 they are rounding errors.
quoted() {
    awk '
        function size(x) { return x < 0 ? -x : x + 0 }
        function is_number(x) { return x ~ /^[-+]?[0-9]*\.?[0-9]+(e[-+]?[0-9]+)?$/ }
        function same(a, b) {
            if (a == b || (a ~ /\.\.\.$/ && index(b, substr(a, 1, length(a) - 3)) == 1)) return 1
            if (!is_number(a) || !is_number(b)) return 0
            return size(a - b) <= 1e-6 * size(a) || (size(a) < 1e-8 && size(b) < 1e-8)
        }
        function agree(wanted, line, i, n, m, w, l) {
            n = split(wanted, w, /[ \t,;:()]+/); m = split(line, l, /[ \t,;:()]+/)
            for (i = 1; i <= n; i++) {
                if (w[i] == "...") return 1
                if (i > m || !same(w[i], l[i])) return 0
                if (i == n && w[i] ~ /\.\.\.$/) return 1
            }
            return n == m
        }
        FILENAME == ARGV[1] { if ($0 != "...") wanted[++count] = $0; next }
        found < count && agree(wanted[found + 1], $0) { found++ }
        END { if (found < count) { print "not printed: " wanted[found + 1]; exit 1 } }' "$1" "$2"
}

! has gnuplot "pictures" && drawn="plot " || drawn=
! "$isoroll" view absent -o - 2>&1 | grep -q "built without three.js" || drawn="$drawn view "
for page in "$source"/examples/tutorials/*.md; do
    title=$(basename "$page")
    mkdir "$work/${title%.md}" && cd "$work/${title%.md}" || exit 1
    steps "$page"
    check "$title has steps" test -s 9.command
    n=0
    while n=$((n + 1)) && [ -e $n.command ]; do
        for word in $drawn; do ! grep -q -e "$word " $n.command || continue 2; done
        checks=$((checks + 1))
        sed -i "s|/usr/share/doc/isoroll|$source|" $n.command
        sh $n.command >printed 2>&1 </dev/null || fail "$title: $(cat $n.command): $(tail -n 1 printed)"
        quoted $n.quoted printed >err || fail "$title: $(cat $n.command)"
    done
done
: >err
finish
