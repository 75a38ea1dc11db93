#pragma once

#include "mechanism.hpp"
#include "variational.hpp"

namespace work_precision {

/// On the group; and with the rates of quaternions as a vector, for comparison.
template <class Mechanism, class X>
void add_rotating(problem& p, const task<X>& t) {
  using equation = kte::problems::equation_of_motion<Mechanism>;
  static constexpr int n = equation::size;
  const entrants<mechanism<Mechanism>, X> on_group(p, the<Mechanism>, t);
  on_group.add_embedded(), on_group.add_fixed(), on_group.add_structured();
  add_variational<Mechanism>(p, t);
  static constexpr equations<n> f{rate_of<equation>};
  const entrants<equations<n>, vector<n>> as_vector(p, f, t, "/quaternions");
  as_vector.template add<kte::dormand_prince45>("dormand_prince45");
  as_vector.template add<kte::adams>("adams");
}

}  // namespace work_precision
