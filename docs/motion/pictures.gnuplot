# Draws the pictures of docs/motion.md from the tables that motion_samples wrote. Parameters: folder (of the tables),
# out (the folder for the pictures).
set style line 1 lc rgb '#1f6fb4' lw 2
set style line 2 lc rgb '#c8501e' lw 2
set style line 3 lc rgb '#2e8b57' lw 2
set style line 4 lc rgb '#8a4fae' lw 2
set style line 5 lc rgb '#666666' lw 2
set grid lc rgb '#dddddd'
set border 3 lc rgb '#888888'
set tics nomirror textcolor rgb '#333333'
set key above horizontal left nobox
set format y '%.1s%c'

file(name) = folder . '/' . name . '.dat'

# Position, speed, acceleration and jerk, one above the other: name, title, and the curves' names ('' ends them).
array kinds[4] = ['position, pulses', 'speed, pulses/s', 'accel., pulses/s²', 'jerk, pulses/s³']
four(name, first, second, third) = sprintf("\
set terminal svg size 760,820 font 'sans,13' noenhanced background rgb 'white'; \
set output '%s/%s.svg'; set multiplot layout 4,1 margins 0.14,0.97,0.07,0.95 spacing 0.03; \
do for [k=1:4] { set ylabel kinds[k]; \
if (k==4) { set xlabel 'time, s'; set format x '%%g' } else { unset xlabel; set format x '' }; \
if (k==1) { set key above horizontal left nobox } else { unset key }; \
plot file('%s') index 0 using 1:(column(k+1)) with lines ls 1 title '%s'%s%s }; \
unset multiplot; set format x '%%g'; set key above horizontal left nobox", \
out, name, name, first, \
second eq '' ? '' : sprintf(", '' index 1 using 1:(column(k+1)) with lines ls 2 title '%s'", second), \
third eq '' ? '' : sprintf(", '' index 2 using 1:(column(k+1)) with lines ls 3 title '%s'", third))

eval four('trapezoid', 'start speed 2000, top 20 k, a 100 k, d 60 k', '', '')
eval four('by_times', '8000 pulses: the top speed is reached', '1500 pulses: it is lowered', '')
eval four('s_curve', 'one jerk for both ramps', 'a smaller one for slowing down', '')
eval four('sections', 'no section: a trapezoid', 'sections of 4000 pulses/s', 'sections of half the change')
eval four('short', 'lower_top', 'keep_half', 'cut_ramp')
eval four('offset', 'no offset', 'offset +60: creeps the rest', 'offset -150: cut off')

# Changes while moving.
set terminal svg size 760,660 font 'sans,13' noenhanced background rgb 'white'
set output out . '/changes.svg'
set multiplot layout 3,1 margins 0.14,0.97,0.1,0.93 spacing 0.03
array changes[5] = ['undisturbed', 'slower at 0.25 s', 'a farther target', 'a target too near: it turns round', 'a stop']
do for [k=1:3] {
  set ylabel kinds[k]
  if (k==3) { set xlabel 'time, s'; set format x '%g' } else { unset xlabel; set format x '' }
  if (k==1) { set key above horizontal left nobox } else { unset key }
  plot for [i=1:5] file('changes') index i-1 using 1:(column(k+1)) with lines ls i title changes[i]
}
unset multiplot
set format x '%g'

# Geometry.
set format y '%g'
set terminal svg size 760,520 font 'sans,13' noenhanced background rgb 'white'
set output out . '/arcs.svg'
set size ratio -1
set key outside right top vertical nobox
set xlabel 'X'; set ylabel 'Y'
array arcs[5] = ['R > 0, counter-clockwise', 'R > 0, clockwise', 'R < 0, counter-clockwise', 'R < 0, clockwise', 'through three points']
plot for [i=1:5] file('arcs') index i-1 using 1:2 with lines ls i title arcs[i], \
  '-' using 1:2 with points pt 7 ps 0.7 lc rgb 'black' notitle
0 0
60 30
20 35
e
unset key
set output out . '/spiral.svg'
plot file('spiral') using 1:2 with lines ls 1
set output out . '/helix.svg'
set size noratio
set zlabel 'Z'
set view 62,35
set ticslevel 0
splot file('helix') using 1:2:3 with lines ls 1
set key above horizontal left nobox

set terminal svg size 760,620 font 'sans,13' noenhanced background rgb 'white'
set output out . '/corners.svg'
set multiplot layout 2,1
array rules[3] = ['stop: from rest at each corner', 'join_below 45°', 'join: run through']
set size ratio -1
unset key
set xlabel 'X'; set ylabel 'Y'
plot file('corners') index 0 using 2:3 with lines ls 5
set size noratio
set key above horizontal left nobox
set xlabel 'time, s'; set ylabel 'path speed, u/s'
set yrange [0:130]
plot for [i=1:3] file('corners') index i-1 using 1:4 with lines ls i title rules[i]
unset multiplot
set autoscale y
load scripts . '/homing.gnuplot'
