#pragma once

#include <kte/contact/friction_problem.hpp>
#include <kte/dynamics/closed_loops/loop_dynamics.hpp>
#include <kte/dynamics/contacts/contact_at.hpp>
#include <kte/dynamics/contacts/frames_of_contacts.hpp>
#include <kte/dynamics/contacts/kept_size.hpp>

#include <string>

/// The contacts that touch at a state, in rows (n, t_1, t_2) of a basis of each contact, (n, t_1) in the plane. Rows in
/// m are divided by the length of the chain, as those of closures.
///
///   u = J v,   u' = J a + J_dot v                                     (1)
///   W = B^T B,   B = L^-T J^T,   M = L^T L                            (2)
///
/// With closures, J_C v = 0, the motion is on the loops, and B is projected: with B_C = Q R,
///
///   B <- (1 - Q Q^T) B,   u' <- u' - B^T Q R^-T u'_C                  (3)
namespace kte::detail {

/// The equations of the contacts of a chain, and its memory.
struct contact_workspace {
  contact_workspace(const chain_constraints& c, const runtime_state& s);

  loop_equations equations;
  loop_factor factor;
  std::vector<contact_at> contacts;
  std::vector<int> closures;
  std::vector<int> touching;  ///< numbers among `contacts`

  kept_size<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> b;  ///< B of (2): places by rows
  kept_size<Eigen::MatrixXd> w;                                                         ///< W
  kept_size<Eigen::VectorXd> bias;    ///< u' without forces of contacts, or u
  kept_size<Eigen::VectorXd> forces;  ///< lambda
  std::vector<friction_contact<>> laws;
  pivoted_qr loops;                    ///< B_C = Q R
  Eigen::VectorXd loop_bias;           ///< R^-T u'_C
  kept_size<Eigen::MatrixXd> overlap;  ///< Q^T B
  std::vector<int> loop_rows;          ///< of closures, among all
  Eigen::VectorXd half, change;

  const closure_place& place(const contact_at& x) const {
    return equations.places.closures[static_cast<std::size_t>(x.closure)];
  }
  contact_at& touched(std::size_t i) { return contacts[static_cast<std::size_t>(touching[i])]; }
  const contact_at& touched(std::size_t i) const { return contacts[static_cast<std::size_t>(touching[i])]; }

