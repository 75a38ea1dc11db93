#pragma once

#include <kte/models/manipulator_dynamics_model.hpp>

#include "data/problems/mechanism.hpp"
#include "equations.hpp"

/// Problems that are mechanisms.
namespace work_precision {

template <class Mechanism>
using model_of = kte::manipulator_dynamics_model<std::remove_cvref_t<decltype(Mechanism::model)>>;

/// The model with its rates out of line: its states may have rotations.
template <class Mechanism>
struct mechanism : model_of<Mechanism> {
  using base = model_of<Mechanism>;
  using typename base::rate;
  using typename base::state;

  mechanism() : base(Mechanism::model) {}
  [[gnu::noinline]] rate operator()(const double& t, const state& x) const { return base::computeStateRate(t, x); }
};
template <class Mechanism>
inline const mechanism<Mechanism> the{};

/// Where all coordinates are numbers.
template <class Mechanism>
vector<2 * model_of<Mechanism>::dofs> rate_of_mechanism(const double& t,
                                                        const vector<2 * model_of<Mechanism>::dofs>& x) {
  return static_cast<const model_of<Mechanism>&>(the<Mechanism>).computeStateRate(t, x);
}

/// At the last reference; the error is of the `count` numbers from the one at `from` on of the output. `Momentum`
/// gives numbers of (q, v) that stay.
template <class Mechanism, class Momentum = std::nullptr_t>
auto task_of_mechanism(std::size_t from = 0, std::size_t count = 0, const Momentum& momentum = {}) {
  using model = model_of<Mechanism>;
  using X = typename model::state;
  using equation = kte::problems::equation_of_motion<Mechanism>;
  static constexpr const auto& r = Mechanism::references[std::size(Mechanism::references) - 1];
  const X start = equation::start();
  const double energy = equation::energy(start);
  if (count == 0) count = std::size(r.values) - from;
  return task<X>{start, static_cast<double>(r.time), [=](const X& x) {
                   judgement j{largest_error(equation::output(x), r.values, from, count),
                               std::abs(equation::energy(x) - energy), none, none};
                   if constexpr (!std::is_same_v<Momentum, std::nullptr_t>)
                     j.momentum = (momentum(x) - momentum(start)).norm() / momentum(start).norm();
                   if constexpr (kte::moves_on_group<model, X>) {
                     j.norm = 0;
                     for (int i = 0; i < model::nq; i += 4)  // rotations only
                       j.norm = std::max(j.norm, std::abs(x.template segment<4>(i).norm() - 1));
                   }
                   return j;
                 }};
}

}  // namespace work_precision
