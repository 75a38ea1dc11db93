# One way to evaluate a model, a line for each operation, "?" where there is none.
$2 == way && $3 == model { time[$1] = $4 }
END {
  n = split("inverse_dynamics mass_matrix forward_dynamics forward_kinematics jacobian", operations, " ")
  for (i = 1; i <= n; ++i) print operations[i], operations[i] in time ? time[operations[i]] : "?"
}
