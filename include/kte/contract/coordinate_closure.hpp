#pragma once

#include <kte/contract/closure.hpp>
#include <kte/math/dual.hpp>

namespace kte {

/// A function of coordinates that a closure keeps at zero. A core that derives from it has this function,
///
///   value(q_1, q_2, ...)   rad or m                                                          (1)
///
/// which is called with dual numbers (functions as `using std::sin; sin(q)`); derivatives and forces follow from it:
///
///   g = F(q_i),   J_i = F_i,   g_ddot = sum F_i q_i'' + sum F_ij q_i' q_j',   f_i += F_i lambda        (2)
///
/// Its ports are the coordinates (`access::on`) and the name of the loop. It has one angular row (`rows`).
template <class Core>
struct coordinate_closure {
  static constexpr closure_rows rows{0, 1};

  template <class... X>
  KTE_INLINE constexpr auto doForce(const X&... x) const {
    const auto things = std::tie(x...);
    constexpr std::size_t n = sizeof...(X) - 1;
    using S = std::remove_cvref_t<decltype(std::get<n>(things).force.x)>;
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      const std::array<S, n> q{as<S>(std::get<I>(things).q)...};
      const auto by = gradient(q);
      return make_loads(S(by[I] * std::get<n>(things).torque.x)...);
    }
    (std::make_index_sequence<n>{});
  }
  /// Stores g in the state of the loop.
  template <class... X>
  constexpr void put_residual(X&... x) const {
    const auto things = std::tie(x...);
    constexpr std::size_t n = sizeof...(X) - 1;
    auto& loop = std::get<n>(things);
    using S = std::remove_cvref_t<decltype(loop.force.x)>;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      loop.ang_residual.x = S(core().value(as<S>(std::get<I>(things).q)...));
    }
    (std::make_index_sequence<n>{});
  }
  /// F at q.
  template <class S, std::size_t N>
  constexpr S residual(const std::array<S, N>& q) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) { return S(core().value(q[I]...)); }
    (std::make_index_sequence<N>{});
  }
  /// The derivatives F_i at q.
  template <class S, std::size_t N>
  constexpr std::array<S, N> gradient(const std::array<S, N>& q) const {
    using number = dual<S, static_cast<int>(N)>;
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      std::array<number, N> x{number(q[I])...};
      for (std::size_t i = 0; i < N; ++i) x[i].derivative[i] = S(1);
      const number y = core().value(x[I]...);
      return std::array<S, N>{y.derivative[I]...};
    }
    (std::make_index_sequence<N>{});
  }
  /// The second derivative along the rates v: sum F_ij v_i v_j.
  template <class S, std::size_t N>
  constexpr S curvature(const std::array<S, N>& q, const std::array<S, N>& v) const {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      const dual<dual<S, 1>, 1> y = core().value(along(along(q[I], v[I]), along(v[I], S(0)))...);
      return y.derivative[0].derivative[0];
    }
    (std::make_index_sequence<N>{});
  }

 private:
  template <class T>
  KTE_INLINE static constexpr dual<T, 1> along(const T& x, const T& rate) {
    dual<T, 1> n(x);
    n.derivative[0] = rate;
    return n;
  }
  KTE_INLINE constexpr const Core& core() const { return static_cast<const Core&>(*this); }
};

namespace detail {
template <std::size_t N>
inline constexpr std::array<port, N + 1> coordinate_closure_ports = [] {
  constexpr std::string_view roles[]{"coordinate1", "coordinate2", "coordinate3", "coordinate4"};
  static_assert(N >= 1 && N <= std::size(roles), "kte: a closure couples one to four coordinates");
  std::array<port, N + 1> p{};
  for (std::size_t i = 0; i < N; ++i) p[i] = {kind::gen, access::on, roles[i]};
  p[N] = {kind::loop, access::keep, "loop"};
  return p;
}();
}  // namespace detail

}  // namespace kte
