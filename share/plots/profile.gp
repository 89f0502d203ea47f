# profile.png: light against height, for one result or several, with field data.
#   gnuplot profile.gp > profile.png
# reads profile.csv in the current folder. The program sets these variables before it loads this file:
if (!exists("tables")) array tables[1] = ['profile.csv']  # the program's own result, then those to compare it with;
# the array `titles` names them; by default they keep their own titles
if (!exists("band")) band = 'PAR'
if (!exists("measured")) measured = ''    # name of the field data; then $measured is a table of sunfleck ratio and height
if (!exists("agreement")) agreement = ''  # how well the first result agrees with them

folder = ''
do for [i = strlen(ARG0):1:-1] { if (folder eq '' && ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder . 'style.gp'

# The tables: the columns of each, the names and the extent of all.
n = |tables|
array name[n]; array ratio[n]; array absorbed[n]
lowest = 0.0; highest = 0.0; most = 0.0; beam = 0; light = 0; confidence = NaN; same = 1
top = NaN; now = NaN; half = NaN; middle = NaN; error = NaN
half_width(column) = valid(column) ? column(column) : 0.0
# The absorbed flux of the layer below this row per metre, so that layers of different thickness can be compared; its middle and
# half-width are `middle` and `error`.
layer(height, value, its_half) = (thickness = height - top, middle = 0.5 * (height + top), error = half / thickness, \
  flux = now / thickness, top = height, now = value, half = its_half, thickness > 0 ? flux : NaN)
row(k) = layer(column(1), valid(k) ? column(k) : NaN, half_width(k + 1))
do for [i = 1:n] {
  table = tables[i]
  load folder . 'table.gp'
  name[i] = cut(exists("titles") ? titles[i] : table_title, 84)
  ratio[i] = column_of('sunfleck_ratio')
  absorbed[i] = column_of(band . '_absorbed')
  its_confidence = number(past('confidence ', after('seed ')))
  if (i == 1) { confidence = its_confidence } else { same = same && confidence == its_confidence }
  stats table using 1:(valid(ratio[i]) ? beam = beam + 1 : 0) name 'HEIGHT' nooutput
  lowest = HEIGHT_min_x < lowest ? HEIGHT_min_x : lowest
  highest = HEIGHT_max_x > highest ? HEIGHT_max_x : highest
  if (absorbed[i] > 0) {
    top = NaN
    stats table using (flux_here = row(absorbed[i]), flux_here == flux_here ? light = light + 1 : 0, \
      most = flux_here + error > most ? flux_here + error : most, 0) nooutput
  }
}
if (measured ne '') {
  stats $measured using 2 name 'HEIGHT' nooutput
  highest = HEIGHT_max > highest ? HEIGHT_max : highest
}
if (measured eq '') { set print $measured; print 'sunfleck_ratio,height_m'; unset print }
legend = n > 1 || measured ne '' ? n + (measured ne '') : 0

width = 1600.0; height = 1000.0
set terminal pngcairo noenhanced size width,height font font . ',20' linewidth 2 background '#ffffff'
set multiplot
set label 1 cut(name[1], 84) at screen 0.5,(1 - 40 / height) center font ',25' textcolor '#101010'
note = (same && confidence > 0 ? sprintf('Bars: %g %% confidence intervals', 100 * confidence) : 'Bars: confidence intervals')
set label 2 (agreement eq '' ? '' : 'Agreement with field data: ' . agreement . '   ·   ') . note \
  at screen 0.5,(1 - 82 / height) center font ',18' textcolor '#101010'
set bmargin at screen 125 / height
set tmargin at screen 1 - (120 + 31 * legend) / height
set yrange [lowest:positive(lowest + 1.05 * (highest - lowest), lowest + 1)]
do for [i = 1:n] {
  dash = 1 + (i - 1) / 6
  set style line i linecolor rgb colour[(i - 1) % 6 + 1] pointtype shape[(i - 1) % 6 + 1] pointsize 1.2 linewidth 1.1 dashtype dash
}
set style line 100 linecolor rgb '#000000' pointtype 6 pointsize 1.7 linewidth 1.6

set lmargin at screen 140 / width
set rmargin at screen 820 / width
set ylabel 'Height (m)' offset 0.5,0
set xlabel 'Sunfleck ratio (share of the plane in direct sun)' offset 0,0.2
set xrange [0:1.02]  # keeps points at 1 clear of the border
set xtics 0.2
if (beam == 0) { set label 3 'no direct beam' at graph 0.5,0.5 center }
if (legend > 0) { set key at screen 140 / width,(1 - 105 / height) left top maxcols 1 Left reverse samplen 2 font ',19' }
plot for [i = 1:n] tables[i] using (valid(ratio[i]) ? column(ratio[i]) : NaN):1:(half_width(ratio[i] + 1)) \
    with xerrorlines linestyle i notitle, \
  for [i = 1:(legend > 0 ? n : 0)] keyentry with linespoints linestyle i title name[i], \
  for [i = 1:(measured ne '')] $measured using 1:2 with points linestyle 100 title cut('measured: ' . measured, 84)

unset key; unset label; unset ylabel
set lmargin at screen 870 / width
set rmargin at screen 1550 / width
set format y ''
set xlabel 'Absorbed ' . band . ' (W m⁻² of ground per m of height)' offset 0,0.2
set xrange [0:1.05 * positive(most, 1)]
set xtics autofreq
if (light == 0) { set label 3 'no light of this band' at graph 0.5,0.5 center }
plot NaN notitle, for [i = 1:n] tables[i] using (top = $0 == 0 ? NaN : top, absorbed[i] > 0 ? row(absorbed[i]) : NaN):(middle):(error) \
  with xerrorlines linestyle i notitle
unset multiplot
