#pragma once

#include <kte/contact/detail/friction_admm.hpp>
#include <kte/contact/detail/friction_enumeration.hpp>
#include <kte/contact/detail/friction_gauss_seidel.hpp>
#include <kte/contact/detail/friction_newton.hpp>
#include <kte/contact/detail/friction_rescue.hpp>
#include <kte/contact/detail/friction_scaling.hpp>
#include <kte/contact/detail/friction_sticking.hpp>
#include <kte/contact/friction_problem.hpp>
#include <kte/detail/compiled.hpp>

namespace kte {

/// What `friction_solver::solve` found.
template <class S = double>
struct friction_solution {
  std::vector<S> lambda;             ///< forces or impulses on rows of W
  std::vector<S> u;                  ///< W lambda + b
  std::vector<friction_mode> modes;  ///< of each contact
  friction_status status = friction_status::not_converged;
  friction_method method = friction_method::none;
  int iterations = 0;  ///< of all methods together
  S residual{};        ///< of the natural map, relative to the largest lambda and b/W_ii

  /// Whether lambda solves the problem to the tolerance.
  bool solved() const { return status == friction_status::solved || status == friction_status::several_solutions; }
};

/// Solves friction problems. Keeps its storage: a second problem of at most the size of one before allocates nothing,
/// except by the methods after Newton's if the size changes.
template <class S = double>
class friction_solver {
 public:
  /// The solution of p, from the start `lambda` if it is given (m numbers): by enumeration for plane problems of up to
  /// 3 contacts; else that where all contacts stick, if it satisfies the laws; else by Newton's method on the natural
  /// map of Alart and Curnier, and if that fails, by it with damping, from solutions of regularised problems
  /// (W + eps I, eps to 0), from iterates of ADMM, and from those of the Gauss-Seidel method. W that is singular: see
  /// `friction_options::least_norm`. If W_nn of contacts differ by more than 1e4, in scaled numbers, also for norms.
  const friction_solution<S>& solve(const friction_problem<S>& p, const friction_options<S>& options = {},
                                    std::span<const S> start = {});

  /// All solutions with different u' of a problem of plane contacts, contacts that slide in a fixed direction or have
  /// no friction: at most 64 combinations of modes; throws `bad_argument` else. If several have one u', that with most
  /// sticking contacts.
  std::span<const friction_solution<S>> solutions(const friction_problem<S>& p,
                                                  const friction_options<S>& options = {});

 private:
  const friction_solution<S>& solve_unscaled(const friction_problem<S>& p, const friction_options<S>& options,
                                             std::span<const S> start);
  bool stick(const friction_options<S>& options);
  bool iterate(const friction_options<S>& options);
  void press();
  std::span<const friction_solution<S>> enumerate(const friction_options<S>& options);
  const friction_solution<S>& choose(const friction_options<S>& options, std::span<const S> start);

  detail::friction_scaling<S> scaling_;
  detail::friction_system<S> system_;
  detail::friction_newton<S> newton_;
  detail::friction_sticking<S> sticking_;
  detail::friction_rescue<S> rescue_;
  detail::friction_enumeration<S> enumeration_;
  std::vector<friction_solution<S>> all_;
  friction_solution<S> found_;
  std::vector<S> F_, best_;
};

}  // namespace kte

#include <kte/contact/detail/friction_solver.hpp>

#ifdef KTE_EXTERN
namespace kte {
KTE_EXTERN template class friction_solver<double>;
}
#endif
