#pragma once

#include <kte/models/saltation_matrix.hpp>

#include <Eigen/LU>

namespace kte {

/// The derivative Phi of the state by the state at the start, along a motion of a model with rigid contacts: an
/// observer of an integration with events.
///
///   kte::transition_matrix phi(model);
///   solver.integrate(10.0, kte::element_events(model), phi);
///   phi.matrix()                                               // (dq, dv) by (dq, dv), along the numbers of v
///
/// Between events Phi' = A Phi, with A of the modes of contacts, by the collocation method of Gauss with five stages,
/// of order 10, on the dense output of each step. At events Phi^+ = S Phi, with S of `saltation_matrix`. Phi(0)
/// projects displacements onto those that keep contacts closed. Start from `settled` states; later integrations go on.
/// Errors as for `saltation_matrix`.
template <class Model>
class transition_matrix {
 public:
  explicit transition_matrix(const Model& model) : model_(detail::model_at_run_time(model)) {}

  /// Phi.
  [[nodiscard]] const Eigen::MatrixXd& matrix() const { return phi_; }

  // ---- the calls of an observer of steps
  using follows_steps = void;
  /// Begins an integration.
  template <class Solver>
  bool start(const Solver& solver) {
    if (phi_.size() == 0)
      phi_ = detail::contact_projection_matrix(model_, solver.time(), Eigen::VectorXd(solver.state()));
    time_ = solver.time();
    return true;
  }
  /// Takes over a step.
  template <class Solver>
  bool step(const Solver& solver) {
    advance(solver, solver.time());
    return true;
  }
  /// Takes over a step until an event.
  template <class Solver, class S, class X>
  bool before(const Solver& solver, const S& t, const X& x) {
    advance(solver, t);
    before_ = x;
    return true;
  }
  /// Applies the event.
  template <class Solver, class S, class X>
  bool after(const Solver&, const S& t, const X& x) {
    const Eigen::VectorXd now = x;
    if (before_.size() == 0)
      detail::raise<bad_argument>("kte: modes of contacts change at the start: kte::settled gives consistent modes");
    phi_ = detail::contact_saltation_matrix(model_, t, before_, now) * phi_;
    before_.resize(0);
    return true;
  }
  /// Refuses a bridge.
  template <class S, class X>
  bool skip(const S& t, const X&, const S&, const X&) {
    detail::raise<bad_argument>("kte: derivatives across a bridge over contacts are not known, at t = " +
                                detail::number(t));
  }
  /// Integrations go on to their end.
  template <class Solver>
  bool settle(Solver&) {
    return false;
  }

 private:
  static constexpr int stages = 5;

  /// K_i = A_i (Phi + h sum_j a_ij K_j),   Phi + h sum_i b_i K_i
  template <class Solver>
  void advance(const Solver& solver, double end) {
    const double h = end - time_;
    if (h == 0) return;
    const Eigen::Index n = phi_.rows();
    const auto& g = gauss();
    Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(stages * n, stages * n), of(stages * n, n);
    for (int i = 0; i < stages; ++i) {
      const double t = time_ + g.place[i] * h;
      const Eigen::MatrixXd a = detail::contact_variation_matrix(model_, t, Eigen::VectorXd(solver.interpolate(t)));
      for (int j = 0; j < stages; ++j) whole.block(i * n, j * n, n, n) -= h * g.inner(i, j) * a;
      of.middleRows(i * n, n) = a * phi_;
    }
    const Eigen::MatrixXd slopes = whole.partialPivLu().solve(of);
    for (int i = 0; i < stages; ++i) phi_ += h * g.weight[i] * slopes.middleRows(i * n, n);
    time_ = end;
  }
  struct coefficients {
    Eigen::Matrix<double, stages, 1> place, weight;
    Eigen::Matrix<double, stages, stages> inner;
  };
  /// The integrals of polynomials through the zeros of the fifth Legendre polynomial.
  static const coefficients& gauss() {
    static const coefficients all = [] {
      coefficients g;
      const double inner_zero = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 6,
                   outer_zero = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 6;
      g.place << 0.5 - outer_zero, 0.5 - inner_zero, 0.5, 0.5 + inner_zero, 0.5 + outer_zero;
      Eigen::Matrix<double, stages, stages> powers, integrals;
      Eigen::Matrix<double, 1, stages> to_end;
      for (int k = 0; k < stages; ++k) {
        powers.col(k) = g.place.array().pow(k);
        integrals.col(k) = g.place.array().pow(k + 1) / (k + 1), to_end[k] = 1.0 / (k + 1);
      }
      const Eigen::Matrix<double, stages, stages> inverse = powers.inverse();
      g.inner = integrals * inverse, g.weight = (to_end * inverse).transpose();
      return g;
    }();
    return all;
  }

  manipulator_dynamics_model<runtime_chain> model_;
  Eigen::MatrixXd phi_;
  double time_ = 0;
  Eigen::VectorXd before_;  ///< the state before the present event
};

}  // namespace kte
