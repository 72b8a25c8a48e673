# trajectory.gp - one trajectory: a sheet of panels in rows of two.
# $curves: chart, over, name, right, begin, end, low, high; $values: curve, x, y; $losses: t.
# If there are on_ball, on_point: $ball, $point: right, up, near; $ends: of, sign, right, up, near;
#     $axes: of, right, up, tip_right, tip_up, number, number_right, number_up.
# If there is above: $path: of, right, away, up, above, side; $marks: sign, right, away, up.
# Squares come first: the path in space, the spheres. Charts follow. A square that would stand alone has charts on its
# right, and a chart that would stand alone is as wide as the sheet: no part of the sheet is empty.
set datafile missing # a line ends where it goes to the other side
space = exists('above')
if (!space) { above = ''; side = ''; strip = 0; dots = 0 }
if (!exists('lost')) { lost = '' }
squares = (space && !strip ? 'above ' : '').(side ne '' ? 'side ' : '').(exists('on_ball') ? 'ball ' : '') \
    .(exists('on_point') ? 'point' : '')
charts = ''
do for [i=2:|$curves|] {
    if (!strstrt(charts, word($curves[i], 1))) { charts = charts.word($curves[i], 1).' ' }
}
odd = words(squares) % 2
beside = odd ? min(2, words(charts)) : 0

# --- what the views show along right, away and up: low[1..3], high[1..3]
array low[3]; array high[3]
if (space) {
    low[1] = right_low; low[2] = away_low; low[3] = up_low
    high[1] = right_high; high[2] = away_high; high[3] = up_high
    widest = max(high[1] - low[1], max(high[2] - low[2], high[3] - low[3]))
    do for [i=1:3] { # both views of a sphere have one scale; else no side is less than 0.45 of the longest
        middle = (low[i] + high[i]) / 2.0
        half = 0.56 * max(strip ? 0 : support > 0 ? widest : 0.45 * widest, high[i] - low[i])
        low[i] = middle - half; high[i] = middle + half
    }
}
flat(i) = high[1] > low[1] ? (high[i] - low[i]) / (high[1] - low[1]) : 1
shape = !space || strip ? 1 : max(0.45, min(1, max(flat(2), side ne '' ? flat(3) : 0)))
is_view(which) = which eq 'above' || which eq 'side'
square_height(i) = is_view(word(squares, i)) && is_view(word(squares, i + 1)) ? 420 - 320 * (1 - shape) : 420

# --- the page
below = strip ? 320 : 50
height = below
do for [i=1:words(squares):2] { height = height + square_height(i) }
height = height + (words(charts) - beside + 1) / 2 * 260 + (exists('noise') ? 40 : 0) + (space ? 26 : 0) + 12
width = 900; panels = 2; own_height = height
eval page
width = 900; height = own_height # a page of another shape is filled: its panels are wider or higher
set multiplot title title noenhanced font ',12'
fresh = 'unset label; unset arrow; unset object; unset xlabel; unset ylabel; unset title; set size noratio; \
set key default'
key_at(x, y) = whole_page.sprintf('; set key horizontal maxrows 1 samplen 1.2 width -1 Left reverse center center \
at screen %.6f, %.6f', across(x), down(y))

