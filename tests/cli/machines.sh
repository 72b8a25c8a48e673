#!/bin/sh
# machines.sh ISOROLL - what happens where something is missing: 64 bits, glibc, HDF5, gnuplot.
. "$(dirname "$0")/lib.sh"
cc=${CC:-cc}

# --- 32 bits are refused, in words
echo 'int main(void) { return 0; }' >empty.c
if "$cc" -m32 empty.c -o empty 2>/dev/null; then
    check_not "32 bits are refused" cmake -S "$source" -B narrow -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS=-m32
    cmake -S "$source" -B narrow -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS=-m32 >out 2>err
    check "and it says why" grep -q "isoroll needs a 64-bit processor and compiler" err
else
    skip "32 bits" "$cc cannot compile for them here"
fi

# --- without gnuplot: words, and no picture
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 5 0.5 >scene.yaml
run 0 run scene.yaml -o ball.csv
mkdir nothing
checks=$((checks + 1))
PATH=$PWD/nothing "$isoroll" plot ball.csv -o picture.svg >out 2>err
[ $? -eq 5 ] || fail "plot without gnuplot: expected exit status 5"
check "it names gnuplot" grep -q gnuplot err
check "no picture" test ! -e picture.svg

# --- musl, a C library without GNU's functions: everything but HDF5 compiles. Libraries for it are not at hand.
if [ "$(length short full)" = full ] && has musl-gcc "musl"; then
    mkdir -p musl
    for header in gsl sundials cvode arkode nvector sunmatrix sunlinsol sunnonlinsol yaml.h; do
        [ ! -e /usr/include/$header ] || ln -s /usr/include/$header musl/
    done
    find "$source/lib" -name '*.c' ! -name 'hdf5*' ! -name 'arb_*' ! -name variant.c >files
    check "there are files" test "$(wc -l <files)" -ge 100
    while read -r file; do
        checks=$((checks + 1))
        musl-gcc -std=c11 -D_DEFAULT_SOURCE -Werror=implicit-function-declaration -fsyntax-only -I "$source/lib" \
            -I musl "$file" 2>err || fail "musl: $file"
    done <files
fi

# --- without HDF5, Arb, MPI and three.js: the library and the command are built, and say what they lack
if [ "$(length short full)" = full ]; then
    { cmake -S "$source" -B bare -DCMAKE_C_COMPILER="$cc" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0 -DISO_HDF5=OFF -DISO_ARB=OFF -DISO_MPI=OFF \
        -DISO_THREE_JS= -DBUILD_TESTING=OFF && cmake --build bare -j 2 --target isoroll_command; } >log 2>&1 ||
        { cp log err; fail "a build without HDF5, Arb, MPI and three.js"; }
    run 0 run scene.yaml --method rk8pd -o exact.csv
    isoroll=$work/bare/isoroll
    run 0 run scene.yaml --method rk8pd -o bare.csv
    check "the same rows" test "$(difference exact.csv bare.csv)" = 0
    run 0 run scene.yaml -o bare.csv # here without fused multiply-adds, which a compiler that optimises makes
    at_most "the same rows by Taylor series" "$(difference ball.csv bare.csv)" 1e-13
    refuses 2 "this build has no HDF5" run scene.yaml -o bare.h5
    refuses 2 "this build has no Arb" prove scene.yaml
    refuses 2 "built without three.js" view scene.yaml -o page.html
fi
finish
