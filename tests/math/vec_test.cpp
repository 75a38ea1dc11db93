#include "catch.hpp"
#include "math/draw.hpp"

namespace vec_test {

using namespace kte;
using test::eigen;

template <class... T>
struct types {};
template <class F, class... T>
void each(types<T...>, F f) {
  (f.template operator()<T>(), ...);
}

using two_t = constant<2>;
/// Axes, distances along axes, plane vectors, and mixtures.
using vectors = types<vec3<>, zero3, vec3<one_t, zero_t, zero_t>, vec3<zero_t, constant<-1>, zero_t>,
                      vec3<zero_t, zero_t, double>, vec3<double, double, zero_t>, vec3<zero_t, double, double>,
                      vec3<double, one_t, double>, vec3<two_t, double, constant<-1>>, vec3<one_t, two_t, zero_t>>;

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST_CASE("dense vectors agree with Eigen") {
  // Numbers below 1. Sum, difference: one rounding each. A product of cross: two products and a difference, each
  // rounded by eps/2 of at most 1, 1 and 2. dot: three products and sums up to 3. Both sides may differ by twice that.
  test::draw draw(1);
  for (int i = 0; i < 10000; ++i) {
    const auto a = draw.vector(), b = draw.vector();
    const double s = draw.number();
    const Eigen::Vector3d ea = eigen(a), eb = eigen(b);
    REQUIRE(eigen(a + b) == Eigen::Vector3d(ea + eb));
    REQUIRE(eigen(a - b) == Eigen::Vector3d(ea - eb));
    REQUIRE(eigen(-a) == Eigen::Vector3d(-ea));
    REQUIRE(eigen(s * a) == Eigen::Vector3d(s * ea));
    REQUIRE(eigen(a * s) == Eigen::Vector3d(s * ea));
    REQUIRE((eigen(cross(a, b)) - ea.cross(eb)).cwiseAbs().maxCoeff() <= 4 * eps);
    REQUIRE(std::abs(dot(a, b) - ea.dot(eb)) <= 8 * eps);
    const vec2 c{a.x, a.y}, d{b.x, b.y};
    REQUIRE(std::abs(dot(c, d) - ea.head<2>().dot(eb.head<2>())) <= 4 * eps);
    REQUIRE(c + d == vec2{a.x + b.x, a.y + b.y});
    REQUIRE(c - d == vec2{a.x - b.x, a.y - b.y});
    REQUIRE(s * c == vec2{s * a.x, s * a.y});
  }
}

TEST_CASE("vectors of typed constants and numbers are exactly the dense ones") {
  test::draw draw(2);
  each(vectors{}, [&]<class A>() {
    each(vectors{}, [&]<class B>() {
      for (int i = 0; i < 8; ++i) {
        const auto a = draw.exact<A>();
        const auto b = draw.exact<B>();
        const double s = draw.dyadic();
        const auto da = as<double>(a), db = as<double>(b);
        REQUIRE(as<double>(a + b) == da + db);
        REQUIRE(as<double>(a - b) == da - db);
        REQUIRE(as<double>(-a) == -da);
        REQUIRE(as<double>(s * a) == s * da);
        REQUIRE(as<double>(a * two_t{}) == 2.0 * da);
        REQUIRE(as<double>(cross(a, b)) == cross(da, db));
        REQUIRE(as<double>(dot(a, b)) == dot(da, db));
        REQUIRE(eigen(cross(a, b)) == Eigen::Vector3d(eigen(a).cross(eigen(b))));
        REQUIRE(as<double>(dot(a, b)) == eigen(a).dot(eigen(b)));
      }
    });
  });
}

TEST_CASE("typed vectors fold") {
  constexpr vec3 x{one, zero, zero};
  constexpr vec3 y{zero, one, zero};
  static_assert(std::is_same_v<decltype(cross(x, y)), vec3<zero_t, zero_t, one_t>>);
  static_assert(std::is_same_v<decltype(dot(x, y)), zero_t>);
  static_assert(std::is_same_v<decltype(cross(along_z(0.5), along_z(2.0))), zero3>);
  static_assert(std::is_same_v<decltype(x * 0.5), vec3<double, zero_t, zero_t>>);
  static_assert(cross(along_x(2.0), along_y(3.0)).z == 6.0);
  static_assert(detail::planar(vec2{1, 2.5}) == vec3{1.0, 2.5, zero});
  SUCCEED();
}

}  // namespace vec_test
