/// Pictures for papers and for README, into a folder (the present one, or the first argument): a double pendulum as it
/// swings, at times over each other, and its angles; an arm that reaches; the topology of a quadruped.
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/view/pictures.hpp>

#include <cstdio>

#include "robots/iiwa14.hpp"
#include "robots/solo12.hpp"

namespace {

// clang-format off
inline constexpr struct upper_ final : kte::coord_key<"upper">    {} upper;
inline constexpr struct lower_ final : kte::coord_key<"lower">    {} lower;
inline constexpr struct base_  final : kte::frame_2D_key<"base">  {} base;
inline constexpr struct rod1_  final : kte::frame_2D_key<"rod1">  {} rod1;
inline constexpr struct elbow_ final : kte::frame_2D_key<"elbow"> {} elbow;
inline constexpr struct rod2_  final : kte::frame_2D_key<"rod2">  {} rod2;
inline constexpr struct tip_   final : kte::frame_2D_key<"tip">   {} tip;
// clang-format on

constexpr auto double_pendulum =
    kte::chain(kte::revolute_joint_2D(upper, base, rod1), kte::rigid_link_2D(rod1, elbow, kte::along_x(1.0)),
               kte::inertia_2D(elbow, kte::point_mass(1.0)), kte::revolute_joint_2D(lower, elbow, rod2),
               kte::rigid_link_2D(rod2, tip, kte::along_x(0.8)), kte::inertia_2D(tip, kte::point_mass(0.7)))
        .gravity(kte::along_y(-9.81));

/// Let go from rest: `lower` is the angle between the rods.
kte::scene swing(double duration, double rate) {
  kte::scene_recording rec(double_pendulum, {.columns = {"upper", "lower", "upper/v", "lower/v", "tip/velocity"}});
  kte::manipulator_dynamics_model model(double_pendulum);
  const auto x0 = model.make_x(std::array{0.6, 0.8}, std::array{0.0, 0.0});
  kte::prince_dormand87 solver(std::cref(model), 0.0, x0, {.absolute = 1e-13, .relative = 1e-13});
  solver.integrate(duration, kte::every(1 / rate), [&](double t, const auto& x) { rec.row(t, model.state_at(t, x)); });
  return rec.contents();
}

/// What a scene recorded, as a table.
kte::table table_of(const kte::scene::recording& r) {
  kte::table t{{"t"}, {r.t}};
  for (const auto& c : r.columns) t.names.push_back(c.name), t.columns.emplace_back(c.data.begin(), c.data.end());
  return t;
}

/// The arm from one posture to another in 2 s, at rest at both ends.
kte::scene reach() {
  constexpr std::array from{-0.9, 0.9, 0.3, -1.2, 0.2, 0.6, 0.0}, to{1.1, 0.5, -0.2, -1.6, -0.4, 1.3, 0.8};
  kte::scene_recording rec(robots::iiwa14);
  auto s = kte::make_state(robots::iiwa14);
  for (int i = 0; i <= 50; ++i) {
    const double u = i / 50.0, part = u * u * u * (10 + u * (6 * u - 15));
    std::array<double, 7> q;
    for (std::size_t j = 0; j < q.size(); ++j) q[j] = from[j] + part * (to[j] - from[j]);
    kte::set_positions(s, q);
    robots::iiwa14.doMotion(s);
    rec.row(2 * u, s);
  }
  return rec.contents();
}

}  // namespace

int main(int count, char** arguments) {
  const std::filesystem::path folder = count > 1 ? arguments[1] : ".";
  const auto fine = swing(8, 200);
  kte::write_moving_picture(
      folder / "double_pendulum.svg", fine,
      {.width = 85, .title = "A double pendulum, simulated by kte", .trails = {"tip"}, .rate = 40});
  kte::write_picture(folder / "double_pendulum_times.svg", fine, {.every = 0.15, .to = 1.2, .trails = {"tip"}});
  kte::write_plot(folder / "double_pendulum_plot.svg", table_of(fine.recordings[0]), {"upper", "lower", "tip/velocity"},
                  {.units = kte::units_of(fine)});
  kte::write_picture(folder / "iiwa14_reach.svg", reach(), {.every = 0.4, .trails = {"tool"}, .bodies = false});
  kte::write_topology(folder / "solo12_topology.svg", robots::solo12);
  std::printf("Wrote 5 pictures in '%s'.\n", folder.string().c_str());
  return 0;
}
