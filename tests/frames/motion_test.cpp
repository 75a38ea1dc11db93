#include <kte/frames/frame_2D.hpp>
#include <kte/frames/frame_3D.hpp>

#include "catch.hpp"
#include "frames/random_motion.hpp"
#include "math/draw.hpp"

namespace motion_test {

using namespace kte;
using namespace kte::test;

constexpr double eps = std::numeric_limits<double>::epsilon();
const digits50 eps50 = std::numeric_limits<digits50>::epsilon();

/// By five points at h = eps^(1/6): h^4/30 and h^4/90 times fifth and sixth derivatives, which for these curves reach
/// some 1e4, and roundings of p and R in 12 h^2: 1e3 eps^(2/3) = 3e-31.
const digits50 by_differences = 1000 * pow(eps50, digits50(2) / 3);

template <class R>
void check_composition_by_differences(unsigned seed) {
  random_numbers draw(seed);
  for (int i = 0; i < 20; ++i) {
    const curve<digits50, R> a(draw), b(draw);
    const auto both = [&](const digits50& t) { return compose(a(t), b(t)); };
    const auto by_formula = compose(motion_along<digits50>(a), motion_along<digits50>(b));
    CHECK(apart<digits50>(by_formula, motion_along<digits50>(both)) <= by_differences);
  }
}

TEST_CASE("composition of motions is the derivative of the composition of poses") {
  check_composition_by_differences<mat3<vec3<digits50>>>(1);
  check_composition_by_differences<unit_quaternion<digits50>>(2);
  check_composition_by_differences<rotation_2D<digits50>>(3);
}

TEST_CASE("composition is associative") {
  random_numbers draw(4);
  const auto check = [&]<class S, class R>(S tolerance, R) {
    for (int i = 0; i < 50; ++i) {
      const auto a = random_motion<S, R>(draw), b = random_motion<S, R>(draw), c = random_motion<S, R>(draw);
      CHECK(apart<S>(compose(compose(a, b), c), compose(a, compose(b, c))) <= tolerance);
    }
  };
  // An entry is a sum of products of up to four matrices and vectors, some 40 roundings of eps/2 either way.
  check(40 * eps, mat3<vec3<>>{});
  check(40 * eps, unit_quaternion<>{});
  check(digits50(40 * eps50), mat3<vec3<digits50>>{});
}

TEST_CASE("a frame at rest at the origin is neutral") {
  random_numbers draw(5);
  const auto m = random_motion<double>(draw);
  const auto here = at_rest(no_rotation{}, zero3{});
  static_assert(std::is_same_v<decltype(compose(m, here)), std::remove_const_t<decltype(m)>>);
  CHECK(numbers_of<double>(compose(m, here)) == numbers_of<double>(m));
  CHECK(numbers_of<double>(compose(here, m)) == numbers_of<double>(m));
}

TEST_CASE("steady rotation: centripetal and Coriolis accelerations") {
  // A turntable of 2 rad/s; on it, at 3 m, a car drives outwards at 5 m/s.
  const motion table{zero3{}, no_rotation{}, zero3{}, vec3{zero, zero, 2.0}, zero3{}, zero3{}};
  const motion car{along_x(3.0), no_rotation{}, along_x(5.0), zero3{}, zero3{}, zero3{}};
  const auto m = compose(table, car);
  CHECK(as<double>(m.velocity) == vec3{5.0, 6.0, 0.0});
  CHECK(as<double>(m.acceleration) == vec3{-12.0, 20.0, 0.0});  // -w^2 r, 2 w v
}

TEST_CASE("a wrench is transmitted so that its power is kept") {
  random_numbers draw(6);
  const auto power = [](const auto& m, const auto& w) {
    return dot(m.velocity, w.force) + dot(m.ang_velocity, w.torque);
  };
  for (int i = 0; i < 50; ++i) {
    const auto a = random_motion<double>(draw);
    const auto x = random_motion<double>(draw);
    const auto b = compose(a, at_rest(x.rotation, x.position));
    const wrench w{random_vector<double>(draw), random_vector<double>(draw)};
    CHECK(power(a, transmit(x, w)) == within(power(b, w), 40 * eps));
  }
}

/// The motion without typed constants.
template <class... M>
auto dense(const motion<M...>& m) {
  return motion{as<double>(m.position),     as<double>(matrix(m.rotation)), as<double>(m.velocity),
                as<double>(m.ang_velocity), as<double>(m.acceleration),     as<double>(m.ang_acceleration)};
}

TEST_CASE("typed motions are exactly the dense ones") {
  draw d(7);
  const auto v = [&] { return d.exact<vec3<>>(); };
  const auto x = [&] { return d.dyadic(); };
  const auto same = [](const auto& a, const auto& b) {
    CHECK(numbers_of<double>(compose(a, b)) == numbers_of<double>(compose(dense(a), dense(b))));
  };
  const auto spin = [&x](const auto& rotation) {
    return motion{zero3{}, rotation, zero3{}, axis::z * x(), zero3{}, axis::z * x()};
  };
  const auto general = [&] { return motion{v(), d.exact<mat3<>>(), v(), v(), v(), v()}; };
  const auto planar = [&] {
    const auto u = [&x] { return vec3{x(), x(), zero}; };
    return motion{u(), rotation_2D{x(), x()}, u(), axis::z * x(), u(), axis::z * x()};
  };
  const auto base_under_gravity = [&] {
    return motion{zero3{}, no_rotation{}, zero3{}, zero3{}, along_y(x()), zero3{}};
  };
  for (int i = 0; i < 10; ++i) {
    const auto link = at_rest(no_rotation{}, along_x(x()));
    const auto slide = motion{axis::x * x(), no_rotation{}, axis::x * x(), zero3{}, axis::x * x(), zero3{}};
    same(general(), link), same(planar(), link), same(base_under_gravity(), link), same(spin(no_rotation{}), link);
    same(general(), slide), same(planar(), slide), same(base_under_gravity(), slide), same(spin(no_rotation{}), slide);

    const auto turn = spin(rotation_2D{x(), x()});
    const auto bend = at_rest(quarter_turn, vec3{x(), x(), zero});
    same(planar(), turn), same(base_under_gravity(), turn), same(slide, turn), same(turn, bend);
    same(planar(), bend), same(base_under_gravity(), bend), same(link, bend), same(bend, turn);

    const auto solid = at_rest(quarter_turn_x, vec3{x(), zero, x()});
    const auto about_y =
        motion{zero3{}, rotation_about(axis::y, x(), x()), zero3{}, axis::y * x(), zero3{}, axis::y * x()};
    const auto about_minus_z = spin(rotation_about(axis::minus_z, x(), x()));
    same(general(), solid), same(base_under_gravity(), solid), same(solid, about_y), same(about_y, solid);
    same(general(), about_y), same(base_under_gravity(), about_y), same(about_y, about_minus_z);
    same(general(), about_minus_z), same(slide, about_minus_z), same(about_minus_z, link);
  }
}

TEST_CASE("what is skipped stays away, and the rest is the same") {
  random_numbers draw(8);
  const auto a = random_motion<double>(draw), b = random_motion<double>(draw);
  const auto all = compose(a, b);
  const auto part = compose(motion{skip{}, skip{}, skip{}, a.ang_velocity, a.acceleration, a.ang_acceleration}, b);
  static_assert(std::is_same_v<decltype(part.position), skip> && std::is_same_v<decltype(part.rotation), skip> &&
                std::is_same_v<decltype(part.velocity), skip>);
  CHECK(part.ang_velocity == all.ang_velocity);
  CHECK(part.acceleration == all.acceleration);
  CHECK(part.ang_acceleration == all.ang_acceleration);
}

TEST_CASE("a frame in the plane moves as one in space about z") {
  random_numbers draw(9);
  const auto n = [&draw] { return draw(); };
  const auto planar = [&] {
    return frame_2D<>{{n(), n()}, rotation_by(3 * n()), {n(), n()}, n(), {n(), n()}, n(), {n(), n()}, n()};
  };
  for (int i = 0; i < 50; ++i) {
    const auto a = planar(), b = planar();
    const auto both = compose(spatial(a), spatial(b));
    // Without typed zeros there are more terms, all of them 0. Results are equal, or differ by an ulp where the
    // compiler contracts a product and a sum.
    CHECK(apart<double>(both, compose(dense(spatial(a)), dense(spatial(b)))) <= 4 * eps);
    frame_2D<> flat;
    set_motion(flat, both);
    CHECK(numbers_of<double>(spatial(flat)) == numbers_of<double>(both));
    frame_3D<> solid;
    set_motion(solid, both);
    CHECK(numbers_of<double>(solid) == numbers_of<double>(both));

    const auto w = transmit(spatial(a), load_of(b));
    const auto dense_a = dense(spatial(a));
    const auto u = transmit(dense_a, wrench{as<double>(load_of(b).force), as<double>(load_of(b).torque)});
    CHECK(w.torque.z == within(u.torque.z, 4 * eps));
    auto loaded = a;
    add_load(loaded, w);
    CHECK(loaded.force == a.force + vec2{w.force.x, w.force.y});
    CHECK(loaded.torque == a.torque + w.torque.z);
    clear_load(loaded);
    CHECK(loaded.force == vec2{0.0, 0.0});
    CHECK(loaded.torque == 0.0);
  }
}

}  // namespace motion_test
