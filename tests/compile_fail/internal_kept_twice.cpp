// expect: error: .*kte: this element writes a name that an earlier element has written
// expect: joint_lugre_gen.*q_, hairs_
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">            {} q;
inline constexpr struct base_  final : kte::frame_2D_key<"base">      {} base;
inline constexpr struct cart_  final : kte::frame_2D_key<"cart">      {} cart;
inline constexpr struct hairs_ final : kte::internal_key<"bristles">  {} hairs;
// clang-format on

constexpr kte::lugre_parameters dry{1e5, 300, 0.4, 1, 1.5, 0.001};
constexpr auto cart_on_rail = kte::chain(kte::prismatic_joint_2D(q, base, cart, kte::axis::x),
                                         kte::joint_lugre_gen(q, hairs, dry), kte::joint_lugre_gen(q, hairs, dry));
