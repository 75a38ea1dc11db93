#!/bin/sh
# Fails if a program with a runtime chain (an arm put together from elements; inverse and forward dynamics, mass matrix
# and inverse, derivatives) instantiates more templates, or becomes more code, than `runtime_limits` allows: headers
# only, and with kte::compiled. Counts and bytes are the same on every machine. Some 35 s of CPU; gate.sh calls it.
#   sh bench/compile/runtime.sh
#   sh bench/compile/runtime.sh record      writes `runtime_limits` anew: what is counted now, and 5 %
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
CXX=g++
limits=$root/bench/compile/runtime_limits
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. "$root/bench/compile/chain.sh"

program() {
  cat <<'END'
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/kte.hpp>
double runtime(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& x) {
  kte::kte_map_chain arm;
  arm << kte::revolute_joint_3D("q", "base", "arm", kte::axis::y)
      << kte::rigid_link_3D("arm", "tip", kte::vec3{0.0, 0.0, 1.0}) << kte::inertia_3D("tip", kte::point_mass(1.0));
  arm.gravity(kte::along_z(-9.81));
  auto s = arm.make_state();
  return kte::inverse_dynamics(arm, s, q, v, x)[0] + kte::forward_dynamics(arm, s, q, v, x)[0] +
         kte::mass_matrix(arm, s, q)(0, 0) + kte::mass_matrix_inverse(arm, s, q)(0, 0) +
         kte::inverse_dynamics_derivatives(arm, s, q, v, x).by_q(0, 0) +
         kte::forward_dynamics_derivatives(arm, s, q, v, x).by_q(0, 0);
}
END
}
{ echo '#define KTE_COMPILED'; program; } >"$work/compiled.cpp"
program >"$work/headers.cpp"

failed=0
grep '^#' "$limits" >"$work/limits"
printf '%-10s %22s %22s %22s\n' program 'functions (most)' 'classes (most)' 'bytes (most)'
while read -r name version most_functions most_classes most_bytes; do
  case $name in '' | '#'*) continue ;; esac
  if ! $CXX --version | head -n 1 | grep -q " $version\."; then
    echo "$name $version $most_functions $most_classes $most_bytes" >>"$work/limits"
    echo "runtime: not counted, as this is not g++ $version"
    continue
  fi
  counts=$(instantiations "$name")
  functions=${counts% *} classes=${counts#* }
  $CXX -std=c++20 -O2 -isystem /usr/include/eigen3 -I"$root/include" -c "$work/$name.cpp" -o "$work/$name.o"
  bytes=$(size "$work/$name.o" | awk 'NR == 2 { print $1 }')
  printf '%-10s %22s %22s %22s\n' "$name" "$functions ($most_functions)" "$classes ($most_classes)" "$bytes ($most_bytes)"
  echo "$name $version $((functions * 21 / 20)) $((classes * 21 / 20)) $((bytes * 21 / 20))" >>"$work/limits"
  if [ "${1:-}" = record ]; then continue; fi
  if [ "$functions" -gt "$most_functions" ] || [ "$classes" -gt "$most_classes" ] || [ "$bytes" -gt "$most_bytes" ]; then
    echo "runtime: a program with a runtime chain ($name) is larger than bench/compile/runtime_limits allows" >&2
    failed=1
  fi
done <"$limits"

if [ "${1:-}" = record ]; then
  cp "$work/limits" "$limits"
elif [ "$failed" != 0 ]; then
  echo 'runtime: find the change that did it; if it is worth it: sh bench/compile/runtime.sh record' >&2
  exit 1
fi
