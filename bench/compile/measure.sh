#!/bin/sh
# Compile time and memory: user + system seconds and peak MB of one compiler run each.
#   CXX=clang++ CXXFLAGS="-O2 -I/opt/eigen" bench/compile/measure.sh
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
: "${CXX:=g++}" "${CXXFLAGS:=-O2 -isystem /usr/include/eigen3}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# All three algorithms on a chain $1 with $2 degrees of freedom.
use() {
  cat <<END
using vector = Eigen::Matrix<double, $2, 1>;
vector tau(const vector& q, const vector& v, const vector& a) { return kte::inverse_dynamics($1, q, v, a); }
Eigen::Matrix<double, $2, $2> mass(const vector& q) { return kte::mass_matrix($1, q); }
vector acceleration(const vector& q, const vector& v, const vector& tau) {
  return kte::forward_dynamics($1, q, v, tau);
}
END
}

# A serial chain of $1 revolute joints about z: links with offsets and quarter turns, bodies of general inertia.
serial() {
  awk -v n="$1" 'BEGIN {
    print "#include <kte/kte.hpp>"
    key = "inline constexpr struct %s_ final : kte::%s_key<\"%s\"> {} %s;\n"
    printf key, "base", "frame_3D", "base", "base"
    for (i = 1; i <= n; ++i) {
      printf key, "q" i, "coord", "q" i, "q" i
      printf key, "seat" i, "frame_3D", "seat" i, "seat" i
      printf key, "link" i, "frame_3D", "link" i, "link" i
    }
    print "inline constexpr auto model = kte::chain("
    split("x y z", turn, " ")
    for (i = 1; i <= n; ++i) {
      from = i == 1 ? "base" : "link" (i - 1)
      printf "    kte::rigid_link_3D(%s, seat%d, kte::vec3{0.0%d, -0.1, 0.2}, kte::quarter_turn_%s),\n", from, i,
             i % 9 + 1, turn[i % 3 + 1]
      printf "    kte::revolute_joint_3D(q%d, seat%d, link%d),\n", i, i, i
      printf "    kte::inertia_3D(link%d, kte::rigid_body{1.%d, kte::vec3{0.01, -0.02, 0.1},\n", i, i
      printf "                    kte::sym3{0.02, 0.001, -0.002, 0.03, 0.0005, 0.025}})%s\n", i < n ? "," : ")"
    }
    print "    .gravity(kte::along_z(-9.81));"
  }'
  use model "$1"
}

measure() {
  if command time -f '%U %S %M' -o "$work/cost" $CXX -std=c++20 $CXXFLAGS -I"$root/include" -I"$root/examples" \
      -c "$work/$1.cpp" -o "$work/$1.o" 2>"$work/errors"; then
    awk -v what="$1" '{ printf "%-12s %8.2f %8.0f\n", what, $1 + $2, $3 / 1024 }' "$work/cost"
  else
    printf '%-12s   failed\n' "$1"
    head -n 5 "$work/errors"
  fi
}

echo '#include <kte/kte.hpp>' >"$work/header.cpp"
{
  echo '#include "robots/iiwa14.hpp"'
  use robots::iiwa14 7
} >"$work/iiwa14.cpp"

echo "$CXX $CXXFLAGS"
printf '%-12s %8s %8s\n' what s MB
measure header
measure iiwa14
for n in ${JOINTS:-7 30 100}; do
  serial "$n" >"$work/serial$n.cpp"
  measure "serial$n"
done
