# The homing modes: distance over time, with the positions of the switches shaded. Loaded by pictures.gnuplot.
set format y '%.0s%c'
unset key
set xlabel 'time, s' offset 0,0.5
set ylabel ''
set yrange [-5500:16500]
set xrange [0:3]
set xtics 1
set object 1 rectangle from graph 0, first 6000 to graph 1, first 9000 fc rgb '#fff2c8' fs noborder behind
set object 2 rectangle from graph 0, first 15000 to graph 1, first 16500 fc rgb '#f6d5cc' fs noborder behind
set object 3 rectangle from graph 0, first -5500 to graph 1, first -4000 fc rgb '#f6d5cc' fs noborder behind

set terminal svg size 980,1000 font 'sans,12' noenhanced background rgb 'white'
set output out . '/homing_super40nc.svg'
set multiplot layout 4,4
do for [mode=0:12] {
  set title sprintf('mode %d', mode) offset 0,-0.5
  plot file('homing_super40nc') index mode using 1:2 with lines ls 1
}
unset multiplot

set terminal svg size 980,300 font 'sans,12' noenhanced background rgb 'white'
set output out . '/homing_others.svg'
array who[4] = ['RS-M8194H, steps + + - +', 'Simple2-R3, positive first', 'Simple2-R3, negative first', 'SLIM']
set multiplot layout 1,4
do for [i=1:4] {
  set title who[i] offset 0,-0.5
  plot file('homing_others') index i-1 using 1:2 with lines ls 1
}
unset multiplot
