/// Many mechanisms at once: pendulums of random length and start, eight in the lanes of a pack, to sweep_pendulums.npy;
/// and iiwa14s under a PD law with random payloads, to sweep_payloads.csv. A run that is killed continues where it was.
///
///   sweep [PENDULUMS [ARMS [THREADS]]]      by default 20000, 200, and two threads
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/kte.hpp>
#include <kte/math/pack.hpp>
#include <kte/static_chain/lanes.hpp>
#include <kte/sweep.hpp>
#include <kte/sweep/final_state.hpp>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "robots/iiwa14.hpp"

using pack = kte::pack<double, 8>;

// clang-format off
inline constexpr struct angle_ final : kte::coord_key<"angle">    {} angle;
inline constexpr struct base_  final : kte::frame_2D_key<"base">  {} base;
inline constexpr struct rod_   final : kte::frame_2D_key<"rod">   {} rod;
inline constexpr struct bob_   final : kte::frame_2D_key<"bob">   {} bob;
// clang-format on
constexpr auto pendulum =
    kte::chain(kte::revolute_joint_2D(angle, base, rod), kte::rigid_link_2D(rod, bob, kte::along_y(-1.0)),
               kte::inertia_2D(bob, kte::point_mass(1.0)), kte::joint_damping_gen(angle, 0.05))
        .gravity(kte::along_y(-9.81));

/// x' = f(t, x) of a chain of n joints under the torques of a law.
template <class Chain, class Law>
struct moving {
  static constexpr int n = Chain::dofs;
  Chain chain;
  Law law;

  template <class T, class X>
  X operator()(const T&, const X& x) const {
    const auto q = x.template head<n>(), v = x.template tail<n>();
    X rate;
    rate.template head<n>() = v;
    rate.template tail<n>() = kte::forward_dynamics(chain, q, v, law(q, v));
    return rate;
  }
};
template <class Chain, class Law>
moving(Chain, Law) -> moving<Chain, Law>;

/// Ten seconds of a pendulum, from rest.
auto swing() {
  return kte::final_state(10.0, [](const auto& c) {
    const auto chain = kte::lanes(pendulum, kte::parameter{"bob/position/y", -c["length"]});
    const auto free = [](const auto& q, const auto&) { return (0 * q).eval(); };
    const Eigen::Vector2<pack> start(c["start"], pack(0.0));
    return kte::runge_kutta4(moving{chain, free}, 0.0, start, 0.01);
  });
}

/// A second of an iiwa14 that moves to a pose by tau = g(q) - K (q - q_d) - D v, where g knows of no payload.
auto reach() {
  return [](const auto& c) {
    const auto chain =
        kte::lanes(robots::iiwa14.gravity(kte::along_z(-9.81)), kte::parameter{"link7/mass", 1.2 + c["payload"]},
                   kte::parameter{"link7/com/z", 0.02 + c["distance"]});
    const auto known = kte::in<pack>(robots::iiwa14.gravity(kte::along_z(-9.81)));
    using joints = Eigen::Matrix<pack, 7, 1>;
    const joints goal = joints::Constant(pack(0.5)), zero = joints::Zero();
    joints stiffness, damping;
    stiffness << 400, 400, 300, 200, 50, 20, 5;
    damping << 40, 40, 30, 20, 5, 2, 0.5;
    const auto law = [&](const auto& q, const auto& v) {
      const joints held = kte::inverse_dynamics(known, q, zero, zero);
      return (held - stiffness.cwiseProduct(q - goal) - damping.cwiseProduct(v)).eval();
    };
    Eigen::Matrix<pack, 14, 1> start = Eigen::Matrix<pack, 14, 1>::Zero();
    kte::runge_kutta4 solver(moving{chain, law}, 0.0, start, 0.001);
    solver.integrate(1.0);
    pack error(0.0), speed(0.0);
    for (int i = 0; i < 7; ++i) {
      error = kte::max(error, abs(solver.state()[i] - goal[i]));
      speed = kte::max(speed, abs(solver.state()[7 + i]));
    }
    return std::array{error, speed};
  };
}

/// Runs a sweep, and prints its rate and statistics.
void run(const char* file, const kte::sweep& s) {
  const auto begin = std::chrono::steady_clock::now();
  const auto summary = s.to(file);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("%s: %llu cases, %llu failed, %.1f s, %.0f per s\n", file, static_cast<unsigned long long>(summary.cases),
              static_cast<unsigned long long>(summary.failed), seconds, static_cast<double>(summary.cases) / seconds);
  for (const auto& c : summary.statistics)
    std::printf("  %-8s %.4f to %.4f, mean %.4f, deviation %.4f\n", c.name.c_str(), c.least, c.most, c.mean,
                c.deviation());
}

int main(int argc, char** argv) {
  const auto number = [&](int i, unsigned long long otherwise) {
    return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
  };
  const kte::sweep_options options{.shard_size = 1024, .executor = kte::batch::threads(number(3, 2))};
  run("sweep_pendulums.npy",
      kte::sweep(
          kte::random_cases(number(1, 20000), 1, {kte::uniform("length", 0.5, 2), kte::uniform("start", 0.1, 3)}),
          {"angle", "speed"}, kte::in_packs<pack>(swing()), options));
  run("sweep_payloads.csv",
      kte::sweep(kte::sobol_cases(number(2, 200), {kte::uniform("payload", 0, 14), kte::uniform("distance", 0, 0.1)}),
                 {"error", "speed"}, kte::in_packs<pack>(reach()), {.shard_size = 64, .executor = options.executor}));
}
