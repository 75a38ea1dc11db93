# The table of libraries timed elsewhere, in straight-line inverse dynamics of the iiwa14 of the same run:
#   awk -f elsewhere.awk numbers elsewhere.txt
function theirs(ns) { return ns == "-" ? "" : sprintf("%.2f", ns / 90) }
function ours(how, key) {
  key = $1 "/" how "/" $2
  return key in time ? sprintf("%.2f, %.1e", time[key] / time["inverse_dynamics/straightline/iiwa14"], error[key]) : ""
}
FNR == NR {
  time[$1 "/" $2 "/" $3] = $4
  error[$1 "/" $2 "/" $3] = $5
  next
}
FNR == 1 {
  print "| operation | robot | kte, static | kte, runtime | Pinocchio | RBDL |"
  print "|-|-|-|-|-|-|"
}
/^#/ { next }
{
  printf "| %s | %s | %s | %s | %s | %s |\n", ($1 == before ? "" : $1), $2, ours("static"), ours("runtime"), theirs($3), theirs($4)
  before = $1
}