# --- views of the path in space; square 0 is the strip
with_path = dots ? 'points pt 7 ps 0.2' : 'lines'
seen(of, near) = strcol('of') eq of && column(which) == near ? column('right') : NaN
marked(sign) = strcol('sign') eq sign ? column('right') : NaN
if_there(is) = is ? '1' : ''
do for [i=(strip ? 0 : 1):words(squares)] {
    which = i ? word(squares, i) : 'above'
    pair = i && (i % 2 == 0 || i < words(squares))
    left = pair ? (i % 2 ? 0 : 450) : beside ? 0 : 225
    top = i ? below : 50
    bottom = i ? top + square_height(i - 1 + i % 2) : 320
    alike = pair ? is_view(which) == is_view(word(squares, i % 2 ? i + 1 : i - 1)) : 0
    eval fresh
    unset key
    if (is_view(which)) {
        eval axes_left
        eval i ? box(left + 75, left + 435, top + 25, bottom - 75) : box(75, 865, 80, 240)
        if (!strip) { set size ratio -1 }
        upward = which eq 'above' ? 'away' : 'up'
        k = which eq 'above' ? 2 : 3
        set title value(which) noenhanced offset 0,-0.3
        tick_name = right_name; eval named('x', low[1], high[1], strip ? 10 : 5)
        tick_name = value(upward.'_name'); eval named('y', low[k], high[k], strip ? 4 : 5)
        if (support > 0 && solid) {
            set object 1 circle at 0,0 size support back fc rgb band fs solid border lc rgb outline lw 1.5
        }
        if (support > 0 && !solid) {
            set object 1 circle at 0,0 size support back fs empty border lc rgb outline lw 2.5
        }
        if (which eq 'side' && exists('slope')) {
            set arrow 1 from low[1], at + slope * low[1] to high[1], at + slope * high[1] nohead back lw 3 \
                lc rgb outline
        }
        balls = if_there(ball > 0 && !strip)
        last = lost eq 'contact lost' ? 'lost' : 'end'
        plot for [c in balls] $marks using (marked('start')):upward:(ball) with circles fs empty border lc rgb axes \
                dt (4,3), \
            for [c in balls] $marks using (marked(last)):upward:(ball) with circles fc rgb far_blue \
                fs transparent solid 0.35 border lc rgb axes, \
            $path using (seen(word(paths, 1), 0)):upward with @with_path lw 1 lc rgb far_blue, \
            $path using (seen(word(paths, 2), 0)):upward with @with_path lw 1 dt (6,3) lc rgb far_vermillion, \
            $path using (seen(word(paths, 2), 1)):upward with @with_path lw 1 dt (6,3) lc rgb vermillion, \
            $path using (seen(word(paths, 1), 1)):upward with @with_path lw 1.6 lc rgb blue, \
            $marks using (marked('start')):upward with points pt 7 ps 1.1 lc rgb black, \
            $marks using (marked('end')):upward with points pt 9 ps 1.3 lc rgb black, \
            $marks using (marked('lost')):upward with points pt 2 ps 1.7 lw 3 lc rgb vermillion
    } else {
        joined = value(which.'_length') > 0
        fine = value(which.'_length') > 40 ? 0.8 : 1.8
        dot = value(which.'_rows') > 500 ? 0.2 : 0.5
        unset border; unset tics; unset grid
        eval box(left + 9, left + 441, top + 25, bottom - 40)
        set size ratio -1; set xrange [-1.2:1.2]; set yrange [-1.07:1.2]
        set object 1 circle at 0,0 size 1 back fc rgb sphere fs solid border lc rgb outline
        set title value('on_'.which) offset 0,0
        path = '$'.which
        of(name) = strcol('of') eq which ? column(name) : NaN
        end_of(sign) = strcol('sign') eq sign ? of('right') : NaN
        sign_colour(near) = near == 1 ? 0 : code(behind)
        plot for [c=0:10] [a=-pi/72:2*pi] '+' using (globe_x(-1, c, a)):(globe_y(c, a)) with lines lw 0.6 lc rgb grid, \
            for [c in if_there(joined)] path using (column('near') == 1 ? NaN : column('right')):'up' \
                with lines lw 0.8 lc rgb far_blue, \
            for [c in if_there(!joined)] path using (column('near') == 1 ? NaN : column('right')):'up' \
                with points pt 7 ps dot lc rgb far_blue, \
            $axes using (of('right')):'up':(column('tip_right') - column('right')):(column('tip_up') - column('up')) \
                with vectors nohead lw 1.2 lc rgb axes, \
            for [c=0:10] [a=-pi/72:2*pi] '+' using (globe_x(1, c, a)):(globe_y(c, a)) with lines lw 0.8 \
                lc rgb near_grid, \
            for [c in if_there(joined)] path using (column('near') == 1 ? column('right') : NaN):'up' \
                with lines lw fine lc rgb blue, \
            for [c in if_there(!joined)] path using (column('near') == 1 ? column('right') : NaN):'up' \
                with points pt 7 ps dot lc rgb blue, \
            $ends using (end_of('start')):'up':(sign_colour(column('near'))) with points pt 7 ps 1.1 lc rgb variable, \
            $ends using (end_of('end')):'up':(sign_colour(column('near'))) with points pt 9 ps 1.3 lc rgb variable, \
            $axes using (of('number_right')):'number_up':(sprintf('%d', column('number'))) with labels tc rgb ink
    }
    if (!alike || i % 2 == 0) { # a key under each square, or one for both
        eval key_at(i == 0 || alike ? 450 : left + 225, bottom - 19)
        if (is_view(which)) {
            eval 'plot NaN with lines lw 1.8 lc rgb blue title word(paths, 1)' \
                .(words(paths) > 1 ? ', NaN with lines lw 1.2 dt (6,3) lc rgb vermillion title "contact"' : '') \
                .', NaN with points pt 7 ps 1.1 lc rgb black title "start"' \
                .(lost ne 'contact lost' ? ', NaN with points pt 9 ps 1.3 lc rgb black title "end"' : '') \
                .(lost ne '' ? ', NaN with points pt 2 ps 1.7 lw 3 lc rgb vermillion title lost' : '')
        } else {
            plot NaN with lines lw 1.8 lc rgb blue title 'near side', NaN with lines lw 1.8 lc rgb far_blue \
                title 'far side', NaN with points pt 7 ps 1.1 lc rgb black title 'start', \
                NaN with points pt 9 ps 1.3 lc rgb black title 'end'
        }
    }
    if (i && (i == words(squares) || i % 2 == 0)) { below = bottom }
}

