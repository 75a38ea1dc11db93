
#include "digits50.hpp"
#include "dynamics/configurations.hpp"

// Velocities are the time derivatives of configurations, by differences at 50 digits.

namespace configuration_rate_test {

using namespace kte;
using namespace kte::test::configurations;
using big = kte::test::digits50;

TEST_CASE("the time derivative of integrate is v") {
  // By central differences at 50 digits, with errors of h^2 = 1e-34 and 1e-50/h.
  const big h("1e-17");
  random_numbers random(4);
  for (int round = 0; round < 10; ++round) {
    const auto q = random_configuration<big>(random);
    const auto v = random_vector<big, nv>(random, 2);
    const joint_vector<big, nq> rate = (integrate(model, q, v, h) - integrate(model, q, v, big(-h))) / (2 * h);
    const auto close = [](const big& x, const big& y) { return abs(x - y) < 1e-30; };
    const auto known = configuration_rate(model, q, v);
    for (int i = 0; i < nq; ++i) CHECK(close(rate[i], known[i]));
    CHECK(close(rate[0], v[0]));
    CHECK(close(rate[12], v[10]));
    const auto quaternion_rate = [&](int i, int j) {  // q' = q (0, w)/2
      const big w = q[i], x = q[i + 1], y = q[i + 2], z = q[i + 3], a = v[j], b = v[j + 1], c = v[j + 2];
      CHECK(close(rate[i], (-x * a - y * b - z * c) / 2));
      CHECK(close(rate[i + 1], (w * a + y * c - z * b) / 2));
      CHECK(close(rate[i + 2], (w * b + z * a - x * c) / 2));
      CHECK(close(rate[i + 3], (w * c + x * b - y * a) / 2));
    };
    quaternion_rate(4, 4), quaternion_rate(8, 7);
    const auto p = unit_quaternion<big>{q[4], q[5], q[6], q[7]} * vec3<big>{v[1], v[2], v[3]};  // p' = R v
    CHECK(close(rate[1], p.x));
    CHECK(close(rate[2], p.y));
    CHECK(close(rate[3], p.z));
    CHECK(close(rate[13], cos(q[15]) * v[11] - sin(q[15]) * v[12]));
    CHECK(close(rate[14], sin(q[15]) * v[11] + cos(q[15]) * v[12]));
    CHECK(close(rate[15], v[13]));
  }
}

TEST_CASE("frames move as the configuration does") {
  // Along q(t) = integrate(q, t v + t^2/2 a, 1) the rates are v + t a but for t^2: velocity and acceleration of a frame
  // are derivatives of where it stands.
  const big h("1e-12");  // errors: h^2 = 1e-24, and 1e-50/h^2 = 1e-26
  random_numbers random(5);
  auto s = make_state<big>(model.gravity(zero3{}));
  for (int round = 0; round < 10; ++round) {
    const auto q = random_configuration<big>(random);
    const auto v = random_vector<big, nv>(random, 2), a = random_vector<big, nv>(random, 3);
    set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
    model.doMotion(s);
    const auto at = [&](const big& t) {
      const joint_vector<big, nv> way = t * v + (t * t / 2) * a;
      return integrate(model, q, way, big(1));
    };
    const auto check = [&](const auto& frame, const auto& where) {
      const auto before = where(at(-h)), now = where(at(big(0))), after = where(at(h));
      const auto back = transpose(frame.rotation);
      const auto velocity = back * ((1 / (2 * h)) * (after - before));
      const auto acceleration = back * ((1 / (h * h)) * ((after - now) - (now - before)));
      const auto gap = [](const auto& x, const auto& y) {
        const auto d = x - y;
        return big(dot(d, d));
      };
      CHECK(gap(velocity, frame.velocity) < 1e-40);
      CHECK(gap(acceleration, frame.acceleration) < 1e-40);
    };
    check(s[tip], [](const auto& p) { return forward_kinematics(model, p, tip).position; });
    check(s[body], [](const auto& p) { return forward_kinematics(model, p, body).position; });
    check(s[disc], [](const auto& p) { return forward_kinematics(model, p, disc).position; });
  }
}

}  // namespace configuration_rate_test
