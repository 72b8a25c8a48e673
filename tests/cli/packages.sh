#!/bin/sh
# packages.sh ISOROLL - .ci/packages.sh: what it installs, where dpkg-query, apt-cache, apt-get and id are stand-ins. apt
# knows the names in `known`, after `apt-get update` those in `later`; dpkg has those in `installed`.
. "$(dirname "$0")/lib.sh"
mkdir -p bin sources/.ci
cp "$source/.ci/packages.sh" sources/.ci
cat >sources/.packages <<'END'
# a comment, with A | B
make
old-arb | new-flint # a comment
# tests: more
third | second | first
# all: the rest
pandoc
END
cat >bin/dpkg-query <<'END'
for name; do :; done
grep -qx -e "$name" installed && printf installed
END
cat >bin/apt-cache <<'END'
for name; do :; done
grep -x -e "$name" known || true # a name that others mention has no text, and is no error
END
cat >bin/apt-get <<'END'
case $1 in
update) cat later >>known ;;
install) shift && for word; do case $word in -*) ;; *) printf '%s ' "$word" ;; esac done >got ;;
esac
END
printf 'echo 0\n' >bin/id
for tool in bin/*; do printf '#!/bin/sh\n%s\n' "$(cat "$tool")" >made && cat made >"$tool" && chmod +x "$tool"; done

# installs EXPECTED INSTALLED KNOWN LATER [ARGUMENT]: lists of names
installs() {
    expected=$1
    echo "$2" | tr ' ' '\n' >installed
    echo "$3" | tr ' ' '\n' >known
    echo "$4" | tr ' ' '\n' >later
    shift 4
    : >got
    checks=$((checks + 1))
    PATH=$work/bin:$PATH sh sources/.ci/packages.sh "$@" >out 2>err || fail "packages.sh $*"
    check "packages.sh $*: installs '$(cat got)', not '$expected'" test "$(cat got)" = "$expected"
}
installs "make old-arb " "" "make old-arb new-flint" ""
installs "make new-flint " "" "make new-flint" ""
installs "make new-flint " "" "" "make new-flint"
installs "make old-arb " "" "" "make"
installs "old-arb " "make new-flint" "make old-arb new-flint" "" # FLINT without Arb is not enough where Arb is apart
installs "" "make new-flint" "make new-flint" ""
installs "" "make old-arb" "" ""
installs "make old-arb second " "" "" "make old-arb second first" tests
installs "third pandoc " "make old-arb first" "third first" "" all
check "it says what it installs" grep -qx "installing third pandoc" out

# where it cannot install, it says the names
printf '#!/bin/sh\nfalse\n' >bin/sudo && chmod +x bin/sudo
printf '#!/bin/sh\necho 1\n' >bin/id
for tool in cmake make cc pkg-config gnuplot; do printf '#!/bin/sh\n' >bin/$tool && chmod +x bin/$tool; done
installs "" "" "make new-flint" ""
check "the names that apt knows" grep -q "no-install-recommends make new-flint$" err

# an empty Debian for README's commands: where there can be none, that is no success
env PATH="$work/bin:$PATH" sh "$source/tests/fresh.sh" bookworm >out 2>err
status=$?
check "fresh.sh without root: status $status" test $status -eq 3
check "it says why" grep -q "^SKIP fresh: README's commands in an empty bookworm: only root can make one" err
check_not "fresh.sh without a suite" sh "$source/tests/fresh.sh"

# CI fails if README's commands fail there; where they cannot be tried, it says so at its end
mkdir sources/tests && cp "$source/.ci/run" sources/.ci
: >sources/tests/run.sh
for status in 0 1 2 3; do
    echo "exit $status" >sources/tests/fresh.sh
    bash sources/.ci/run >"said.$status" 2>&1
    echo $? >"ended.$status"
done
check "CI passes" test "$(cat ended.?)" = "$(printf '0\n1\n2\n0')"
check "what could not be tried is said" grep -q "NOT TRIED" said.3
check_not "and only then" grep -q "NOT TRIED" said.0

# the list itself: every line is a name, or names with | between
check_not ".packages: names" sh -c "sed 's/#.*//' '$source/.packages' | grep -vE '^ *\$|^[a-z0-9.+-]+( \| [a-z0-9.+-]+)* *\$'"
finish
