# The table of targets: awk -f rows.awk -f targets.awk rows long_time overhead
NF == 3 && FILENAME ~ /long_time/ {
  if ($2 == 1) first[$1] = $3
  tenth[$1, $2] = $3
}
NF == 5 && FILENAME ~ /overhead/ { overhead[$1] = $5 }
function row(what, measured, digits, most, direction, verdict) {
  if (measured == "") {
    printf "| %s | not measured | %s %s | |\n", what, direction, most
    return
  }
  verdict = direction == "at most" ? measured + 0 <= most + 0 : measured + 0 >= most + 0
  verdict = verdict ? "met" : sprintf("**missed**, by a factor of %.2g", measured > most ? measured / most : most / measured)
  printf "| %s | " digits " | %s %s | %s |\n", what, measured, direction, most, verdict
}
# The least cost to an error among methods that are (or are not) fixed, or stiff; `who` is which.
function best(problem, e, of, kind, names, name, m, c, least) {
  names = split(methods[problem], name)
  least = who = ""
  for (m = 1; m <= names; ++m) {
    if (name[m] ~ /mujoco/ || (kind == "adaptive" && fixed(name[m])) || (kind == "stiff" && !stiff(name[m]))) continue
    c = cost_to(problem " " name[m], e, of)
    if (c != "" && (least == "" || c < least)) {
      least = c
      who = name[m]
    }
  }
  return least
}
# The least error of stiff methods at a tolerance.
function best_error(problem, s, names, name, m, i, least) {
  names = split(methods[problem], name)
  least = who = ""
  for (m = 1; m <= names; ++m) {
    i = index_of(problem " " name[m], s)
    if (i && !failed[problem " " name[m], i] && stiff(name[m]) && (least == "" || error[problem " " name[m], i] < least)) {
      least = error[problem " " name[m], i]
      who = name[m]
    }
  }
  return least
}
function least_error(problem, kind, names, name, m, e, least) {
  names = split(methods[problem], name)
  least = who = ""
  for (m = 1; m <= names; ++m) {
    if (name[m] ~ /mujoco/ || (kind == "group" && name[m] ~ /\//)) continue
    e = floor_of(problem " " name[m])
    if (least == "" || e < least) {
      least = e
      who = name[m]
    }
  }
  return least
}
function code(name) { return name == "" ? "" : ", `" name "`" }
END {
  print "| | measured | | |"
  print "|-|-|-|-|"
  t = best("pendulum", 1e-10, "time", "adaptive")
  row("pendulum, 50 s to 1e-10, best adaptive integrator" code(who) ", ms", t == "" ? "" : t * 1e3, "%.3g", 1, "at most")
  key = "pendulum dormand_prince45"
  i = index_of(key, 1e-6)
  row("pendulum, 50 s, `dormand_prince45` with tolerance 1e-6, evaluations", i ? cost[key, "evaluations", i] : "", "%d", 5000, "at most")
  other = cost_to("iiwa14 mujoco_RK4", 1e-6, "time")
  t = best("iiwa14", 1e-6, "time", "")
  row("iiwa14, tool to 1e-6 m, MuJoCo's RK4 : best" code(who) ", CPU time", other == "" || t == "" ? "" : other / t, "%.1f", 20, "at least")
  key = "dzhanibekov runge_kutta4"
  row("Dzhanibekov, 100 s, `runge_kutta4`, order", key in count ? order_of(key) : "", "%.2f", 3.9, "at least")
  row("the same, least error of the attitude", key in count ? floor_of(key) : "", "%.1e", 1e-11, "at most")
  row("the same, change of the angular momentum in the world at the finest step", key in count ? momentum[key, count[key]] : "", "%.1e", 1e-13, "at most")
  e = least_error("dzhanibekov", "group")
  row("Dzhanibekov, 100 s, least error of methods on the group" code(who), e, "%.1e", 1e-11, "at most")
  e = least_error("double_pendulum_2_rad", "")
  row("double pendulum from 2 rad, 10 s, least error" code(who), e, "%.1e", 1e-9, "at most")
  n = best("flyball_governor", 1e-8, "evaluations", "stiff")
  row("flyball governor, s(10) to 1e-8 by an implicit method" code(who) ", evaluations", n, "%d", 20000, "at most")
  split("vdpol hires orego", reaction)
  for (p = 1; p <= 3; ++p) {
    e = best_error(reaction[p], 1e-9)
    row(reaction[p] ", correct digits with tolerance 1e-9" code(who), e == "" ? "" : -log(e) / log(10), "%.1f", 8, "at least")
  }
  names = split("stormer_verlet implicit_midpoint variational2 variational4", name)
  for (m = 1; m <= names; ++m)
    row("pendulum, 1e6 steps, `" name[m] "`: largest energy error of the last tenth : first", name[m] in first ? tenth[name[m], 10] / first[name[m]] : "", "%.4f", 1.01, "at most")
  names = split("runge_kutta4 dormand_prince45 adams", name)
  for (m = 1; m <= names; ++m)
    row("iiwa14, `" name[m] "`: time beside its evaluations, %", name[m] in overhead ? overhead[name[m]] : "", "%.1f", 20, "at most")
}
