#pragma once

#include <kte/dynamics/detail/record_loops.hpp>

#include <algorithm>

/// What few chains have, in the loops over records: masses between several things, and friction that depends on what
/// joints carry. `Elements` and states as in dynamics/detail/record_loops.hpp.
namespace kte::detail {

/// Rates and accelerations of all degrees of freedom, put aside; they are zero until this goes.
template <class State>
class motion_aside {
 public:
  explicit motion_aside(State& s) : state_(s), v_(s.dofs()), a_(s.dofs()) {
    read_listed_numbers<vector_of::v>(s, v_), read_listed_numbers<vector_of::a>(s, a_);
    const decltype(v_) none = decltype(v_)::Zero(s.dofs());
    put_all(none, none);
  }
  ~motion_aside() { put_all(v_, a_); }
  motion_aside(const motion_aside&) = delete;
  motion_aside& operator=(const motion_aside&) = delete;

 private:
  template <class V>
  void put_all(const V& v, const V& a) {
    for_each_listed_freedom(
        state_, [&](auto& x, const freedom& at) { put<vector_of::v>(x, at, v), put<vector_of::a>(x, at, a); });
  }
  State& state_;
  Eigen::Matrix<typename State::scalar, Eigen::Dynamic, 1> v_, a_;
};

/// The forces of masses between several things on the degrees of freedom, at rest under the accelerations of the state.
template <class Elements, class State>
void forces_of_spread_masses(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  bring_up_to_date(c, s);
  take_rates(s);
  for (std::size_t b = 0; b < static_cast<std::size_t>(t.forest.bases); ++b) w.bodies[b] = {};
  tree::move_bodies<true>(t.forest, w);
  place_touched_frames(s, true);
  clear_coordinates(s);
  for (const int e : t.spread) c.mass_loads(e, s);
  for (auto& b : w.bodies) b.needs = {};
  for_each_frame_load(s, [&w](std::size_t slot, const tree::dense_wrench<S>& x) {
    auto& needs = w.bodies[slot].needs;
    needs = {needs.force - x.force, needs.torque - x.torque};
  });
  tree::take_needs(t.forest, w);
  for (const auto& r : t.forest.records)
    each_axis<vector_of::f>(s, r, [&w](auto& f, std::size_t k) { f -= w.force[k]; });
  push_on_coordinates(c, s, acting::bodies);
}
/// Their part of the mass matrix, by columns: the forces that unit accelerations need,
///
///   M = sum J^T M_e J          (1)
///
/// with M_e of an element over its ports. After `place_bodies`.
template <class Elements, class State, class Matrix>
void add_spread_masses(const Elements& c, State& s, Matrix& m) {
  using S = typename State::scalar;
  const motion_aside<State> aside(s);
  place_in_world(s);
  Eigen::Matrix<S, Eigen::Dynamic, 1> a = Eigen::Matrix<S, Eigen::Dynamic, 1>::Zero(s.dofs()), none(s.dofs()),
                                      f(s.dofs());
  const auto forces_at = [&](auto& forces) {
    for_each_listed_freedom(s, [&](auto& x, const freedom& at) { put<vector_of::a>(x, at, a); });
    forces_of_spread_masses(c, s);
    read_listed_numbers<vector_of::f>(s, forces);
  };
  forces_at(none);  // not zero where a motion is given
  for (int j = 0; j < s.dofs(); ++j) {
    a[j] = S(1);
    forces_at(f);
    for (int i = j; i < s.dofs(); ++i) {  // the other triangle is the same but for rounding
      const S mass = none[i] - f[i];
      m(i, j) += mass;
      if (i != j) m(j, i) += mass;
    }
    a[j] = S(0);
  }
}

/// Of the i-th joint that has friction by what it carries.
template <class Elements, class State>
[[noreturn, gnu::cold, gnu::noinline]] void blame_friction(const Elements& c, const State& s, Eigen::Index i) {
  const auto& t = s.tree();
  const int e = t.readers[static_cast<std::size_t>(i)];
  const int slot = t.forest.frame(c.ports(e).back().what, c.written(e)).slot - t.forest.bases;
  c.blame_friction(s, t.forest.row[static_cast<std::size_t>(t.forest.records[static_cast<std::size_t>(slot)].first)]);
}

/// Accelerations where joints have friction by what they carry: sweep() computes them with the friction in the working
/// memory, and of them the friction follows again. Broyden's iteration for
///
///   r(x) = friction(a(x)) - x = 0          (2)
///
/// which ends at rounding. Where r' is so near to singular that this makes x lose half its digits, |r'^-1| |x| > |x| /
/// sqrt(eps), joints are about to jam (Painleve 1895), and on the other side of that there is no x: throws
/// `no_solution` for both, with the first coordinate where it is so. (Broyden, Math. Comp. 19 (1965), his first
/// method.)
template <class Elements, class State, class Sweep>
void iterate_friction(const Elements& c, State& s, const Sweep& sweep) {
  using S = typename State::scalar;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  const auto n = static_cast<Eigen::Index>(s.tree().readers.size());
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> inverse = -decltype(inverse)::Identity(n, n);  // of r'
  vector x = vector::Zero(n), r(n), before(n), step(n), column(n);
  const auto residual = [&] {
    std::copy(x.begin(), x.end(), s.work.friction.begin());
    sweep();
    forces_on_coordinates(c, s, acting::with_given_friction);
    Eigen::Index i = 0;
    for_each_friction(c, s, [&](const auto&, const S& f) { r[i] = f - x[i], ++i; });
  };
  const auto largest = [](const vector& y) {
    using std::abs;
    S most(0);
    for (const S& i : y) most = select(most < S(abs(i)), S(abs(i)), most);
    return most;
  };
  const auto times_inverse = [&inverse, n](const vector& y) {  // Eigen's products are not for packs
    vector product = vector::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) product[i] += inverse(i, j) * y[j];
    return product;
  };
  const S eps = std::numeric_limits<S>::epsilon();
  const auto check_sure = [&] {
    using std::abs;
    using std::sqrt;
    const S most = largest(x) / S(sqrt(eps));
    for (Eigen::Index i = 0; i < n; ++i) {
      S unsure(0);
      for (Eigen::Index j = 0; j < n; ++j) unsure += S(abs(inverse(i, j))) * S(abs(x[j]));
      if (!all(unsure <= most)) [[unlikely]]
        blame_friction(c, s, i);
    }
  };
  S least = (std::numeric_limits<S>::max)();
  int idle = 0;
  residual();
  for (int i = 0; i < 60; ++i) {
    const S error = largest(r), size = largest(x);
    if (all(error <= S(S(4) * eps * size))) return check_sure();
    idle = all(error < S(least / S(2))) ? 0 : idle + 1;
    least = select(error < least, error, least);
    if (idle >= 3 && (idle >= 8 || all(error <= S(2 * least))) && all(error <= S(S(4096) * eps * size)))
      return check_sure();  // rounding of a and of friction
    step = times_inverse(r);
    step = -step;
    x += step, before = r;
    residual();
    if (all(largest(step) <= S(S(4096) * eps * size))) continue;  // r - before is rounding
    const vector gone = times_inverse(vector(r - before));
    S along(0);
    for (Eigen::Index k = 0; k < n; ++k) along += step[k] * gone[k];
    const S share = select(along == S(0), S(0), S(S(1) / select(along == S(0), S(1), along)));
    for (Eigen::Index j = 0; j < n; ++j) {
      S across(0);
      for (Eigen::Index k = 0; k < n; ++k) across += step[k] * inverse(k, j);
      for (Eigen::Index k = 0; k < n; ++k) column[k] = inverse(k, j) + share * (step[k] - gone[k]) * across;
      inverse.col(j) = column;
    }
  }
  blame_friction(c, s, 0);
}

}  // namespace kte::detail
