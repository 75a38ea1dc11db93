#pragma once

#include <kte/integrators/time_grid.hpp>

#include <Eigen/Core>

#include <concepts>

namespace kte {

/// A positive number for all components of a state, or one for each: `1e-6`, or an Eigen vector.
template <class S>
class per_component {
 public:
  template <std::convertible_to<S> T>
  per_component(const T& all) : all_(static_cast<S>(all)) {}  // NOLINT(google-explicit-constructor)
  template <class V>
  per_component(const Eigen::MatrixBase<V>& each)  // NOLINT(google-explicit-constructor)
      : each_(each.template cast<S>()) {}

  const S& operator[](Eigen::Index i) const { return each_.size() == 0 ? all_ : each_[i]; }

  /// Throws `bad_argument` for a number that is not positive, and for another count of numbers than n.
  void check(Eigen::Index n, const char* name) const {
    if (each_.size() == 0) return detail::check_positive(all_, name);
    if (each_.size() != n)
      detail::raise<bad_argument>(std::string("kte: ") + name + " has " + std::to_string(each_.size()) +
                                  " numbers, for " + std::to_string(n) + " components");
    for (Eigen::Index i = 0; i < n; ++i)
      detail::check_positive(each_[i], (std::string(name) + " of component " + std::to_string(i)).c_str());
  }

 private:
  S all_{};
  Eigen::Matrix<S, Eigen::Dynamic, 1> each_;
};

/// How exact an integrator that chooses its own steps shall be. Where states have rotations, components are those of
/// rates (`rate_of`).
template <class S>
struct tolerances {
  per_component<S> absolute = S(1e-6);  ///< in units of the state; positive
  per_component<S> relative = S(1e-6);  ///< as a fraction of the state; positive
  long long max_steps = 1000000;        ///< of one `integrate`, with those rejected

  /// Throws `bad_argument` for settings that make no sense for n components.
  void check(Eigen::Index n) const {
    absolute.check(n, "absolute tolerance");
    relative.check(n, "relative tolerance");
    if (max_steps < 1) detail::raise<bad_argument>("kte: max_steps must be positive, got " + std::to_string(max_steps));
  }
};

}  // namespace kte
