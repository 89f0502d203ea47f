# day.png: the course of light over one or several days, in one band.
#   gnuplot day.gp > day.png
# reads day.csv in the current folder. The program sets these variables before it loads this file:
if (!exists("table")) table = 'day.csv'
if (!exists("band")) band = 'PAR'

folder = ''
do for [i = strlen(ARG0):1:-1] { if (folder eq '' && ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder . 'style.gp'
load folder . 'table.gp'
if (!exists("title")) title = table_title

array quantity[4] = ['incident', 'absorbed_vegetation', 'absorbed_soil', 'reflected']
array label[5] = ['incident', 'absorbed by vegetation', 'absorbed by soil', 'reflected', 'absorbed by structures']
array line[4] = ['#000000', '#009E73', '#D55E00', '#0072B2']
array k[4]
do for [c = 1:4] { k[c] = column_of(band . '_' . quantity[c]) }
sunlit = column_of('sunlit_leaf_fraction')
structure = column_of(band . '_absorbed_structure')
elevation = column_of('elevation_deg')

# The middle of a step on the local clock, which ignores the offset after the time; it notes the extent of the steps.
start(time) = strptime('%Y-%m-%dT%H:%M:%S', time[1:19])
begin = NaN; end = NaN; most = 0.0; steps = 0; structures = 0
cell(c) = valid(c) ? column(c) : NaN
half_width(c) = valid(c) ? column(c) : 0.0
high(c) = cell(c) + half_width(c + 1)
raise(c) = high(c) > most ? most = high(c) : 0
meet(c) = c > 0 && valid(c) && column(c) > 0 ? structures = 1 : 0
stats table using (begin = begin == begin ? begin : start(strcol(1)), end = start(strcol(1)) + column(2), steps = steps + 1, \
  raise(k[1]) + raise(k[2]) + raise(k[3]) + raise(k[4]), meet(structure)) nooutput
if (!(end > begin)) { end = begin + 60 }

# The steps as columns of middle, then value, low and high end of each quantity, then 0 and 1 in turn for each stretch of steps
# without a gap, then the interval of structures. The stretches of either number are drawn as one curve, which the other number's
# interrupt.
last = begin; stretch = 0
stretch_of(start, length) = (stretch = start > last + 0.5 ? 1 - stretch : stretch, last = start + length, stretch)
interval(c, shown) = shown && valid(c) ? sprintf('%.9g %.9g %.9g ', column(c), column(c) - half_width(c + 1), high(c)) : 'NaN NaN NaN '
set table $steps
plot table using (sprintf('%.1f ', start(strcol(1)) + 0.5 * column(2)) . interval(k[1], 1) . interval(k[2], 1) . interval(k[3], 1) \
  . interval(k[4], 1) . interval(sunlit, column(elevation) > 0) . sprintf('%d ', stretch_of(start(strcol(1)), column(2))) \
  . interval(structures ? structure : k[1], structures)) with table
unset table
drawn(c, s) = column(17) == s ? column(c) : NaN
set datafile separator whitespace
unset datafile columnheaders

several = end - begin > 86400
if (several) { begin = 86400 * floor(begin / 86400); end = 86400 * ceil(end / 86400) }
first_date = strftime('%Y-%m-%d', begin); last_date = strftime('%Y-%m-%d', end - 1)

width = 1600.0; height = 1100.0
set terminal pngcairo noenhanced size width,height font font . ',20' linewidth 2 background '#ffffff'
set multiplot
set lmargin at screen 150 / width
set rmargin at screen 1510 / width
set xdata time
set timefmt '%s'
set xrange [begin:end]
if (several) { set xtics begin,86400 * ceil(0.13 * (end - begin) / 86400) }
do for [c = 1:4] { set style line c linecolor rgb line[c] linewidth 1.4 dashtype c pointtype 7 pointsize 0.7 }
set style line 5 linecolor rgb '#7F7F7F' linewidth 1.4 pointtype 7 pointsize 0.7
set style line 6 linecolor rgb '#D55E00' linewidth 1.4 pointtype 7 pointsize 0.7
set style fill transparent solid 0.3 noborder
mark = steps > 48 ? -1 : 7  # many steps are drawn as lines
do for [c = 1:6] { set style line c pointtype mark }

set label 1 cut(title, 84) at screen 0.5,(1 - 40 / height) center font ',25' textcolor '#101010'
set label 2 sprintf('Shaded: %g %% confidence intervals', 100 * number(past('confidence ', after('seed ')))) \
  at screen 0.5,(1 - 82 / height) center font ',18' textcolor '#101010'
set bmargin at screen 440 / height
set tmargin at screen 925 / height
set label 3 band . ' (W m⁻² of ground)' at screen 50 / width,682.5 / height center rotate by 90
set format x ''
set yrange [0:positive(1.08 * most, 1)]
set key at screen 150 / width,(1 - 104 / height) left top horizontal maxcols 2 + structures Left reverse samplen 2 font ',19'
plot for [c = 1:4] for [s = 0:1] $steps using 1:(drawn(3 * c, s)):(drawn(3 * c + 1, s)) with filledcurves linecolor rgb line[c] notitle, \
  for [c = 1:4] for [s = 0:1] $steps using 1:(drawn(3 * c - 1, s)) with linespoints linestyle c notitle, \
  for [s = 0:2 * structures - 1] $steps using 1:(drawn(19, s)):(drawn(20, s)) with filledcurves linecolor rgb '#7F7F7F' notitle, \
  for [s = 0:2 * structures - 1] $steps using 1:(drawn(18, s)) with linespoints linestyle 5 notitle, \
  for [c = 1:4 + structures] keyentry with linespoints linestyle c title label[c]

unset key; unset label
set bmargin at screen 125 / height
set tmargin at screen 390 / height
set format x (several ? '%Y-%m-%d' : '%H:%M')
set yrange [0:1]
set ytics 0.25
set label 3 'Sunlit leaf fraction' at screen 50 / width,257.5 / height center rotate by 90
set xlabel first_date eq last_date ? 'Local time, ' . first_date : 'Local time' offset 0,0.2
plot for [s = 0:1] $steps using 1:(drawn(15, s)):(drawn(16, s)) with filledcurves linecolor rgb '#D55E00' notitle, \
  for [s = 0:1] $steps using 1:(drawn(14, s)) with linespoints linestyle 6 notitle
unset multiplot
