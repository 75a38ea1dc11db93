#pragma once

#include <kte/frames/contact_state.hpp>
#include <kte/models/detail/displacement.hpp>

namespace kte {

namespace detail {
/// The sizes of the parts of the states of a chain; Eigen::Dynamic if they are known only at run time.
template <class Chain>
struct sizes_of_model {
  using wiring = typename Chain::wiring;
  static constexpr int q = wiring::nq, v = wiring::dofs;
  static constexpr int own_z = wiring::count(kind::internal);  ///< of elements; those of contacts follow
  static constexpr int z = own_z + numbers_of_contact * wiring::count(kind::contact), u = wiring::nu;
  static constexpr int x = q + v + z, x_dot = 2 * v + z;
  static constexpr bool only_numbers = [] {
    for (std::size_t i = 0; i < wiring::freedoms; ++i)
      if (wiring::table.free[i].what != kind::gen) return false;
    return wiring::count(kind::loop) == 0 && wiring::count(kind::contact) == 0;  // else states move on a manifold
  }();
  static std::span<const freedom> freedoms(const Chain&) { return {wiring::table.free.data(), wiring::freedoms}; }
  static constexpr int nq(const Chain&) { return wiring::nq; }
  static constexpr int nv(const Chain&) { return wiring::dofs; }
  static constexpr int nu(const Chain&) { return wiring::nu; }
  static constexpr int count(const Chain&, kind k) { return wiring::count(k); }
  /// Calls visit(name, first index in u, size) for each input.
  template <class Visit>
  static void each_input(const Chain&, const Visit& visit) {
    for (std::size_t i = 0; i < std::size_t{wiring::table.signals}; ++i)
      if (const auto& signal = wiring::table.signal[i]; signal.u >= 0)
        visit(signals_of_wiring<wiring>::names[i], signal.u, nu_of(signal.what));
  }
};
}  // namespace detail

/// A chain with its states as vectors:
///
///   x = (q, v, z)        positions, rates, internal states of elements; then for each rigid contact its mode (0 open,
///                        1 sticks, 2 slides, -2 open and ignored by `only_if`) and the direction in which it slides,
///                        4 numbers         (1)
///   x' = (v, a, z')                                                            (2)
///   u                    signals that no element writes, in order of first appearance, except the time
///
/// If coordinates are rotations or poses, q contains quaternions, x' has fewer numbers than x, and integrators move on
/// the group (integrators/motion_space.hpp). The class derives from the chain, so that all algorithms accept it.
template <class Chain, class S>
class state_space : public Chain {
  using size = detail::sizes_of_model<Chain>;

 public:
  using state = Eigen::Matrix<S, size::x, 1>;
  using rate = Eigen::Matrix<S, size::x_dot, 1>;
  using input_vector = Eigen::Matrix<S, size::u, 1>;

  explicit state_space(const Chain& c) : Chain(c), u_(input_vector::Zero(size::nu(c))) {}

  [[nodiscard]] const Chain& chain() const { return *this; }
  /// The number of internal states z.
  [[nodiscard]] int internals() const { return own_internals() + detail::numbers_of_contact * contacts(); }
  /// The coordinates, with their positions in q and v.
  [[nodiscard]] std::span<const detail::freedom> freedoms() const { return size::freedoms(chain()); }
  /// The size of v and a.
  [[nodiscard]] int velocity_count() const { return size::nv(chain()); }
  /// The number of rigid contacts.
  [[nodiscard]] int contacts() const { return size::count(chain(), kind::contact); }
  /// Calls visit(number of a contact, the first of its numbers in x).
  template <class Visit>
  void each_contact(const Visit& visit) const {
    const int first = numbers_q() + velocity_count() + own_internals();
    for (int i = 0; i < contacts(); ++i) visit(i, first + detail::numbers_of_contact * i);
  }
  /// The size of x.
  [[nodiscard]] int state_size() const { return numbers_q() + velocity_count() + internals(); }
  /// The size of x'.
  [[nodiscard]] int rates() const { return 2 * velocity_count() + internals(); }

