#include <kte/math/axis.hpp>

#include "catch.hpp"
#include "math/draw.hpp"

namespace matrix_test {

using namespace kte;
using test::eigen;

template <class... T>
struct types {};
template <class F, class... T>
void each(types<T...>, F f) {
  (f.template operator()<T>(), ...);
}

using n = double;
using z = zero_t;
using o = one_t;
using m = constant<-1>;
/// Turns about axes, half turns, rotations by numbers about x, y and z, and matrices with all sorts of entries.
using matrices =
    types<mat3<>, std::remove_const_t<decltype(quarter_turn_x)>, std::remove_const_t<decltype(half_turn_z)>,
          mat3<vec3<o, z, z>, vec3<z, n, n>>, mat3<vec3<n, z, n>, vec3<z, o, z>, vec3<n, z, n>>,
          mat3<vec3<n, n, z>, vec3<n, n, z>, vec3<z, z, o>>, mat3<vec3<n, m, constant<2>>, vec3<o, n, n>, vec3<>>>;
using symmetric = types<sym3<>, sym3<zero_t>, sym3<n, z, z, n, z, n>, sym3<z, z, z, z, z, n>, sym3<n, n, z, o, z, n>>;
using vectors = types<vec3<>, zero3, vec3<z, z, n>, vec3<n, m, z>>;

constexpr double eps = std::numeric_limits<double>::epsilon();

double gap(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff(); }

TEST_CASE("dense matrices agree with Eigen") {
  // Entries below 1: a dot product of three has an error of at most 8/2 eps on either side, and one of three such dot
  // products, below 3 each, at most 3 (4 eps) + 24/2 eps.
  test::draw draw(3);
  for (int i = 0; i < 10000; ++i) {
    const auto a = draw.matrix(), b = draw.matrix();
    const auto s = draw.symmetric(), t = draw.symmetric();
    const auto v = draw.vector();
    const Eigen::Matrix3d ea = eigen(a), eb = eigen(b), es = eigen(s);
    const Eigen::Vector3d ev = eigen(v);
    REQUIRE(eigen(transpose(a)) == Eigen::Matrix3d(ea.transpose()));
    REQUIRE(gap(eigen(a * v), ea * ev) <= 8 * eps);
    REQUIRE(gap(eigen(a * b), ea * eb) <= 8 * eps);
    REQUIRE(gap(eigen(s * v), es * ev) <= 8 * eps);
    REQUIRE(eigen(s + t) == Eigen::Matrix3d(es + eigen(t)));
    REQUIRE(gap(eigen(congruence(a, s)), ea * es * ea.transpose()) <= 48 * eps);
  }
}

TEST_CASE("products of mixed matrices are exactly the dense ones") {
  test::draw draw(4);
  each(matrices{}, [&]<class A>() {
    each(matrices{}, [&]<class B>() {
      for (int i = 0; i < 8; ++i) {
        const auto a = draw.exact<A>();
        const auto b = draw.exact<B>();
        REQUIRE(as<double>(a * b) == as<double>(a) * as<double>(b));
        REQUIRE(eigen(a * b) == Eigen::Matrix3d(eigen(a) * eigen(b)));
        REQUIRE(as<double>(transpose(a)) == transpose(as<double>(a)));
      }
    });
    each(vectors{}, [&]<class V>() {
      for (int i = 0; i < 8; ++i) {
        const auto a = draw.exact<A>();
        const auto v = draw.exact<V>();
        REQUIRE(as<double>(a * v) == as<double>(a) * as<double>(v));
        REQUIRE(eigen(a * v) == Eigen::Vector3d(eigen(a) * eigen(v)));
      }
    });
    each(symmetric{}, [&]<class S>() {
      for (int i = 0; i < 8; ++i) {
        const auto a = draw.exact<A>();
        const auto s = draw.exact<S>();
        REQUIRE(as<double>(congruence(a, s)) == congruence(as<double>(a), as<double>(s)));
        REQUIRE(eigen(congruence(a, s)) == Eigen::Matrix3d(eigen(a) * eigen(s) * eigen(a).transpose()));
      }
    });
  });
}

TEST_CASE("sums and products of mixed symmetric matrices are exactly the dense ones") {
  test::draw draw(5);
  each(symmetric{}, [&]<class S>() {
    each(symmetric{}, [&]<class T>() {
      const auto s = draw.exact<S>();
      const auto t = draw.exact<T>();
      REQUIRE(as<double>(s + t) == as<double>(s) + as<double>(t));
    });
    each(vectors{}, [&]<class V>() {
      const auto s = draw.exact<S>();
      const auto v = draw.exact<V>();
      REQUIRE(as<double>(s * v) == as<double>(s) * as<double>(v));
      REQUIRE(eigen(s * v) == Eigen::Vector3d(eigen(s) * eigen(v)));
    });
  });
}

TEST_CASE("plane rotations agree with their matrices") {
  test::draw draw(6);
  for (int i = 0; i < 100; ++i) {
    const rotation_2D a{draw.dyadic(), draw.dyadic()}, b{draw.dyadic(), draw.dyadic()};
    const auto v = draw.exact<vec3<>>();
    const auto s = draw.exact<sym3<>>();
    REQUIRE(as<double>(matrix(a * b)) == as<double>(matrix(a) * matrix(b)));
    REQUIRE(as<double>(matrix(transpose(a))) == as<double>(transpose(matrix(a))));
    REQUIRE(a * v == matrix(a) * v);
    REQUIRE(vec2{(a * v).x, (a * v).y} == a * vec2{v.x, v.y});
    REQUIRE(congruence(a, s) == congruence(as<double>(matrix(a)), s));
    REQUIRE(congruence(no_rotation{}, s) == s);
    REQUIRE((no_rotation{} * a == a && a * no_rotation{} == a && no_rotation{} * v == v));
    REQUIRE(matrix(no_rotation{}) * v == v);
  }
  CHECK(angle(rotation_by(2.5)) == 2.5);
  CHECK(angle(rotation_by(-2)) == -2.0);
  static_assert(no_rotation{} * no_rotation{} == no_rotation{} && transpose(no_rotation{}) == no_rotation{});
}

}  // namespace matrix_test
