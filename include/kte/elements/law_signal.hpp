#pragma once

#include <kte/contract/transmission.hpp>

#include <type_traits>

namespace kte {

namespace core {

/// A signal that is a user-defined function of others: y = f(u_1, u_2, ...), one number or three.
template <class Law, std::size_t N>
struct law_signal {
  /// The kind of signal that f returns for numbers.
  static constexpr kind gives = []<std::size_t... I>(std::index_sequence<I...>) {
    using result = std::invoke_result_t<const Law&, std::enable_if_t<(I < N), double>...>;
    return requires(const result& y) { y.x, y.y, y.z; }
    ? kind::vector : kind::input;
  }
  (std::make_index_sequence<N>{});
  static constexpr std::string_view type = "law_signal";
  static constexpr bool holds_code = true;
  static constexpr std::array<port, N + 1> ports = [] {
    constexpr std::string_view roles[]{"input1", "input2", "input3", "input4", "input5", "input6"};
    static_assert(N >= 1 && N <= std::size(roles), "kte: a law takes one to six signals");
    std::array<port, N + 1> p{};
    for (std::size_t i = 0; i < N; ++i) p[i] = {kind::input, access::in, roles[i]};
    p[N] = {gives, access::out, "output"};
    return p;
  }();

  Law law;

  template <class... U>
  KTE_INLINE constexpr auto doMotion(const U&... u) const {
    return law(u...);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// A signal `output` that is a function of one to six others:
///
///   kte::law_signal([](const auto& t) { using std::sin; return 2.0 * sin(t); }, kte::chain_time, drive)
///
/// The function must accept numbers of any type, which may carry derivatives. If it returns a `vec3`, the signal has
/// three numbers (a `vector_key`), as for `position_control_3D` and `external_force_3D`:
///
///   kte::law_signal([](const auto& t) { using std::sin; return kte::along_z(5.0 * sin(t)); }, kte::chain_time, push)
///
/// A chain with it cannot be saved.
template <class Law, class... U>
[[nodiscard]] constexpr auto law_signal(const Law& law, const U&... inputs_and_output) {
  return connect(core::law_signal<Law, sizeof...(U) - 1>{law}, inputs_and_output...);
}

}  // namespace kte
