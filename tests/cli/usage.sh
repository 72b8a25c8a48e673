#!/bin/sh
# usage.sh ISOROLL - the command line itself: exit statuses, messages, help, pipes, full disks, interruptions.
. "$(dirname "$0")/lib.sh"
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >scene.yaml
"$isoroll" run scene.yaml >ball.csv
commands="run convert compare cost check plot view section chaos periodic splitting prove integrals sweep explain analogue frequencies list manual"

# --- exit statuses
quietly run scene.yaml
run 1 check --max 1e-30 ball.csv
says "ball.csv: a residual is above 1e-30"
refuses 2 "missing argument SCENE" run
refuses 3 "absent_key" run - <<END
absent_key: 1
END
scene -1 "1.4e100, 2.1e100, 3e100" "0.9e200, -0.3e200, -0.225e200" "0.36, 0.48, 0.8" 1e-199 1e-200 >large.yaml
run 0 run large.yaml
refuses 4 "fit a double" run large.yaml --as point
run 4 compare large.yaml
refuses 5 "cannot open 'absent.yaml': No such file" run absent.yaml

# --- what is wrong on a command line
run 2
check "help on stderr" grep -q '^usage: isoroll' err
refuses 2 "unknown command 'runn'" runn scene.yaml
refuses 2 "unknown command ''" ''
refuses 2 "unknown command '--verbose'" --verbose
refuses 2 "option --bogus; see 'isoroll run --help'" run --bogus scene.yaml
refuses 2 "ambiguous option --t=5: it fits --tol, --t-end, --times" run --t=5 scene.yaml # --tol, --times, --t-end
refuses 2 "option -x" run --verbose -xh scene.yaml
refuses 2 "--help=1: the option --help takes no argument" run --help=1
refuses 2 "missing after --tol" run scene.yaml --tol
refuses 2 "missing after -o" run scene.yaml -o
refuses 2 "one argument too many: b" run scene.yaml b
refuses 2 "--output '': expected a file" run scene.yaml -o ''
for bad in x 0 nan 1e400 0x1p-40 '' ' 1e-9' 1e-16 0.2; do refuses 2 "--tol '$bad': expected a number in" run scene.yaml --tol "$bad"; done
for bad in x nan inf 1e999 '1 2'; do refuses 2 "--t-end '$bad': expected a number" run scene.yaml --t-end "$bad"; done
for bad in 0 -1 x; do refuses 2 "--step '$bad': expected a positive number" run scene.yaml --step "$bad"; done
refuses 2 "--method 'rk': expected a method of 'isoroll list methods'" run scene.yaml --method rk
refuses 2 "--backend 'both': expected ball, point, exact or auto" run scene.yaml --backend both
refuses 2 "--as 'auto': expected ball, point or both" run scene.yaml --as auto
refuses 2 "nothing is called 'bogus'; valid are systems, backends, effects" list bogus

# --- a word that is none of a list: the nearest one, as for keys of YAML
nearest() { # WORD ARGUMENT...: usage, or bad input, with the nearest word
    word=$1
    shift
    "$isoroll" "$@" >out 2>err
    case $? in 2 | 3) ;; *) fail "isoroll $*: refused by none of 2 and 3" ;; esac
    last=$*
    says "did you mean '$word'?"
    check "isoroll $last: nothing on stdout" test ! -s out
}
nearest periodic perodic scene.yaml
nearest run help runn
nearest --plot frequencies --plott a.svg scene.yaml
nearest --t-end run --tend 3 scene.yaml
nearest rk8pd run --method rk8pp scene.yaml
nearest ball run --backend bal scene.yaml
nearest omega1 section --event omga1=0.5 scene.yaml
nearest omega1 check ball.csv --columns t,omga1,omega2,omega3,n1,n2,n3
nearest methods list metods
nearest frequencies manual frequences
sed 's/^# effects.*//; s/^# k:/# effects: gravty\n# k:/' ball.csv >wind.csv
nearest gravity check wind.csv

# --- a file of another kind: what it is, and which commands take it
printf 'scene: scene.yaml\nvary: {k: [0.5, 1]}\nmeasure: {rotations: {}}\n' >sweep.yaml
run 0 sweep sweep.yaml -o result.csv
run 0 section scene.yaml --crossings 3 --quiet -o section.csv
run 0 chaos scene.yaml --turns 3 --csv chaos.csv
for command in plot check convert; do
    case $command in plot) more="-o a.svg" ;; convert) more="--to point" ;; *) more="" ;; esac
    # shellcheck disable=SC2086 # a list
    refuses 3 "'scene.yaml' is a scene, and no trajectory: 'isoroll run scene.yaml -o trajectory.csv' makes one" $command scene.yaml $more
    # shellcheck disable=SC2086
    refuses 3 "'sweep.yaml' is a sweep, which is for: explain, sweep" $command sweep.yaml $more
done
for command in run compare cost section chaos periodic splitting integrals frequencies analogue explain; do
    [ $command = explain ] || refuses 3 "$command: 'sweep.yaml' is a sweep, which is for: explain, sweep" $command sweep.yaml
    refuses 3 "$command: 'ball.csv' is a trajectory, which is for: convert, check, plot, view" $command ball.csv
    refuses 3 "$command: 'section.csv' is a section, which is for: convert, check, plot, view" $command section.csv
    refuses 3 "$command: 'result.csv' is the result of a sweep, which is for: plot, sweep" $command result.csv
    refuses 3 "$command: 'chaos.csv' is a table 'chaos', with no states of one scene, which is for: plot" $command chaos.csv
