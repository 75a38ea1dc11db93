/// The tutorial: one pendulum as a static and as a runtime chain. It is built, saved as XML and JSON, loaded back as a
/// runtime chain and into the static chain type, simulated for 50 s by Euler's method and by Dormand-Prince 5(4), and
/// compared with the exact solution. Rows of t, q, qd, qdd, f go to pendulum_*.ssv.
#include <kte/io.hpp>
#include <kte/kte.hpp>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include <cstdio>
#include <ctime>
#include <numbers>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">        {} q;
inline constexpr struct base_  final : kte::frame_2D_key<"base">  {} base;
inline constexpr struct joint_ final : kte::frame_2D_key<"joint"> {} joint;
inline constexpr struct tip_   final : kte::frame_2D_key<"tip">   {} tip;
// clang-format on

constexpr double length = 0.5, gravity = 9.81, duration = 50;

constexpr auto pendulum =
    kte::chain(kte::revolute_joint_2D(q, base, joint), kte::rigid_link_2D(joint, tip, kte::along_x(length)),  // m
               kte::inertia_2D(tip, kte::point_mass(1.0)))                                                    // kg
        .gravity(kte::along_y(-gravity));

/// The exact angle at time t after release from the horizontal, rad; q is 0 there and -pi/2 when hanging:
///   q = 2 asin(k sn(K - w t)) - pi/2,   k = sin(pi/4),  w = sqrt(g/L)
double exact(double t) {
  const double k = std::sqrt(0.5), w = std::sqrt(gravity / length);
  return 2 * std::asin(k * boost::math::jacobi_sn(k, boost::math::ellint_1(k) - w * t)) - std::numbers::pi / 2;
}

/// Accelerations by the three passes and the mass matrix; for both kinds of chain.
template <class Chain, class State>
double acceleration(const Chain& chain, State& s, const Eigen::Vector2d& x) {
  auto& c = s.coordinate(0);
  c.q = x[0], c.q_dot = x[1], c.q_ddot = 0;
  chain.doMotion(s);
  chain.clearForce(s);
  chain.doForce(s);
  return c.q_ddot = c.f / kte::mass_matrix(chain, s)(0, 0);
}

template <class Chain, class State>
void simulate(const Chain& chain, State s, const char* how) {
  const auto rhs = [&](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], acceleration(chain, s, x)); };
  const Eigen::Vector2d x0(0, 0);
  const auto run = [&](const char* name, auto solver) {
    const std::string file = std::string("pendulum_") + how + "_" + name + ".ssv";
    kte::table_writer out(file, {"t", "q", "qd", "qdd", "f"});
    double largest = 0;
    solver.integrate(duration, kte::every(0.001), [&](double t, const Eigen::Vector2d& x) {
      const double a = acceleration(chain, s, x);
      out.row(t, x[0], x[1], a, s.coordinate(0).f);
      largest = std::max(largest, std::abs(x[0] - exact(t)));
    });
    out.close();
    return std::pair{solver, largest};
  };
  const auto line = [&](const char* name, const auto& make) {
    const auto [recorded, largest] = run(name, make());
    auto timed = make();  // again without recording, for the time
    const std::clock_t start = std::clock();
    timed.integrate(duration);
    const double ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("  %-8s %-22s %12lld %10.2f %16.1e %16.1e\n", how, name, timed.statistics().evaluations, ms,
                std::abs(recorded.state()[0] - exact(duration)), largest);
  };
  line("euler_1ms", [&] { return kte::euler(rhs, 0.0, x0, 0.001); });
  line("dormand_prince45_1e-6",
       [&] { return kte::dormand_prince45(rhs, 0.0, x0, {.absolute = 1e-6, .relative = 1e-6}); });
  line("dormand_prince45_1e-9",
       [&] { return kte::dormand_prince45(rhs, 0.0, x0, {.absolute = 1e-9, .relative = 1e-9}); });
  line("dormand_prince45_1e-12",
       [&] { return kte::dormand_prince45(rhs, 0.0, x0, {.absolute = 1e-12, .relative = 1e-12}); });
}

int main() {
  kte::runtime_chain built;  // the pendulum, assembled at run time
  built.gravity(kte::along_y(-gravity)) << kte::revolute_joint_2D("q", "base", "joint")
                                        << kte::rigid_link_2D("joint", "tip", kte::along_x(length))
                                        << kte::inertia_2D("tip", kte::point_mass(1.0));

  kte::save_model("pendulum.xml", pendulum);
  kte::save_model("pendulum.json", built);
  const auto loaded = kte::to_chain(kte::load_model("pendulum.xml"));
  const auto same_type = kte::from_record(pendulum, kte::load_model("pendulum.json"));
  const bool same =
      kte::record_of(loaded) == kte::record_of(pendulum) && kte::record_of(same_type) == kte::record_of(built);
  std::printf("Saved pendulum.xml and pendulum.json, loaded both: %s.\n\n",
              same ? "the same models" : "DIFFERENT MODELS");

  std::printf("A pendulum of %.1f m released from the horizontal, %.0f s. Exact: q(50 s) = %.15f rad.\n", length,
              duration, exact(duration));
  std::printf("  %-8s %-22s %12s %10s %16s %16s\n", "chain", "integrator", "evaluations", "CPU ms", "error at 50 s",
              "largest error");
  simulate(pendulum, kte::make_state(pendulum), "static");
  simulate(same_type, kte::make_state(same_type), "loaded");
  simulate(built, built.make_state(), "runtime");
  return same ? 0 : 1;
}