  /// The state x of q and v, with z = 0 or as given. Throws `bad_argument` for wrong sizes.
  template <indexable Q, indexable V>
  [[nodiscard]] state make_x(const Q& q, const V& v) const {
    return make_x(q, v, Eigen::Matrix<S, size::z, 1>::Zero(internals()).eval());
  }
  template <indexable Q, indexable V, indexable Z>
  [[nodiscard]] state make_x(const Q& q, const V& v, const Z& z) const {
    const Eigen::Index at_v = numbers_q(), at_z = at_v + velocity_count(), end = at_z + internals();
    if constexpr (size::q != Eigen::Dynamic) {
      detail::check_configuration<Chain>(q), check_size<size::v>(v, "v");
    } else {
      detail::check_configuration(numbers_q(), velocity_count(), q);
      check_size(static_cast<std::size_t>(velocity_count()), v, "v");
    }
    check_size(static_cast<std::size_t>(internals()), z, "z", "internal states");
    state x(end);
    for (Eigen::Index i = 0; i < at_v; ++i) x[i] = S(q[static_cast<std::size_t>(i)]);
    for (Eigen::Index i = at_v; i < at_z; ++i) x[i] = S(v[static_cast<std::size_t>(i - at_v)]);
    for (Eigen::Index i = at_z; i < end; ++i) x[i] = S(z[static_cast<std::size_t>(i - at_z)]);
    return x;
  }
  /// The positions q of x, as a view. Throws `bad_argument` for an x of wrong size.
  template <class X>
  [[nodiscard]] auto positions_of(const Eigen::MatrixBase<X>& x) const {
    return checked(x.derived()).head(Eigen::fix<size::q>(numbers_q()));
  }
  /// The velocities v of x, as a view.
  template <class X>
  [[nodiscard]] auto velocities_of(const Eigen::MatrixBase<X>& x) const {
    return checked(x.derived()).segment(numbers_q(), Eigen::fix<size::v>(velocity_count()));
  }
  /// The internal states z of x, as a view.
  template <class X>
  [[nodiscard]] auto internals_of(const Eigen::MatrixBase<X>& x) const {
    return checked(x.derived()).tail(Eigen::fix<size::z>(internals()));
  }

  /// Sets all inputs u. Throws `bad_argument` for a wrong number of inputs, and for numbers that are not finite.
  template <indexable U>
  void setInput(const U& u) {
    check_size(static_cast<std::size_t>(u_.size()), u, "u", "inputs");
    detail::check_result(u, static_cast<std::size_t>(u_.size()), [&] { refuse_inputs(u); });
    for (Eigen::Index i = 0; i < u_.size(); ++i) u_[i] = S(u[static_cast<std::size_t>(i)]);
  }
  /// The inputs u.
  [[nodiscard]] const input_vector& input() const { return u_; }

  // ---- motion on the group, for chains with rotations
  /// out = x (+) d (integrators/motion_space.hpp).
  void displace(const state& x, const rate& d, state& out) const requires(!size::only_numbers) {
    out.resize(x.size());
    const S* from = x.data();
    for (const auto& f : freedoms()) detail::displace_one<S>(f, from, d.data(), out);
    vectors_of(out) = vectors_of(x) + vectors_of(d);
  }
  /// Converts the rate r of the state to that of the displacement d.
  void pull_back(const rate& d, rate& r) const requires(!size::only_numbers) {
    for (const auto& f : freedoms()) detail::pull_back_one<S>(f, d.data(), r);
  }
  /// The size of the state for each number of a displacement.
  void magnitudes(const state& x, rate& m) const requires(!size::only_numbers) {
    for (const auto& f : freedoms()) detail::magnitudes_of<S>(f, x.data(), m);
    vectors_of(m) = vectors_of(x);
  }
  /// The part of d lost in the rounding of out.
  void rounding(const state& x, const rate& d, const state& out, rate& rest) const requires(!size::only_numbers) {
    for (const auto& f : freedoms()) detail::rounding_of_one<S>(f, x.data(), d.data(), out.data(), rest);
    vectors_of(rest) = vectors_of(d) - (vectors_of(out) - vectors_of(x));
  }

 protected:
  int numbers_q() const { return size::nq(chain()); }
  int own_internals() const { return size::count(chain(), kind::internal); }
  /// x, after a check of its size.
  template <class X>
  const X& checked(const X& x) const {
    check_size(static_cast<std::size_t>(state_size()), x, "x", "numbers of a state");
    return x;
  }

  input_vector u_;

 private:
  template <class U>
  [[noreturn, gnu::cold, gnu::noinline]] void refuse_inputs(const U& u) const {
    std::string text;
    size::each_input(chain(), [&](std::string_view name, int first, int n) {
      for (int i = first; i < first + n && text.empty(); ++i)
        if (const double x = detail::plain_number(S(u[static_cast<std::size_t>(i)])); !std::isfinite(x))
          text.append(" of '").append(name).append("' must be finite, got ").append(detail::number(x));
    });
    detail::raise<bad_argument>("kte: an input" + (text.empty() ? " must be finite" : text));
  }
  static constexpr int vectors = size::v == Eigen::Dynamic ? Eigen::Dynamic : size::v + size::z;
  /// v and z of a state, or their rates.
  template <class X>
  auto vectors_of(X& x) const {
    return x.tail(Eigen::fix<vectors>(velocity_count() + internals()));
  }
};

}  // namespace kte
