# Pinocchio's times relative to those of kte, from lines "operation how model ns error": for each operation and robot that
# both have. Prints nothing without Pinocchio.
function ratio(how, key) {
  key = $1 "/" how "/" $3
  return key in time ? sprintf("%.2f, %.1e", $4 / time[key], error[key]) : ""
}
FNR == NR {
  time[$1 "/" $2 "/" $3] = $4
  error[$1 "/" $2 "/" $3] = $5
  next
}
$2 != "pinocchio" { next }
!found++ {
  print "| operation | robot | static | runtime | Pinocchio, ns |"
  print "|-|-|-|-|-|"
}
{
  printf "| %s | %s | %s | %s | %.0f, %.1e |\n", ($1 == before ? "" : $1), $3, ratio("static"), ratio("runtime"), $4, $5
  before = $1
}
