#include <kte/contract/parameter_check.hpp>
#include <kte/kte.hpp>

#include <limits>

#include "catch.hpp"

namespace parameter_check_test {

using namespace kte;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
constexpr std::array<port, 2> ports{{{kind::gen, access::on, "anchor1"}, {kind::gen, access::on, "anchor2"}}};
constexpr std::array<std::string_view, 2> names{"hip", "knee"};

/// What the check f refuses: the text, or nothing.
template <class F>
std::string refused(const F& f) {
  parameter_check::breach broken;
  const parameter_check check{"strut_gen", ports, names, broken};
  f(check);
  return broken.rule ? check() : "";
}
std::string text(const std::string& rest) { return "kte: strut_gen (anchor1 'hip', anchor2 'knee'): " + rest; }

TEST_CASE("a parameter is refused with element, rule and value, the first of several") {
  CHECK(refused([](const auto& c) { c.require(true, "rule", 1.0); }).empty());
  CHECK(refused([](const auto& c) { c.require(false, "length must be odd", 0.1); }) ==
        text("length must be odd, got 0.10000000000000001"));
  CHECK(refused([](const auto& c) {
          c.require(true, "first", 1), c.require(false, "second", 2), c.require(false, "third", 3);
        }) == text("second, got 2"));
}

TEST_CASE("finite is all that is neither infinite nor NaN, and any typed constant") {
  const auto finite = [](const auto& x) { return refused([&](const auto& c) { c.finite(x, "x"); }); };
  using limits = std::numeric_limits<double>;
  for (const double x : {0.0, -0.0, limits::max(), limits::lowest(), limits::denorm_min()}) CHECK(finite(x).empty());
  CHECK(finite(inf) == text("x, got inf"));
  CHECK(finite(-inf) == text("x, got -inf"));
  CHECK(finite(not_a_number).starts_with(text("x, got ")));  // nan or -nan
  CHECK(finite(constant<-3>{}).empty());
  CHECK(finite(vec3{zero, 1.0, one}).empty());
  CHECK(finite(vec3{inf, 1.0, 1.0}) == text("x, got inf"));
  CHECK(finite(vec3{0.0, -inf, 1.0}) == text("x, got -inf"));
  CHECK(finite(vec3{zero, 1.0, inf}) == text("x, got inf"));
  for (std::size_t k = 0; k < 6; ++k) {
    std::array<double, 6> m{1, 2, 3, 4, 5, 6};
    m[k] = -inf;
    CHECK(finite(sym3{m[0], m[1], m[2], m[3], m[4], m[5]}) == text("x, got -inf"));
  }
}

TEST_CASE("not negative is zero, -0 and above, finite") {
  const auto not_negative = [](const auto& x) { return refused([&](const auto& c) { c.not_negative(x, "x"); }); };
  for (const double x : {0.0, -0.0, 1e-300, 1e300}) CHECK(not_negative(x).empty());
  CHECK(not_negative(-0.5) == text("x, got -0.5"));
  CHECK(!not_negative(-1e-300).empty());
  CHECK(not_negative(inf) == text("x, got inf"));
  CHECK(not_negative(-inf) == text("x, got -inf"));
  CHECK(!not_negative(not_a_number).empty());
  CHECK(not_negative(zero).empty());
  CHECK(not_negative(minus_one) == text("x, got -1"));
}

TEST_CASE("axes have length 1 to 1e-9") {
  const auto unit = [](const auto& x) { return refused([&](const auto& c) { c.unit(x, "x"); }); };
  CHECK(unit(vec3{0.6, zero, 0.8}).empty());
  CHECK(unit(vec3{zero, minus_one, zero}).empty());
  for (const double good : {1 - 0.9e-9, 1 + 0.9e-9}) CHECK(unit(vec3{0.6 * good, 0.0, 0.8 * good}).empty());
  for (const double bad : {1 - 1.1e-9, 1 + 1.1e-9}) CHECK(!unit(vec3{0.6 * bad, 0.0, 0.8 * bad}).empty());
  CHECK(unit(vec3{0.0, 0.0, 0.0}) == text("x, got 0"));
  CHECK(unit(vec3{3.0, 4.0, 0.0}) == text("x, got 5"));
  CHECK(unit(vec3{0.0, -inf, 1.0}) == text("x, got -inf"));
  CHECK(!unit(vec3{not_a_number, 0.0, 1.0}).empty());
  CHECK(unit(vec3{1e200, 0.0, 0.0}) == text("x, got inf"));  // its square
}

TEST_CASE("rotations are orthonormal and turn to the right") {
  const auto rotation = [](const auto& x) { return refused([&](const auto& c) { c.rotation(x, "x"); }); };
  const mat3 good{vec3{0.6, -0.8, 0.0}, vec3{0.8, 0.6, 0.0}, vec3{0.0, 0.0, 1.0}};
  CHECK(rotation(no_rotation{}).empty());
  CHECK(rotation(good).empty());
  CHECK(rotation(unit_quaternion<>{0.6, 0.0, 0.8, 0.0}).empty());
  CHECK(rotation(rotation_2D<>{0.6, 0.8}).empty());
  CHECK(rotation(quarter_turn_x).empty());
  CHECK(rotation(unit_quaternion<>{1.2, 0.0, 1.6, 0.0}) == text("x, got 2"));  // its matrix would be a rotation
  CHECK(rotation(unit_quaternion<>{0.0, 0.0, 0.0, 0.0}) == text("x, got 0"));
  CHECK(rotation(rotation_2D<>{0.3, 0.4}) == text("x, got 0.5"));
  auto longer = good, mirrored = good, askew = good;
  longer.z = 2.0 * longer.z;
  CHECK(rotation(longer) == text("x, got 2"));
  mirrored.z = -mirrored.z;
  CHECK(rotation(mirrored) == text("x, got -1"));
  askew.z = vec3{0.0, 0.6, 0.8};  // each row of length 1
  CHECK(!rotation(askew).empty());
  askew.z = vec3{1e-10, 0.0, 1.0};  // printed with ten digits
  CHECK(rotation(askew).empty());
}

TEST_CASE("bodies are physical where no principal moment is above the sum of the others") {
  const auto physical = [](const auto& inertia) {
    return refused([&](const auto& c) { c.physical(rigid_body{1.0, zero3{}, inertia}); });
  };
  CHECK(physical(diagonal(1.0, 2.0, 3.0)).empty());  // flat
  CHECK(physical(diagonal(0.0, 0.0, 0.0)).empty());
  CHECK(physical(diagonal(0.0, 1.0, 1.0)).empty());              // thin
  CHECK(physical(sym3{1.5, -0.5, 0.0, 1.5, 0.0, 3.0}).empty());  // 1, 2, 3 in other axes
  CHECK(physical(diagonal(1.0, 2.0, 3.0 + 5e-9)).empty());       // within 1e-9 of 6
  CHECK(!physical(diagonal(1.0, 2.0, 3.0 + 7e-9)).empty());
  const std::string rule =
      "inertia must be physical: no principal moment above the sum of the other two "
      "(rigid_body{...}.as_published() is not checked for this)";
  CHECK(physical(diagonal(1.0, 2.0, 3.5)) == text(rule + ", but 3.5 is above 2 + 1 by 0.5"));
  CHECK(physical(sym3{1.5, -0.5, 0.0, 1.5, 0.0, 3.5}).starts_with(text(rule + ", but 3.5 is above 2 + 1 by 0.5")));
  CHECK(physical(diagonal(1.0, inf, 3.0)) == text("inertia must be finite, got inf"));
  // Relative to what the frame feels: far from it, digits of the moments are lost.
  const auto far = [](double d) {
    return refused([&](const auto& c) { c.physical(rigid_body{2.0, along_x(d), diagonal(1.0, 2.0, 3.0 + 1e-6)}); });
  };
  CHECK(!far(1.0).empty());
  CHECK(far(100.0).empty());
}

TEST_CASE("what the elements refuse, each rule once") {
  const auto bad_lugre = [](double lugre_parameters::*what, double value) {
    lugre_parameters p{.sigma0 = 1, .sigma1 = 1, .sigma2 = 1, .coulomb = 1, .stiction = 2, .stribeck_velocity = 1};
    p.*what = value;
    return joint_lugre_gen("q", "z", p);
  };
  const rigid_body upset{1.0, zero3{}, diagonal(1.0, 1.0, 3.0)};
  const mat3 mirror{vec3{1.0, 0.0, 0.0}, vec3{0.0, 1.0, 0.0}, vec3{0.0, 0.0, -1.0}};
  const auto rule = [](const std::string& t) { return kte::test::says("): " + t); };
  CHECK_THROWS_MATCHES(damper_gen("p", "q", -1.0), bad_parameter,
                       rule("damping must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(damper_2D("a", "b", inf), bad_parameter,
                       rule("damping must be finite and not negative, got inf"));
  CHECK_THROWS_MATCHES(damper_3D("a", "b", -2.0), bad_parameter,
                       rule("damping must be finite and not negative, got -2"));
  CHECK_THROWS_MATCHES(torsion_damper_2D("a", "b", -3.0), bad_parameter,
                       rule("damping must be finite and not negative, got -3"));
  CHECK_THROWS_MATCHES(torsion_damper_3D("a", "b", -4.0), bad_parameter,
                       rule("damping must be finite and not negative, got -4"));
  CHECK_THROWS_MATCHES(inertia_gen("q", -1.0), bad_parameter, rule("mass must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(inertia_2D("a", point_mass(-2.0)), bad_parameter,
                       rule("mass must be finite and not negative, got -2"));
  CHECK_THROWS_MATCHES(inertia_3D("a", point_mass(inf)), bad_parameter,
                       rule("mass must be finite and not negative, got inf"));
  CHECK_THROWS_MATCHES(inertia_2D("a", point_mass(1.0, along_x(inf))), bad_parameter,
                       rule("centre of mass must be finite, got inf"));
  CHECK_THROWS_MATCHES(inertia_3D("a", point_mass(1.0, along_z(-inf))), bad_parameter,
                       rule("centre of mass must be finite, got -inf"));
  CHECK_THROWS_MATCHES(inertia_2D("a", planar_body(1.0, -0.5)), bad_parameter,
                       rule("inertia must be finite and not negative, got -0.5"));
  CHECK_THROWS_MATCHES(inertia_3D("a", rigid_body{1.0, zero3{}, diagonal(1.0, 1.0, inf)}), bad_parameter,
                       rule("inertia must be finite, got inf"));
  CHECK_THROWS_MATCHES(inertia_3D("a", rigid_body{1.0, zero3{}, diagonal(1.0, inf, 1.0)}.as_published()), bad_parameter,
                       rule("inertia must be finite"));
  CHECK_THROWS_MATCHES(inertia_3D("a", upset), bad_parameter, rule("inertia must be physical: "));
  CHECK_THROWS_MATCHES(joint_backlash_gen("p", "q", -1.0, 1.0, 1.0), bad_parameter,
                       rule("gap must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(joint_backlash_gen("p", "q", 1.0, -2.0, 1.0), bad_parameter,
                       rule("stiffness must be finite and not negative, got -2"));
  CHECK_THROWS_MATCHES(joint_backlash_gen("p", "q", 1.0, 1.0, -3.0), bad_parameter,
                       rule("damping must be finite and not negative, got -3"));
  CHECK_THROWS_MATCHES(bad_lugre(&lugre_parameters::sigma0, 0), bad_parameter,
                       rule("sigma0 must be finite and positive, got 0"));
  CHECK_THROWS_MATCHES(bad_lugre(&lugre_parameters::sigma1, -1), bad_parameter,
                       rule("sigma1 must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(bad_lugre(&lugre_parameters::sigma2, -1), bad_parameter,
                       rule("sigma2 must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(bad_lugre(&lugre_parameters::coulomb, 0), bad_parameter,
                       rule("coulomb must be finite and positive, got 0"));
  CHECK_THROWS_MATCHES(bad_lugre(&lugre_parameters::stiction, 0.5), bad_parameter,
                       rule("stiction must be finite and not below coulomb, got 0.5"));
  CHECK_THROWS_MATCHES(bad_lugre(&lugre_parameters::stiction, inf), bad_parameter,
                       rule("stiction must be finite and not below coulomb, got inf"));
  CHECK_THROWS_MATCHES(bad_lugre(&lugre_parameters::stribeck_velocity, 0), bad_parameter,
                       rule("stribeck_velocity must be finite and positive, got 0"));
  CHECK_THROWS_MATCHES(prismatic_joint_2D("q", "a", "b", vec2{0.0, 2.0}), bad_parameter,
                       rule("axis must have length 1, got 2"));
  CHECK_THROWS_MATCHES(prismatic_joint_3D("q", "a", "b", vec3{0.0, 0.0, 0.0}), bad_parameter,
                       rule("axis must have length 1, got 0"));
  CHECK_THROWS_MATCHES(revolute_joint_3D("q", "a", "b", vec3{0.0, 3.0, 4.0}), bad_parameter,
                       rule("axis must have length 1, got 5"));
  CHECK_THROWS_MATCHES(rigid_link_gen("p", "q", inf), bad_parameter, rule("offset must be finite, got inf"));
  CHECK_THROWS_MATCHES(rigid_link_2D("a", "b", along_x(inf)), bad_parameter, rule("position must be finite, got inf"));
  CHECK_THROWS_MATCHES(rigid_link_3D("a", "b", along_x(-inf)), bad_parameter,
                       rule("position must be finite, got -inf"));
  CHECK_THROWS_MATCHES(rigid_link_2D("a", "b", zero3{}, rotation_2D<>{0.6, 0.6}), bad_parameter,
                       rule("rotation must be orthonormal and right-handed"));
  CHECK_THROWS_MATCHES(rigid_link_3D("a", "b", zero3{}, mirror), bad_parameter,
                       rule("rotation must be orthonormal and right-handed, got -1"));
  CHECK_THROWS_MATCHES(spring_gen("p", "q", inf, 1.0), bad_parameter, rule("rest length must be finite, got inf"));
  CHECK_THROWS_MATCHES(spring_2D("a", "b", -1.0, 1.0), bad_parameter,
                       rule("rest length must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(spring_3D("a", "b", -1.0, 1.0), bad_parameter,
                       rule("rest length must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(spring_gen("p", "q", 0.0, -1.0), bad_parameter,
                       rule("stiffness must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(spring_3D("a", "b", 0.0, 1.0, -2.0), bad_parameter,
                       rule("saturation must be finite and not negative, got -2"));
  CHECK_THROWS_MATCHES(torsion_spring_2D("a", "b", -1.0), bad_parameter,
                       rule("stiffness must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(torsion_spring_3D("a", "b", 1.0, -2.0), bad_parameter,
                       rule("saturation must be finite and not negative, got -2"));
  CHECK_THROWS_MATCHES(torsion_spring_2D("a", "b", 1.0, zero, inf), bad_parameter,
                       rule("rest angle must be finite, got inf"));
}

}  // namespace parameter_check_test
