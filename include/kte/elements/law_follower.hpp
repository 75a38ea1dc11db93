#pragma once

#include <kte/contract/coordinate_follower.hpp>

namespace kte {

namespace core {

/// A coordinate that is a user-defined function of one or several others (contract/coordinate_follower.hpp).
template <class Law, std::size_t N>
struct law_follower : coordinate_follower<law_follower<Law, N>> {
  static constexpr type_name type{"law_follower", kind::gen};
  static constexpr bool holds_code = true;
  static constexpr std::array<port, N + 1> ports = [] {
    constexpr std::string_view roles[]{"base1", "base2", "base3", "base4", "base5", "base6"};
    static_assert(N >= 1 && N <= std::size(roles), "kte: a coordinate follows one to six others");
    std::array<port, N + 1> p{};
    for (std::size_t i = 0; i < N; ++i) p[i] = {kind::gen, access::in, roles[i]};
    p[N] = {kind::gen, access::out, "end"};
    return p;
  }();

  Law law;

  constexpr explicit law_follower(const Law& f) : law(f) {}

  template <class... Q>
  KTE_INLINE constexpr auto value(const Q&... q) const {
    return law(q...);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// A coordinate `end` that is a function of one to six others, m or rad: a cam, a linkage, a cable.
///
///   kte::law_follower_gen([](const auto& q) { using std::sin; return 0.1 * sin(q); }, crank, lift)
///
/// The function must accept numbers of any type, which carry derivatives; rates, accelerations and forces follow from
/// it. A chain with it cannot be saved.
template <class Law, class... Q>
[[nodiscard]] constexpr auto law_follower_gen(const Law& law, const Q&... coordinates_and_end) {
  return connect(core::law_follower<Law, sizeof...(Q) - 1>(law), coordinates_and_end...);
}

}  // namespace kte
