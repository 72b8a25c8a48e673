#!/bin/sh
# package.sh [TAR] - the Debian packages on an empty Debian of their own: apt installs them, the demo and a program in C
# run, and after they are removed nothing of them is left. It needs root, and debootstrap or TAR: a tar file of an
# empty Debian 12 (debootstrap --variant=minbase). It downloads what the packages need. So it is run by hand.
ISO_SOURCE=${ISO_SOURCE:-$(cd "$(dirname "$0")/.." && pwd)}
tar=${1-}
case $tar in [!/]*) tar=$PWD/$tar ;; esac
build=$ISO_SOURCE/.build/package
set -- "$build/isoroll"
. "$ISO_SOURCE/tests/cli/lib.sh"

[ "$(id -u)" -eq 0 ] || impossible "an empty Debian" "only root can have one"
for tool in dpkg-deb dpkg-shlibdeps cmake; do
    command -v $tool >/dev/null || impossible "an empty Debian" "$tool is not installed"
done
[ -n "$tar" ] || command -v debootstrap >/dev/null || impossible "an empty Debian" "debootstrap is not installed"

# --- the packages, and what lintian says of them
{ nice cmake -S "$ISO_SOURCE" -B "$build" -DCMAKE_INSTALL_PREFIX=/usr -DBUILD_TESTING=OFF &&
    rm -f "$build"/*.deb && nice cmake --build "$build" -j "$(nproc)" --target package; } >log 2>&1 ||
    { cat log; exit 1; }
if has lintian "the rules of Debian"; then
    lintian --allow-root --fail-on error "$build"/*.deb >said 2>&1 || { cp said err; fail "lintian finds errors"; }
    checks=$((checks + 1))
    cat said
fi

# --- an empty Debian with what the packages need
root=$work/debian
mkdir "$root"
if [ -n "$tar" ]; then
    tar -C "$root" -xpf "$tar" || impossible "an empty Debian" "$tar cannot be unpacked"
else
    nice debootstrap --variant=minbase bookworm "$root" >log 2>&1 ||
        impossible "an empty Debian" "debootstrap fails: $(tail -n 1 log)"
fi
cp /etc/resolv.conf "$root/etc/"
mkdir "$root/debs" && cp "$build"/*.deb "$root/debs/"
cp "$ISO_SOURCE/tests/cli/outside.c" "$root/debs/"
# inside COMMAND: a line for the shell of that Debian
inside() {
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive LC_ALL=C \
        sh -ec "$1" >out 2>err
}
# done_inside NAME COMMAND: and it succeeds
done_inside() {
    checks=$((checks + 1))
    inside "$2" || fail "$1"
}
inside 'apt-get update -qq' || impossible "an empty Debian" "apt-get update fails: $(tail -n 1 err)"
start=$(date +%s)
done_inside "apt installs the packages" 'apt-get install -y -qq ./debs/isoroll_*.deb'
echo "apt-get install ./isoroll_*.deb: $(($(date +%s) - start)) s"
start=$(date +%s)
done_inside "isoroll runs" 'cd /tmp && isoroll run /usr/share/doc/isoroll/examples/15_two_spheres/scene.yaml \
    -o ball.csv && isoroll plot ball.csv -o ball.png && test -s ball.png'
echo "a trajectory and a picture of it: $(($(date +%s) - start)) s"
start=$(date +%s)
done_inside "apt installs the package for Python" \
    'apt-get install -y -qq ./debs/libisoroll0_*.deb ./debs/python3-isoroll_*.deb'
echo "apt-get install ./libisoroll0_*.deb ./python3-isoroll_*.deb: $(($(date +%s) - start)) s"
start=$(date +%s)
done_inside "a Python array of it" "cd /tmp && python3 -c 'import isoroll
n = isoroll.read(\"ball.csv\").n
assert n.shape[1] == 3 and abs((n * n).sum(1) - 1).max() < 1e-12'"
echo "a Python array of it: $(($(date +%s) - start)) s"
done_inside "all packages, and what programs need" \
    'apt-get install -y -qq ./debs/*.deb gcc libc6-dev pkg-config man-db libsundials-dev cmake make'

# leaves_nothing NAME: purges our packages and compares all files with `before`
names=$(for file in "$build"/*.deb; do dpkg-deb -f "$file" Package; done | tr '\n' ' ')
files() {
    (cd "$root" && find . -path ./proc -prune -o -path ./sys -prune -o -path ./dev -prune -o -path ./var/lib/dpkg -prune \
        -o -path ./var/log -prune -o -path ./var/lib/apt -prune -o -path ./var/cache -prune -o -print | sort)
}
done_inside "dpkg removes the packages" "dpkg --purge $names && rm -rf /tmp/*"
files >before
check "they are gone" test ! -e "$root/usr/bin/isoroll"
check "nothing with the name isoroll is left" test -z "$(grep -i isoroll before | grep -v '^./debs')"
done_inside "dpkg installs them again" 'dpkg -i /debs/*.deb'
done_inside "the demo runs" 'cd /tmp && sh /usr/share/doc/isoroll/apps/demo.sh --view && cat isoroll-demo/*.svg >/dev/null'
check "three pictures" test "$(ls "$root"/tmp/isoroll-demo/*.svg | wc -l)" -eq 3
done_inside "man shows a page" 'man isoroll-run | grep -q tolerance'
done_inside "a program with pkg-config" 'cd /tmp && gcc /debs/outside.c -o outside $(pkg-config --cflags --libs isoroll) &&
    test "$(./outside)" = "k = -1"'
done_inside "a program with CMake, shared and static" 'mkdir /tmp/c && cd /tmp/c && cat >CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.25)
project(outside LANGUAGES C)
find_package(isoroll 0.3 REQUIRED COMPONENTS static)
add_executable(shared /debs/outside.c)
target_link_libraries(shared PRIVATE isoroll::isoroll)
add_executable(static /debs/outside.c)
target_link_libraries(static PRIVATE isoroll::isoroll_static)
END
    cmake . && make && test "$(./shared) $(./static)" = "k = -1 k = -1"'
done_inside "dpkg removes them" "dpkg --purge $names && rm -rf /tmp/*"
files >after
checks=$((checks + 1))
diff before after >err || fail "files are left, or gone"
[ -s err ] && cat err
finish
