// mistakes: 4
// expect: error: .*kte: no closed form of inverse kinematics: it needs an arm with three, four, six or seven joints
// expect: error: .*kte: inverse kinematics in closed form needs an arm with one tool; kte::numerical_inverse_kinematics takes
// expect: error: .*kte: this chain has no frame of this name
// expect: error: .*kte: the limits of a static chain need one number for each degree of freedom
#include <kte/elements/free_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/manipulators/nearest.hpp>

// clang-format off
inline constexpr struct q1_     final : kte::coord_key<"q1">        {} q1;
inline constexpr struct q2_     final : kte::coord_key<"q2">        {} q2;
inline constexpr struct q3_     final : kte::coord_key<"q3">        {} q3;
inline constexpr struct floats_ final : kte::pose_3D_key<"floats">  {} floats;
inline constexpr struct base_   final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_  final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct wrist_  final : kte::frame_3D_key<"wrist">  {} wrist;
inline constexpr struct hand_   final : kte::frame_3D_key<"hand">   {} hand;
inline constexpr struct nose_   final : kte::frame_3D_key<"nose">   {} nose;
// clang-format on

constexpr auto body = kte::chain(kte::free_joint_3D(floats, base, hand));
constexpr auto two = kte::chain(kte::revolute_joint_3D(q1, base, elbow), kte::revolute_joint_3D(q2, elbow, hand));
constexpr auto three = kte::chain(kte::revolute_joint_3D(q1, base, elbow), kte::revolute_joint_3D(q2, elbow, wrist),
                                  kte::revolute_joint_3D(q3, wrist, hand));

using place = kte::pose<kte::mat3<kte::vec3<>>, kte::vec3<>>;
auto two_joints(const place& x) { return kte::inverse_kinematics(kte::manipulator(two, hand), x); }
auto two_tools(const place& x, const kte::joint_vector<double, 3>& q) {
  return kte::inverse_kinematics(kte::manipulator(three, hand, wrist), x, kte::nearest(q));
}
auto misspelt() { return kte::manipulator(three, nose); }
auto too_few() { return kte::manipulator(three, hand, kte::unlimited(body)); }
