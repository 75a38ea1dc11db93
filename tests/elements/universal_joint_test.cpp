#include <kte/elements/universal_joint.hpp>
#include <kte/io/model_file.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "elements/laws.hpp"
#include "elements/mechanism_results.hpp"

namespace universal_joint_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q1_     final : coord_key<"q1">        {} q1;
inline constexpr struct q2_     final : coord_key<"q2">        {} q2;
inline constexpr struct p_      final : coord_key<"p">         {} p;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct shaft_  final : frame_3D_key<"shaft">  {} shaft;
inline constexpr struct hand_   final : frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};
constexpr vec3 oblique{2.0 / 3, -1.0 / 3, 2.0 / 3}, offset{0.25, -0.5, 0.125}, weight{0.5, -1.5, -9.81};
/// Sums of some hundred products along two bodies, relative to the largest.
constexpr double few_ulps = 1e-14;

constexpr auto arm = chain(hooke_joint_3D(q1, q2, ground, shaft, axis::x, oblique, offset), inertia_3D(shaft, brick),
                           revolute_joint_3D(p, shaft, hand, axis::y), inertia_3D(hand, brick))
                         .gravity(weight);
runtime_chain with_arm(runtime_chain c) {
  c.gravity(weight) << inertia_3D("shaft", brick) << revolute_joint_3D("p", "shaft", "hand", axis::y)
                    << inertia_3D("hand", brick);
  return c;
}

TEST_CASE("universal joints are the same by keys, by texts, and as joints and a link") {
  runtime_chain texts, old;
  texts << hooke_joint_3D("q1", "q2", "ground", "shaft", axis::x, oblique, offset);
  old << revolute_joint_3D("q1", "ground", "cross", axis::x) << rigid_link_3D("cross", "second", offset)
      << revolute_joint_3D("q2", "second", "shaft", oblique);
  CHECK(difference(arm, with_arm(texts), hand, 1) < few_ulps);
  CHECK(difference(with_arm(texts), with_arm(old), hand, 2) < few_ulps);
  CHECK(record_of(with_arm(texts)) == record_of(arm));
  runtime_chain none, without;
  none << hooke_joint_3D("q1", "q2", "ground", "shaft", axis::x, axis::y, zero3{});
  without << universal_joint_3D("q1", "q2", "ground", "shaft", axis::x, axis::y);
  CHECK(difference(with_arm(none), with_arm(without), hand, 3) < few_ulps);
}

TEST_CASE("a joint of two coordinates has a place, as a link in front of it") {
  constexpr mat3<> turned{{0.8, -0.48, 0.36}, {0.6, 0.64, -0.48}, {0.0, 0.6, 0.8}};
  constexpr auto placed =
      chain(hooke_joint_3D(q1, q2, ground, shaft, axis::x, oblique, offset).at(offset, turned),
            inertia_3D(shaft, brick), revolute_joint_3D(p, shaft, hand, axis::y), inertia_3D(hand, brick))
          .gravity(weight);
  runtime_chain texts, linked;
  texts << hooke_joint_3D("q1", "q2", "ground", "shaft", axis::x, oblique, offset).at(offset, turned);
  linked << fixed_joint_3D("ground", "mount", offset, turned)
         << hooke_joint_3D("q1", "q2", "mount", "shaft", axis::x, oblique, offset);
  CHECK(difference(placed, with_arm(texts), hand, 1) < few_ulps);
  CHECK(difference(with_arm(texts), with_arm(linked), hand, 2) < few_ulps);
  const auto r = record_of(placed);
  CHECK(r == record_of(with_arm(texts)));
  CHECK(r.elements[0].parameters.size() == 3);
  CHECK(from_json(to_json(r)) == r);
  CHECK(record_of(models::registered(r)) == r);
  CHECK(record_of(from_record(placed, r)) == r);
  // By keys alone, and in the plane of the first joint: the cross stands in the mount.
  constexpr auto alone = universal_joint_3D(q1, q2, ground, shaft, axis::x, axis::y).at(along_z(0.5));
  CHECK(forward_kinematics(alone, std::array{0.3, 0.4}, inner_of(shaft)).position.z == 0.5);
  CHECK(complaint(
            [] { universal_joint_3D("q1", "q2", "ground", "shaft", axis::x, axis::y).at(along_x(not_a_number)); }) ==
        "kte: revolute_joint_3D (coordinate 'q1', base 'ground', end 'shaft.inner'): position must be finite, got nan");
}

