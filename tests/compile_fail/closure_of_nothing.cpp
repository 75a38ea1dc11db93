// expect: error: .*kte: nothing moves by this coordinate of the element: misspelt
// expect: coupled_coordinates.*did_you_mean_key<roker_, *rocker_>
#include <kte/elements/closures.hpp>
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct crank_  final : kte::coord_key<"crank">    {} crank;
inline constexpr struct rocker_ final : kte::coord_key<"rocker">   {} rocker;
inline constexpr struct roker_  final : kte::coord_key<"roker">    {} roker;
inline constexpr struct base_   final : kte::frame_2D_key<"base">  {} base;
inline constexpr struct a_      final : kte::frame_2D_key<"a">     {} a;
inline constexpr struct b_      final : kte::frame_2D_key<"b">     {} b;
inline constexpr struct gear_   final : kte::loop_key<"gear">      {} gear;
// clang-format on

constexpr auto linkage = kte::chain(kte::revolute_joint_2D(crank, base, a), kte::revolute_joint_2D(rocker, base, b),
                                    kte::coupled_coordinates(gear, crank, roker, 1.0, 2.0));