  /// Computes the places and slip velocities of contacts from motions in the working memory of the state, of those
  /// with filter(closure); call `at_positions` of the equations first, or `at_velocities`, with these motions.
  template <class Filter = every_closure>
  void find(const chain_constraints& c, const runtime_state& s, const Filter& filter = {}) {
    for (auto& x : contacts)
      if (filter(x.closure)) x.motion = equations.motion(s, x.closure), locate(c, x, x.motion);
  }
  /// As `find`, without equations.
  void find_anew(const chain_constraints& c, const runtime_state& s) {
    for (auto& x : contacts) locate(c, x, loop_equations::moving_between(s, place(x)));
  }
  /// As `find` in a tree, from bias motions in the working memory of the state.
  void find_biased(const chain_constraints& c, const runtime_state& s) {
    for (auto& x : contacts) {
      locate(c, x, equations.biased_motion(s, x.closure));
    }
  }
  /// The place of a contact in the relative motion m of its frames. Errors name the contact.
  template <class Motion>
  void locate(const chain_constraints& c, contact_at& x, const Motion& m) {
    put_place(c, x, [&] { return c.touch_at(place(x).element, m); });
  }
  /// The place of a contact, from find_place(). Errors name the contact.
  template <class Find>
  KTE_INLINE void put_place(const chain_constraints& c, contact_at& x, const Find& find_place) {
#if defined(__cpp_exceptions)
    try {
      x.place = find_place();
    } catch (const bad_argument& e) {
      refuse_place(c, x, e.what());
    }
#else
    x.place = find_place();
#endif
    x.slip = x.place.slip;
    if (!is_unit(x.place.normal)) [[unlikely]]
      refuse_place(c, x, no_normal_here);
  }
  [[noreturn, gnu::cold]] void refuse_place(const chain_constraints& c, const contact_at& x, std::string_view why) {
    raise<bad_argument>(text_of_no_place(std::string(c.loop_name(place(x).loop)), why));
  }
  /// The rows of a contact of those of all, such as J v, in m.
  vec3<> unscaled(const contact_at& x, const Eigen::VectorXd& all) const;
  /// Whether a contact touches.
  bool touches(const contact_at& x) const { return !x.passes && x.place.gap <= touching_gap * equations.places.length; }
  /// Chooses contacts that touch, those for which `chosen`, and sets their bases.
  template <class Chosen>
  void choose(const Chosen& chosen) {
    touching.clear();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      contacts[i].touches = chosen(contacts[i]);
      if (contacts[i].touches) touching.push_back(static_cast<int>(i));
    }
    order_rows();
  }
  /// As `choose`, contacts by their numbers, in this order.
  void choose(const std::vector<int>& chosen) { touching = chosen, order_rows(); }
  /// The contact i of those that touch slides in the direction of its slip velocity, or in a direction.
  void let_slide(std::size_t i) {
    const vec3<> t = tangential(touched(i));
    let_slide(i, (1 / std::sqrt(dot(t, t))) * t);
  }
  void let_slide(std::size_t i, const vec3<>& direction) {
    auto& x = touched(i);
    x.basis = basis_along(x.place.normal, direction);
    laws[i].sliding = std::array<double, 2>{1, 0};
  }
  static vec3<> tangential(const contact_at& x) { return x.slip - dot(x.place.normal, x.slip) * x.place.normal; }
  /// The rows of contact x of those of a vector in axes of its surface.
  template <class Rows>
  void put_rows(const contact_at& x, const vec3<>& of, Rows& rows) const {
    for (int k = 0; k < x.rows(); ++k)
      rows[x.first + k] = dot(x.basis[static_cast<std::size_t>(k)], of) / equations.places.length;
  }
  vec3<> force_of(const contact_at& x) const;
  /// (2) and (3); call (1) of the factor at the positions of the state first. `of_closures`: u' of their rows.
  void make_matrix(const chain_constraints& c, runtime_state& s, const Eigen::VectorXd& of_closures) {
    make_matrix<false>(c, s, of_closures);
  }
  /// (2) alone, as if there were no closures.
  void make_matrix_of_tree(const chain_constraints& c, runtime_state& s) {
    const bool by_paths = !factor.is_dense();
    for (std::size_t i = 0; by_paths && i < touching.size(); ++i) put_rows_on_path<false>(s, touched(i));
    if (by_paths) return multiply_paths();
    put_rows_in_matrix(c, s), multiply_rows();
  }
  /// As `make_matrix` in a tree, and `bias` = u' without forces of contacts; call `find_biased` first.
  void make_matrix_and_bias(const chain_constraints& c, runtime_state& s) {
    make_matrix<true>(c, s, equations.acceleration);
  }
  /// The u' of (3), from `bias`, for u' of the rows of closures. For another bias after `make_matrix`.
  void subtract_closures(const Eigen::VectorXd& of_closures);
  /// d = L^-1 B lambda, with the part of closures, by degrees of freedom.
  void accelerate(runtime_state& s, Eigen::VectorXd& d) {
    find_half_change();
    factor.other_half(s, equations, half, d);
  }

  /// As `accelerate` in a tree with articulated inertias in the working memory of the state, whose accelerations
  /// `accelerate_after` finds.
  void accelerate_with_tree(runtime_state& s) {
    find_half_change();
    factor.add_half_change(s, equations, half);
  }

  /// The kinetic energy lost where velocities are projected onto the closures, J: u'_C is J_C v.
  double energy_of_closures() const { return closures.empty() ? 0.0 : loop_bias.head(loops.rank()).squaredNorm() / 2; }
  /// The forces of closures, by rows of all: R^-1 (-R^-T u'_C - Q^T B lambda).
  void put_loop_forces(Eigen::VectorXd& all);

