#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <span>

namespace kte {

/// A contact of a friction problem: rows (n, t) in the plane, (n, t1, t2) in space, n first.
template <class S = double>
struct friction_contact {
  int rows = 3;                          ///< 2 in the plane, 3 in space
  S friction{};                          ///< mu >= 0 of sliding
  std::optional<S> sticking_friction{};  ///< mu_s >= mu of sticking; mu if not given
  /// Sliding in a fixed direction d, |d| = 1: lambda_t = -mu lambda_n d whatever u_t' is. In the plane d = (+-1, 0).
  std::optional<std::array<S, 2>> sliding{};
  bool pressed = false;  ///< whether lambda_n > 0 is demanded, as for a tangential impact
};

/// What a contact does in a solution of a friction problem.
enum class friction_mode {
  open,    ///< lambda = 0, u_n' >= 0
  sticks,  ///< u' = 0, |lambda_t| <= mu_s lambda_n
  slides   ///< u_n' = 0, lambda_t = -mu lambda_n u_t'/|u_t'|
};

/// The algorithm that found a solution of a friction problem.
enum class friction_method {
  none,          ///< no algorithm was needed, or none succeeded
  enumeration,   ///< of combinations of modes
  newton,        ///< Newton's method on the natural map
  continuation,  ///< Newton's method, from solutions for W + eps I with eps from 1 to 0
  admm,          ///< Newton's method from iterates of the alternating direction method of multipliers
  gauss_seidel   ///< Newton's method from iterates of the nonlinear Gauss-Seidel method
};
/// How the solution of a friction problem ended.
enum class friction_status {
  solved,             ///< lambda satisfies all laws
  several_solutions,  ///< solved; by enumeration, and there are solutions with other u'
  no_solution,        ///< by enumeration: there is none
  nearly_singular,    ///< by enumeration: none was found, but equations were too nearly singular to exclude one, as
                      ///< where a body stands on one that is 1e12 times lighter
  not_converged       ///< lambda has the smallest residual of all iterates
};

/// Forces and impulses with a larger residual are not taken: those of redundant contacts, as the corners of a face, may
/// end at some 1e-11.
inline constexpr double largest_residual = 1e-8;
/// Whether the solution of a friction problem is taken: solved, or within `largest_residual`.
template <class S>
constexpr bool is_taken(friction_status status, const S& residual) {
  return status == friction_status::solved || status == friction_status::several_solutions ||
         (status == friction_status::not_converged && residual <= S(largest_residual));
}

/// Settings of the solution of a friction problem.
template <class S = double>
struct friction_options {
  S tolerance = S(1e-12);  ///< of the residual
  /// lambda is the limit of those for W + eps I, eps to 0, as of contacts of equal stiffness: if all of them stick, the
  /// lambda of least norm with this u'. Costs time only where W is singular; false: lambda is near it, to about 1e-7.
  bool least_norm = true;
  bool polish = false;    ///< one more step of Newton's method where it helps
  int newton_steps = 40;  ///< at most, from each starting point
  int admm_steps = 2000;  ///< at most
  int sweeps = 1000;      ///< of the Gauss-Seidel method, at most
};

/// A friction problem: find lambda with u' = W lambda + b and, for each contact,
///
///   lambda_n >= 0,   u_n' >= 0,   lambda_n u_n' = 0,   |lambda_t| <= mu lambda_n,
///   u_t' = 0  or  lambda_t = -mu lambda_n u_t'/|u_t'|                                     (1)
///
/// W = J M^-1 J^T is symmetric and positive semidefinite. Rows of contacts follow each other. This is a view: what it
/// refers to must outlive it.
template <class S = double>
struct friction_problem {
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  Eigen::Map<const matrix, 0, Eigen::OuterStride<>> W;
  Eigen::Map<const vector> b;
  std::span<const friction_contact<S>> contacts;

  friction_problem(Eigen::Ref<const matrix> W_, Eigen::Ref<const vector> b_, std::span<const friction_contact<S>> of)
      : W(W_.data(), W_.rows(), W_.cols(), Eigen::OuterStride<>(W_.outerStride())),
        b(b_.data(), b_.size()),
        contacts(of) {}
};

}  // namespace kte