# --- charts
entry(i, column) = word($curves[i + 1], column)
x_of(i) = column('curve') == i + 0 ? column('x') : NaN
colour(name) = strstrt('energy h', name) ? black : strstrt('kinetic pressure ds/dt', name) ? blue : orange
is_right(i) = entry(i, 4) eq '1'
with_curve = |$values| == |$curves| ? 'points pt 7' : 'lines lw 1.5' # dots if there is one row
from_zero(low, high) = low >= 0 && low < 0.3 * high ? 0 : low - 0.04 * (high - low)
do for [j=1:words(charts)] {
    which = word(charts, j)
    pair = j > beside && ((j - beside) % 2 == 0 || j < words(charts))
    left = j <= beside || (j - beside) % 2 == 0 ? 450 : 0
    right = j > beside && !pair ? 900 : left + 450
    top = j > beside ? below : below - 420 + (j - 1) * 210 - (beside == 1 ? 0 : 8)
    bottom = top + (j > beside ? 260 : beside == 1 ? 370 : 210)
    tall = bottom - top > 230
    eval fresh
    eval axes_left
    eval box(left + 75, right - (which eq 'drift' ? 180 : 55), top + 40, bottom - 52)
    # its curves on the left and on the right, and their ranges
    on_left = ''; on_right = ''; least = 1e300; most = -1e300; least_right = 1e300; most_right = -1e300
    do for [i=1:|$curves| - 1] {
        if (entry(i, 1) eq which) {
            over = entry(i, 2); first = number(entry(i, 5)); last = number(entry(i, 6))
            if (is_right(i)) {
                on_right = on_right.i.' '
                least_right = min(least_right, number(entry(i, 7))); most_right = max(most_right, number(entry(i, 8)))
            } else {
                on_left = on_left.i.' '
                least = min(least, number(entry(i, 7))); most = max(most, number(entry(i, 8)))
            }
        }
    }
    tick_name = over
    eval named('x', first, last, right - left > 500 ? 9 : 5)
    if (which eq 'drift') {
        highest = ceil(log10(max(most, 1e-15)) + 0.3)
        set logscale y; set yrange [5e-18:10.0**highest]; set grid noxtics
        set ytics nomirror out scale 0.6 norotate ('≤10^{-17}' 1e-17)
        do for [i=-17 + 1 + (highest + 17) / 8:highest:1 + (highest + 17) / 8] {
            set ytics add (sprintf('10^{%d}', i) 10.0**i)
        }
        set label 1 'relative drift of the integrals' left at graph 0, graph 1.09
        set key left top Left reverse vertical maxrows 16 samplen 2 spacing 1.2 noenhanced title 'largest' left \
            at screen across(right - 180 + 13), down(top + 33)
        largest(i) = number(entry(i, 8)) > 0 ? sprintf('%.0e', number(entry(i, 8))) : '0'
        plot for [i in on_left] $values using (x_of(i)):(max(column('y'), 1e-17)) \
            with lines ls (i - word(on_left, 1)) % strokes + 1 lw 1.5 title entry(i, 3).'  '.largest(i)
        unset logscale y
    } else {
        set key horizontal maxrows 1 noenhanced Left reverse samplen 1.5 width (which eq 'paces' ? 0 : -2) \
            at graph 1, graph 1.03 right bottom
        tick_name = ''
        eval ticks('y', from_zero(least, most), most + 0.04 * (most - least), tall ? 5 : 3)
        set label 2 tick_text noenhanced right tc rgb ink at graph 0, graph 1 offset -1,0.6
        if (on_right ne '') {
            set border 11
            tick_name = 'μ'
            eval ticks('y2', from_zero(least_right, most_right), most_right + 0.04 * (most_right - least_right), \
                tall ? 5 : 3)
            if (tick_text ne 'μ') {
                set label 3 tick_text noenhanced left tc rgb ink at graph 1, graph 1 offset 0.5,0.6
            }
        }
        if (which eq 'paces') { set label 1 'speed (mean 1)' left at graph 0, graph 1 offset 0,0.9 }
        if (which ne 'paces') {
            do for [i=2:|$losses|] {
                set arrow from first number($losses[i]), graph 0 to first number($losses[i]), graph 1 nohead dt (6,4) \
                    lw 1.5 lc rgb vermillion
            }
        }
        if (on_right eq '') {
            plot for [i in on_left] $values using (x_of(i)):'y' with @with_curve lc rgb colour(entry(i, 3)) \
                title entry(i, 3)
        } else {
            plot for [i in on_right] $values using (x_of(i)):'y' axes x1y2 with @with_curve lc rgb colour(entry(i, 3)) \
                    title entry(i, 3), \
                for [i in on_left] $values using (x_of(i)):'y' with @with_curve lc rgb colour(entry(i, 3)) \
                    title entry(i, 3), \
                for [c in if_there(lost ne '')] keyentry with lines dt (6,4) lw 1.5 lc rgb vermillion title lost
        }
        unset y2tics
    }
    if (j > beside && (j == words(charts) || (j - beside) % 2 == 0)) { below = bottom }
}

# --- words below
if (exists('noise')) {
    eval whole_page
    unset key
    set label 1 noise noenhanced center tc rgb ink at screen 0.5, screen down(below + 20)
    plot NaN notitle
}
if (space) {
    eval whole_page
    unset key
    set label 1 'lengths, times and forces are in the units of the scene' center tc rgb words \
        at screen 0.5, screen down(height - 25)
    plot NaN notitle
}
