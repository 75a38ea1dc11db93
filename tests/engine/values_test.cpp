#include <kte/engine/axes.hpp>

#include "catch.hpp"

// Values that recursions hand on, and axes that are unit vectors by type.

namespace values_test {

using namespace kte;
using namespace kte::engine;

TEST_CASE("arrays hold numbers instead of typed constants") {
  using typed = wrench<vec3<double, zero_t, one_t>, zero3>;
  STATIC_REQUIRE(std::is_same_v<dense<double, typed>, wrench<vec3<double>, vec3<double>>>);
  STATIC_REQUIRE(std::is_same_v<dense<float, zero_t>, float>);
  STATIC_REQUIRE(std::is_same_v<dense<double, skip>, skip>);
  dense<double, typed> x{};
  const typed from{{0.25, {}, {}}, {}};
  assign(x, from);
  CHECK(x.force == vec3{0.25, 0.0, 1.0});
  CHECK(x.torque == vec3{0.0, 0.0, 0.0});
  CHECK(fresh(x).force == x.force);
}

TEST_CASE("numbers are read back as the type that has constants among them") {
  const wrench<vec3<double>, vec3<double>> x{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  using typed = wrench<vec3<double, zero_t, double>, zero3>;
  const typed y = typed_as<typed>::of(x);
  CHECK(y.force.x == 1.0);
  CHECK(y.force.z == 3.0);
}

TEST_CASE("skipped quantities are unchanged") {
  motion_vector<vec3<double>, vec3<double>> x{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  assign(x, motion_vector<skip, vec3<double>>{{}, {7.0, 8.0, 9.0}});
  CHECK(x.linear == vec3{1.0, 2.0, 3.0});
  CHECK(x.angular == vec3{7.0, 8.0, 9.0});
  motion_vector<skip, vec3<double>> y{};
  assign(y, x);
  CHECK(y.angular == x.angular);
}

TEST_CASE("unit axes are known by type") {
  const auto number = []<class V, class W>(const V&, const W&) { return unit_axis<motion_vector<V, W>>; };
  CHECK(number(vec3{one, zero, zero}, zero3{}) == 0);
  CHECK(number(vec3{zero, zero, minus_one}, zero3{}) == 2);
  CHECK(number(zero3{}, vec3{zero, one, zero}) == 4);
  CHECK(number(zero3{}, vec3{zero, zero, one}) == 5);
  CHECK(number(zero3{}, vec3{zero, zero, 1.0}) == -1);
  CHECK(number(vec3{one, zero, zero}, vec3{one, zero, zero}) == -1);
  CHECK(number(zero3{}, zero3{}) == -1);
}

TEST_CASE("what belongs to a unit axis is left out") {
  const sym3 a{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const mat3 h{vec3{1.0, 2.0, 3.0}, vec3{4.0, 5.0, 6.0}, vec3{7.0, 8.0, 9.0}};
  dense<double, articulated<sym3<double>, mat3<vec3<double>>, sym3<double>>> x{};
  assign(x, without<1>(articulated{a, h, a}));  // along y
  CHECK(x.linear == sym3{1.0, 0.0, 3.0, 0.0, 0.0, 6.0});
  CHECK(x.coupling == mat3{vec3{1.0, 2.0, 3.0}, vec3{0.0, 0.0, 0.0}, vec3{7.0, 8.0, 9.0}});
  CHECK(x.angular == a);
  assign(x, without<5>(articulated{a, h, a}));  // about z
  CHECK(x.linear == a);
  CHECK(x.coupling == mat3{vec3{1.0, 2.0, 0.0}, vec3{4.0, 5.0, 0.0}, vec3{7.0, 8.0, 0.0}});
  CHECK(x.angular == sym3{1.0, 2.0, 0.0, 4.0, 0.0, 0.0});
  assign(x, without<-1>(articulated{a, h, a}));
  CHECK(x.linear == a);
  CHECK(x.angular == a);
}

}  // namespace values_test
