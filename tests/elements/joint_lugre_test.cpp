#include <kte/dynamics/derivatives.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/runtime_chain/from_record.hpp>
#include <kte/static.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace joint_lugre_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_     final : coord_key<"q">           {} q;
inline constexpr struct push_  final : input_key<"push">        {} push;
inline constexpr struct hairs_ final : internal_key<"bristles"> {} bristles;
inline constexpr struct base_  final : frame_2D_key<"base">     {} base;
inline constexpr struct cart_  final : frame_2D_key<"cart">     {} cart;
// clang-format on

constexpr lugre_parameters dry{
    .sigma0 = 1e5, .sigma1 = 316, .sigma2 = 0.4, .coulomb = 1, .stiction = 1.5, .stribeck_velocity = 0.001};

template <class S>
struct answer {
  S force, z_dot;
};
template <class S>
answer<S> answer_to(const lugre_parameters& p, const S& v, const S& z) {
  auto x = trial_of<S>(joint_lugre_gen("q", "z", p), 1);
  x.template at<0>() = {.q_dot = v};
  x.template at<1>().z = z;
  x.doMotion(), x.doForce();
  return {x.template at<0>().f, x.template at<1>().z_dot};
}
/// By the formulas of the paper.
template <class S>
answer<S> by_paper(const lugre_parameters& p, const S& v, const S& z) {
  using std::abs, std::exp;
  const S r = v / S(p.stribeck_velocity);
  const S g = p.coulomb + (S(p.stiction) - p.coulomb) * exp(S(-r * r));
  const S z_dot = v - S(p.sigma0) * abs(v) * z / g;
  return {-(S(p.sigma0) * z + p.sigma1 * z_dot + p.sigma2 * v), z_dot};
}

/// A cart of 1 kg that rubs and is pushed.
constexpr auto cart_on_rail = chain(prismatic_joint_2D(q, base, cart, axis::x), inertia_2D(cart, point_mass(1.0)),
                                    joint_lugre_gen(q, bristles, dry), driving_actuator_gen(q, push));
/// Where the cart is after 2 s under a push that rises for 1 s, so slowly that the bristles do not swing, with the
/// state of the bristles.
Eigen::Vector3d pushed_by(double force) {
  manipulator_dynamics_model model(cart_on_rail);
  const auto pushed = [&](double t, const Eigen::Vector3d& x) {
    model.input(push) = force * std::min(t, 1.0);
    return model(t, x);
  };
  rosenbrock23 solver(pushed, 0.0, model.make_x(std::array{0.0}, std::array{0.0}),
                      {.absolute = 1e-12, .relative = 1e-8});
  solver.integrate(1), solver.integrate(2);
  return solver.state();
}
/// The motion by the formulas of the paper, in 20000 classical Runge-Kutta steps h: the fastest rate, w = 316 1/s, is
/// that of the cart on its bristles, so they err by (w h)^4 / 120 = 1e-8 of what little it swings.
Eigen::Vector3d pushed_in_fixed_steps(double force) {
  constexpr double h = 1e-4;
  const auto rates = [&](double t, const Eigen::Vector3d& x) {
    const auto y = by_paper<double>(dry, x[1], x[2]);
    return Eigen::Vector3d(x[1], force * std::min(t, 1.0) + y.force, y.z_dot);
  };
  Eigen::Vector3d x(0, 0, 0);
  for (int i = 0; i < 20000; ++i) {
    const double t = i * h;
    const Eigen::Vector3d a = rates(t, x), b = rates(t + h / 2, x + h / 2 * a), c = rates(t + h / 2, x + h / 2 * b);
    x += h / 6 * (a + 2 * b + 2 * c + rates(t + h, x + h * c));
  }
  return x;
}

TEST_CASE("LuGre friction is as in the paper") {
  random_numbers draw(1);
  for (int i = 0; i < 20; ++i) {
    const double v = draw(0.003), z = draw(1.5e-5);
    const auto x = answer_to(dry, v, z);
    const auto exact = by_paper<digits50>(dry, v, z), same = answer_to<digits50>(dry, v, z);
    // some 8 roundings, of terms up to 1e5 z = 1.5 and 316 z_dot = 3
    CHECK(std::abs(x.force - double(exact.force)) < 8 * 1.1e-16 * 5);
    CHECK(std::abs(x.z_dot - double(exact.z_dot)) < 8 * 1.1e-16 * 0.01);
    CHECK(abs(same.force - exact.force) < 1e-47);
  }
}

