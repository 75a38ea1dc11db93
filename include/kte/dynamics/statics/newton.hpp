#pragma once

#include <kte/dynamics/statics/problem.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseLU>

#include <limits>

/// Newton's method on tau(q, p) = 0 of statics/problem.hpp.
namespace kte::detail {

/// Scales of the numbers of a step: 1 for rotations; for lengths the size of the box around all frames at the present
/// q.
inline Eigen::VectorXd weights_of_steps(static_problem& f, const Eigen::VectorXd& q, double p) {
  f.forces(q, p);
  const double length = f.extent();
  Eigen::VectorXd w = Eigen::VectorXd::Ones(f.size());
  const auto& body_tree = f.state().tree().body_tree;
  for (const auto& r : body_tree.nodes)
    for (int k = 0; k < r.axes; ++k) {
      const int row = body_tree.row[static_cast<std::size_t>(r.first + k)];
      const bool slides =
          r.moves == tree::joint::several ? r.axis[static_cast<std::size_t>(k)] < 3 : r.moves == tree::joint::prismatic;
      if (slides && row < f.size()) w[row] = 1 / length;
    }
  return w;
}

/// An additional row that lets p vary: a step (d, dp) satisfies normal . d + by_parameter dp = 0.
struct path_plane {
  Eigen::VectorXd normal;
  double by_parameter;
};

/// Factors of K, or with a plane of
///
///   | K       d tau/dp     |
///   | normal  by_parameter |
class tangent_factors {
 public:
  bool factor(static_problem& f, const Eigen::VectorXd& q, double p, const path_plane* plane) {
    const sparse_matrix* m = &f.tangent(q, p);
    if (plane != nullptr) {
      border(*m, f.forces_by_parameter(q, p), *plane);
      m = &bordered_;
    }
    if (std::exchange(analyzed_, m->rows()) != m->rows()) lu_.analyzePattern(*m);
    lu_.factorize(*m);
    return lu_.info() == Eigen::Success;
  }
  /// The Newton step for forces tau. Its last number is dp.
  Eigen::VectorXd step(const Eigen::VectorXd& tau) {
    const Eigen::Index n = tau.size();
    Eigen::VectorXd right = Eigen::VectorXd::Zero(lu_.rows());
    right.head(n) = -tau;
    return padded(lu_.solve(right), n);
  }
  /// The direction of the path: normal . d + by_parameter dp = 1.
  Eigen::VectorXd direction() { return lu_.solve(Eigen::VectorXd::Unit(lu_.rows(), lu_.rows() - 1)); }

 private:
  static Eigen::VectorXd padded(const Eigen::VectorXd& x, Eigen::Index n) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(n + 1);
    all.head(x.size()) = x;
    return all;
  }
  void border(const sparse_matrix& k, const Eigen::VectorXd& by_p, const path_plane& plane) {
    const Eigen::Index n = k.rows();
    bordered_.resize(n + 1, n + 1);
    bordered_.reserve(k.nonZeros() + 2 * n + 1);
    for (Eigen::Index j = 0; j < n; ++j) {
      bordered_.startVec(j);
      for (sparse_matrix::InnerIterator x(k, j); x; ++x) bordered_.insertBack(x.row(), j) = x.value();
      bordered_.insertBack(n, j) = plane.normal[j];
    }
    bordered_.startVec(n);
    for (Eigen::Index i = 0; i < n; ++i) bordered_.insertBack(i, n) = by_p[i];
    bordered_.insertBack(n, n) = plane.by_parameter;
    bordered_.finalize();
  }

  Eigen::SparseLU<sparse_matrix, Eigen::COLAMDOrdering<int>> lu_;
  sparse_matrix bordered_;
  Eigen::Index analyzed_ = -1;  ///< rows of the pattern that was analyzed
};

/// Newton's method with steps by `integrate`. A step is judged by the simplified Newton step after it, K^-1 tau with
/// the same factors, not by forces, because stretched beams have large forces that the next step removes (Deuflhard,
/// Newton Methods for Nonlinear Problems, 2004, 3.3).
class static_newton {
 public:
  static_newton(static_problem& f, Eigen::VectorXd weights, double tolerance, int most)
      : f_(f), weights_(std::move(weights)), tolerance_(tolerance), most_(most) {}