done
refuses 3 "'scene.yaml' is a scene: a sweep has the keys scene, vary and measure; scenes are for: run, compare" sweep scene.yaml
refuses 3 "sweep: 'ball.csv' is a trajectory, which is for: convert, check, plot, view" sweep ball.csv
refuses 3 "'sweep.yaml' is a sweep" view sweep.yaml -o a.html
refuses 5 "cannot open 'a?[31m?b'" run "$(printf 'a\033[31m\nb')" # nothing that moves the cursor
refuses 5 "File name too long" run "$(printf '%05000d' 0 | tr 0 x)"
refuses 5 "cannot read '.': Is a directory" run .
refuses 5 "cannot write '.'" run scene.yaml -o .
refuses 3 ":1:1" run /dev/null
refuses 2 "convert: 'scene.yaml' would overwrite what is read" convert --to point --scene scene.yaml ball.csv -o scene.yaml
run 0 run scene.yaml --step 5 --step 2 --verbose --verbose --t-end=4
check "the last of repeated options counts" test "$(rows out | cut -d, -f1 | tr '\n' ' ')" = "0 2 4 "
prints -x '# backend: point' run --back point -- scene.yaml
cp scene.yaml ./-x.yaml
run 0 run -- -x.yaml

# --- help: that of `help COMMAND`, `COMMAND --help` and `COMMAND -h` lists exactly the options that are taken
run 0 --help
mv out help
run 0 help
check "help" cmp out help
for command in $commands; do
    quietly "$command" --help
    cp out "help.$command"
    check "$command: usage line" grep -q "^usage: isoroll $command " out
    run 0 "$command" -h
    check "$command: -h" cmp out "help.$command"
    run 0 help "$command"
    check "help $command" cmp out "help.$command"
    check "--help lists $command" grep -q "^  $command " help
done
check "no line of help is longer than 80 characters" test -z "$(cat help.* | awk 'length > 80')"
cat help.* | sed -n 's/^  --\([a-zA-Z-]*\) .*/\1/p' | sort -u >all_options
check "20 options or so" test "$(wc -l <all_options)" -ge 17
n=0 newline='
'
for command in $commands; do
    text=$(cat "help.$command") n=$((n + 1))
    while read -r option; do
        n=$((n + 1))
        [ $((n % $(length 4 1))) -eq 0 ] || continue # each option with some of the commands
        checks=$((checks + 1))
        said=$("$isoroll" "$command" "--$option" 2>&1 >/dev/null </dev/null)
        case $text:$said in
        *"$newline  --$option "*:*"unknown option"*) fail "$command --$option is not taken" ;;
        *"$newline  --$option"*) ;; # taken, or the beginning of another one
        *:*"unknown option --$option;"*) ;;
        *) fail "$command --$option is taken: $said" ;;
        esac
    done <all_options
done
run 0 --version
for library in isoroll SUNDIALS GSL libyaml jansson; do
    check "--version: $library" grep -qE "^$library [0-9]+\.[0-9]+" out
done
run 0 list
cp out list
for topic in systems backends methods surfaces integrals clocks columns; do
    quietly list "$topic"
    check "list $topic" grep -q "^$topic: " out
    check "list has $topic" grep -q "^$topic: " list
done
check "list methods" grep -q '^  rk8pd ' list


# --- disks (more: hard_faults.sh, which has pipes and streams as well)
if "$isoroll" run scene.yaml -o a.h5 2>err; then
    (ulimit -f 4 && exec "$isoroll" run scene.yaml --step 0.01 -o b.h5) 2>err
    check "HDF5 and a limit on files" grep -q "cannot write 'b.h5': File too large" err
fi
for folder in absent /proc scene.yaml; do refuses 5 "cannot write" run scene.yaml -o $folder/a.csv; done
if [ "$(id -u)" -eq 0 ]; then
    skip "a locked folder" "root may write there"
else
    mkdir locked && chmod 555 locked
    refuses 5 "cannot write" run scene.yaml -o locked/a.csv
fi

printf '0,1,2,3\n1,2,3,4\n' >nameless.csv
refuses 3 "nameless.csv:1:1: expected a line of column names such as t,omega1,omega2,... before the numbers; without one, \
--columns t,omega1,... names them" check nameless.csv
grep -v '^# k:' ball.csv >no_k.csv
refuses 3 "does not say its k: write it in a line '# k: K' of the file, or give --k K" check no_k.csv

# --- interruptions
# A long run to which a signal comes says how many rows it has written (that these are whole: hard_faults.sh).
for signal in INT TERM; do
    [ $signal != INT ] || interruptible "SIGINT" || continue
    signalled $signal "written 4096" run scene.yaml --t-end 1e8 --step 100 --backend ball -o stopped.csv
    says "interrupted: $(rows stopped.csv | wc -l) of"
    signalled $signal "worked 20" run scene.yaml --t-end 1e10 --step 1e10 --backend ball -o stopped.csv # within a row
    says "interrupted: $(rows stopped.csv | wc -l) of"
done

# --- a closed standard stream
"$isoroll" run scene.yaml --t-end 10 --step 1 -o expected.csv
"$isoroll" run scene.yaml --t-end 10 --step 1 --verbose -o closed.csv 2>&-
check "a closed stderr does not tear the file" cmp expected.csv closed.csv
finish
