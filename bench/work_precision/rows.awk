# What others ask of rows: awk -f rows.awk -f targets.awk ... rows. Methods of a problem in order of appearance; of each
# its settings, coarse to fine.
$1 != "#" && NF >= 13 {
  key = $1 " " $2
  if (!(key in count)) methods[$1] = methods[$1] " " $2
  i = ++count[key]
  setting[key, i] = $3
  error[key, i] = $4 == "failed" ? 1e99 : $4 > 0 ? $4 + 0 : 1e-17
  failed[key, i] = $4 == "failed"
  cost[key, "time", i] = $5
  cost[key, "evaluations", i] = $6
  energy[key, i] = $11
  momentum[key, i] = $12
  norm[key, i] = $13
  reason[key, i] = $0
  sub(/^[^#]*# /, "", reason[key, i])
}
function fixed(method) {
  return method ~ /^(euler|midpoint|runge_kutta[45]|adams_BM[35]|semi_implicit_euler|stormer_verlet|implicit_midpoint|variational[24]|mujoco_RK4)/
}
function stiff(method) { return method ~ /^(bdf|rodas|rosenbrock23|tr_bdf2|trapezoidal|kennedy_carpenter34)/ }
# An error by which the next finer setting does not err more: one alone may be luck.
function sure(key, i) { return i < count[key] && error[key, i + 1] > error[key, i] ? error[key, i + 1] : error[key, i] }
# The lowest cost, "time" or "evaluations", at which a method errs by e or less, for sure: between two settings, by a
# straight line of logarithms; of the crudest setting if that is good enough. "" if none is. Of settings that cost more
# and err more than another nothing is seen.
function cost_to(key, e, of, i, j, best, c, after) {
  best = 1e99
  after = 0
  for (;;) {
    j = 0
    for (i = 1; i <= count[key]; ++i)
      if (sure(key, i) < best && cost[key, of, i] >= after && (!j || cost[key, of, i] < cost[key, of, j])) j = i
    if (!j) return ""
    c = cost[key, of, j]
    if (sure(key, j) <= e) break
    best = sure(key, j)
    after = c
  }
  if (best > 1e98 || after <= 0) return c
  return after * exp(log(c / after) * log(best / e) / log(best / sure(key, j)))
}
# The least error, and whether finer settings err more.
function floor_of(key, i, j) {
  j = 1
  for (i = 2; i <= count[key]; ++i)
    if (error[key, i] < error[key, j]) j = i
  at_floor = j
  reached = j < count[key]
  return error[key, j]
}
# The median of the slopes of log error by log step between neighbours that err by less than 0.01. Of those near the floor
# there are few. "" where there are none.
function order_of(key, i, j, n, slope, steps) {
  n = 0
  steps = floor_of(key) > 0.01 ? 1 : at_floor
  for (i = 2; i <= steps; ++i) {
    if (error[key, i - 1] > 0.01 || error[key, i] >= error[key, i - 1]) continue
    for (j = ++n; j > 1 && slope[j - 1] > slope_at(key, i); --j) slope[j] = slope[j - 1]
    slope[j] = slope_at(key, i)
  }
  return n < 2 ? "" : n % 2 ? slope[(n + 1) / 2] : (slope[n / 2] + slope[n / 2 + 1]) / 2
}
function slope_at(key, i) {
  return log(error[key, i - 1] / error[key, i]) / log(setting[key, i - 1] / setting[key, i])
}
# The setting s of a method, or 0.
function index_of(key, s, i) {
  for (i = 1; i <= count[key]; ++i)
    if (setting[key, i] + 0 == s + 0) return i
  return 0
}
# 12345678 as 12.3M.
function short(n) { return n < 9999.5 ? sprintf("%.0f", n) : n < 999500 ? sprintf("%.3gk", n / 1e3) : sprintf("%.3gM", n / 1e6) }
function milliseconds(s) { return s < 0.9995 ? sprintf("%.3g", s * 1e3) : sprintf("%.0f", s * 1e3) }