  /// The largest number of a step, without dp.
  double size_of(const Eigen::VectorXd& step) const {
    double most = 0;
    for (Eigen::Index i = 0; i < weights_.size(); ++i) {
      const double part = std::abs(weights_[i] * step[i]);
      if (!(part <= most)) most = part;
    }
    return most;
  }
  const Eigen::VectorXd& weights() const { return weights_; }
  int iterations() const { return iterations_; }
  int left() const { return most_ - iterations_; }
  tangent_factors& factors() { return factors_; }

  /// Newton's method from q and p, which become the solution, or remain unchanged. `close`: full steps, which must be
  /// short and few; otherwise damped steps.
  bool solve(Eigen::VectorXd& q, double& p, bool close, const path_plane* plane = nullptr) {
    Eigen::VectorXd at = q, tau = f_.forces(q, p);
    double at_p = p, before = std::numeric_limits<double>::infinity();
    for (const int end = close ? iterations_ + longest_way : most_; iterations_ < (std::min)(end, most_);) {
      ++iterations_;
      look_for_interruption();
      if (!factors_.factor(f_, at, at_p, plane)) return false;
      const Eigen::VectorXd step = factors_.step(tau);
      const double size = size_of(step);
      if (!(size <= (std::numeric_limits<double>::max)()) || (close && size > longest)) return false;
      const bool done = size <= tolerance_ || (before < 1e-7 && size > before / 4);
      if (close || done) {
        if (!move(at, at_p, step, tau)) return false;
      } else if (!move_damped(at, at_p, step, size, tau)) {
        return false;
      }
      at = moved_, at_p = moved_p_, before = size;
      if (!done) continue;
      q = at, p = at_p;
      return true;
    }
    return false;
  }

 private:
  static constexpr double longest = 0.7;  ///< step size, rad
  static constexpr int longest_way = 20;  ///< steps

  bool move_damped(const Eigen::VectorXd& q, double p, const Eigen::VectorXd& step, double size, Eigen::VectorXd& tau) {
    for (double part = (std::min)(1.0, longest / size); part > 1e-6; part /= 2)
      if (move(q, p, part * step, tau) && size_of(factors_.step(tau)) <= (1 - part / 4) * size) return true;
    return false;
  }

  /// Computes the result of a step, `moved_`, and the forces there. Returns false if the forces are undefined.
  bool move(const Eigen::VectorXd& q, double p, const Eigen::VectorXd& step, Eigen::VectorXd& tau) {
    try {
      const Eigen::VectorXd to = f_.displaced(q, step.head(f_.size()));
      tau = f_.forces(to, p + step[f_.size()]);
      moved_ = to, moved_p_ = p + step[f_.size()];
      return true;
    } catch (const bad_argument&) {  // forces may be undefined far away: a beam whose ends meet
      return false;
    }
  }

  static_problem& f_;
  Eigen::VectorXd weights_, moved_;
  double tolerance_, moved_p_ = 0;
  int most_, iterations_ = 0;
  tangent_factors factors_;
};

/// The coordinate that moves most along the null space of K; empty if K is regular to rounding.
inline std::string coordinate_not_held(static_problem& f, const Eigen::VectorXd& q, double p) {
  sparse_matrix k = f.tangent(q, p);
  const double most = largest_number(k);
  const double tiny = most > 0 ? 1e-14 * most : 1.0;
  for (int j = 0; j < f.size(); ++j) k.coeffRef(j, j) += tiny;
  Eigen::SparseLU<sparse_matrix, Eigen::COLAMDOrdering<int>> lu(k);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(f.size(), 1, 2);
  for (int i = 0; i < 3 && lu.info() == Eigen::Success; ++i) x = lu.solve(x).normalized();
  Eigen::Index row = 0;
  x.cwiseAbs().maxCoeff(&row);
  if (lu.info() == Eigen::Success && (k * x).norm() > 1e-12 * most + 2 * tiny) return {};
  return std::string(name_of_row(layout_of_state(f.state()), static_cast<int>(row)));
}

}  // namespace kte::detail
