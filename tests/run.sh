#!/bin/sh
# run.sh [--all | --threads | --valgrind] - runs the tests, with all their set-up: installs missing packages, builds in
# .build/.
#
#     sh tests/run.sh         gcc: every test, at short length
#     sh tests/run.sh --all   gcc: every test, at full length; then, at short length, clang: the quick unit tests; and
#                             AddressSanitizer and UndefinedBehaviorSanitizer (gcc): all but scripts that repeat units
#     sh tests/run.sh --threads    ThreadSanitizer (gcc): the tests of what runs in threads, at short length
#     sh tests/run.sh --valgrind   valgrind: quick unit tests of every floor, at short length
#
# Warnings are errors. What the lengths are: tests/README.md.
set -eu
cd "$(dirname "$0")/.."
what=
case ${1-} in
--all | --threads | --valgrind) what=$1 && shift ;;
esac
[ $# -eq 0 ] || { echo "usage: sh tests/run.sh [--all | --threads | --valgrind]" >&2; exit 2; }
sh .ci/packages.sh "$([ "$what" = --all ] && echo all || echo tests)"
jobs=$(($(nproc 2>/dev/null || echo 2) + 1)) # one more than processors: some wait for a disk
rounds= # the rounds that were run

# round NAME LENGTH CTEST-OPTION CMAKE-OPTION...
round() {
    name=$1 length=$2 select=$3
    shift 3
    echo "=== $name, $length length"
    log=.build/test-$name.log
    { cmake -S . -B ".build/test-$name" -DISO_WERROR=ON -DBUILD_TESTING=ON "$@" &&
        cmake --build ".build/test-$name" -j "$jobs"; } >"$log" 2>&1 || { cat "$log"; exit 1; }
    # shellcheck disable=SC2086 # $select is an option and its value
    ISO_TEST_LENGTH=$length ctest --test-dir ".build/test-$name" -j "$jobs" --output-on-failure \
        --no-tests=error $select
    # parts that cannot be tried here
    grep -h '^SKIP ' ".build/test-$name/Testing/Temporary/LastTest.log" | sort -u || true
    rounds="$rounds${rounds:+, }$name ($length)"
}

threaded='api|batch|batch_failures|crossings|chaos|sweep|section_run|indicators|hard_machine|sweep_files|section'
quick='number|version|params|model|integrals|formula|effect_rows|rest|map|reduction|poisson|needs|refusal'
quick="$quick|two_point|separation|coordinates|orbit|attitude|convert|off_level|analogue"
quick="$quick|spectrum|scene|trajectory|sweep_file|plot|api"
# other compilers build every test, and run all but these, which take most of the time
long='periodic|chaos|effects|tangent|splitting_k|prove|integral_rotor|integral_search|theorem_rotor|taylor|level|lanes'
long="$long|event|exact|exact_forms|exact_near|exact_far|exact_rotor|measure|sweep|api_studies|hard_.*"
mkdir -p .build
left_out=
case $what in
'')
    round gcc short '' -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Release
    left_out="full length, clang, sanitizers (sh tests/run.sh --all)"
    ;;
--threads) # not `cost`, which measures time
    round threads short "-R ^(cli_)?($threaded)\$" -DCMAKE_C_COMPILER=gcc -DISO_SANITIZE=thread
    left_out="all that has no threads"
    ;;
--valgrind)
    command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 1; }
    round valgrind short "-R ^($quick)\$" -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Release \
        "-DCMAKE_CROSSCOMPILING_EMULATOR=valgrind;-q;--error-exitcode=9;--leak-check=full"
    left_out="tests that take long in valgrind, or need long double (it has 64 bits): study, run"
    ;;
--all)
    sh apps/live/sources.sh .build/live-sources || echo "no sources of GSL: view --live is left out"
    round gcc full '' -DISO_LIVE_BUILD=ON -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Release
    if command -v clang >/dev/null; then
        round clang short "-L unit -E ^($long)\$" -DISO_LIVE=OFF -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=Release
    else
        left_out="clang (not installed)"
    fi
    round sanitize short '' -DISO_LIVE=OFF -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Release -DISO_SANITIZE=ON
    ;;
esac
echo "=== run: $rounds; left out: ${left_out:-nothing}"
