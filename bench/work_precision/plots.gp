# Draws rows, a file of lines of kte_work_precision, into the folder out:
#   gnuplot -e "rows='...'; long_time='...'; out='...'" plots.gp
set encoding utf8
set datafile missing "-"
selected(problem, method, cost) = sprintf("< awk '$1 == \"%s\" && $2 == \"%s\" && $4 != \"failed\" && $4 < 3 { print $%d, ($4 > 1e-17 ? $4 : 1e-17) }' %s", problem, method, cost, rows)
present(condition, column) = system(sprintf("awk '%s && !seen[$%d]++ { printf \"%%s \", $%d }' %s", condition, column, column, rows))

# Every method has a colour and a mark of its own. Explicit, adaptive: blue and green; stiff: orange to brown; fixed
# steps: grey, black and green; those that keep something: violet.
methods = "dormand_prince45 prince_dormand87 adams rosenbrock23 rodas tr_bdf2 trapezoidal ".\
          "kennedy_carpenter34 bdf euler midpoint runge_kutta4 runge_kutta5 adams_BM3 adams_BM5 semi_implicit_euler ".\
          "stormer_verlet implicit_midpoint variational2 variational4 dormand_prince45/quaternions adams/quaternions mujoco_RK4"
colours = "#0072b2 #1b3a93 #009e73 #e69f00 #d55e00 #f0a58f #c9a37a #a6501a #8b0000 #cccccc #aaaaaa #222222 ".\
          "#666666 #66c2a5 #117733 #e7b5d9 #cc79a7 #b565d9 #882255 #5e2a84 #44aa99 #999933 #ff0000"
marks = "7 5 9 4 5 6 8 9 7 1 2 7 5 10 11 1 2 6 8 9 13 12 3"
at(name) = strstrt(" ".methods." ", " ".name." ")
place(name) = (at(name) > 0 ? words(substr(methods, 1, at(name) - 1)) + 1 : 1)
colour(name) = word(colours, place(name))
mark(name) = int(word(marks, place(name)))
set grid lc rgb "#dddddd"

# What the error of a problem is of, with its unit.
error(p) = p eq "iiwa14" ? "error of the tool, m" : p eq "flyball_governor" ? "error of the slider, m" : \
           p eq "dzhanibekov" ? "error of the rotation matrix" : \
           strstrt(" hires vdpol orego rober ", " ".p." ") > 0 ? "largest relative error" : "largest error, SI units"

set terminal svg size 1200,520 font "sans-serif,11" background rgb "white"
set logscale xy
set format xy "1e%T"
set yrange [1e-16:3]
unset mxtics
unset mytics
do for [p in present("NF >= 13", 1)] {
  set output out."/".p.".svg"
  set multiplot title p noenhanced
  shown = present(sprintf("$1 == \"%s\" && $4 != \"failed\" && $4 < 3", p), 2)
  do for [panel = 1:2] {
    set origin (panel - 1) * 0.4, 0
    set size (panel == 1 ? 0.4 : 0.6), 0.95
    set lmargin at screen (panel == 1 ? 0.05 : 0.46)
    set rmargin at screen (panel == 1 ? 0.40 : 0.81)
    set xlabel (panel == 1 ? "CPU time, s" : "evaluations")
    if (panel == 1) { set label 1 error(p) at screen 0.01, 0.51 center rotate by 90 } else { unset label 1 }
    if (panel == 1) { unset key } else { set key at screen 0.98, 0.93 right top vertical noenhanced samplen 1.5 spacing 0.95 }
    plot for [m in shown] selected(p, m, panel == 1 ? 5 : 6) using 1:2 \
      with linespoints pt mark(m) ps 0.5 lw 1.3 lc rgb colour(m) title m
  }
  unset multiplot
}

# Energy of a pendulum over many steps.
set terminal svg size 800,420 font "sans-serif,11" background rgb "white"
set output out."/long_time.svg"
unset logscale
set logscale y
set origin 0, 0
set size 1, 1
set lmargin at screen 0.1
set rmargin at screen 0.72
set format x "%g"
set yrange [*:*]
set xlabel "tenth of 1e6 steps"
set ylabel "largest energy error, J"
set key at screen 0.99, 0.93 right top vertical noenhanced
plot for [m in system(sprintf("awk '!seen[$1]++ { printf \"%%s \", $1 }' %s", long_time))] \
  sprintf("< awk '$1 == \"%s\"' %s", m, long_time) using 2:3 with linespoints pt mark(m) ps 0.5 lw 1.3 lc rgb colour(m) title m