TEST_CASE("two shafts with a universal joint between them, up to a right angle") {
  // Shafts turn about z and about an axis inclined by b in the plane x, z. Of their angles tan a2 = tan a1 / cos b, and
  // with N = cos^2 b + sin^2 a1 sin^2 b, a2' = a1' cos b / N. The cross: tan q1 = sin a1 tan b, sin q2 = cos a1 sin b.
  constexpr auto c =
      chain(revolute_joint_3D(p, ground, hand), universal_joint_3D(q1, q2, hand, shaft, axis::x, axis::y));
  using std::sqrt, std::atan2;
  for (const double bend : {0.1, 1.0, 1.5, 1.5707, 1.570795})  // cos b = 1.3e-6 at last
    for (const double a1 : {0.0, 1e-7, 0.3, 1.5, 2.0, 4.0}) {
      INFO(bend << ' ' << a1);
      const double cb = std::cos(bend), sb = std::sin(bend), c1 = std::cos(a1), s1 = std::sin(a1);
      const double n = cb * cb + s1 * s1 * sb * sb;
      const std::array q{a1, atan2(s1 * sb, cb), atan2(c1 * sb, sqrt(n))};
      const std::array v{1.0, c1 * sb * cb / n, -s1 * sb / sqrt(n)};
      const auto r = forward_kinematics(c, q, shaft).rotation;
      const double a2 = atan2(s1, c1 * cb);
      CHECK(near(vec3{r.x.z, r.y.z, r.z.z}, vec3{sb, 0.0, cb}, 1e-15));  // the axis of the second shaft
      CHECK(near(vec3{r.x.y, r.y.y, r.z.y}, vec3{-std::sin(a2) * cb, std::cos(a2), std::sin(a2) * sb}, 1e-15));
      const auto w = frame_velocity(c, q, v, shaft).angular;
      CHECK(near(w, vec3{0.0, 0.0, cb / n}, 1e-15 * (1 + std::fabs(v[1]))));
    }
}

TEST_CASE("the cross of a universal joint has a name") {
  auto s = make_state(arm);
  s[q1].q = 0.5;
  arm.doMotion(s);
  CHECK(s[inner_of(shaft)].rotation.y.y == within(std::cos(0.5), 2e-16));
  CHECK(inner_of(shaft).name == "shaft.inner");
  CHECK(inner_of("shaft") == "shaft.inner");
  auto t =
      with_arm(runtime_chain() << hooke_joint_3D("q1", "q2", "ground", "shaft", axis::x, oblique, offset)).make_state();
  CHECK(t.frame_3D(inner_of("shaft")).position == vec3{0.0, 0.0, 0.0});
}

TEST_CASE("universal joints in files are two joints") {
  const auto r = record_of(arm);
  CHECK(r.elements[0].type == "revolute_joint_3D");
  CHECK(r.elements[0].connections[2].name == "shaft.inner");
  CHECK(r.elements[1].type == "revolute_joint_3D");
  CHECK(r.elements[1].parameters[1].name == "position");
  CHECK(from_json(to_json(r)) == r);
  CHECK(from_xml(to_xml(r)) == r);
  CHECK(record_of(models::registered(r)) == r);
  CHECK(record_of(from_record(arm, r)) == r);
}

TEST_CASE("a universal joint wants axes of length 1 that are not parallel") {
  const auto what = [](const vec3<>& axis1, const vec3<>& axis2) {
    return complaint([&] { (void)universal_joint_3D("a", "b", "fork", "shaft", axis1, axis2); });
  };
  CHECK(what({0, 0, 2}, {0, 1, 0}) ==
        "kte: revolute_joint_3D (coordinate 'a', base 'fork', end 'shaft.inner'): axis must have length 1, got 2");
  CHECK(what({0, 0, 1}, {0, not_a_number, 0}) ==
        "kte: revolute_joint_3D (coordinate 'b', base 'shaft.inner', end 'shaft'): axis must have length 1, got nan");
  const std::string rule = ": axes must not be parallel: the squared sine between them must be above 1e-12, got 0";
  const std::string ports = " (coordinate1 'a', coordinate2 'b', base 'fork', end 'shaft')";
  CHECK(what({0, 0, 1}, {0, 0, -1}) == "kte: universal_joint_3D" + ports + rule);
  CHECK(complaint([] { (void)hooke_joint_3D("a", "b", "fork", "shaft", axis::x, axis::minus_x, offset); }) ==
        "kte: hooke_joint_3D" + ports + rule);
  CHECK(complaint([] { (void)hooke_joint_3D("a", "b", "fork", "shaft", axis::x, axis::y, along_x(infinity)); }) ==
        "kte: revolute_joint_3D (coordinate 'b', base 'shaft.inner', end 'shaft'): position must be finite, got inf");
  CHECK(what({0, 0, 1}, {0, 0.6, 0.8}) == "");
}

}  // namespace universal_joint_test
