# Of every problem the fastest method to some errors, and that with the fewest evaluations.
function winner(p, e, of, names, name, m, c, best) {
  names = split(methods[p], name)
  best = ""
  for (m = 1; m <= names; ++m) {
    if (name[m] ~ /mujoco/) continue
    c = cost_to(p " " name[m], e, of)
    if (c != "" && (best == "" || c < least)) {
      best = name[m]
      least = c
    }
  }
  return best
}
END {
  split("1e-3 1e-6 1e-9 1e-12", errors)
  problems = split(all, problem)
  print "| | to 1e-3 | 1e-6 | 1e-9 | 1e-12 |"
  print "|-|-|-|-|-|"
  for (q = 1; q <= problems; ++q) {
    printf "| %s |", problem[q]
    for (i = 1; i <= 4; ++i) {
      fast = winner(problem[q], errors[i], "time")
      time = least
      few = winner(problem[q], errors[i], "evaluations")
      if (fast == "") printf " |"
      else if (fast == few) printf " `%s` %s / %s |", fast, milliseconds(time), short(least)
      else printf " `%s` %s; `%s` %s |", fast, milliseconds(time), few, short(least)
    }
    print ""
  }
}
