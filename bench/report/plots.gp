# Draws numbers, a file of lines "operation how model ns error", into the folder out:
#   gnuplot -e "numbers='...'; here='bench/report'; out='...'" plots.gp
set encoding utf8
set datafile missing "?"
rows(condition, columns) = sprintf("< awk '%s { print %s }' %s", condition, columns, numbers)
of(operation, model) = sprintf('$1 == "%s" && $3 ~ /^%s/', operation, model)
present(condition) = system(sprintf("awk '%s && !seen[$2]++ { printf \"%%s \", $2 }' %s", condition, numbers))

# Every way to evaluate has a colour and a mark of its own.
ways = "static runtime straightline straightline_aba batch8 batch16_float float long_double kdl bullet mujoco dart ".\
       "pack8 pack16 pack16_float"
colours = "#0072b2 #d55e00 #222222 #888888 #009e73 #66c2a5 #56b4e9 #1b3a93 #cc79a7 #e69f00 #882255 #999933 ".\
          "#117733 #44aa99 #88ccee"
marks = "7 5 9 11 13 13 7 7 1 2 3 8 12 14 12"
at(way) = strstrt(" ".ways." ", " ".way." ")
place(way) = (at(way) > 0 ? words(substr(ways, 1, at(way) - 1)) + 1 : 1)
colour(way) = word(colours, place(way))
mark(way) = int(word(marks, place(way)))
set grid lc rgb "#dddddd"

# Time against error of the iiwa14.
set terminal svg size 1200,1300 font "sans-serif,11" background rgb "white"
set output out."/error.svg"
set logscale xy
set format y "1e%T"
set xrange [5:20000]
set yrange [1e-20:1e-5]
set multiplot layout 4,3 title "iiwa14: nanoseconds a state against error"
unset key
do for [o in "inverse_dynamics nonlinear_effects mass_matrix forward_dynamics forward_kinematics jacobian ".\
             "mass_matrix_inverse id_derivatives fd_derivatives"] {
  set title o noenhanced
  plot for [w in present(of(o, "iiwa14"))] \
    rows(of(o, "iiwa14").' && $2 == "'.w.'"', '$4, $5') using 1:2 with points pt mark(w) ps 0.9 lc rgb colour(w)
}
set key left top noenhanced samplen 1
unset title
unset border
unset tics
plot for [w in ways] NaN with points pt mark(w) ps 0.9 lc rgb colour(w) title w
unset multiplot
set border
set tics

# The ways side by side.
set terminal svg size 1200,500 font "sans-serif,11" background rgb "white"
set output out."/ways.svg"
unset logscale
set logscale y
set format y "%g"
set xrange [*:*]
set yrange [5:20000]
set ylabel "ns a state"
set title "iiwa14"
set key top left horizontal noenhanced
set style data histogram
set style histogram clustered gap 1
set style fill solid 0.9 noborder
set boxwidth 0.95
set xtics noenhanced
plot for [w in "static runtime straightline batch8 batch16_float float kdl bullet mujoco dart"] \
  sprintf("< awk -v way=%s -v model=iiwa14 -f %s/way.awk %s", w, here, numbers) using 2:xtic(1) title w lc rgb colour(w)

# Growth with the number of bodies.
set terminal svg size 1200,480 font "sans-serif,11" background rgb "white"
set output out."/growth.svg"
set logscale xy
set xrange [0.8:1300]
set yrange [1:2e7]
set xtics 1,4,1024
set xlabel "bodies"
set multiplot layout 1,3 title "Serial chains: time by the number of bodies"
do for [o in "inverse_dynamics mass_matrix forward_dynamics"] {
  set title o noenhanced
  set key top left vertical noenhanced
  plot for [w in present(of(o, "serial"))] \
    rows(of(o, "serial").' && $2 == "'.w.'"', 'substr($3, 7), $4').' | sort -n' using 1:2 \
    with linespoints pt mark(w) ps 0.6 lc rgb colour(w) title w
}
unset multiplot
