#include <kte/elements/universal_joint.hpp>

#include "elements/laws.hpp"
#include "elements/mechanism_results.hpp"

namespace joint_of_two_coordinates_test {

using namespace kte;
using namespace kte::test;

/// An own joint of two coordinates: R = Rot(z, q1) Rot(y, q2), p = Rot(z, q1) r.
struct wrist : transmission<wrist> {
  static constexpr type_name type{"wrist", kind::frame_3D};
  static constexpr std::array<port, 4> ports{{{kind::gen, access::angle, "yaw"},
                                              {kind::gen, access::angle, "pitch"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  vec3<> offset;  // m
  constexpr explicit wrist(const vec3<>& r) : offset(r) {}

  template <class C, class D>
  constexpr auto relative(const C& yaw, const D& pitch) const {
    const motion first{zero3{}, rotation_about(axis::z, yaw.cos, yaw.sin),
                       zero3{}, axis::z * yaw.q_dot,
                       zero3{}, axis::z * yaw.q_ddot};
    const motion second{offset,  rotation_about(axis::y, pitch.cos, pitch.sin),
                        zero3{}, axis::y * pitch.q_dot,
                        zero3{}, axis::y * pitch.q_ddot};
    return compose(first, second);
  }
  constexpr void check(const parameter_check& where) const { where.finite(offset, "offset must be finite"); }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("offset", self.offset);
  }
};

// clang-format off
inline constexpr struct q_      final : coord_key<"q">         {} q;
inline constexpr struct yaw_    final : coord_key<"yaw">       {} yaw;
inline constexpr struct pitch_  final : coord_key<"pitch">     {} pitch;
inline constexpr struct p_      final : coord_key<"p">         {} p;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct arm_    final : frame_3D_key<"arm">    {} arm;
inline constexpr struct flange_ final : frame_3D_key<"flange"> {} flange;
inline constexpr struct palm_   final : frame_3D_key<"palm">   {} palm;
inline constexpr struct hand_   final : frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};
constexpr vec3<> weight{0.5, -1.5, -9.81}, offset{0.05, 0.02, 0.1};
/// Sums of some hundred products along three bodies, relative to the largest.
constexpr double few_ulps = 1e-14;

template <class Joint>
auto static_arm(const Joint& joint) {
  return chain(revolute_joint_3D(q, ground, arm, vec3{0.6, 0.0, 0.8}), inertia_3D(arm, brick),
               rigid_link_3D(arm, flange, vec3{0.3, -0.1, 0.4}), joint, inertia_gen(pitch, 0.02),
               inertia_3D(palm, brick), revolute_joint_3D(p, palm, hand, axis::x).at(vec3{0.1, 0.3, 0.2}),
               inertia_3D(hand, brick))
      .gravity(weight);
}
template <class Joint>
runtime_chain runtime_arm(const Joint& joint) {
  runtime_chain c;
  c.gravity(weight) << revolute_joint_3D("q", "ground", "arm", vec3{0.6, 0.0, 0.8}) << inertia_3D("arm", brick)
                    << rigid_link_3D("arm", "flange", vec3{0.3, -0.1, 0.4}) << joint << inertia_gen("pitch", 0.02)
                    << inertia_3D("palm", brick)
                    << revolute_joint_3D("p", "palm", "hand", axis::x).at(vec3{0.1, 0.3, 0.2})
                    << inertia_3D("hand", brick);
  return c;
}
auto own() { return runtime_arm(connect(wrist(offset), "yaw", "pitch", "flange", "palm")); }
auto in_series() { return runtime_arm(hooke_joint_3D("yaw", "pitch", "flange", "palm", axis::z, axis::y, offset)); }

TEST_CASE("an own joint of two coordinates obeys the laws") {
  random_numbers draw(1);
  const auto joint = connect(wrist(offset), "yaw", "pitch", "base", "end");
  CHECK(testing::motion_is_derivative<double>(joint, draw) <= by_differences<double>);
  CHECK(testing::power_is_kept<double>(joint, draw) <= rounding<double>);
  CHECK(testing::motion_is_derivative<digits50>(joint, draw) <= by_differences<digits50>);
}

TEST_CASE("a joint of two coordinates is two joints of one") {
  CHECK(difference(own(), in_series(), hand, 1) < few_ulps);
  const auto two = static_arm(connect(wrist(offset), yaw, pitch, flange, palm));
  CHECK(difference(two, in_series(), hand, 2) < few_ulps);
}

TEST_CASE("other algorithms on a joint of two coordinates") {
  const auto a = own(), b = in_series();
  auto s = a.make_state(), t = b.make_state();
  const auto two = static_arm(connect(wrist(offset), yaw, pitch, flange, palm));
  random_numbers random(3);
  for (int round = 0; round < 3; ++round) {
    const some_motion m(4, 4, random);
    const auto same = [](const Eigen::MatrixXd& x, const Eigen::MatrixXd& y) {
      CHECK((x - y).cwiseAbs().maxCoeff() <= few_ulps * std::max(1.0, y.cwiseAbs().maxCoeff()));
    };
    same(coriolis_matrix(a, s, m.q, m.v), coriolis_matrix(b, t, m.q, m.v));
    same(coriolis_matrix(two, m.q, m.v), coriolis_matrix(b, t, m.q, m.v));
    same(jacobian_rate(a, s, m.q, m.v, "hand"), jacobian_rate(b, t, m.q, m.v, "hand"));
    same(jacobian_rate(two, m.q, m.v, hand), jacobian_rate(b, t, m.q, m.v, "hand"));
    same(torque_regressor(a, s, m.q, m.v, m.x), torque_regressor(b, t, m.q, m.v, m.x));
    same(torque_regressor(two, m.q, m.v, m.x), torque_regressor(b, t, m.q, m.v, m.x));
    same(centroidal_momentum_matrix(a, s, m.q), centroidal_momentum_matrix(b, t, m.q));
    same(centroidal_momentum_matrix(two, m.q), centroidal_momentum_matrix(b, t, m.q));
    const auto by = forward_dynamics_derivatives(a, s, m.q, m.v, m.x),
               other = forward_dynamics_derivatives(b, t, m.q, m.v, m.x);
    same(by.by_q, other.by_q), same(by.by_v, other.by_v), same(by.by_tau, other.by_tau);
    CHECK(kinetic_energy(two, m.q, m.v) == within_relative(kinetic_energy(b, t, m.q, m.v), few_ulps));
    // The acceleration of one of its coordinates is prescribed.
    const auto one = hybrid_dynamics(a, s, m.q, m.v, m.x, {"pitch", "p"}),
               same_one = hybrid_dynamics(b, t, m.q, m.v, m.x, {"pitch", "p"});
    same(one.a, same_one.a), same(one.tau, same_one.tau);
  }
}

TEST_CASE("coordinates of a joint of two in another order") {
  // The pitch becomes the first degree of freedom.
  const auto turned_round = [](const auto& joint) {
    runtime_chain c;
    c.gravity(weight) << mimic_gen("pitch", "twice", 2.0) << joint << inertia_3D("palm", brick)
                      << revolute_joint_3D("twice", "palm", "hand", axis::x) << inertia_3D("hand", brick);
    return c;
  };
  const auto a = turned_round(connect(wrist(offset), "yaw", "pitch", "ground", "palm"));
  const auto b = turned_round(hooke_joint_3D("yaw", "pitch", "ground", "palm", axis::z, axis::y, offset));
  CHECK(difference(a, b, hand, 5) < few_ulps);
}

TEST_CASE("the coordinates of one joint are locked together") {
  const auto c = own();
  const Eigen::Vector4d at(0.3, -0.4, 0.5, 0.6);
  CHECK(complaint([&] { (void)reduced(c, at, "yaw"); }) ==
        "kte: wrist_3D (yaw 'yaw', pitch 'pitch', base 'flange', end 'palm') has several coordinates: lock all of them "
        "or none");
  const auto locked = reduced(c, at, "yaw", "pitch"), other = reduced(in_series(), at, "yaw", "pitch");
  CHECK(difference(locked, other, hand, 6) < few_ulps);
}

TEST_CASE("either all coordinates of a joint are free or none") {
  runtime_chain c;
  c << base_gen("given") << connect(wrist(offset), "given", "pitch", "ground", "palm") << inertia_3D("palm", brick);
  auto s = c.make_state();
  CHECK(complaint([&] {
          (void)forward_dynamics(c, s, std::array{0.1}, std::array{0.2}, std::array{0.3});
        }).find("has several coordinates, and not all of them are degrees of freedom") != std::string::npos);
}

}  // namespace joint_of_two_coordinates_test
