# All operations on one model, each sorted by time: sort numbers | awk -v model=iiwa14 -f model.awk
BEGIN {
  print "| operation | how | ns | times straight-line | error |"
  print "|-|-|-|-|-|"
  split("inverse_dynamics nonlinear_effects mass_matrix forward_dynamics forward_kinematics jacobian passes " \
        "mass_matrix_inverse id_derivatives fd_derivatives regressor inverse_kinematics", operations, " ")
}
$3 == model {
  ++rows[$1]
  how[$1, rows[$1]] = $2
  time[$1, rows[$1]] = $4
  error[$1, rows[$1]] = $5
  if ($2 == "straightline") unit[$1] = $4
}
END {
  for (o = 1; o in operations; ++o) {
    name = operations[o]
    for (i = 1; i <= rows[name]; ++i) {
      t = time[name, i]
      ratio = unit[name] == "" ? "" : sprintf("%.2f", t / unit[name])
      t = sprintf(t < 1000 ? "%.3g" : "%.0f", t)
      printf "| %s | %s | %s | %s | %.1e |\n", (i == 1 ? name : ""), how[name, i], t, ratio, error[name, i]
    }
  }
}
