# profile.png: sunfleck ratio, sunlit share of the leaves and absorbed light against height, for one result or several, with field
# data. A panel with nothing to show leaves its room to the others.
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
array name[n]; array ratio[n]; array sunlit[n]; array absorbed[n]
lowest = 0.0; highest = 0.0; most = 0.0; confidence = NaN; same = 1
array points[3] = [0, 0, 0]  # of each panel
top = NaN; now = NaN; half = NaN; middle = NaN; error = NaN
has(column) = column > 0 && valid(column)
cell(column) = has(column) ? column(column) : NaN
half_width(column) = valid(column) ? column(column) : 0.0
# The value of the layer below this row, whose own value is kept for the next; `middle` and `error` are that layer's middle and
# half-width. What is absorbed is taken per metre, so that layers of different thickness can be compared.
layer(height, value, its_half, per_metre) = (thickness = height - top, middle = 0.5 * (height + top), \
  divisor = per_metre ? thickness : 1.0, error = half / divisor, below = now / divisor, top = height, now = value, half = its_half, \
  thickness > 0 ? below : NaN)
# The point of a panel: the sunfleck ratio of a plane, the sunlit share or the absorbed flux of a layer.
plane(k) = (middle = column(1), error = half_width(k + 1), cell(k))
point(panel, i) = (top = $0 == 0 ? NaN : top, panel == 1 ? plane(ratio[i]) \
  : panel == 2 ? layer(column(1), cell(sunlit[i]), half_width(sunlit[i] + 1), 0) \
  : layer(column(1), cell(absorbed[i]), half_width(absorbed[i] + 1), 1))
do for [i = 1:n] {
  table = tables[i]
  load folder . 'table.gp'
  name[i] = cut(exists("titles") ? titles[i] : table_title, 84)
  ratio[i] = column_of('sunfleck_ratio')
  sunlit[i] = column_of('sunlit_leaf_fraction')
  absorbed[i] = column_of(band . '_absorbed')
  its_confidence = number(past('confidence ', after('seed ')))
  if (i == 1) { confidence = its_confidence } else { same = same && confidence == its_confidence }
  stats table using 1 name 'HEIGHT' nooutput
  lowest = HEIGHT_min < lowest ? HEIGHT_min : lowest
  highest = HEIGHT_max > highest ? HEIGHT_max : highest
  do for [panel = 1:3] {
    count = 0
    stats table using (here = point(panel, i), here == here ? count = count + 1 : 0, \
      panel == 3 && here + error > most ? most = here + error : 0, 0) nooutput
    points[panel] = points[panel] + count
  }
}
if (measured ne '') {
  stats $measured using 2 name 'HEIGHT' nooutput
  highest = HEIGHT_max > highest ? HEIGHT_max : highest
}
if (measured eq '') { set print $measured; print 'sunfleck_ratio,height_m'; unset print }
legend = n > 1 || measured ne '' ? n + (measured ne '') : 0

# A step of 1, 2 or 5 times a power of ten of which a range has six at most, so that their numbers do not touch.
few(range) = (power = 10.0 ** floor(log10(range / 6)), steps = range / 6 / power, power * (steps <= 1 ? 1 : steps <= 2 ? 2 : steps <= 5 ? 5 : 10))

# The panels with something to show share the room.
array shown[3]
shown[1] = points[1] > 0 || measured ne ''
shown[2] = points[2] > 0
shown[3] = points[3] > 0 || !(shown[1] || shown[2])
panels = shown[1] + shown[2] + shown[3]
array axis[3] = ["Sunfleck ratio\n(share of the plane in direct sun)", "Sunlit leaf fraction\n(share of leaf area in direct sun)", \
  'Absorbed ' . band . "\n(W m⁻² of ground per m of height)"]

width = 1600.0; height = 1000.0
set terminal pngcairo noenhanced size width,height font font . ',20' linewidth 2 background '#ffffff'
set multiplot
set label 1 cut(name[1], 84) at screen 0.5,(1 - 40 / height) center font ',25' textcolor '#101010'
note = (same && confidence > 0 ? sprintf('Bars: %g %% confidence intervals', 100 * confidence) : 'Bars: confidence intervals')
if (points[1] == 0) { note = 'No direct beam   ·   ' . note }
set label 2 (agreement eq '' ? '' : 'Agreement with field data: ' . agreement . '   ·   ') . note \
  at screen 0.5,(1 - 82 / height) center font ',18' textcolor '#101010'
set bmargin at screen 150 / height
set tmargin at screen 1 - (120 + 31 * legend) / height
set yrange [lowest:positive(lowest + 1.05 * (highest - lowest), lowest + 1)]
do for [i = 1:n] {
  dash = 1 + (i - 1) / 6
  set style line i linecolor rgb colour[(i - 1) % 6 + 1] pointtype shape[(i - 1) % 6 + 1] pointsize 1.2 linewidth 1.1 dashtype dash
}
set style line 100 linecolor rgb '#000000' pointtype 6 pointsize 1.7 linewidth 1.6

set ylabel 'Height (m)' offset 0.5,0
if (legend > 0) { set key at screen 140 / width,(1 - 105 / height) left top maxcols 1 Left reverse samplen 2 font ',19' }
slot = (1410 - 50 * (panels - 1)) / panels
left = 140
do for [panel = 1:3] {
  if (shown[panel]) {
    set lmargin at screen left / width
    set rmargin at screen (left + slot) / width
    set xlabel axis[panel] offset 0,0.2
    if (panel < 3) {
      set xrange [0:1.02]  # keeps points at 1 clear of the border
      set xtics 0.2
    } else {
      set xrange [0:1.05 * positive(most, 1)]
      set xtics few(1.05 * positive(most, 1))
    }
    if (points[panel] == 0) { set label 3 panel < 3 ? 'no direct beam' : 'no light of this band' at graph 0.5,0.5 center }
    plot NaN notitle, \
      for [i = 1:n] tables[i] using (point(panel, i)):(middle):(error) with xerrorlines linestyle i notitle, \
      for [i = 1:(left == 140 && legend > 0 ? n : 0)] keyentry with linespoints linestyle i title name[i], \
      for [i = 1:(panel == 1 && measured ne '')] $measured using 1:2 with points linestyle 100 title cut('measured: ' . measured, 84)
    unset key; unset label; unset ylabel
    set format y ''
    left = left + slot + 50
  }
}
unset multiplot
