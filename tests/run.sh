#!/bin/sh
# Runs the tests, with all their set-up: installs missing packages, builds in .build/, three rounds:
#     gcc        every test, warnings are errors
#     clang      the unit tests, warnings are errors
#     sanitize   every test under AddressSanitizer and UndefinedBehaviorSanitizer (gcc)
set -eu
cd "$(dirname "$0")/.."
sh .ci/packages.sh tests
jobs=$(nproc 2>/dev/null || echo 2)

# round NAME CTEST-OPTION CMAKE-OPTION...
round() {
    name=$1 select=$2
    shift 2
    echo "=== $name"
    log=.build/test-$name.log
    { cmake -S . -B ".build/test-$name" -DISO_WERROR=ON -DBUILD_TESTING=ON "$@" &&
        cmake --build ".build/test-$name" -j "$jobs"; } >"$log" 2>&1 || { cat "$log"; exit 1; }
    # shellcheck disable=SC2086 # $select is an option and its value
    ctest --test-dir ".build/test-$name" -j "$jobs" --output-on-failure --no-tests=error $select
}

mkdir -p .build
round gcc '' -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Release
if command -v clang >/dev/null; then
    round clang '-L unit' -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=Release
else
    echo "=== clang is not installed: its round is left out"
fi
round sanitize '' -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Release -DISO_SANITIZE=ON
