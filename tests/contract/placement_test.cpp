#include <kte/contract/placement.hpp>
#include <kte/io/model_file.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "elements/laws.hpp"
#include "elements/mechanism_results.hpp"

// Joints placed in their base by .at(position, rotation): a link and a joint in one.

namespace placement_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_      final : coord_key<"q">         {} q;
inline constexpr struct p_      final : coord_key<"p">         {} p;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct mount_   final : frame_3D_key<"mount">   {} mount;
inline constexpr struct arm_    final : frame_3D_key<"arm">    {} arm;
inline constexpr struct perch_  final : frame_3D_key<"perch">  {} perch;
inline constexpr struct hand_   final : frame_3D_key<"hand">   {} hand;
inline constexpr struct tip_    final : frame_2D_key<"tip">    {} tip;
inline constexpr struct floor_  final : frame_2D_key<"floor">  {} floor_2D;
// clang-format on

constexpr vec3 position{0.25, -0.5, 0.125};
constexpr mat3<> rotation{{0.8, -0.48, 0.36}, {0.6, 0.64, -0.48}, {0.0, 0.6, 0.8}};
constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};
constexpr vec3 weight{0.5, -1.5, -9.81};

/// Sums of some hundred products along two bodies, relative to the largest.
constexpr double few_ulps = 1e-14;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& joint) {
    CHECK(testing::motion_is_derivative<S>(joint, draw) <= by_differences<S>);
    CHECK(testing::power_is_kept<S>(joint, draw) <= rounding<S>);
  };
  const vec3<S> r{S(1) / 3, S(-2) / 5, S(1) / 7};
  const auto turn = to_quaternion(r);
  check(revolute_joint_2D("q", "base", "end").at(along_x(S(1) / 3)));
  check(prismatic_joint_2D("q", "base", "end", axis::x).at(vec2{S(1) / 3, S(1) / 7}, rotation_by(S(7) / 5)));
  check(free_joint_2D("X", "base", "end").at(zero3{}, quarter_turn));
  check(revolute_joint_3D("q", "base", "end", axis::y).at(r, quarter_turn_x));
  check(prismatic_joint_3D("q", "base", "end", axis::z).at(r, turn));
  check(spherical_joint_3D("X", "base", "end").at(r, matrix(turn)));
  check(free_joint_3D("X", "base", "end").at(r, turn));
  check(planar_joint_3D("X", "base", "end").at(r, turn));
  check(screw_joint_3D("q", "base", "end", axis::x, S(1) / 3).at(r, turn));
}

TEST_CASE("joints with a place obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a joint with a place is a link and the joint") {
  const auto beyond = [](runtime_chain& c) -> runtime_chain& {
    return c.gravity(weight) << inertia_3D("arm", brick) << revolute_joint_3D("p", "arm", "hand", axis::y)
                             << inertia_3D("hand", brick);
  };
  unsigned seed = 0;
  const auto check = [&](const auto& joint, const auto&... place) {
    runtime_chain placed, linked;
    placed << joint("ground").at(place...);
    linked << fixed_joint_3D("ground", "mount", place...) << joint("mount");
    INFO(record_of(placed).elements[0].type);
    CHECK(difference(beyond(placed), beyond(linked), hand, ++seed) < few_ulps);
    CHECK(difference(placed, models::registered(record_of(placed)), hand, seed) < few_ulps);
  };
  const auto turn = unit_quaternion<>{0.5, 0.5, -0.1, 0.7};
  check([](auto base) { return revolute_joint_3D("q", base, "arm"); }, position, rotation);
  check([](auto base) { return revolute_joint_3D("q", base, "arm", vec3{0.6, 0.0, 0.8}); }, along_z(0.5));
  check([](auto base) { return prismatic_joint_3D("q", base, "arm", axis::y); }, zero3{}, quarter_turn_x);
  check([](auto base) { return spherical_joint_3D("q", base, "arm"); }, position, turn);
  check([](auto base) { return free_joint_3D("q", base, "arm"); }, position, rotation);
  check([](auto base) { return planar_joint_3D("q", base, "arm"); }, position, rotation);
  check([](auto base) { return screw_joint_3D("q", base, "arm", axis::x, 0.25); }, position, rotation);
}

TEST_CASE("static chains of joints with a place") {
  const auto check = [](const auto& placed, const auto& linked, const auto& end) {
    CHECK(difference(placed, linked, end, 1) < few_ulps);
    CHECK(difference(placed, models::registered(record_of(placed)), end, 2) < few_ulps);
  };
  constexpr auto placed =
      chain(revolute_joint_3D(q, ground, arm, axis::x).at(along_z(0.5), quarter_turn_x), inertia_3D(arm, brick),
            revolute_joint_3D(p, arm, hand).at(position, rotation), inertia_3D(hand, brick))
          .gravity(weight);
  constexpr auto linked =
      chain(rigid_link_3D(ground, mount, along_z(0.5), quarter_turn_x), revolute_joint_3D(q, mount, arm, axis::x),
            inertia_3D(arm, brick), rigid_link_3D(arm, perch, position, rotation), revolute_joint_3D(p, perch, hand),
            inertia_3D(hand, brick))
          .gravity(weight);
  check(placed, linked, hand);
  const auto in_plane = chain(revolute_joint_2D(q, floor_2D, tip).at(vec2{0.5, 0.25}, rotation_by(0.3)),
                              inertia_2D(tip, point_mass(2.0, along_x(0.5))))
                            .gravity(along_y(-9.81));
  check(in_plane, models::registered(record_of(in_plane)), tip);
  const auto at = forward_kinematics(in_plane, std::array{0.4}, tip);
  CHECK(at.position.x == 0.5);
  CHECK(at.position.y == 0.25);
  CHECK(at.rotation.cos == within(std::cos(0.7), 2e-16));
}

