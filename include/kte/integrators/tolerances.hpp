#pragma once

#include <kte/integrators/time_grid.hpp>

#include <Eigen/Core>

#include <concepts>

namespace kte {

/// One number for all components of a state, or one for each: `1e-6`, or an Eigen vector.
template <class S>
class per_component {
 public:
  template <std::convertible_to<S> T>
  per_component(const T& all) : all_(static_cast<S>(all)) {}  // NOLINT(google-explicit-constructor)
  template <class V>
  per_component(const Eigen::MatrixBase<V>& each)  // NOLINT(google-explicit-constructor)
      : each_(each.template cast<S>()) {}

  const S& operator[](Eigen::Index i) const { return each_.size() == 0 ? all_ : each_[i]; }

  /// Throws `bad_argument` for numbers that are negative or not finite, and unless there are n numbers.
  void check(Eigen::Index n, const char* name) const {
    if (each_.size() == 0) return detail::check_not_negative(all_, name);
    if (each_.size() != n)
      detail::raise<bad_argument>(std::string("kte: ") + name + " has " + std::to_string(each_.size()) +
                                  " numbers, for " + std::to_string(n) + " components");
    for (Eigen::Index i = 0; i < n; ++i)
      detail::check_not_negative(each_[i], (std::string(name) + " of component " + std::to_string(i)).c_str());
  }

 private:
  S all_{};
  Eigen::Matrix<S, Eigen::Dynamic, 1> each_;
};

/// Tolerances of an integrator with step control: the error of each step in component i is at most w_i,
///
///   w_i = absolute_i + relative_i |x_i|            (1)
///
/// One of the two may be 0; an absolute tolerance whose square vanishes, below 1e-154, counts as 0. Tolerances below
/// the rounding error, w_i < 4 eps |x_i|, are rejected, because every step rounds by eps/2. For states with rotations,
/// components are those of rates (`rate_of`).
template <class S>
struct tolerances {
  per_component<S> absolute = S(1e-6);  ///< in units of the state; not negative
  per_component<S> relative = S(1e-6);  ///< as a fraction of the state; not negative
  long long max_steps = 1000000;        ///< of one `integrate`, including rejected ones
  S initial_step = S(0);                ///< s, first step, also after `restart`; 0: computed from the first slopes
  /// s; the integration fails if the tolerances need a shorter step. The last step to an end may be shorter
  S smallest_step = S(0);
  S largest_step = S(0);  ///< s; 0: unlimited

  /// Throws `bad_argument` for invalid settings, or settings that do not fit n components.
  void check(Eigen::Index n) const {
    check_step(initial_step, "initial step");
    check_step(smallest_step, "smallest step");
    check_step(largest_step, "largest step");
    if (largest_step != S(0)) {
      check_order(smallest_step, "smallest step", largest_step, "largest step");
      check_order(initial_step, "initial step", largest_step, "largest step");
    }
    if (initial_step != S(0)) check_order(smallest_step, "smallest step", initial_step, "initial step");
    absolute.check(n, "absolute tolerance");
    relative.check(n, "relative tolerance");
    for (Eigen::Index i = 0; i < n; ++i)
      if (!(absolute[i] + relative[i] > S(0)))
        detail::raise<bad_argument>("kte: absolute and relative tolerance are both 0, of component " +
                                    std::to_string(i));
      else if (absolute[i] * absolute[i] < (std::numeric_limits<S>::min)() && relative[i] < least_relative())
        detail::raise<bad_argument>("kte: relative tolerance " + detail::number(static_cast<double>(relative[i])) +
                                    " of component " + std::to_string(i) + " is out of reach of the arithmetic: " +
                                    detail::number(static_cast<double>(least_relative())) + " or more");
    if (max_steps < 1) detail::raise<bad_argument>("kte: max_steps must be positive, got " + std::to_string(max_steps));
  }
  /// Whether (1) is within reach for all states.
  bool are_within_reach(Eigen::Index n) const {
    for (Eigen::Index i = 0; i < n; ++i)
      if (relative[i] < least_relative()) return false;
    return true;
  }
  /// A message that names the component whose tolerance is out of reach for states of these sizes; empty if there is
  /// none.
  template <class X>
  std::string out_of_reach(const X& sizes) const {
    using std::abs;
    for (Eigen::Index i = 0; i < sizes.size(); ++i) {
      const S x = detail::largest_lane(abs(typename X::Scalar(sizes[i]))), w = absolute[i] + relative[i] * x;
      if (w < least_relative() * x)
        return "the tolerance " + detail::number(static_cast<double>(w)) + " of component " + std::to_string(i) +
               ", which is " + detail::number(detail::as_double(sizes[i])) +
               ", is out of reach of the arithmetic: " + detail::number(static_cast<double>(least_relative() * x)) +
               " or more";
    }
    return {};
  }

  /// A message that names the component whose tolerance is too small for its rate f: their ratio has no finite square;
  /// empty if there is none.
  template <class X, class R>
  std::string too_small(const X& sizes, const R& f) const {
    using std::abs;
    for (Eigen::Index i = 0; i < sizes.size(); ++i) {
      const S w = absolute[i] + relative[i] * detail::largest_lane(abs(typename X::Scalar(sizes[i])));
      const S ratio = detail::largest_lane(abs(typename R::Scalar(f[i]))) / w;
      if (w > S(0) && !(ratio * ratio <= (std::numeric_limits<S>::max)()))
        return "the tolerance " + detail::number(static_cast<double>(w)) + " of component " + std::to_string(i) +
               " is too small for its rate " + detail::number(detail::as_double(f[i]));
    }
    return {};
  }

 private:
  static S least_relative() { return 4 * std::numeric_limits<S>::epsilon(); }
  static void check_step(const S& h, const char* name) {
    if (h != S(0)) detail::check_positive(h, name);
  }
  static void check_order(const S& less, const char* name, const S& more, const char* name_of_more) {
    if (more < less) [[unlikely]]
      detail::raise<bad_argument>(std::string("kte: ") + name + " " + detail::number(static_cast<double>(less)) +
                                  " is above the " + name_of_more + " " + detail::number(static_cast<double>(more)));
  }
};

}  // namespace kte
