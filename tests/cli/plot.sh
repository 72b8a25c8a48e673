#!/bin/sh
# plot.sh ISOROLL - pictures of trajectories: the path in space, where contact is lost, any two columns, ticks (what is
# drawn: test_picture_space, test_picture_paths; tables of studies: tables.sh). gnuplot is replaced by a script that keeps its
# input; the last part takes the real one.
. "$(dirname "$0")/lib.sh"
stand_in
real_path=$PATH
PATH=$work/bin:$PATH

# draw ARGUMENT...: a picture; gnuplot's commands are in `script`
draw() {
    rm -f script
    run 0 plot "$@" -o picture.svg
}

# tells NAME WORDS...: the script has each of the words
tells() {
    what=$1
    shift
    for words; do check "$what: '$words'" grep -q -F -e "$words" script; done
}

# tells_not NAME WORDS...: it has none of them
tells_not() {
    what=$1
    shift
    for words; do check_not "$what: '$words'" grep -q -F -e "$words" script; done
}

# block NAME COLUMN VALUE NAME...: of the block of data with this name, the rows whose COLUMN has this value: these of
# its columns, with blanks between
block() {
    awk -v head="\$$1 << EOD" -v by="$2" -v value="$3" -v names="$(shift 3 && echo "$*")" '
        $0 == "EOD" { inside = 0 }
        inside == 1 { n = split(names, name, " "); for (i = 1; i <= NF; i++) { gsub(/"/, "", $i); at[$i] = i }
                      inside = 2; next }
        inside == 2 && $at[by] == value { for (i = 1; i <= n; i++) printf "%s%s", $at[name[i]], i < n ? " " : "\n" }
        $0 == head { inside = 1 }' script
}

# line KEY: the value of a line of the picture
line() { sed -n "s/^$1 = //p" script; }

# columns_of FILE NAME...: these columns, with blanks between
columns_of() {
    file=$1
    shift
    { columns "$file"; rows "$file"; } | awk -F, -v names="$*" '
        NR == 1 { n = split(names, name, " "); for (i = 1; i <= NF; i++) at[$i] = i; next }
        { for (i = 1; i <= n; i++) printf "%s%s", $at[name[i]], i < n ? " " : "\n" }'
}

# --- a bowl: axis 3 of space is up, so that the views are columns of the file
bowl=$source/examples/10_bowl/scene.yaml
run 0 run "$bowl" --t-end 8 --step 0.02 -o bowl.csv
draw bowl.csv
tells "bowl" "the path of the ball, seen from above" "seen from the side" "height \\050axis 3\\051" \
    \"energy h\" \"pressure\" "μ needed" "up to rounding" \
    "where it touched the support"
check "the user is told of the twin" grep -q "the ball is drawn alone: .*gravity" err
tells_not "bowl" 'lost = "' '"drift" "t"'
cp picture.svg kept.svg

# a file of another program: the centre alone, without k
{ echo "t,omega1,omega2,omega3,n1,n2,n3,centre1,centre2,centre3"; columns_of bowl.csv t omega1 omega2 omega3 n1 n2 n3 \
    centre1 centre2 centre3 | tr ' ' ','; } >foreign.csv
draw foreign.csv --k 1.1 --J 1.18e-4,1.26e-4,1.34e-4
tells "foreign" "seen along axis 3 of space" "seen along axis 2 of space"
tells_not "foreign" "from above" '"height' '"energies"'
check "foreign: neither support nor ball" test "$(line support) $(line ball)" = "0 0"

# --- off the top: the last row is where contact is lost
top=$source/examples/09_off_the_top/scene.yaml
run 0 run "$top" -o off.csv
lost=$(columns_of off.csv t | tail -n 1)
draw off.csv
tells "off the top" 'lost = "contact lost"'

# --- on a plane
run 0 run "$source/examples/01_bowling_ball/lane.yaml" --t-end 30 -o lane.csv
draw lane.csv
tells "lane" "the scale across it is larger" "along the path" "the ball: n, the normal where it touches" # it has a point
tells_not "lane" 'side = "seen from the side"'

# --- a free ball: no space, no weight
scene -1 "1.4, 2.1, 3" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.1 >free.yaml
run 0 run free.yaml -o free.csv
draw free.csv
tells "a free ball" '"paces" "t" "ds/dt"'
tells_not "a free ball" 'above = "' '"energies"' '"pressure"'
columns_of free.csv n1 n2 n3 | awk '{ printf "%.17g\n", 1 / ($1 * $1 / 1.4 + $2 * $2 / 2.1 + $3 * $3 / 3) }' >q
for pace in 0 1; do # q^(1 + 1/(2k)) and q^(1 - 1/(2k)), their means 1
    block values curve $((pace + 1)) x y | paste -d ' ' - q >a
    at_most "pace $pace" "$(awk -v e=$((2 * pace + 1)) '
        { x[NR] = $2; y[NR] = $3 ^ (e / 2); sum += $2; r = x[NR] / y[NR] / (x[1] / y[1]) - 1
          if (r < 0) r = -r; if (r > worst) worst = r }
        END { r = sum / NR - 1; if (r < 0) r = -r; print (NR > 50 ? worst + r : "few rows") }' a)" 1e-13
done

# --- two columns
draw bowl.csv --columns t,n3
tells "two columns" '"columns" "t" "n₃"' "equal = 0"
draw bowl.csv --columns centre1,centre3
tells "components of a vector" "equal = 1"
columns_of bowl.csv t n3 | tr ' ' ',' >bare.csv
draw - --columns t,n3 <bowl.csv
run 0 section "$source/examples/16_sections/scene.yaml" --crossings 20 -o crossings.csv
draw crossings.csv --columns l,x # a table that is no trajectory
tells_not "standard input" stdin

# --- what is refused, and leaves the picture that was there
cp kept.svg picture.svg
refuses 3 "bowl.csv: there is no column 'n4'; valid are t, omega1" plot bowl.csv --columns t,n4 -o picture.svg
refuses 3 "there is no column '\`touch OWNED\`'" plot bowl.csv --columns 't,`touch OWNED`' -o picture.svg
refuses 3 "expected a line of column names" plot - --columns t,n3 -o picture.svg <bare.csv
refuses 3 "does not say its k" plot foreign.csv -o picture.svg
sed '5s/,[^,]*,\([^,]*\)$/,nan,\1/' foreign.csv >bad.csv
refuses 3 "expected a finite number for centre2" plot bad.csv --k 1.1 --J 1,2,3 -o picture.svg
refuses_changed bowl.csv 's/^# effects: .*/# effects: rolling_resistance attitude reactions/' \
    "'# gravity.mgb', but no line '# effects' that names 'gravity'" plot -o picture.svg
columns_of bowl.csv t n3 | head -n 0 >none.csv
refuses 3 "" plot none.csv --columns t,n3 -o picture.svg
check "the old picture is still there" cmp -s kept.svg picture.svg
check "nothing was run" test ! -e OWNED

# --- drawn by gnuplot (all formats: test_plot)
PATH=$real_path
if has gnuplot "pictures"; then
    run 0 plot bowl.csv -o bowl.svg
    steady bowl.svg
    run 0 plot foreign.csv --k 1.1 --J 1.18e-4,1.26e-4,1.34e-4 -o foreign.pdf
    check "words of the picture" grep -q ">seen from the side<" bowl.svg
fi

# ticks LOW HIGH TEXT TICK: about 5 ticks between these, each with its own short label: what they mean, and one of them
ticks() {
    gnuplot -d -e "load '$source/apps/isoroll/pictures/page.gp'; tick_name = 't'; eval ticks('x', $1, $2, 5); \
        set print '-'; print tick_text; print tick_list" >out 2>err
    check "from $1 to $2: '$3'" test "$(head -n 1 out)" = "$3"
    check "from $1 to $2: $4" grep -q -F -e "$4" out
    check "from $1 to $2: neither few nor many" test "$(tail -n 1 out | tr -cd , | wc -c)" -ge 2 -a \
        "$(tail -n 1 out | tr -cd , | wc -c)" -le 10
    check "from $1 to $2: all different" test -z "$(tail -n 1 out | tr , '\n' | sed "s/' .*//" | sort | uniq -d)"
}
if has gnuplot "ticks"; then
    ticks 0 10 t "'4' 4"
    ticks 0 1e6 "t / 10⁶" "'0.4' 400000"
    ticks 0 1e-5 "t / 10⁻⁵" "'0.4' "
    ticks -0.3 0.3 t "'−0.2' "
    ticks 1e9 1e9+10 "t − 1000000000" "'4' 1000000004"
    ticks 1e6 1e6+1e-3 "(t − 1000000) / 10⁻³" "'0.4' "
    ticks 0 1e-280 "t / 10⁻²⁸⁰" "'0.4' "
    ticks 0 1e299 "t / 10²⁹⁹" "'0.4' "
fi

# --- how it looks: --style, --size, --title, --script
if has gnuplot "looks"; then
    for file in bowl.csv; do
        run 0 plot $file -o look.svg --script look.gp
        check "$file: its script draws the same" sh -c 'gnuplot -d look.gp | cmp - look.svg'
        run 0 plot $file -o look.png --script look.gp --size 600x500px --title "a 'title' of \`my\` own"
        check "$file: its script draws the same .png" sh -c 'gnuplot -d look.gp | cmp - look.png'
        check "its data are in it" grep -q '^\$path << EOD' look.gp
        check_not "no file is named in it" grep -q "$file\|look" look.gp
    done
    check "a size in pixels" test "$(od -An -j16 -N8 -tu1 look.png | tr -d '\n')" = "   0   0   2  88   0   0   1 244"
    run 0 plot bowl.csv -o look.svg --title "only this"
    check "a title" grep -q ">only this<" look.svg
    check_not "in place of its own" grep -q "The path of a ball" look.svg
    for none in "" none; do
        run 0 plot bowl.csv -o look.svg --title "$none"
        check_not "no title: '$none'" grep -q "The path of a ball" look.svg
    done
    # print: 178 mm = 504.6 pt or 86 mm = 243.8 pt wide, letters of 8 pt, fonts inside
    run 0 plot bowl.csv -o two.pdf --style print
    run 0 plot bowl.csv --columns t,n3 -o one.pdf --style print
    run 0 plot bowl.csv --columns t,n3 -o other.pdf --style print --size 100x80mm
    if has pdfinfo "the size of pages"; then
        for page in "two 504.6" "one 243.8" "other 283.5"; do
            width=$(pdfinfo "${page% *}.pdf" | sed -n 's/^Page size: *\([0-9.]*\) x.*/\1/p')
            at_most "the width of ${page% *}.pdf" "$(awk -v a="$width" -v b="${page#* }" 'BEGIN { d = a - b
                print (d < 0 ? -d : d) }')" 1
        done
        check_not "every font is inside" sh -c 'pdffonts two.pdf | tail -n +3 | awk "{ print \$(NF - 4) }" | grep -v yes'
        pdftotext -bbox one.pdf words
        # a line of DejaVu Sans is 1.164 of its letters high
        at_most "letters of 8 pt" "$(sed -n 's/.*yMin="\([0-9.]*\)".*yMax="\([0-9.]*\)">over<.*/\1 \2/p' words |
            awk '{ d = ($2 - $1) / 1.164 - 8; print (d < 0 ? -d : d) }')" 0.1
    fi
fi
refuses 2 "expected screen or print" plot bowl.csv -o look.svg --style paper
for size in 86x60 86mm 86x60cm 1x1mm 20000x100px nanx60mm; do
    refuses 2 "expected WIDTHxHEIGHT" plot bowl.csv -o look.svg --size="$size"
done
for wish in --style=print --size=86x60mm --title=a --script=a.gp; do
    option=${wish%=*}
    refuses 2 "$option is about a picture: give --plot FILE, too" chaos "$bowl" "$wish"
    refuses 2 "$option is about a picture" section "$bowl" "$wish"
done
refuses 2 "would be two files in one" plot bowl.csv -o look.svg --script look.svg
# Nobody reads the pipe: it is refused, before the work begins.
mkfifo pipe
timeout 60 "$isoroll" plot bowl.csv --columns t,n3 -o look.svg --script pipe >out 2>err
check "nothing waits for the reader of a pipe" test $? -eq 5
check "a script is no pipe" grep -q "cannot write 'pipe': it is not a regular file" err
refuses 5 "cannot write 'pipe'" chaos absent.yaml --plot look.svg --script pipe

# --- tables that lack something
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >scene.yaml
run 0 chaos scene.yaml --turns 20 --starts 5 --csv chaos.csv
refuses 2 "--window is for sections" plot bowl.csv -o none.svg --window 0:1,0:1
refuses 2 "--k is for trajectories" plot chaos.csv -o none.svg --k 0.5
refuses_changed chaos.csv '/^# axis/d' "the table does not say its axis" plot -o none.svg
check "no picture of these" test ! -e none.svg
finish
