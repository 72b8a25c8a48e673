#!/bin/sh
# package.sh ISOROLL - the Debian packages: which files and which dependencies they have. tests/package.sh installs them.
. "$(dirname "$0")/lib.sh"
needs dpkg-shlibdeps "Debian packages"
: "${ISO_BUILD:?}"

# cpack FOLDER: makes the packages in a folder
make_packages() {
    cpack --config "$ISO_BUILD/CPackConfig.cmake" -B "$PWD/$1" >log 2>&1 || { cp log err; fail "cpack"; }
}
make_packages first
version=$("$isoroll" --version | sed 's/[^0-9]*\([0-9.]*\).*/\1/;q')-1
machine=$(dpkg --print-architecture)
# deb_of PACKAGE: the name of its file
deb_of() {
    case $1 in python3-*) echo "${1}_${version}_all.deb" ;; *) echo "${1}_${version}_$machine.deb" ;; esac
}

# --- files: each package has its own, no file is in two
packages="isoroll libisoroll0 libisoroll-dev python3-isoroll"
[ ! -x "$ISO_BUILD/isoroll-mpi" ] || packages="$packages isoroll-mpi"
for package in $packages; do
    deb=first/$(deb_of "$package")
    check "there is $deb" test -s "$deb"
    dpkg-deb -c "$deb" | sed 's/ -> .*//; s/.* \.\//\//' | grep -v '/$' >"$package.files"
    dpkg-deb -f "$deb" >"$package.control"
    for file in copyright changelog.gz changelog.Debian.gz; do
        check "$package: $file" grep -qx "/usr/share/doc/$package/$file" "$package.files"
    done
    check "$package: files of root" test -z "$(dpkg-deb -c "$deb" | awk '$2 != "root/root"')"
    check "$package: all in /usr" test -z "$(grep -v '^/usr/' "$package.files")"
    check "$package: a maintainer" grep -q '^Maintainer: .* <.*@.*>$' "$package.control"
done
check "no more packages" test "$(ls first/*.deb | wc -l)" -eq "$(echo "$packages" | wc -w)"
check "no file is in two packages" test -z "$(cat ./*.files | sort | uniq -d)"
"$isoroll" --help | sed -n 's/^  \([a-z]*\)  *\[*[A-Z][A-Z]*\]*  *[a-z].*/\1/p' | grep -v '^isoroll$' >commands
check "there are commands" test "$(wc -l <commands)" -ge 10
for command in $(cat commands); do
    check "man page of $command" grep -qx "/usr/share/man/man1/isoroll-$command.1.gz" isoroll.files
done
for file in bin/isoroll share/man/man1/isoroll.1.gz share/bash-completion/completions/isoroll share/doc/isoroll/README.md \
    share/zsh/site-functions/_isoroll share/doc/isoroll/examples/15_two_spheres/scene.yaml share/doc/isoroll/apps/demo.sh; do
    check "isoroll has $file" grep -qx "/usr/$file" isoroll.files
done
check "libisoroll0 has a library" grep -q '/libisoroll\.so\.0$' libisoroll0.files
check "and nothing but that and its documents" test -z "$(grep -v '/libisoroll\.so\.0\|/usr/share/doc/' libisoroll0.files)"
for file in 'include/isoroll/isoroll\.h' 'lib.*/libisoroll\.so' 'lib.*/libisoroll\.a' 'lib.*/isoroll\.pc' \
    'lib.*/isorollConfig\.cmake'; do
    check "libisoroll-dev has $file" grep -qx "/usr/$file" libisoroll-dev.files
done
for file in __init__.py _library.py py.typed _instruments.pyi; do
    check "python3-isoroll has $file" grep -qx "/usr/lib/python3/dist-packages/isoroll/$file" python3-isoroll.files
done
check_not "nothing compiled" grep -q pycache python3-isoroll.files
check_not "no private header" grep -q '_impl\.h' libisoroll-dev.files

# --- dependencies
for library in libc6 libgsl libyaml libsundials-cvode libsundials-arkode; do
    check "isoroll needs $library" grep -q "^Depends: .*$library" isoroll.control
    check "libisoroll0 needs $library" grep -q "^Depends: .*$library" libisoroll0.control
done
! ldd "$isoroll" | grep -q libhdf5 || check "isoroll needs HDF5" grep -q "^Depends: .*libhdf5" isoroll.control
check_not "libisoroll0 needs no jansson" grep -q jansson libisoroll0.control
# SUNDIALS 7 of Debian 13 needs MPI itself, and whoever makes its context names MPI's empty communicator.
core=$(ldd "$isoroll" | sed -n 's/.*=> \(.*libsundials_core[^ ]*\).*/\1/p')
if [ -z "$core" ] || ! objdump -p "$core" | grep -q 'NEEDED *libmpi'; then
    check_not "isoroll needs no MPI" grep -qi mpi isoroll.control
fi
check "isoroll recommends gnuplot" grep -q '^Recommends: .*gnuplot' isoroll.control
check "libisoroll-dev needs its library" grep -q "^Depends: libisoroll0 (= $version)" libisoroll-dev.control
check "python3-isoroll needs its library" grep -q "^Depends: libisoroll0 (= $version), .*numpy" python3-isoroll.control
dpkg-deb -e "first/python3-isoroll_${version}_all.deb" python3
check "what was compiled is removed" test -x python3/prerm -a -x python3/postinst
dpkg-deb -e "first/libisoroll0_${version}_$machine.deb" control
check "dpkg learns the library" grep -q '^libisoroll 0 libisoroll0 (>= ' control/shlibs
check "ldconfig runs" grep -q ldconfig control/triggers

# --- the packaged command runs, and the demo beside it
dpkg-deb -x "first/isoroll_${version}_$machine.deb" there
check "the packaged command runs" there/usr/bin/isoroll --version
documents=$(cd there/usr/share/doc/isoroll && find . -name '*.md')
check "there are documents" test "$(echo "$documents" | wc -l)" -ge 8
for document in $documents; do # links [text](path)
    folder=there/usr/share/doc/isoroll/$(dirname "$document")
    for link in $(sed 's/](/\n](/g' "there/usr/share/doc/isoroll/$document" |
        sed -n 's/^](\([^)#]*\)[^)]*).*/\1/p' | grep -v '^[a-z]*:'); do
        check "$document: there is $link" test -e "$folder/$link"
    done
done
if [ "$(length short full)" = full ] && has gnuplot "the packaged demo"; then
    mkdir isoroll-demo && touch isoroll-demo/mine.txt isoroll-demo/mine.svg
    check "the packaged demo runs" sh -c \
        'PATH=$PWD/there/usr/bin:$PATH sh there/usr/share/doc/isoroll/apps/demo.sh >demo'
    check "three pictures" test "$(ls isoroll-demo/[0-9]*.svg | wc -l)" -eq 3
    check "the demo names three pictures and three tables" test "$(grep -c '\.svg$\|\.txt$' demo)" -eq 6
    check_not "the demo names what it made alone" grep -q mine demo
fi

# --- the same sources make the same packages
if [ "$(length short full)" = full ]; then
    make_packages second
    for package in $packages; do
        deb=$(deb_of "$package")
        check "$package: the same bytes again" cmp "first/$deb" "second/$deb"
    done
fi
finish
