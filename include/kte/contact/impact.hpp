#pragma once

#include <kte/contact/friction_solver.hpp>
#include <kte/contact/impact_law.hpp>

namespace kte {

/// What an impact does.
template <class S = double>
struct impact_solution {
  std::vector<S> impulse;            ///< P, Ns
  std::vector<S> u;                  ///< u^+, m/s
  std::vector<friction_mode> modes;  ///< of each contact, of its last friction problem
  S energy{};                        ///< T^+ - T^- = P.(u^+ + u^-)/2, J
  S restitution_factor{1};           ///< theta of (3); of `sequential`, the least of all rounds
  int rounds = 1;                    ///< impacts of single contacts, of `sequential`
  friction_status status = friction_status::not_converged;
  S residual{};  ///< the largest of all friction problems

  /// Whether all friction problems were solved.
  bool solved() const { return status == friction_status::solved || status == friction_status::several_solutions; }
};

/// Resolves impacts with Newton's restitution e of each contact:
///
///   u^+ = W P + u^-, a friction problem of lambda = P, u_n' = u_n^+ + e u_n^-, u_t' = u_t^+     (1)
///   T^+ - T^- = P.(u^+ + u^-)/2                                                                 (2)
///   if (2) > 0: e -> theta e with the largest theta in [0, 1] that has (2) <= 0                 (3)
///
/// With e = 0, (2) is never positive. A contact that is `pressed` has a tangential impact: P_n > 0 is demanded.
template <class S = double>
class impact_solver {
 public:
  /// p.b is u^-, in the units of W P; one restitution for each contact, 0 <= e <= 1.
  const impact_solution<S>& solve(const friction_problem<S>& p, std::span<const S> restitution,
                                  impact_law law = impact_law::at_once, const friction_options<S>& options = {}) {
    if (restitution.size() != p.contacts.size())
      detail::raise<bad_argument>("impact: one restitution for each contact is needed");
    for (const S& e : restitution)
      if (!(e >= S(0) && e <= S(1))) detail::raise<bad_argument>("impact: restitution must be between 0 and 1");
    all_ = &p;
    options_ = options, options_.polish = true;
    const auto m = static_cast<std::size_t>(p.b.size());
    found_.status = friction_status::solved, found_.residual = S(0), found_.rounds = 1, found_.restitution_factor = S(1);
    found_.impulse.assign(m, S(0)), found_.modes.assign(p.contacts.size(), friction_mode::open);
    found_.u.assign(p.b.data(), p.b.data() + m);
    if (law == impact_law::sequential)
      one_at_a_time(p, restitution);
    else
      resolve(p, restitution, 0);
    found_.energy = S(0);
    for (std::size_t r = 0; r < m; ++r) found_.energy += found_.impulse[r] * (found_.u[r] + p.b[static_cast<Eigen::Index>(r)]) / 2;
    return found_;
  }

 private:
  void one_at_a_time(const friction_problem<S>& p, std::span<const S> restitution);
  void resolve(const friction_problem<S>& part, std::span<const S> restitution, std::size_t first);
  S gain(S theta, const friction_problem<S>& part, std::span<const S> restitution);

  impact_solution<S> found_;
  friction_solver<S> solver_;
  friction_options<S> options_;
  const friction_problem<S>* all_ = nullptr;
  const friction_solution<S>* last_ = nullptr;
  std::vector<S> b_, before_, start_;
};

}  // namespace kte

#include <kte/contact/detail/impact.hpp>
