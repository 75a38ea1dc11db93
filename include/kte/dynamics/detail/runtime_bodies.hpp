#pragma once

#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/runtime_frames.hpp>
#include <kte/tree/momentum.hpp>

/// Loops over the bodies of runtime chains, in the working memory of a state.
namespace kte {

namespace detail {

/// Puts accelerations, and on request velocities, of a state aside for as long as it lives.
class rates_aside {
 public:
  rates_aside(runtime_state& s, bool velocities) : state_(s), velocities_(velocities) {
    each([](double& x, double& kept) { kept = x, x = 0; });
  }
  ~rates_aside() {
    each([](double& x, const double& kept) { x = kept; });
  }
  rates_aside(const rates_aside&) = delete;
  rates_aside& operator=(const rates_aside&) = delete;

 private:
  template <class F>
  void each(const F& f) {
    for_each_listed_freedom(state_, [&](auto& c, const freedom& at) {
      auto i = static_cast<std::size_t>(at.v), j = i + static_cast<std::size_t>(state_.dofs());
      visit_a(c, [&](double& x) { f(x, state_.work.kept[i++]); });
      if (velocities_) visit_v(c, [&](double& x) { f(x, state_.work.kept[j++]); });
    });
  }
  runtime_state& state_;
  bool velocities_;
};

inline const Eigen::VectorXd& applied_forces(runtime_state& s) {
  take_needed_forces(s);
  check_result(s.work.forces, static_cast<std::size_t>(s.dofs()), [&s] { blame("a force", s); });
  return s.work.forces;
}

/// Inverse dynamics of the bodies alone, without accelerations of coordinates.
inline void forces_of_bodies(const kte_map_chain& c, runtime_state& s, bool accelerated_bases) {
  forces_on_coordinates(runtime_elements{c}, s, acting::bodies, accelerated_bases);
}

/// visit(row of an axis among all coordinates, momentum of its unit rate about the origin of the world).
template <class F>
void for_each_momentum(runtime_state& s, const F& visit) {
  const auto& f = s.tree().forest;
  tree::momenta(f, s.work,
                [&](int k, const tree::dense_wrench<double>& h) { visit(f.row[static_cast<std::size_t>(k)], h); });
}
/// Momentum at the origin of the world, after `carry`; coordinates that are given rest.
inline tree::dense_wrench<double> momentum_of_coordinates(runtime_state& s) {
  const auto& f = s.tree().forest;
  take_rates(s);
  for (const auto& r : f.records)
    if (r.what == kind::gen && !r.yields && s.made_for()->writers[0][static_cast<std::size_t>(r.slot)] < 0)
      s.work.rate[static_cast<std::size_t>(r.first)] = 0;
  tree::dense_wrench<double> sum{};
  tree::momenta(f, s.work, [&](int k, const tree::dense_wrench<double>& h) {
    const double r = s.work.rate[static_cast<std::size_t>(k)];
    sum = {sum.force + r * h.force, sum.torque + r * h.torque};
  });
  return sum;
}
}  // namespace detail

}  // namespace kte