TEST_CASE("places of joints in files") {
  constexpr auto c = chain(revolute_joint_3D(q, ground, arm).at(along_z(0.5), quarter_turn_x),
                           prismatic_joint_3D(p, arm, hand, axis::x).at(position));
  const auto r = record_of(c);
  using names = std::vector<std::string>;
  const auto names_of = [](const element_record& e) {
    names all;
    for (const auto& x : e.parameters) all.push_back(x.name);
    return all;
  };
  CHECK(r.elements[0].type == "revolute_joint_3D");
  CHECK(names_of(r.elements[0]) == names{"axis", "position", "rotation"});
  CHECK(r.elements[0].parameters[1].values == std::vector{0.0, 0.0, 0.5});
  CHECK(r.elements[0].parameters[2].values == std::vector{1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0});
  CHECK(names_of(record_of(chain(revolute_joint_3D(q, ground, arm))).elements[0]) == names{"axis"});
  CHECK(from_json(to_json(r)) == r);
  CHECK(record_of(from_record(c, r)) == r);
  CHECK(record_of(models::registered(r)) == r);

  const auto dry = record_of(chain(dry_revolute_joint_3D(q, ground, arm, axis::y, 0.25).at(position, rotation)));
  CHECK(names_of(dry.elements[0]) == names{"axis", "friction_radius", "smoothing", "position", "rotation"});
  CHECK(record_of(models::registered(dry)) == dry);

  // One of them alone, which is enough.
  auto without = r;
  without.elements[0].parameters.pop_back();
  CHECK(record_of(models::registered(without)).elements[0].parameters[1] == r.elements[0].parameters[1]);
  without = r;
  without.elements[0].parameters.erase(without.elements[0].parameters.begin() + 1);
  CHECK(record_of(models::registered(without)).elements[0].parameters[2] == r.elements[0].parameters[2]);
  // A static chain has a place by its type.
  without = r;
  without.elements[1].parameters.resize(1);
  CHECK_THROWS_WITH(from_record(c, without), contains_text("does not have the parameters of its type"));
  without = r;
  without.elements[0].parameters[0].values = {0, 0, 2};
  CHECK_THROWS_AS(from_record(c, without), bad_file);  // z by its type
  without = r;
  without.elements[0].parameters[1].values = {0, 0, std::numeric_limits<double>::infinity()};
  CHECK_THROWS_AS(from_record(c, without), bad_parameter);
  const auto oblique = chain(revolute_joint_3D(q, ground, arm, vec3{0.6, 0.0, 0.8}).at(position));
  without = record_of(oblique);
  without.elements[0].parameters[0].values = {0, 0, 2};
  CHECK_THROWS_WITH(from_record(oblique, without), contains_text("axis must have length 1"));
  auto flat = record_of(chain(revolute_joint_2D(q, floor_2D, tip).at(along_x(0.5), quarter_turn)));
  CHECK(record_of(models::registered(flat)) == flat);
  flat.elements[0].parameters[1].values[2] = 1;
  CHECK_THROWS_WITH(models::registered(flat), contains_text("'position' out of the plane"));
}

TEST_CASE("the place of a joint is finite, and a rotation") {
  const auto what = [](const auto&... place) {
    return complaint([&] { revolute_joint_3D("elbow", "upper", "fore").at(place...); });
  };
  const std::string where = "kte: revolute_joint_3D (coordinate 'elbow', base 'upper', end 'fore'): ";
  CHECK(what(along_x(not_a_number)) == where + "position must be finite, got nan");
  CHECK(what(zero3{}, mat3<>{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}) ==
        where + "rotation must be orthonormal and right-handed, got -1");
  CHECK(what(zero3{}, unit_quaternion<>{0.5, 0.0, 0.0, 0.8}).starts_with(where + "rotation must be orthonormal"));
  CHECK(complaint([] {
          revolute_joint_2D("q", "b", "e").at(zero3{}, rotation_2D{0.9, 0.9});
        }).starts_with("kte: revolute_joint_2D (coordinate 'q', base 'b', end 'e'): rotation must be"));
  CHECK(what(position, rotation) == "");
}

/// A sliding joint with friction that grows with what it carries across.
struct frictional_joint : transmission<frictional_joint> {
  static constexpr type_name type{"frictional_joint", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::in, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  static constexpr bool load_dependent_friction = true;
  double coefficient;
  constexpr explicit frictional_joint(double c) : coefficient(c) {}

  template <class C>
  constexpr auto relative(const C& c) const {
    return motion{axis::x * c.q, no_rotation{}, axis::x * c.q_dot, zero3{}, axis::x * c.q_ddot, zero3{}};
  }
  template <class C, class Wrench>
  constexpr auto friction(const C& c, const Wrench& end) const {
    return -(coefficient * c.q_dot) * (end.force.z * end.force.z);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("coefficient", self.coefficient);
  }
};

TEST_CASE("a custom joint has a place, and keeps its friction") {
  const auto placed =
      chain(connect(frictional_joint(0.5), q, ground, arm).at(position, rotation), inertia_3D(arm, brick))
          .gravity(weight);
  const auto linked = chain(fixed_joint_3D(ground, mount, position, rotation),
                            connect(frictional_joint(0.5), q, mount, arm), inertia_3D(arm, brick))
                          .gravity(weight);
  const std::array at{0.3}, v{2.0}, a{0.5};
  const double tau = inverse_dynamics(linked, at, v, a)[0];
  CHECK(inverse_dynamics(placed, at, v, a)[0] == within_relative(tau, few_ulps));
  CHECK(tau > 100);  // most of it friction
}

}  // namespace placement_test
