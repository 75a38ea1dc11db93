# The table of energies over a long time: awk -f long_time.awk long_time
!($1 in seen) {
  seen[$1] = 1
  name[++methods] = $1
}
{ most[$1, $2] = $3 }
END {
  print "| tenth | 1 | 2 | 4 | 6 | 8 | 10 |"
  print "|-|-|-|-|-|-|-|"
  for (m = 1; m <= methods; ++m) {
    printf "| `%s` |", name[m]
    for (i = 1; i <= 10; i += i < 2 ? 1 : 2) printf " %.3g |", most[name[m], i]
    print ""
  }
}
