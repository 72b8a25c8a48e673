#!/bin/sh
# Installs the build tree into a temporary prefix, moves that prefix, and builds outside.c against it in every way a
# user can: find_package (shared, static), pkg-config (shared, fully static), bare options; C, and C++ if there is
# one.
set -eu
: "${ISO_SOURCE:?}" "${ISO_BUILD:?}" "${CC:=cc}"
here=$ISO_SOURCE/tests/cli
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# runs_right NAME PROGRAM [OPTION...]: the program prints k
runs_right() {
    name=$1
    shift
    answer=$("$@") && [ "$answer" = "k = -1" ] || { echo "FAIL $name: answered '$answer'"; exit 1; }
    echo "ok   $name"
}

cmake --install "$ISO_BUILD" --prefix "$work/first" >install.log || { cat install.log; exit 1; }
mv first moved # whatever remembers its first place fails below
prefix=$work/moved
if find "$prefix" -name '*_impl.h' | grep .; then echo "FAIL a private header is installed"; exit 1; fi
"$prefix/bin/isoroll" --version >version || { echo "FAIL the installed command does not run"; exit 1; }

cat >CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.25)
project(outside LANGUAGES C)
find_package(isoroll 0.3 REQUIRED)
add_executable(shared "$here/outside.c")
target_link_libraries(shared PRIVATE isoroll::isoroll)
find_package(isoroll 0.3 REQUIRED COMPONENTS static)
add_executable(static "$here/outside.c")
target_link_libraries(static PRIVATE isoroll::isoroll_static)
END
{ cmake -S . -B build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$CC" && cmake --build build; } >log 2>&1 ||
    { cat log; exit 1; }
runs_right "find_package" build/shared
runs_right "find_package, static" build/static

pc=$(find "$prefix" -name isoroll.pc)
lib=${pc%/pkgconfig/*}
export PKG_CONFIG_PATH="$lib/pkgconfig"
if grep -i jansson "$pc"; then echo "FAIL jansson is the command's, not the library's"; exit 1; fi
# shellcheck disable=SC2046 # the flags are lists
{
    "$CC" -std=c11 "$here/outside.c" -o shared $(pkg-config --cflags --libs isoroll)
    runs_right "pkg-config" ./shared
    # everything static, down to libc; so it stands on its own
    if pkg-config --static --libs isoroll | grep -q -- '-lflint' && [ "$("$CC" -print-file-name=libflint.a)" = libflint.a ]; then
        echo "SKIP a fully static program: there is no static library of FLINT, which Arb needs"
    elif pkg-config --static --libs isoroll | grep -q -- '-lhdf5'; then
        echo "SKIP a fully static program: HDF5 does not say which static libraries it needs"
    else
        "$CC" -std=c11 -static "$here/outside.c" -o static $(pkg-config --static --cflags --libs isoroll)
        runs_right "pkg-config --static" ./static
    fi
}

# bare NAME COMPILER [OPTION...]: no help from CMake or pkg-config
bare() {
    name=$1
    shift
    "$@" -I"$prefix/include" "$here/outside.c" -o bare -L"$lib" -lisoroll
    runs_right "$name" env LD_LIBRARY_PATH="$lib" ./bare
}
bare "-I, -L and -l alone" "$CC" -std=c11 -Wall -Wextra -Wpedantic -Werror
find "$prefix/include/isoroll" -name '*.h' | sed "s|^$prefix/include/||" >headers
while read -r header; do # each by itself
    printf "#include <%s>\ntypedef int nothing;\n" "$header" >one.c
    "$CC" -std=c11 -Wpedantic -Werror -fsyntax-only -I"$prefix/include" one.c || { echo "FAIL $header"; exit 1; }
done <headers
command -v c++ >/dev/null || { echo "SKIP install: C++: c++ is not installed"; exit 0; }
bare "C++" c++ -x c++ -std=c++17 -Wall -Wpedantic -Werror
while read -r header; do
    echo "#include <$header>" >one.cpp
    c++ -std=c++17 -Wpedantic -Werror -fsyntax-only -I"$prefix/include" one.cpp || { echo "FAIL $header: C++"; exit 1; }
done <headers
echo "ok   $(wc -l <headers) headers, each by itself"