TEST_CASE("sliding steadily, the force is that of Stribeck's curve") {
  for (const double v : {-1.0, -0.002, 0.0005, 0.1}) {
    const double r = v / 0.001, g = 1 + 0.5 * std::exp(-r * r), z = std::copysign(g / 1e5, v);
    const auto x = answer_to(dry, v, z);
    CHECK(std::abs(x.z_dot) < 1e-16);
    CHECK(x.force == within_relative(-(std::copysign(g, v) + 0.4 * v), 1e-13));
  }
  CHECK(answer_to(dry, 0.0, 1e-5).z_dot == 0);
  CHECK(answer_to(dry, 0.0, 1e-5).force == -1);  // a spring
}

TEST_CASE("below stiction a load is held for ever, above it slides") {
  const auto held = pushed_by(1.4), sliding = pushed_by(1.6);
  const auto exact = pushed_in_fixed_steps(1.4);
  // 2700 steps err by 1e-12 + 1e-8 |z| at most, and x moves by 15 times as much: dz/dx = 1 - 1.4/1.5. Then z
  // rests.
  CHECK(held[0] == within(exact[0], 2700 * 15 * 1.14e-12));
  CHECK(held[2] == within(1.4e-5, 1.14e-12));
  CHECK(std::abs(held[1]) < 1e-8);
  CHECK(sliding[0] > 0.25);
  CHECK(std::abs(sliding[2]) <= 1.5e-5);
}

TEST_CASE("derivatives pass through LuGre friction") {
  const auto c = chain(prismatic_joint_2D(q, base, cart, axis::x), inertia_2D(cart, point_mass(1.0)),
                       joint_lugre_gen(q, bristles, dry));
  const std::array x{0.0}, v{0.002}, a{0.0};
  const auto d = inverse_dynamics_derivatives(c, x, v, a);
  CHECK(d.by_v(0, 0) == within_relative(316 + 0.4, 1e-15));  // without bristles: z = 0
  CHECK(d.tau[0] == within_relative(0.002 * 316.4, 1e-15));
}

TEST_CASE("LuGre friction is saved and loaded") {
  const auto saved = record_of(cart_on_rail);
  CHECK(record_of(models::registered(saved)) == saved);
  CHECK(record_of(from_record(cart_on_rail, saved)) == saved);
}

TEST_CASE("LuGre friction rejects invalid input") {
  const auto what = [](auto member, double x) {
    auto p = dry;
    p.*member = x;
    return complaint([&] { (void)joint_lugre_gen("q", "z", p); });
  };
  const std::string where = "kte: joint_lugre_gen (coordinate 'q', bristles 'z'): ";
  CHECK(what(&lugre_parameters::sigma0, 0) == where + "sigma0 must be finite and positive, got 0");
  CHECK(what(&lugre_parameters::sigma1, -1) == where + "sigma1 must be finite and not negative, got -1");
  CHECK(what(&lugre_parameters::sigma2, not_a_number).starts_with(where + "sigma2 must be"));
  CHECK(what(&lugre_parameters::coulomb, -2) == where + "coulomb must be finite and positive, got -2");
  CHECK(what(&lugre_parameters::stiction, 0.5) == where + "stiction must be finite and not below coulomb, got 0.5");
  CHECK(what(&lugre_parameters::stiction, 1) == "");  // that of coulomb
  CHECK(what(&lugre_parameters::stribeck_velocity, 0) ==
        where + "stribeck_velocity must be finite and positive, got 0");
}

TEST_CASE("LuGre friction at rates of any size") {
  const kte::core::joint_lugre_gen friction{
      {.sigma0 = 1e10, .sigma1 = 0, .sigma2 = 0, .coulomb = 2, .stiction = 3, .stribeck_velocity = 1e-3}};
  using number = kte::dual<double, 1>;
  for (const double v : {1e150, 1e300, -1e300}) {
    kte::coordinate c{0.0, v, 0.0, kte::skip{}, kte::skip{}};
    CHECK(friction.z_dot(c, 1e-10) == v - 0.5 * std::abs(v));
    number rate(v);
    rate.derivative[0] = 1;
    kte::coordinate moving{number(0), rate, number(0), kte::skip{}, kte::skip{}};
    CHECK(friction.z_dot(moving, number(1e-10)).derivative[0] == (v < 0 ? 1.5 : 0.5));
  }
}

TEST_CASE("the Jacobian of a model with LuGre friction knows its bristles") {
  manipulator_dynamics_model model(cart_on_rail);
  model.input(push) = 1.2;
  const Eigen::Vector3d x(0.1, 5e-4, 1e-5);
  const auto j = model.jacobian(0.0, x);
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d d = Eigen::Vector3d::Zero();
    d[i] = i == 0 ? 1e-3 : 1e-5 * x[i];
    const Eigen::Vector3d differences = (model(0.0, x + d) - model(0.0, x - d)) / (2 * d[i]);
    // 1e-10 of third derivatives, of up to 3 in these units; rounding over 1e-5
    CHECK((j.col(i) - differences).norm() <= 1e-9 * differences.norm());
  }
}

}  // namespace joint_lugre_test
