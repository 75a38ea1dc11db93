#include <kte/integrators/rosenbrock23.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/static.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace joint_elasto_plastic_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_     final : coord_key<"q">           {} q;
inline constexpr struct push_  final : input_key<"push">        {} push;
inline constexpr struct hairs_ final : internal_key<"bristles"> {} bristles;
// clang-format on

constexpr elasto_plastic_parameters dry{.sigma0 = 1e5,
                                        .sigma1 = 316,
                                        .sigma2 = 0.4,
                                        .coulomb = 1,
                                        .stiction = 1.5,
                                        .stribeck_velocity = 0.001,
                                        .breakaway = 7e-6};
constexpr lugre_parameters same_bristles{dry.sigma0,  dry.sigma1,   dry.sigma2,
                                         dry.coulomb, dry.stiction, dry.stribeck_velocity};

template <class S>
struct answer {
  S force, z_dot;
};
template <class S>
answer<S> answer_to(const S& v, const S& z, const elasto_plastic_parameters& p = dry) {
  auto x = trial_of<S>(joint_elasto_plastic_gen("q", "z", p), 1);
  x.template at<0>() = {.q_dot = v};
  x.template at<1>().z = z;
  x.doMotion(), x.doForce();
  return {x.template at<0>().f, x.template at<1>().z_dot};
}
/// By the formulas of the paper.
template <class S>
answer<S> by_paper(const S& v, const S& z) {
  using std::abs, std::exp, std::sin, std::acos;
  const S r = v / S(dry.stribeck_velocity), g = dry.coulomb + (S(dry.stiction) - dry.coulomb) * exp(S(-r * r));
  const S z_max = g / S(dry.sigma0), z_ba = dry.breakaway, size = abs(z);
  S alpha(0);
  if ((v < 0) == (z < 0)) {
    if (size >= z_max)
      alpha = 1;
    else if (size > z_ba)
      alpha = sin(S(acos(S(-1)) * (size - (z_max + z_ba) / 2) / (z_max - z_ba))) / 2 + S(0.5);
  }
  const S z_dot = v * (1 - alpha * (v < 0 ? S(-z) : z) / z_max);
  return {-(S(dry.sigma0) * z + dry.sigma1 * z_dot + dry.sigma2 * v), z_dot};
}
/// Where a mass of 1 kg is after 4 s under a push of 0.4 N, and a force that also oscillates by 0.25 N: its bristles
/// stay below the 0.7 N at which they begin to slip.
template <class Friction>
Eigen::Vector3d pushed_to_and_fro(const Friction& friction) {
  manipulator_dynamics_model model(chain(inertia_gen(q, 1.0), friction, driving_actuator_gen(q, push)));
  const auto pushed = [&](double t, const Eigen::Vector3d& x) {
    model.input(push) = 0.4 * std::min(t, 1.0) + (t < 1 ? 0 : 0.25 * std::sin(40 * (t - 1)));
    return model(t, x);
  };
  rosenbrock23 solver(pushed, 0.0, model.make_x(std::array{0.0}, std::array{0.0}),
                      {.absolute = 1e-11, .relative = 1e-6});
  solver.integrate(1), solver.integrate(4);
  return solver.state();
}

TEST_CASE("elasto-plastic friction is as in the paper") {
  random_numbers draw(1);
  for (int i = 0; i < 40; ++i) {
    const double v = draw(0.003), z = draw(1.5e-5);
    const auto x = answer_to(v, z);
    const auto exact = by_paper<digits50>(v, z), same = answer_to<digits50>(v, z);
    CHECK(std::abs(x.force - double(exact.force)) < 16 * 1.1e-16 * 5);
    CHECK(std::abs(x.z_dot - double(exact.z_dot)) < 16 * 1.1e-16 * 0.01);
    CHECK(abs(same.force - exact.force) < 1e-46);
  }
  CHECK(answer_to(0.0, 1e-5).z_dot == 0);
  CHECK(answer_to(0.0, 1e-5).force == -1);              // a spring
  CHECK(answer_to(1e-3, 7e-6).z_dot == 1e-3);           // that only bends
  CHECK(answer_to(1e-3, -3e-5).z_dot == 1e-3);          // or bends back
  for (const double v : {-1.0, -0.002, 0.0005, 0.1}) {  // sliding steadily, the force is that of Stribeck's curve
    const double r = v / 0.001, g = 1 + 0.5 * std::exp(-r * r);
    const auto x = answer_to(v, std::copysign(g / 1e5, v));
    CHECK(std::abs(x.z_dot) < 1e-15 * std::abs(v));
    CHECK(x.force == within_relative(-(std::copysign(g, v) + 0.4 * v), 1e-13));
  }
  CHECK(std::isnan(answer_to(not_a_number, 1e-5).force));
  CHECK(static_cast<double>(answer_to(1e-3f, 8e-6f).force) == within(answer_to(1e-3, 8e-6).force, 1e-5));
  auto sharp = dry;  // slips at once where it does
  sharp.stiction = 1, sharp.breakaway = 1 / 1e5;
  CHECK(answer_to(1e-3, 1 / 1e5, sharp).z_dot == 1e-3);
  CHECK(std::abs(answer_to(1e-3, 1.001 / 1e5, sharp).z_dot) <= 1.01e-6);
  CHECK(std::isnan(answer_to(1e-3, not_a_number).z_dot));
}

TEST_CASE("under a swinging load it stays where LuGre friction creeps", "[long]") {
  const auto x = pushed_to_and_fro(joint_elasto_plastic_gen(q, bristles, dry));
  CHECK(x[0] == within(x[2], 1e-12));  // the bristles have bent with it
  CHECK(std::abs(x[0]) < 7e-6);
  const auto y = pushed_to_and_fro(joint_lugre_gen(q, bristles, same_bristles));
  CHECK(y[0] > 1.2 * y[2]);
  CHECK(y[0] > 8e-6);
}

TEST_CASE("the Jacobian of a model with elasto-plastic friction knows its bristles") {
  manipulator_dynamics_model model(chain(inertia_gen(q, 1.0), joint_elasto_plastic_gen(q, bristles, dry)));
  const Eigen::Vector3d x(0.1, 5e-4, 1e-5);
  const auto j = model.jacobian(0.0, x);
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d d = Eigen::Vector3d::Zero();
    d[i] = i == 0 ? 1e-3 : 1e-5 * x[i];
    const Eigen::Vector3d differences = (model(0.0, x + d) - model(0.0, x - d)) / (2 * d[i]);
    CHECK((j.col(i) - differences).norm() <= 1e-8 * differences.norm());
  }
}

TEST_CASE("elasto-plastic friction is saved and loaded, and rejects invalid input") {
  const auto saved = record_of(chain(inertia_gen(q, 1.0), joint_elasto_plastic_gen(q, bristles, dry)));
  CHECK(record_of(models::registered(saved)) == saved);
  const auto what = [](auto member, double x) {
    auto p = dry;
    p.*member = x;
    return complaint([&] { (void)joint_elasto_plastic_gen("q", "z", p); });
  };
  const std::string where = "kte: joint_elasto_plastic_gen (coordinate 'q', bristles 'z'): ";
  using p = elasto_plastic_parameters;
  CHECK(what(&p::sigma0, 0) == where + "sigma0 must be finite and positive, got 0");
  CHECK(what(&p::breakaway, 0) == where + "breakaway must be finite and positive, got 0");
  CHECK(what(&p::breakaway, 1) == where + "breakaway must not be above coulomb / sigma0, got 1");
}

}  // namespace joint_elasto_plastic_test
