#include <kte/elements/cylindrical_joint.hpp>
#include <kte/io/model_file.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "elements/laws.hpp"
#include "elements/mechanism_results.hpp"

namespace cylindrical_joint_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct turn_   final : coord_key<"turn">      {} turn;
inline constexpr struct slide_  final : coord_key<"slide">     {} slide;
inline constexpr struct p_      final : coord_key<"p">         {} p;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct sleeve_ final : frame_3D_key<"sleeve"> {} sleeve;
inline constexpr struct hand_   final : frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};
constexpr vec3 oblique{2.0 / 3, -1.0 / 3, 2.0 / 3}, weight{0.5, -1.5, -9.81};
/// Sums of some hundred products along two bodies, relative to the largest.
constexpr double few_ulps = 1e-14;

constexpr auto arm = chain(cylindrical_joint_3D(turn, slide, ground, sleeve, oblique), inertia_3D(sleeve, brick),
                           revolute_joint_3D(p, sleeve, hand, axis::y), inertia_3D(hand, brick))
                         .gravity(weight);

runtime_chain with_arm(runtime_chain c) {
  c.gravity(weight) << inertia_3D("sleeve", brick) << revolute_joint_3D("p", "sleeve", "hand", axis::y)
                    << inertia_3D("hand", brick);
  return c;
}

TEST_CASE("a cylindrical joint is the same by keys, by texts, and slid before it turns") {
  runtime_chain texts, other;
  texts << cylindrical_joint_3D("turn", "slide", "ground", "sleeve", oblique);
  other << inertia_gen("turn", 0.0)  // first in the order of coordinates
        << prismatic_joint_3D("slide", "ground", "slid", oblique)
        << revolute_joint_3D("turn", "slid", "sleeve", oblique);
  CHECK(difference(arm, with_arm(texts), hand, 1) < few_ulps);
  CHECK(difference(with_arm(texts), with_arm(other), hand, 2) < few_ulps);
  CHECK(record_of(with_arm(texts)) == record_of(arm));
}

TEST_CASE("a sleeve on a shaft that stands elsewhere") {
  constexpr auto placed =
      chain(cylindrical_joint_3D(turn, slide, ground, sleeve, oblique).at(along_y(0.5), quarter_turn_x),
            inertia_3D(sleeve, brick), revolute_joint_3D(p, sleeve, hand, axis::y), inertia_3D(hand, brick))
          .gravity(weight);
  runtime_chain texts, linked;
  texts << cylindrical_joint_3D("turn", "slide", "ground", "sleeve", oblique).at(along_y(0.5), quarter_turn_x);
  linked << fixed_joint_3D("ground", "mount", along_y(0.5), quarter_turn_x)
         << cylindrical_joint_3D("turn", "slide", "mount", "sleeve", oblique);
  CHECK(difference(placed, with_arm(texts), hand, 1) < few_ulps);
  CHECK(difference(placed, with_arm(linked), hand, 2) < few_ulps);
  CHECK(record_of(models::registered(record_of(placed))) == record_of(placed));
}

TEST_CASE("a sleeve on a shaft") {
  constexpr auto c = chain(cylindrical_joint_3D(turn, slide, ground, sleeve, axis::x),
                           inertia_3D(sleeve, rigid_body{2.0, along_x(0.25), diagonal(0.5, 0.3, 0.3)}));
  const std::array q{0.7, -1.5};
  const auto m = mass_matrix(c, q);
  CHECK(m(0, 0) == 0.5);
  CHECK(m(0, 1) == 0.0);
  CHECK(m(1, 1) == 2.0);
  const auto x = forward_kinematics(c, q, sleeve);
  CHECK(x.position.x == -1.5);
  CHECK(x.rotation.z.y == within(std::sin(0.7), 2e-16));
  auto s = make_state(c);
  s[turn].q = 0.5, s[slide].q = 2.0;
  c.doMotion(s);
  CHECK(s[inner_of(sleeve)].position == vec3{0.0, 0.0, 0.0});
  CHECK(s[inner_of(sleeve)].rotation == s[sleeve].rotation);
}

TEST_CASE("a cylindrical joint in files is two joints") {
  const auto r = record_of(arm);
  CHECK(r.elements[0].type == "revolute_joint_3D");
  CHECK(r.elements[0].connections[2].name == "sleeve.inner");
  CHECK(r.elements[1].type == "prismatic_joint_3D");
  CHECK(r.elements[1].connections[1].name == "sleeve.inner");
  CHECK(from_json(to_json(r)) == r);
  CHECK(record_of(models::registered(r)) == r);
  CHECK(record_of(from_record(arm, r)) == r);
}

TEST_CASE("a runtime chain takes a joint of two as a whole, or not") {
  runtime_chain c;
  c << base_3D("ground") << fixed_joint_3D("ground", "taken");
  const auto before = record_of(c);
  CHECK_THROWS_WITH(c << cylindrical_joint_3D("turn", "slide", "ground", "taken", axis::z),
                    "kte: prismatic_joint_3D (coordinate 'slide', base 'taken.inner', end 'taken'): it writes 'taken', "
                    "which is then written twice");
  CHECK(record_of(c) == before);
  CHECK(c.dofs() == 0);
  c << cylindrical_joint_3D("turn", "slide", "ground", "sleeve", axis::z);
  CHECK(c.dofs() == 2);
  CHECK(c.make_state().frame_3D("sleeve.inner").position == vec3{0.0, 0.0, 0.0});
}

TEST_CASE("a cylindrical joint wants an axis of length 1") {
  CHECK(complaint([] {
          (void)cylindrical_joint_3D("turn", "slide", "shaft", "sleeve", vec3{0.0, 0.0, 2.0});
        }) ==
        "kte: revolute_joint_3D (coordinate 'turn', base 'shaft', end 'sleeve.inner'): axis must have length 1, got 2");
}

}  // namespace cylindrical_joint_test