 private:
  template <bool Accelerate>
  void make_matrix(const chain_constraints& c, runtime_state& s, const Eigen::VectorXd& of_closures) {
    const bool by_paths = !factor.is_dense();
    for (std::size_t i = 0; by_paths && i < touching.size(); ++i) put_rows_on_path<Accelerate>(s, touched(i));
    if (by_paths && closures.empty()) return multiply_paths();
    put_rows_in_matrix(c, s);
    if (!closures.empty()) project<Accelerate>(c, s), subtract_closures(of_closures);
    multiply_rows();
  }
  void multiply_rows() {
    w.resize(b.cols(), b.cols());
    w.noalias() = b.transpose() * b;
  }
  /// Sets the bases, rows and laws of `touching`.
  void order_rows() {
    laws.clear();
    int row = 0;
    for (const int i : touching) {
      auto& x = contacts[static_cast<std::size_t>(i)];
      x.basis = basis_at(x.place.normal, x.planar), x.first = row, row += x.rows();
      friction_contact<> law;
      law.rows = x.rows(), law.friction = x.place.law.friction;
      laws.push_back(law);
    }
    bias.resize(row), forces.setZero(row);
  }
  /// B lambda with the part of closures, to `half`.
  void find_half_change();
  /// half = B lambda.
  void push_forces();
  /// Rows of a contact in a tree, by the places on its path: B, with `Accelerate` also `bias`.
  template <bool Accelerate>
  void put_rows_on_path(runtime_state& s, contact_at& x) {
    const auto& m = equations.place(x.closure);
    const auto to_body = transpose(m.rotation);
    const vec3<> arm = x.place.point - m.position;
    double units[6 * closing_stride]{};
    for (int k = 0; k < x.rows(); ++k) {
      const vec3<> n = (1 / equations.places.length) * x.basis[static_cast<std::size_t>(k)];
      const vec3<> force = to_body * n, torque = to_body * cross(arm, n);
      const double all[6]{force.x, force.y, force.z, torque.x, torque.y, torque.z};
      for (int j = 0; j < 6; ++j) units[j * closing_stride + k] = all[j];
    }
    if constexpr (Accelerate) {
      put_rows(x, x.place.slip_rate, bias);
      bias[x.first] += x.place.bending / equations.places.length;
    }
    std::size_t count = 0;
    int before = 0;
    factor.half_solve_units<Accelerate>(
        s, equations, x.closure, units, x.rows(),
        [&](std::size_t at, int first, const tree::simd<double>& entries) KTE_INLINE_LAMBDA {
          if (first != before) before = first, count = 0;
          if (count == x.path.size()) x.path.emplace_back();
          auto& to = x.path[count++];
          to.place = static_cast<int>(at);
          tree::store<double>(entries, &to.entries[static_cast<std::size_t>(first)]);
        },
        [&](int k, double rate) { bias[x.first + k] += rate; });
  }
  /// B as a matrix, with closures and in chains that are not trees.
  void put_rows_in_matrix(const chain_constraints& c, runtime_state& s);
  /// W of contacts by their paths.
  void multiply_paths() {
    w.resize(bias.size(), bias.size());
    for (std::size_t i = 0; i < touching.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) multiply(touched(i), touched(j));
  }
  void multiply(const contact_at& x, const contact_at& y);
  template <bool Accelerate>
  void project(const chain_constraints& c, runtime_state& s) {
    int rows = 0;
    for (const int k : closures) rows += equations.places.closures[static_cast<std::size_t>(k)].rows.count();
    auto of = loops.matrix(b.rows(), rows);
    of.setZero();
    int first = 0;
    for (const int k : closures) {
      factor.half_solve<Accelerate>(c, s, equations, k,
                                    [&](int at, int row, double entry) { of(at, first + row) = entry; });
      first += equations.places.closures[static_cast<std::size_t>(k)].rows.count();
    }
    loops.choose(least_pivot);
    loop_rows.clear();
    for (const int k : closures) {
      const auto& x = equations.places.closures[static_cast<std::size_t>(k)];
      for (int r = 0; r < x.rows.count(); ++r) loop_rows.push_back(x.first + r);
    }
    const auto rank = loops.rank();
    overlap.resize(rank, b.cols());
    half.resize(b.rows() + pivoted_qr::padding), change.resize(half.size());
    for (Eigen::Index k = 0; k < b.cols(); ++k) {
      half.setZero(), half.head(b.rows()) = b.col(k);
      loops.times_q_transposed(half.data());
      overlap.col(k) = half.head(rank);
      loops.times_q(half.data(), change.data());
      b.col(k) -= change.head(b.rows());
    }
  }
};

