#pragma once

#include <kte/dynamics/static_equilibrium.hpp>
#include <kte/runtime_chain.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace kte {

/// Options of `equilibrium_path`.
struct equilibrium_path_options {
  std::string_view parameter{};          ///< an input, or a coordinate of base_gen; empty: the load factor
  double from = 0, to = 1;               ///< first and last value of the parameter
  double step = 0.1;                     ///< largest distance between points, see `equilibrium_path`
  int points = 1000;                     ///< largest number of points
  std::vector<external_wrench> loads{};  ///< as for `static_equilibrium`
  double tolerance = 1e-10;              ///< as for `static_equilibrium`
};

/// A point of a path of equilibria: the configuration q and the `stability` of its tangent.
struct equilibrium_point {
  double parameter = 0;  ///< the value of the parameter
  Eigen::VectorXd q;
  tangent_stability stability;
};

#ifdef KTE_FUNCTION
namespace detail {
/// Pseudo-arclength continuation: a predictor step along the tangent of the path, and a corrector in the plane normal
/// to it.
class path_follower {
 public:
  path_follower(static_problem& f, const Eigen::VectorXd& q0, const equilibrium_path_options& options)
      : f_(f),
        options_(options),
        span_(options.to - options.from),
        newton_(f, weights_of_steps(f, q0, options.from), options.tolerance, (std::numeric_limits<int>::max)()),
        squares_(newton_.weights().cwiseAbs2() / (std::max)(1, f.size())) {
    at_.q = q0, at_.parameter = options.from;
  }
  std::vector<equilibrium_point> follow() {
    start();
    double length = options_.step;
    while (static_cast<int>(points_.size()) < options_.points && points_.back().parameter != options_.to) {
      if (length < 1e-7 * options_.step) fail("cannot be followed any further");
      const int before = newton_.iterations();
      const double turn = go_on(length);
      if (turn < 0.9)
        length /= 2;
      else if (turn > 0.98 && newton_.iterations() - before <= 9)
        length = (std::min)(1.5 * length, options_.step);
    }
    return std::move(points_);
  }

 private:
  [[noreturn, gnu::cold]] void fail(const char* why) {
    const auto name = points_.empty() ? coordinate_not_held(f_, at_.q, at_.parameter) : std::string();
    raise<no_solution>("kte: equilibrium_path: the path " + std::string(why) + " at " +
                       (f_.by_load() ? "load factor" : std::string(options_.parameter)) + " " + number(at_.parameter) +
                       (name.empty() ? "" : ": nothing holds '" + name + "'"));
  }
  /// The inner product of two directions (d, dp).
  double product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    const Eigen::Index n = squares_.size();
    return a.head(n).cwiseProduct(squares_).dot(b.head(n)) + a[n] * b[n] / (span_ * span_);
  }
  path_plane plane() const {
    const Eigen::Index n = squares_.size();
    return {direction_.head(n).cwiseProduct(squares_), direction_[n] / (span_ * span_)};
  }
  void start() {
    const auto n = static_cast<Eigen::Index>(f_.size());
    direction_ = Eigen::VectorXd::Unit(n + 1, n) * span_;
    if (!newton_.solve(at_.q, at_.parameter, false) || !turn_direction(at_)) fail("has no start");
    at_.stability = stability_of(f_.tangent(at_.q, at_.parameter));
    points_.push_back(at_);
  }
  /// Computes the direction of the path at a point, oriented like the previous one.
  bool turn_direction(const equilibrium_point& x) {
    const path_plane across = plane();
    if (!newton_.factors().factor(f_, x.q, x.parameter, &across)) return false;
    Eigen::VectorXd d = newton_.factors().direction();
    const double length = std::sqrt(product(d, d));
    if (!(length > 0 && length <= (std::numeric_limits<double>::max)())) return false;
    direction_ = d / length;
    return true;
  }
  /// Takes a step of the given length. Accepts it if the new direction is close to the previous one; returns the cosine
  /// of the angle between them.
  double go_on(double length) {
    const Eigen::VectorXd before = direction_;
    const auto n = static_cast<Eigen::Index>(f_.size());
    equilibrium_point next = at_;
    try {
      next.q = f_.displaced(at_.q, length * before.head(n)), next.parameter += length * before[n];
      const path_plane across = plane();
      if (!newton_.solve(next.q, next.parameter, true, &across)) return 0;
      if ((next.parameter - options_.to) / span_ >= 0) {
        next.parameter = options_.to;
        if (!newton_.solve(next.q, next.parameter, true)) return 0;
      }
      const bool found = turn_direction(next);
      const double turn = found ? product(direction_, before) : 0;
      if (turn >= 0.9) next.stability = stability_of(f_.tangent(next.q, next.parameter));
      // An eigenvalue changes sign where the parameter turns back. Elsewhere a sign change means a branch point, or
      // that a step has cut a sharp bend.
      const bool jumped = next.stability.unstable != at_.stability.unstable && direction_[n] * before[n] > 0;
      if (turn < 0.9 || (jumped && length > 1e-3 * options_.step)) {
        direction_ = before;
        return 0;
      }
      at_ = next;
      points_.push_back(at_);
      return turn;
    } catch (const bad_argument&) {  // the forces are undefined at this point
      direction_ = before;
      return 0;
    }
  }

