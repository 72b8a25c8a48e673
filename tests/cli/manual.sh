#!/bin/sh
# manual.sh ISOROLL - man pages and completions say what --help says: the same commands, options and words, no more and
# no less. What the build made is what the command prints.
. "$(dirname "$0")/lib.sh"

# same NAME A B: two lists of words, one a line, are equal and not empty
same() {
    check "$1: there are some" test -s "$2"
    checks=$((checks + 1))
    diff "$2" "$3" >differences 2>&1 || fail "$1: $(tr '\n' ' ' <differences)"
}

# page NAME: prints it into `page`
page() {
    quietly manual "$1"
    mv out page
}

# --- the lists of --help: commands; options of each, in `options.COMMAND`
run 0 --help
sed -n 's/^  \([a-z]*\)  *\[*[A-Z][A-Z]*\]*  *[a-z].*/\1/p' out | grep -v '^isoroll$' | sort >commands
for command in $(cat commands); do
    run 0 "$command" --help
    sed -n 's/^  --\([a-zA-Z-]*\) .*/\1/p' out | sort >"options.$command"
    sed -n 's/.*(-\([a-z]\)\([ )].*\)*$/\1/p' out | sort >"letters.$command"
done
check "ten commands or more" test "$(wc -l <commands)" -ge 10

# --- man pages
page isoroll
sed -n 's/^\.BR isoroll\\-\([a-z]*\) (1)$/\1/p' page | sort -u >listed
same "isoroll(1) lists the commands" listed commands
for command in $(cat commands); do
    page "$command"
    check "isoroll-$command(1): its title" grep -qi "^\.TH isoroll-$command 1 " page
    sed 's/\\-/-/g' page | sed -n 's/^\(\\fB-[a-z]\\fR.*, \)*\\fB--\([a-zA-Z-]*\)\\fR.*/\2/p' | sort >listed
    same "isoroll-$command(1): options" listed "options.$command"
    sed 's/\\-/-/g' page | sed -n 's/^\\fB-\([a-z]\)\\fR.*/\1/p' | sort >listed
    same "isoroll-$command(1): letters" listed "letters.$command"
    for part in NAME SYNOPSIS DESCRIPTION OPTIONS 'EXIT STATUS' EXAMPLE; do
        check "isoroll-$command(1): $part" grep -qx "\.SH $part" page
    done
    check "isoroll-$command(1): no long line" awk 'length > 1000 { exit 1 }' page
done
if command -v groff >/dev/null; then
    for of in isoroll $(cat commands); do
        page "$of"
        groff -man -Tascii -ww page >shown 2>warnings || fail "groff: $of"
        check "groff has no warning for $of: $(head -n 1 warnings)" test ! -s warnings
        check "groff shows $of" test "$(wc -l <shown)" -gt 20
    done
fi
if command -v man >/dev/null; then
    check "man -l shows a page" sh -c 'man -l page </dev/null'
fi
refuses 2 "no page is called 'runn'" manual runn
refuses 5 "cannot write" manual run -o absent/run.1

# --- bash: what it offers
page zsh
if command -v zsh >/dev/null; then check "zsh reads it" zsh -n page; fi
prints "^--backend	what computes the orbit: ball, point" --complete run --backe
run 0 --complete run --backend=e
check "zsh has an option and its word in one" sh -c 'cut -f 1 out | grep -qx exact'

# offers WORD...: the words offered for the last of these, into `listed`
offers() {
    PATH=$(dirname "$isoroll"):$PATH bash -c '. ./page && COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) && _isoroll && printf "%s\n" "${COMPREPLY[@]}"' bash "$@" |
        sort >listed 2>err
}

# completes EXPECTED WORD...: to this one word
completes() {
    expected=$1
    shift
    offers "$@"
    check "bash: '$*' becomes $expected, not $(tr '\n' ' ' <listed)" test "$(cat listed)" = "$expected"
}
if command -v bash >/dev/null; then
    page bash
    { cat commands && printf '%s\n' --help --version; } | sort >expected
    offers isoroll ''
    same "bash: commands" listed expected
    completes run isoroll ru
    completes exact isoroll run --backend e
    completes exact isoroll run --backend = e
    completes both isoroll run --as bo
    completes methods isoroll list me
    completes '' isoroll run scene
    completes '' isoroll nothing --b
    for command in $(cat commands); do
        offers isoroll "$command" --
        sed 's/^/--/' "options.$command" | sort >expected
        same "bash: options of $command" listed expected
    done
    offers isoroll run --method ''
    { echo auto && "$isoroll" list methods | sed -n '3,$s/^  \([a-z0-9_]*\) .*/\1/p'; } | sort >expected
    same "bash: methods" listed expected
    offers isoroll list ''
    "$isoroll" list | sed -n 's/^\([a-z]*\): .*/\1/p' | sort >expected
    same "bash: topics" listed expected
fi

# --- apps/README.md: a section for each command, whose commands work
readme=$source/apps/README.md
sed -n 's/^## \([a-z]*\): .*/\1/p' "$readme" | sort >listed
same "apps/README.md: sections" listed commands
ln -s "$source/examples" examples
sed -n 's/^    \$ isoroll \([^|>]*\)\( [|>].*\)*$/\1/p' "$readme" >lines
check "apps/README.md: commands" test "$(wc -l <lines)" -ge "$(wc -l <commands)"
while read -r line; do
    case $line in
    "sweep "*) line="$line --shard 1/20" ;; # all its points take minutes
    *.svg* | *.png*) has gnuplot "$line" || continue ;;
    esac
    # shellcheck disable=SC2086 # a list
    if "$isoroll" $line >out 2>err </dev/null; then
        checks=$((checks + 1))
    elif grep -qE 'isoroll was built without|this build has no' err; then
        skip "$line" "$(cat err)"
    else
        fail "isoroll $line"
    fi
done <lines

# --- what the build made
if [ -d "${ISO_BUILD:-absent}/man" ]; then
    for of in isoroll $(cat commands); do
        page "$of"
        file=isoroll-$of.1
        [ "$of" != isoroll ] || file=isoroll.1
        check "the build made $file" cmp page "$ISO_BUILD/man/man1/$file"
    done
    check "one file for each page" test "$(ls "$ISO_BUILD/man/man1" | wc -l)" -eq $(($(wc -l <commands) + 1))
    page bash
    check "the build made the completion of bash" cmp page "$ISO_BUILD/man/isoroll"
    page zsh
    check "the build made the completion of zsh" cmp page "$ISO_BUILD/man/_isoroll"
    check "installation" cmake --install "$ISO_BUILD" --component manual --prefix "$work/there"
    for file in man/man1/isoroll.1 man/man1/isoroll-run.1 bash-completion/completions/isoroll zsh/site-functions/_isoroll; do
        check "share/$file is installed" test -s "there/share/$file"
    done
fi
finish
