// expect: error: .*kte: this chain has no input of this name
// expect: motor_
#include <kte/kte.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_2D_key<"base">   {} base;
inline constexpr struct cart_  final : kte::frame_2D_key<"cart">   {} cart;
inline constexpr struct motor_ final : kte::input_key<"motor">     {} motor;
// clang-format on

constexpr auto cart_on_rail = kte::chain(kte::prismatic_joint_2D(q, base, cart, kte::axis::x));
void push() { kte::manipulator_dynamics_model(cart_on_rail).input(motor) = 1.0; }
