#include <kte/dynamics/derivatives.hpp>
#include <kte/kte.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "catch.hpp"
#include "chain/models.hpp"
#include "random.hpp"

// Derivatives by dual numbers, in chains where some elements are known by their forces alone; both ways against each
// other; forward dynamics too against central differences at 50 digits. Measured 1.3e-15 of the largest number for
// inverse dynamics, 7e-16 for forward dynamics; bounds are 3 to 4 times that.

using namespace kte;
using big = boost::multiprecision::cpp_bin_float_50;

namespace {

namespace keys {
// clang-format off
inline constexpr struct q1_     final : coord_key<"q1">           {} q1;
inline constexpr struct q2_     final : coord_key<"q2">           {} q2;
inline constexpr struct ball_   final : rotation_3D_key<"ball">   {} ball;
inline constexpr struct base_   final : frame_3D_key<"base">      {} base;
inline constexpr struct a_      final : frame_3D_key<"a">         {} a;
inline constexpr struct b_      final : frame_3D_key<"b">         {} b;
inline constexpr struct c_      final : frame_3D_key<"c">         {} c;
inline constexpr struct d_      final : frame_3D_key<"d">         {} d;
// clang-format on
}  // namespace keys

constexpr rigid_body body{1.5, vec3{0.125, -0.25, 0.0625}, sym3{0.25, 0.03125, -0.0625, 0.1875, 0.015625, 0.1875}};
constexpr rigid_body light{0.25, vec3{0.03125, 0.125, -0.0625}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
constexpr vec3 fall{0.5, -0.25, -9.81};

/// A base that is anywhere and moves in any way; a coordinate or input that is given.
template <class S>
void move(frame_3D<S>& x, random_numbers& random) {
  const auto vector = [&random] { return vec3<>{random(), random(), random()}; };
  x.position = as<S>(vector());
  x.rotation = as<S>(matrix(normalized(random(), random(), random(), 2 + random())));
  x.velocity = as<S>(vector()), x.ang_velocity = as<S>(vector());
  x.acceleration = as<S>(9.0 * vector()), x.ang_acceleration = as<S>(3.0 * vector());
}
template <class S>
void move(frame_2D<S>& x, random_numbers& random) {
  const double angle = random(3);
  x.position = {S(random()), S(random())};
  x.rotation = {S(std::cos(angle)), S(std::sin(angle))};
  x.velocity = {S(random()), S(random())}, x.ang_velocity = S(random());
  x.acceleration = {S(random(9)), S(random(9))}, x.ang_acceleration = S(random(3));
}
template <class S>
void move(gen_coord<S>& x, random_numbers& random) {
  x.q = S(random(3)), x.q_dot = S(random(2)), x.q_ddot = S(random(5));
}
void move(double& x, random_numbers& random) { x = random(5); }
void move(big& x, random_numbers& random) { x = random(5); }

/// max |x - exact| / max |exact|; infinite if an x is no number.
template <class X, class Y>
double gap(const X& x, const Y& exact) {
  big difference = 0, size = 0;
  for (Eigen::Index i = 0; i < exact.rows(); ++i)
    for (Eigen::Index j = 0; j < exact.cols(); ++j) {
      const big d = abs(big(x(i, j)) - big(exact(i, j)));
      if (d == d) difference = std::max(difference, d);
      if (!(d == d)) difference = HUGE_VAL;
      size = std::max(size, big(abs(big(exact(i, j)))));
    }
  return static_cast<double>(size == 0 ? difference : difference / size);
}
void note(double& worst, double d) {
  if (!(d <= worst)) worst = d;
}

/// Central differences of f(state) by q, v or a, along each velocity; steps of 1e-16 err by 1e-32 times a third
/// derivative and lose 1e-34.
enum class by { q, v, a };
template <class Chain, class State, class F>
auto differences(const Chain& c, const State& s, by what, const F& f) {
  constexpr int n = Chain::dofs;
  using vector = joint_vector<big, n>;
  const big step("1e-16");
  joint_matrix<big, n> m;
  for (int j = 0; j < n; ++j) {
    const auto at = [&](const big& h) {
      auto t = s;
      const vector e = vector::Unit(j);
      if (what == by::q) set_positions(t, integrate(c, positions(s), e, h));
      if (what == by::v) set_velocities(t, vector(velocities(s) + h * e));
      if (what == by::a) set_accelerations(t, vector(accelerations(s) + h * e));
      return vector(f(t));
    };
    m.col(j) = (at(step) - at(-step)) / (2 * step);
  }
  return m;
}

constexpr auto joints = [] {
  using namespace keys;
  return chain(revolute_joint_3D(q1, base, a, axis::minus_y), inertia_3D(a, body),
               rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x), spherical_joint_3D(ball, b, c),
               inertia_3D(c, body), prismatic_joint_3D(q2, c, d, axis::x), inertia_3D(d, light),
               spring_gen(q1, q2, 0.25, 20.0), damper_gen(q1, q2, 0.25));
}();
/// Analytical.
constexpr auto arm = joints.gravity(fall);
/// Not: forces between frames.
constexpr auto sprung = [] {
  using namespace keys;
  return chain(joints, spring_3D(base, d, 0.5, 40.0), damper_3D(base, c, 0.75)).gravity(fall);
}();

/// The same random q, v, a in two states.
template <class State>
auto put_random(State& s, auto& exact, unsigned seed) {
  random_numbers random(seed);
  using wiring = typename State::wiring;
  joint_vector<double, wiring::nq> q;
  joint_vector<double, wiring::dofs> v, a;
  for (auto& x : q) x = random(3);
  for (auto& x : v) x = random(2);
  for (auto& x : a) x = random(5);
  set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
  set_positions(exact, q), set_velocities(exact, v), set_accelerations(exact, a);
  return std::tuple{q, v, a};
}

template <class Chain, class... Outside>
void check(const char* name, const Chain& chain, double most_of_inverse, double most_of_forward,
           const Outside&... outside) {
  STATIC_REQUIRE(!detail::is_analytical<Chain>);
  constexpr int n = Chain::dofs;
  struct {
    double by_q = 0, by_v = 0, by_a = 0, tau = 0, forward_by_q = 0, forward_by_v = 0, by_tau = 0;
  } worst;
  for (unsigned round = 0; round < 3; ++round) {
    auto s = make_state(chain);
    auto exact = make_state<big>(chain);
    put_random(s, exact, 10 + round);
    random_numbers draw(100 + round), same(100 + round);
    (move(s[outside], draw), ...), (move(exact[outside], same), ...);

    const auto forces = [&](const auto& t) { return inverse_dynamics(chain, t); };
    const auto r = inverse_dynamics_derivatives(chain, s);
    const auto by_a = differences(chain, exact, by::a, forces);
    note(worst.by_q, gap(r.by_q, differences(chain, exact, by::q, forces)));
    note(worst.by_v, gap(r.by_v, differences(chain, exact, by::v, forces)));
    note(worst.by_a, gap(r.by_a, by_a));
    note(worst.tau, gap(r.tau, forces(exact)));

    const auto rates = [&](const auto& t) { return forward_dynamics(chain, t); };
    const auto f = forward_dynamics_derivatives(chain, s);
    CHECK(f.a == rates(s));
    note(worst.forward_by_q, gap(f.by_q, differences(chain, exact, by::q, rates)));
    note(worst.forward_by_v, gap(f.by_v, differences(chain, exact, by::v, rates)));
    const auto identity = joint_matrix<big, n>::Identity();
    const joint_matrix<big, n> unity = f.by_tau.template cast<big>() * by_a;
    note(worst.by_tau, gap(unity, joint_matrix<big, n>(identity)));
  }
#ifdef KTE_PRINT
  std::printf("%s: ID by_q %.1e by_v %.1e by_a %.1e tau %.1e; FD by_q %.1e by_v %.1e M^-1 M %.1e\n", name, worst.by_q,
              worst.by_v, worst.by_a, worst.tau, worst.forward_by_q, worst.forward_by_v, worst.by_tau);
#endif
  CAPTURE(name);
  CHECK(worst.by_q < most_of_inverse);
  CHECK(worst.by_v < most_of_inverse);
  CHECK(worst.by_a < most_of_inverse);
  CHECK(worst.tau < most_of_inverse);
  CHECK(worst.forward_by_q < most_of_forward);
  CHECK(worst.forward_by_v < most_of_forward);
  CHECK(worst.by_tau < most_of_forward);
}

}  // namespace

TEST_CASE("derivatives of a chain with springs between frames", "[derivatives]") {
  check("sprung", sprung, 4e-15, 3e-15, keys::base);
}
TEST_CASE("derivatives where coordinates follow others and move two joints", "[derivatives]") {
  check("tree", models::tree, 4e-15, 3e-15, models::ground, models::wall, models::motor);
}

TEST_CASE("element by element as by dual numbers", "[derivatives]") {
  STATIC_REQUIRE(detail::is_analytical<std::remove_const_t<decltype(arm)>>);
  auto s = make_state(arm), t = s;
  for (unsigned round = 0; round < 10; ++round) {
    const auto [q, v, a] = put_random(s, t, round);
    const auto r = inverse_dynamics_derivatives(arm, q, v, a);
    inverse_dynamics_result<double, 5> x;
    detail::dual_derivatives<double>(arm, detail::base_under_gravity(arm), q, v, a, x);
    CHECK(gap(r.tau, x.tau) < 2e-15);
    CHECK(gap(r.by_q, x.by_q) < 3e-15);
    CHECK(gap(r.by_v, x.by_v) < 3e-15);
  }
}