#ifdef KTE_FUNCTION
KTE_FUNCTION contact_workspace::contact_workspace(const chain_constraints& c, const runtime_state& s)
    : equations(c, s) {
  const auto& all = equations.places.closures;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (c.touches(all[i].element)) {
      refuse_fixed_frames(c, s, all[i]);
      contact_at x;
      x.closure = static_cast<int>(i), x.slot = all[i].loop - c.loops();
      x.planar = all[i].rows.count() == 2, x.has_gate = c.has_gate(all[i].element);
      contacts.push_back(x);
    } else {
      closures.push_back(static_cast<int>(i));
    }
}
KTE_FUNCTION vec3<> contact_workspace::unscaled(const contact_at& x, const Eigen::VectorXd& all) const {
  const auto& at = place(x);
  const auto row = [&](int k) { return k < at.rows.count() ? all[at.first + k] / equations.places.scale(at, k) : 0.0; };
  return {row(0), row(1), row(2)};
}
KTE_FUNCTION vec3<> contact_workspace::force_of(const contact_at& x) const {
  vec3<> f{};
  for (int k = 0; k < x.rows(); ++k)
    f = f + forces[x.first + k] / equations.places.length * x.basis[static_cast<std::size_t>(k)];
  return f;
}
KTE_FUNCTION void contact_workspace::subtract_closures(const Eigen::VectorXd& of_closures) {
  if (closures.empty()) return;
  loop_bias.setZero(static_cast<Eigen::Index>(loop_rows.size()) + pivoted_qr::padding);
  for (std::size_t k = 0; k < loops.chosen.size(); ++k)
    loop_bias[static_cast<Eigen::Index>(k)] = of_closures[loop_rows[static_cast<std::size_t>(loops.chosen[k])]];
  loops.solve_transposed(loop_bias.data());
  for (Eigen::Index k = 0; k < b.cols(); ++k) bias[k] -= overlap.col(k).dot(loop_bias.head(loops.rank()));
}
KTE_FUNCTION void contact_workspace::put_loop_forces(Eigen::VectorXd& all) {
  all.setZero(equations.places.rows);
  if (closures.empty()) return;
  half = -loop_bias;
  half.head(loops.rank()) -= overlap * forces;
  loops.solve(half.data());
  for (std::size_t k = 0; k < loops.chosen.size(); ++k)
    all[loop_rows[static_cast<std::size_t>(loops.chosen[k])]] = half[static_cast<Eigen::Index>(k)];
}
KTE_FUNCTION void contact_workspace::find_half_change() {
  push_forces();
  if (closures.empty()) return;
  change.setZero(half.size());
  loops.times_q(loop_bias.data(), change.data());
  half -= change;
}
KTE_FUNCTION void contact_workspace::push_forces() {
  const auto places = static_cast<Eigen::Index>(equations.places.row_of_place.size());
  half.setZero(places + pivoted_qr::padding);
  if (factor.is_dense() || !closures.empty()) {
    half.head(places).noalias() = b * forces;
    return;
  }
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const auto& x = touched(i);
    for (const auto& at : x.path)
      for (int k = 0; k < x.rows(); ++k)
        half[at.place] += at.entries[static_cast<std::size_t>(k)] * forces[x.first + k];
  }
}
KTE_FUNCTION void contact_workspace::put_rows_in_matrix(const chain_constraints& c, runtime_state& s) {
  b.setZero(static_cast<Eigen::Index>(equations.places.row_of_place.size()), bias.size());
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const auto& x = touched(i);
    if (!factor.is_dense()) {
      for (const auto& at : x.path)
        for (int k = 0; k < x.rows(); ++k) b(at.place, x.first + k) += at.entries[static_cast<std::size_t>(k)];
      continue;
    }
    factor.half_solve(c, s, equations, x.closure, [&](int at, int row, double entry) {
      for (int k = 0; k < x.rows(); ++k) {
        const auto& axis = x.basis[static_cast<std::size_t>(k)];
        b(at, x.first + k) += (row == 0 ? axis.x : row == 1 ? axis.y : axis.z) * entry;
      }
    });
  }
}
KTE_FUNCTION void contact_workspace::multiply(const contact_at& x, const contact_at& y) {
  using simd = tree::simd<double, row_lanes>;
  simd sum[3]{};
  auto a = x.path.rbegin();
  auto b_of = y.path.rbegin();
  while (a != x.path.rend() && b_of != y.path.rend()) {  // places ascend from the bases
    if (a->place != b_of->place) {
      a->place < b_of->place ? ++a : ++b_of;
      continue;
    }
    simd of_x;
    tree::load<double>(of_x, a->entries.data());
    for (std::size_t k = 0; k < 3; ++k) sum[k] += b_of->entries[k] * of_x;
    ++a, ++b_of;
  }
  for (int k = 0; k < y.rows(); ++k) {
    double column[row_lanes];
    tree::store<double>(sum[k], column);
    for (int r = 0; r < x.rows(); ++r) w(x.first + r, y.first + k) = w(y.first + k, x.first + r) = column[r];
  }
}
#endif

}  // namespace kte::detail
