#include <kte/math/rigid_body.hpp>

#include <vector>

#include "catch.hpp"
#include "math/draw.hpp"

namespace rigid_body_test {

using namespace kte;
using test::eigen;

constexpr double eps = std::numeric_limits<double>::epsilon();

struct particle {
  double mass;
  Eigen::Vector3d at;
};
/// 200 masses in (0, 1) kg in a cube of 2 m.
std::vector<particle> cloud(std::uint64_t seed) {
  test::draw draw(seed);
  std::vector<particle> r;
  for (int i = 0; i < 200; ++i) r.push_back({(1 + draw.number()) / 2, eigen(draw.vector())});
  return r;
}

/// Mass, first moment and inertia about the origin by their definitions.
struct moments {
  double mass = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  void add(const particle& p) {
    mass += p.mass;
    first += p.mass * p.at;
    inertia += p.mass * (p.at.squaredNorm() * Eigen::Matrix3d::Identity() - p.at * p.at.transpose());
  }
};
moments of(const std::vector<particle>& particles) {
  moments r;
  for (const auto& p : particles) r.add(p);
  return r;
}

/// The body of a cloud as its user would give it: about its centre of mass.
rigid_body<> body(const std::vector<particle>& particles) {
  const Eigen::Vector3d c = of(particles).first / of(particles).mass;
  auto centred = particles;
  for (auto& p : centred) p.at -= c;
  const auto i = of(centred).inertia;
  return {of(particles).mass, {c.x(), c.y(), c.z()}, {i(0, 0), i(0, 1), i(0, 2), i(1, 1), i(1, 2), i(2, 2)}};
}

template <class M, class H, class I>
void check_same(const composite<M, H, I>& a, const moments& b, double tolerance) {
  CHECK(std::abs(as<double>(a.mass) - b.mass) <= tolerance);
  CHECK((eigen(a.moment) - b.first).cwiseAbs().maxCoeff() <= tolerance);
  CHECK((eigen(a.inertia) - b.inertia).cwiseAbs().maxCoeff() <= tolerance);
}

// Sums of 200 terms, which grow to about 100 kg, 20 kg m and 130 kg m^2, are rounded 200 times by eps/2 of that:
// 1.3e4 eps at worst, and the errors of single terms are lost in this. Far from the origin, at 10 m, moments grow to
// 3e4 kg m^2, and the bound with them.
constexpr double near_by = 2e4 * eps, far_off = 3e6 * eps;

TEST_CASE("a cloud of point masses adds up to its composite") {
  for (const std::uint64_t seed : {11u, 12u, 13u}) {
    const auto particles = cloud(seed);
    composite<double, vec3<>, sym3<>> sum{};
    for (const auto& p : particles) sum = sum + to_composite(point_mass(p.mass, vec3{p.at.x(), p.at.y(), p.at.z()}));
    check_same(sum, of(particles), near_by);
    check_same(to_composite(body(particles)), of(particles), near_by);
  }
}

TEST_CASE("a transported composite is that of the moved cloud") {
  test::draw draw(14);
  for (const double distance : {0.0, 1.0, 10.0}) {
    for (std::uint64_t seed = 20; seed < 40; ++seed) {
      const auto rotation = matrix(draw.rotation());
      const auto position = distance * draw.vector();
      auto particles = cloud(seed);
      const auto at_home = to_composite(body(particles));
      for (auto& p : particles) p.at = eigen(rotation) * p.at + eigen(position);
      const double tolerance = distance > 1 ? far_off : near_by;
      check_same(transported(rotation, position, at_home), of(particles), tolerance);
      check_same(transported(no_rotation{}, position, transported(rotation, zero3{}, at_home)), of(particles),
                 tolerance);
    }
  }
}

TEST_CASE("composites of two clouds add") {
  auto a = cloud(15);
  const auto b = cloud(16);
  const auto sum = to_composite(body(a)) + to_composite(body(b));
  a.insert(a.end(), b.begin(), b.end());
  check_same(sum, of(a), 2 * near_by);
  check_same(sum + no_mass, of(a), 2 * near_by);
}

TEST_CASE("the force on a rotating composite is that on its particles") {
  // F = m a + al x h, T = I al + h x a: the sums of m_i a_i and p_i x m_i a_i with a_i = a + al x p_i.
  const auto particles = cloud(17);
  const auto c = to_composite(body(particles));
  const vec3 a{0.3, -0.7, 0.2}, al{-0.4, 0.1, 0.9};
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
  for (const auto& p : particles) {
    const Eigen::Vector3d f = p.mass * (eigen(a) + eigen(al).cross(p.at));
    force += f;
    torque += p.at.cross(f);
  }
  CHECK((eigen(c.mass * a + cross(al, c.moment)) - force).cwiseAbs().maxCoeff() <= near_by);
  CHECK((eigen(c.inertia * al + cross(c.moment, a)) - torque).cwiseAbs().maxCoeff() <= near_by);
}

template <class A, class B>
void check_equal(const A& a, const B& b) {
  CHECK(as<double>(a.mass) == as<double>(b.mass));
  CHECK(as<double>(a.moment) == as<double>(b.moment));
  CHECK(as<double>(a.inertia) == as<double>(b.inertia));
}
template <class M, class C, class I>
rigid_body<> dense(const rigid_body<M, C, I>& b) {
  return {as<double>(b.mass), as<double>(b.com), as<double>(b.inertia)};
}
template <class M, class H, class I>
composite<double, vec3<>, sym3<>> dense(const composite<M, H, I>& c) {
  return {as<double>(c.mass), as<double>(c.moment), as<double>(c.inertia)};
}

TEST_CASE("typed bodies and transports are exactly the dense ones") {
  test::draw draw(18);
  const auto check_body = [&](const auto& body) {
    check_equal(to_composite(body), to_composite(dense(body)));
    const auto check_pose = [&](const auto& r, const auto& p) {
      const auto c = to_composite(body);
      check_equal(transported(r, p, c), transported(as<double>(matrix(r)), as<double>(p), dense(c)));
      check_equal(transported(r, p, c) + c, dense(transported(r, p, c)) + dense(c));
    };
    check_pose(no_rotation{}, zero3{});
    check_pose(no_rotation{}, draw.exact<vec3<>>());
    check_pose(quarter_turn_x, along_z(draw.dyadic()));
    check_pose(half_turn_y, vec3{draw.dyadic(), zero, draw.dyadic()});
    check_pose(rotation_about(axis::y, draw.dyadic(), draw.dyadic()), along_x(draw.dyadic()));
    check_pose(draw.exact<mat3<>>(), draw.exact<vec3<>>());
    check_pose(rotation_2D{draw.dyadic(), draw.dyadic()}, vec3{draw.dyadic(), draw.dyadic(), zero});
  };
  for (int i = 0; i < 20; ++i) {
    check_body(point_mass(draw.dyadic()));
    check_body(point_mass(draw.dyadic(), along_y(draw.dyadic())));
    check_body(planar_body(draw.dyadic(), draw.dyadic(), along_x(draw.dyadic())));
    check_body(rigid_body{draw.dyadic(), draw.exact<vec3<>>(), draw.exact<sym3<>>()});
    check_body(rigid_body{draw.dyadic(), along_z(draw.dyadic()), diagonal(draw.dyadic(), draw.dyadic(), zero)});
  }
}

TEST_CASE("typed bodies fold") {
  static_assert(std::is_same_v<decltype(to_composite(point_mass(2.0))), composite<double, zero3, sym3<zero_t>>>);
  static_assert(std::is_same_v<decltype(to_composite(planar_body(1, 2)).inertia),
                               sym3<zero_t, zero_t, zero_t, zero_t, zero_t, double>>);
  static_assert(to_composite(point_mass(2, along_x(3))).inertia.zz == 18.0);
  SUCCEED();
}

}  // namespace rigid_body_test
