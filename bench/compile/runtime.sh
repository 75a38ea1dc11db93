#!/bin/sh
# Fails if a program with a runtime chain (an arm put together from elements; inverse and forward dynamics, mass matrix
# and inverse, derivatives) instantiates more templates, or becomes more code, than `runtime_limits` allows: headers
# only, and with kte::compiled. Counts and bytes are the same on every machine. Some 35 s of CPU; gate.sh calls it.
#   sh bench/compile/runtime.sh
#   sh bench/compile/runtime.sh record      writes `runtime_limits` anew: what is counted now, and 5 %
set -eu
. "$(dirname "$0")/limits.sh"

program() {
  cat <<'END'
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/kte.hpp>
double runtime(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& x) {
  kte::runtime_chain arm;
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

limits_of runtime_limits program functions classes bytes
while read -r name version most; do
  case $name in '' | '#'*) continue ;; esac
  if ! $CXX --version | head -n 1 | grep -q " $version\."; then
    not_compared "$name $version $most" "this is not g++ $version"
    continue
  fi
  counts=$(instantiations "$name")
  $CXX -std=c++20 -O2 -isystem /usr/include/eigen3 -I"$root/include" -c "$work/$name.cpp" -o "$work/$name.o"
  compare "$name $version" "$counts $(size "$work/$name.o" | awk 'NR == 2 { print $1 }')" "$most"
done <"$limits"
finish
