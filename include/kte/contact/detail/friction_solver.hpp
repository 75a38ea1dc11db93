#pragma once

#include <kte/contact/detail/cholesky.hpp>
#include <kte/contact/detail/friction_modes.hpp>
#include <kte/contact/friction_solver.hpp>

namespace kte {

/// Tries the solution where all contacts stick, inside their cones.
template <class S>
bool friction_solver<S>::stick(const friction_options<S>& o) {
  for (std::size_t k = 0; k < system_.contacts.size(); ++k)
    if (system_.contacts[k].sliding || !(system_.mu[k] > S(0)) || system_.contacts[k].pressed) return false;
  if (!sticking_.solve(system_, found_.lambda.data())) return false;
  detail::find_modes(system_, found_);
  for (const friction_mode mode : found_.modes)
    if (mode != friction_mode::sticks) return false;
  system_.velocity(found_.lambda.data(), found_.u.data());
  found_.residual = system_.residual(found_.lambda.data(), found_.u.data(), F_.data());
  if (!(found_.residual <= o.tolerance)) return false;
  found_.status = friction_status::solved, found_.method = friction_method::newton, found_.iterations = 1;
  return true;
}

template <class S>
bool friction_solver<S>::iterate(const friction_options<S>& o) {
  S* const lambda = found_.lambda.data();
  int& n = found_.iterations;
  S& residual = found_.residual;
  const auto done = [&](friction_method method) {
    found_.method = method;
    return residual <= o.tolerance;
  };
  n += newton_.solve(system_, lambda, S(0), (std::min)(o.newton_steps, 15), o.tolerance, false, residual);
  if (done(friction_method::newton)) return true;
  n += newton_.solve(system_, lambda, S(0), o.newton_steps, o.tolerance, true, residual);
  if (done(friction_method::newton)) return true;
  best_.assign(found_.lambda.begin(), found_.lambda.end());
  S best = residual;
  const auto keep = [&] {
    if (residual < best) best = residual, best_.assign(found_.lambda.begin(), found_.lambda.end());
  };
  if (rescue_.continuation(system_, newton_, lambda, o, n, residual)) return done(friction_method::continuation);
  keep();
  if (rescue_.admm(system_, newton_, lambda, o, n, residual)) return done(friction_method::admm);
  keep();
  if (rescue_.gauss_seidel(system_, newton_, lambda, o, n, residual)) return done(friction_method::gauss_seidel);
  keep();
  for (const double least : {0.3, 0.6, 0.85})  // other paths
    if (rescue_.continuation(system_, newton_, lambda, o, n, residual, S(least), 400))
      return done(friction_method::continuation);
  keep();
  found_.lambda.assign(best_.begin(), best_.end());
  residual = best;
  return false;
}

template <class S>
const friction_solution<S>& friction_solver<S>::solve(const friction_problem<S>& p, const friction_options<S>& o,
                                                      std::span<const S> start) {
  detail::check_friction_problem(p);
  if (!scaling_.scales(p, start)) [[likely]]
    return solve_unscaled(p, o, start);
  found_ = solve_unscaled(scaling_.scaled(p), o, scaling_.start());
  scaling_.unscale(found_.lambda, found_.u);
  return found_;
}

template <class S>
const friction_solution<S>& friction_solver<S>::solve_unscaled(const friction_problem<S>& p,
                                                               const friction_options<S>& o, std::span<const S> start) {
  system_.assign(p);
  const auto m = static_cast<std::size_t>(p.b.size());
  bool plane = p.contacts.size() <= 3, pressed = false, jammed = false;
  for (std::size_t k = 0; k < p.contacts.size(); ++k) {
    const auto& contact = p.contacts[k];
    plane = plane && contact.rows == 2, pressed = pressed || contact.pressed;
    jammed = jammed || system_.is_jammed(k);
  }
  if (plane || ((pressed || jammed) && enumeration_.combinations(system_) > 0)) return choose(o, start);

  found_.lambda.resize(m), found_.u.resize(m), found_.modes.resize(p.contacts.size()), F_.resize(m);
  found_.iterations = 0;
  for (std::size_t k = 0; k < p.contacts.size(); ++k)
    if (!p.contacts[k].sliding) system_.mu[k] = p.contacts[k].sticking_friction.value_or(p.contacts[k].friction);
  if (start.empty() && stick(o)) return found_;
  bool again = true, solved = false;
  while (again) {  // at most once for each contact: who slips with the friction of sticking gets that of sliding
    if (start.size() == m)
      std::copy_n(start.begin(), m, found_.lambda.begin());
    else
      std::fill(found_.lambda.begin(), found_.lambda.end(), S(0));
    if (pressed) press();
    solved = iterate(o);
    if (solved && o.least_norm) newton_.balance(system_, found_.lambda.data(), o.tolerance, found_.residual);
    if (solved && o.polish) found_.iterations += newton_.polish(system_, found_.lambda.data(), found_.residual);
    again = false;
    detail::find_modes(system_, found_);
    for (std::size_t k = 0; k < p.contacts.size() && solved; ++k) {
      if (found_.modes[k] != friction_mode::slides || !(system_.mu[k] > p.contacts[k].friction)) continue;
      system_.mu[k] = p.contacts[k].friction;
      again = true;
    }
  }
  system_.velocity(found_.lambda.data(), found_.u.data());
  found_.residual = system_.residual(found_.lambda.data(), found_.u.data(), F_.data());
  for (std::size_t k = 0; k < p.contacts.size(); ++k)
    if (p.contacts[k].pressed && found_.modes[k] == friction_mode::open) solved = false;
  found_.status = solved ? friction_status::solved : friction_status::not_converged;
  return found_;
}

/// Starts from contacts that all stick.
template <class S>
void friction_solver<S>::press() {
  detail::cholesky<S> factor;
  factor.factor(system_.W, system_.size, system_.stride, S(1e-9) * system_.unit);
  for (Eigen::Index r = 0; r < system_.size; ++r) found_.lambda[static_cast<std::size_t>(r)] = -system_.b[r];
  factor.solve(found_.lambda.data());
}

template <class S>
std::span<const friction_solution<S>> friction_solver<S>::solutions(const friction_problem<S>& p,
                                                                    const friction_options<S>& o) {
  using std::abs;
  detail::check_friction_problem(p);
  system_.assign(p);
  const int combinations = enumeration_.combinations(system_);
  if (combinations == 0)
    detail::raise<bad_argument>(
        "friction problem: only piecewise linear problems of up to 64 combinations have a list of solutions");
  return enumerate(o);
}

template <class S>
std::span<const friction_solution<S>> friction_solver<S>::enumerate(const friction_options<S>& o) {
  using std::abs;
  const auto m = static_cast<std::size_t>(system_.size);
  const int combinations = enumeration_.combinations(system_);
  F_.resize(m);
  std::size_t count = 0;
  enumeration_.nearly_singular = false;
  for (int i = 0; i < combinations; ++i) {
    if (all_.size() == count) all_.emplace_back();
    friction_solution<S>& x = all_[count];
    x.lambda.resize(m), x.u.resize(m), x.modes.resize(system_.contacts.size());
    if (!enumeration_.solve(system_, i, x.lambda.data(), x.modes.data())) continue;
    system_.velocity(x.lambda.data(), x.u.data());
    x.residual = system_.residual(x.lambda.data(), x.u.data(), F_.data());
    if (!(x.residual <= o.tolerance)) continue;
    x.status = friction_status::solved, x.method = friction_method::enumeration, x.iterations = i + 1;
    S scale(0);
    for (std::size_t r = 0; r < m; ++r) scale = (std::max)({scale, S(abs(system_.b[r])), S(abs(x.u[r]))});
    bool known = false;
    for (std::size_t other = 0; other < count && !known; ++other) {
      known = true;
      for (std::size_t r = 0; r < m; ++r) known = known && abs(x.u[r] - all_[other].u[r]) <= S(1e-9) * scale;
    }
    if (!known) ++count;
  }
  if (count > 1)
    for (std::size_t i = 0; i < count; ++i) all_[i].status = friction_status::several_solutions;
  return {all_.data(), count};
}

template <class S>
const friction_solution<S>& friction_solver<S>::choose(const friction_options<S>& o, std::span<const S> start) {
  const auto found = enumerate(o);
  const auto m = static_cast<std::size_t>(system_.size);
  if (found.empty()) {
    found_.lambda.assign(m, S(0)), found_.u.resize(m),
        found_.modes.assign(system_.contacts.size(), friction_mode::open);
    system_.velocity(found_.lambda.data(), found_.u.data());
    found_.residual = system_.residual(found_.lambda.data(), found_.u.data(), F_.data());
    found_.status = enumeration_.nearly_singular ? friction_status::nearly_singular : friction_status::no_solution;
    found_.method = friction_method::enumeration;
    return found_;
  }
  std::size_t best = 0;
  S least(0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    S measure(0);
    if (start.size() == m)
      for (std::size_t r = 0; r < m; ++r) measure += (found[i].lambda[r] - start[r]) * (found[i].lambda[r] - start[r]);
    else
      for (const friction_mode mode : found[i].modes) measure -= mode == friction_mode::open ? S(1) : S(0);
    if (i == 0 || measure < least) least = measure, best = i;
  }
  return found[best];
}

}  // namespace kte