  static_problem& f_;
  const equilibrium_path_options& options_;
  double span_;
  static_newton newton_;
  Eigen::VectorXd squares_, direction_;
  equilibrium_point at_;
  std::vector<equilibrium_point> points_;
};
}  // namespace detail

/// The implementation of `equilibrium_path`.
KTE_FUNCTION std::vector<equilibrium_point> follow_equilibria(const runtime_chain& c, runtime_state& s,
                                                              const Eigen::VectorXd& q0,
                                                              const equilibrium_path_options& options) {
  using namespace detail;
  if (!(options.tolerance > 0 && options.tolerance < 1) || options.points < 1 || !(options.step > 0) ||
      !(std::abs(options.to - options.from) > 0) || !std::isfinite(options.to - options.from + options.step))
    raise<bad_argument>(
        "kte: options of equilibrium_path: `from` and `to` must be finite and differ, step must be finite and "
        "positive, points at least 1, tolerance between 0 and 1");
  static_problem f(c, s, options.loads, options.parameter);
  auto points = path_follower(f, q0, options).follow();
  set_positions(s, points.back().q);
  return points;
}
#else
std::vector<equilibrium_point> follow_equilibria(const runtime_chain&, runtime_state&, const Eigen::VectorXd&,
                                                 const equilibrium_path_options&);
#endif

/// Equilibria of a chain as its loads or a parameter change, by pseudo-arclength continuation, which also passes limit
/// points (snap-through). The parameter is the load factor of `static_equilibrium` (without holding forces), or an
/// input, or a coordinate of base_gen in the state. The first point is the equilibrium that damped steps find from q0
/// at `from`. The last point is at `to`, unless the number of points reaches `points`.
///
/// The distance between points is at most `step`, and less where the path is curved. Distance is the root mean square
/// of rotations, rad, of lengths relative to the size of the chain, and of the parameter relative to to - from. The
/// parameter turns back at limit points. Other changes of `stability.unstable` are branch points, whose branches are
/// not followed.
///
///   for (const auto& x : kte::equilibrium_path(truss, s, q0)) std::cout << x.parameter << ' ' << x.q[0] << '\n';
///
/// The state is then at the last point. Throws what `static_equilibrium` throws; the state is then unchanged.
template <indexable Q>
std::vector<equilibrium_point> equilibrium_path(const runtime_chain& c, runtime_state& s, const Q& q0,
                                                const equilibrium_path_options& options = {}) {
  return follow_equilibria(c, s, detail::start_of_statics(c, s, q0), options);
}

}  // namespace kte
