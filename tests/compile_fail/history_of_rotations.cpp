// expect: error: .*kte: this method keeps a history of slopes, which needs states that are vectors
// expect: kte::vector_form
#include <kte/integrators/adams.hpp>
#include <kte/kte.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>

// clang-format off
inline constexpr struct turn_  final : kte::rotation_3D_key<"turn">  {} turn;
inline constexpr struct base_  final : kte::frame_3D_key<"base">     {} base;
inline constexpr struct body_  final : kte::frame_3D_key<"body">     {} body;
// clang-format on

constexpr auto top = kte::chain(kte::spherical_joint_3D(turn, base, body));
auto f(const kte::manipulator_dynamics_model<std::remove_const_t<decltype(top)>>& model) {
  return kte::adams(std::cref(model), 0.0, model.make_x(std::array{1.0, 0.0, 0.0, 0.0}, std::array{0.0, 0.0, 0.0}));
}
