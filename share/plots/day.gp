# day.png: the course of light over one or several days, or the daily sums of more than seven, in one band. A panel with nothing to
# show leaves its room to the other.
#   gnuplot day.gp > day.png
# reads day.csv in the current folder, and for sums day_sums.csv. The program sets these variables before it loads this file:
if (!exists("table")) table = 'day.csv'
if (!exists("sums")) sums = 'day_sums.csv'
if (!exists("band")) band = 'PAR'

folder = ''
do for [i = strlen(ARG0):1:-1] { if (folder eq '' && ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder . 'style.gp'
load folder . 'table.gp'
if (!exists("title")) title = table_title

array quantity[5] = ['incident', 'absorbed_vegetation', 'absorbed_soil', 'reflected', 'absorbed_structure']
array label[5] = ['incident', 'absorbed by vegetation', 'absorbed by soil', 'reflected', 'absorbed by structures']
array line[6] = ['#000000', '#009E73', '#D55E00', '#0072B2', '#7F7F7F', '#D55E00']
array k[6]  # the columns of these quantities and of the sunlit leaf fraction
do for [c = 1:5] { k[c] = column_of(band . '_' . quantity[c]) }
k[6] = column_of('sunlit_leaf_fraction')
if (k[1] == 0) { print no_column_of_this_band }

# The extent of the steps on the local clock, which ignores the offset after the time.
start(time) = strptime('%Y-%m-%dT%H:%M:%S', time[1:19])
begin = NaN; end = NaN; steps = 0; structures = 0; lit = 0
cell(c) = c > 0 && valid(c) ? column(c) : NaN
amount(c) = cell(k[c])
half_width(c) = k[c] > 0 ? cell(k[c] + 1) : NaN
stats table using (begin = begin == begin ? begin : start(strcol(1)), end = start(strcol(1)) + column(2), steps = steps + 1, \
  amount(5) > 0 ? structures = 1 : 0, amount(6) == amount(6) ? lit = 1 : 0) nooutput
if (!(end > begin)) { end = begin + 60 }
date_of(time) = 0 + floor(time / 86400) - floor(begin / 86400) + 1
dates = date_of(end - 1)
several = end - begin > 86400
season = dates > 7
stopped = after('incomplete: ')
confidence = number(past('confidence ', after('seed ')))

# The points in time, each a line of its middle, then the value, the low and the high end of each quantity, then 0 and 1 in turn for each stretch
# of them without a gap. The stretches of either number are drawn as one curve, which the other number's interrupt.
most = 0.0; last = begin; stretch = 0
stretch_of(from, length) = (stretch = from > last + 0.5 ? 1 - stretch : stretch, last = from + length, stretch)
raise(c, high) = c < 6 && high > most ? most = high : 0
interval(c, mean, half) = (half = half == half ? half : 0.0, raise(c, mean + half), \
  sprintf('%.9g %.9g %.9g ', mean, mean - half, mean + half))
photons = NaN
if (season) {
  # The sunlit leaf fraction is its mean over the steps of a date that have one; their half-widths are added in quadrature.
  array sunlit[dates]; array squares[dates]; array seconds[dates]
  do for [d = 1:dates] { sunlit[d] = 0.0; squares[d] = 0.0; seconds[d] = 0.0 }
  add(d, share, half, length) = share == share ? (sunlit[d] = sunlit[d] + length * share, seconds[d] = seconds[d] + length, \
    squares[d] = squares[d] + (length * half) ** 2) : 0
  stats table using (add(date_of(start(strcol(1))), amount(6), half_width(6), column(2)), 0) nooutput
  table = sums
  load folder . 'table.gp'
  do for [c = 1:5] { k[c] = column_of(band . '_' . quantity[c] . '_mj_m2') }
  mol = column_of(band . '_incident_mol_m2')
  if (mol > 0) { stats table using (cell(k[1]) > 0 && cell(mol) > 0 ? photons = column(mol) / column(k[1]) : 0, 0) nooutput }  # mol MJ-1
  midnight(date) = strptime('%Y-%m-%d', date)
  mean(d) = seconds[d] > 0 ? interval(6, sunlit[d] / seconds[d], sqrt(squares[d]) / seconds[d]) : interval(6, NaN, NaN)
  set table $points
  plot table using (sprintf('%.1f ', midnight(strcol(1)) + 43200) . interval(1, cell(k[1]), half_width(1)) \
    . interval(2, cell(k[2]), half_width(2)) . interval(3, cell(k[3]), half_width(3)) . interval(4, cell(k[4]), half_width(4)) \
    . interval(5, cell(k[5]), half_width(5)) . mean(date_of(midnight(strcol(1)))) \
    . sprintf('%d', stretch_of(midnight(strcol(1)), 86400))) with table
  unset table
} else {
  set table $points
  plot table using (sprintf('%.1f ', start(strcol(1)) + 0.5 * column(2)) . interval(1, amount(1), half_width(1)) \
    . interval(2, amount(2), half_width(2)) . interval(3, amount(3), half_width(3)) . interval(4, amount(4), half_width(4)) \
    . interval(5, amount(5), half_width(5)) . interval(6, amount(6), half_width(6)) \
    . sprintf('%d', stretch_of(start(strcol(1)), column(2)))) with table
  unset table
}
drawn(c, s) = column(20) == s ? column(c) : NaN

twofold = season && photons == photons
set datafile separator whitespace
unset datafile columnheaders

if (several) { begin = 86400 * floor(begin / 86400); end = 86400 * ceil(end / 86400) }
first_date = strftime('%Y-%m-%d', begin); last_date = strftime('%Y-%m-%d', end - 1)

width = 1600.0; height = 1100.0
set terminal pngcairo noenhanced size width,height font font . ',20' linewidth 2 background '#ffffff'
set multiplot
set lmargin at screen 150 / width
set rmargin at screen (twofold ? 1440 : 1510) / width
set xdata time
set timefmt '%s'
set xrange [begin:end]
apart = ceil(0.13 * (end - begin) / 86400)
if (season) {
  set xtics (begin + 43200)  # below its point; gnuplot would round steps of weeks to months
  do for [d = 1:dates - 1] {
    if (d % apart == 0) { set xtics add (begin + 86400 * d + 43200) } else { if (apart < 10) { set xtics add ('' begin + 86400 * d + 43200 1) } }
  }
} else {
  if (several) { set xtics begin,86400 * apart }
}
mark = !season && steps > 48 ? -1 : 7  # many steps are drawn as lines,
size = season && dates > 60 ? 0.4 : 0.7  # and many dates as small points
do for [c = 1:6] {
  dash = c < 5 ? c : 1
  set style line c linecolor rgb line[c] linewidth 1.4 dashtype dash pointtype mark pointsize size
}
set style fill transparent solid 0.3 noborder
drawing_time = season ? 'Local date' : first_date eq last_date ? 'Local time, ' . first_date : 'Local time'
time_format = several ? '%Y-%m-%d' : '%H:%M'

set label 1 cut(title, 84) at screen 0.5,(1 - 40 / height) center font ',25' textcolor '#101010'
set label 2 (season ? 'Daily sums' . (lit ? ', mean sunlit fraction' : '') . '   ·   ' : '') . (stopped eq '' ? '' : 'Incomplete: ' . stopped . '   ·   ') \
  . sprintf('Shaded: %g %% confidence intervals', 100 * confidence) \
  at screen 0.5,(1 - 82 / height) center font ',18' textcolor '#101010'
bottom = lit ? 440 : 125
set bmargin at screen bottom / height
set tmargin at screen 925 / height
middle = 0.5 * (bottom + 925)
set label 3 band . (season ? ' (MJ m⁻² d⁻¹ of ground)' : ' (W m⁻² of ground)') at screen 50 / width,middle / height center rotate by 90
set format x (lit ? '' : time_format)
if (!lit) { set xlabel drawing_time offset 0,0.2 }
top = positive(1.08 * most, 1)
set yrange [0:top]
if (twofold) {
  set label 4 band . ' (mol m⁻² d⁻¹ of ground)' at screen 1560 / width,middle / height center rotate by 90
  set ytics nomirror
  set y2range [0:photons * top]
  set y2tics
}
set key at screen 150 / width,(1 - 104 / height) left top horizontal maxcols 2 + structures Left reverse samplen 2 font ',19'
plot for [c = 1:4 + structures] for [s = 0:1] $points using 1:(drawn(3 * c, s)):(drawn(3 * c + 1, s)) with filledcurves linecolor rgb line[c] notitle, \
  for [c = 1:4 + structures] for [s = 0:1] $points using 1:(drawn(3 * c - 1, s)) with linespoints linestyle c notitle, \
  for [c = 1:4 + structures] keyentry with linespoints linestyle c title label[c]

if (lit) {
  unset key; unset label; unset y2tics
  set bmargin at screen 125 / height
  set tmargin at screen 390 / height
  set format x time_format
  set yrange [0:1]
  set ytics mirror 0.25
  set label 3 'Sunlit leaf fraction' at screen 50 / width,257.5 / height center rotate by 90
  set xlabel drawing_time offset 0,0.2
  plot for [s = 0:1] $points using 1:(drawn(18, s)):(drawn(19, s)) with filledcurves linecolor rgb line[6] notitle, \
    for [s = 0:1] $points using 1:(drawn(17, s)) with linespoints linestyle 6 notitle
}
unset multiplot
