#include <kte/elements/inertia.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/frames/frame_2D.hpp>
#include <kte/static_chain/static_chain.hpp>

/// For GDB to look at. Constants, so that there is nothing to run.
namespace names {
// clang-format off
constexpr struct q_     final : kte::coord_key<"q, \"é\"">   {} q;
constexpr struct base_  final : kte::frame_2D_key<"base">    {} base;
constexpr struct joint_ final : kte::frame_2D_key<"joint>">  {} joint;
constexpr struct tip_   final : kte::frame_2D_key<"tip">     {} tip;
// clang-format on
}  // namespace names
using namespace names;

extern constexpr kte::vec3 typed{0.5, kte::zero, kte::minus_one};
extern constexpr auto turn = kte::mat3{kte::vec3{1.0, 2.0, 3.0}, kte::axis::y, kte::vec3{4.0, 5.0, 6.0}};
extern constexpr auto moment = kte::diagonal(1.0, 2.0, 3.0);
extern constexpr kte::frame_2D<> frame{{1.0, 2.0}};
extern constexpr auto hinge = kte::revolute_joint_2D(q, base, joint);
extern constexpr auto bar = kte::rigid_link_2D(joint, tip, kte::along_x(0.5));
extern constexpr auto mount = hinge.at(kte::along_y(0.25), kte::quarter_turn);
extern constexpr auto pendulum =
    kte::chain(hinge, bar, kte::inertia_2D(tip, kte::point_mass(1.0))).gravity(kte::along_y(-9.75));

int main() {}
