#!/bin/sh
# Fails if the mass matrix, forward dynamics or the derivatives of inverse dynamics of a static chain become more
# instructions, or more accesses of the stack, than `register_limits` allows: what compilers no longer keep in registers costs up to half of the time
# (docs/decisions/10-registers.md). Counts are the same on every machine. Some 50 s of CPU; gate.sh calls it.
#   sh bench/compile/registers.sh
#   sh bench/compile/registers.sh record      writes `register_limits` anew: what is counted now, and 5 %
set -eu
. "$(dirname "$0")/limits.sh"

# A serial robot; a trunk that floats with one leg.
cat >"$work/chains.hpp" <<'END'
#include "robots/solo12.hpp"
#include "robots/ur5.hpp"
inline constexpr auto& serial = robots::ur5;
inline constexpr auto floating = [] {
  using namespace robots::solo12_names;
  return kte::chain(kte::free_joint_3D(trunk, ground, body),
                    kte::inertia_3D(body, kte::rigid_body{1.2, kte::zero3{}, kte::diagonal(0.006, 0.02, 0.025)}),
                    robots::solo12_leg(fl, 1, 1))
      .gravity(kte::along_z(-9.81));
}();
END
cat >"$work/dynamics.cpp" <<'END'
#include "chains.hpp"
constexpr auto nq = std::remove_cvref_t<decltype(MODEL)>::nq, nv = std::remove_cvref_t<decltype(MODEL)>::dofs;
extern "C" void mass(const double* x, kte::joint_matrix<double, nv>* y) { *y = kte::mass_matrix(MODEL, x); }
extern "C" void accelerations(const double* x, kte::joint_vector<double, nv>* y) {
  *y = kte::forward_dynamics(MODEL, x, x + nq, x + nq + nv);
}
END
cat >"$work/derivatives.cpp" <<'END'
#include <kte/dynamics/derivatives.hpp>
#include "chains.hpp"
constexpr auto nq = std::remove_cvref_t<decltype(MODEL)>::nq, nv = std::remove_cvref_t<decltype(MODEL)>::dofs;
extern "C" void derivatives(const double* x, kte::inverse_dynamics_result<double, nv>* y) {
  *y = kte::inverse_dynamics_derivatives(MODEL, x, x + nq, x + nq + nv);
}
END

# "instructions accesses" of what functions of object file $1 whose names match $2 have.
counted() {
  objdump -d --no-show-raw-insn "$1" | awk -v name="<($2)" '
    />:$/ { here = $0 ~ name && $0 !~ /cold/ }
    here && /^ +[0-9a-f]+:/ { ++all; if ($2 !~ /^(lea|nop)/ && /\(%r[sb]p/) ++stack }
    END { print all + 0, stack + 0 }'
}

if [ "$(uname -m)" != x86_64 ]; then
  echo 'registers: counted on x86-64 only'
  exit 0
fi
limits_of register_limits 'compiler, chain, algorithm' instructions stack
while read -r compiler version model algorithm most; do
  case $compiler in '' | '#'*) continue ;; esac
  key="$compiler $version $model $algorithm"
  if ! $compiler --version 2>/dev/null | head -n 1 | grep -q " $version\."; then
    not_compared "$key $most" "this is not $compiler $version"
    continue
  fi
  case $algorithm in
    mass) unit=dynamics name='mass>|_ZN3kte11mass_matrix' ;;
    accelerations) unit=dynamics name='accelerations>|_ZN3kte16forward_dynamics' ;;
    derivatives) unit=derivatives name=. ;;  # many functions, one for each kind of joint at each depth
  esac
  object=$work/$compiler.$model.$unit.o
  [ -f "$object" ] || $compiler -std=c++20 -O3 -march=x86-64-v3 -fno-math-errno -DNDEBUG -DMODEL="$model" \
    -isystem /usr/include/eigen3 -I"$root/include" -I"$root/examples" -c "$work/$unit.cpp" -o "$object"
  compare "$key" "$(counted "$object" "$name")" "$most"
done <"$limits"
finish
