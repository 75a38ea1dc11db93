#pragma once

#include <kte/contacts.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/simulation.hpp>
#include <kte/static.hpp>

#include <cmath>

/// Two legs of 1 m on a hinge, in the plane, with the x axis down a slope: walkers without motors.
namespace kte::test::walkers {

// clang-format off
inline constexpr struct x_ final : coord_key<"x"> {} x_of_hip;
inline constexpr struct y_ final : coord_key<"y"> {} y_of_hip;
inline constexpr struct first_ final : coord_key<"first"> {} first;
inline constexpr struct second_ final : coord_key<"second"> {} second;
inline constexpr struct slope_ final : frame_2D_key<"slope"> {} slope;
inline constexpr struct slide_ final : frame_2D_key<"slide"> {} slide;
inline constexpr struct hip_ final : frame_2D_key<"hip"> {} hip;
inline constexpr struct first_leg_ final : frame_2D_key<"first leg"> {} first_leg;
inline constexpr struct second_leg_ final : frame_2D_key<"second leg"> {} second_leg;
inline constexpr struct first_tip_ final : frame_2D_key<"first tip"> {} first_tip;
inline constexpr struct second_tip_ final : frame_2D_key<"second tip"> {} second_tip;
inline constexpr struct first_foot_ final : contact_key<"first foot"> {} first_foot;
inline constexpr struct second_foot_ final : contact_key<"second foot"> {} second_foot;
// clang-format on

struct walker {
  double gravity, angle;             ///< m/s^2; of the slope
  double hip_mass, leg_mass, place;  ///< kg; of the mass of a leg, from the hip, m
};
/// Goswami, Thuilot, Espiau 1996.
inline constexpr walker compass{9.81, 3 * 3.14159265358979323846 / 180, 10, 5, 0.5};
/// Garcia, Chatterjee, Ruina, Coleman 1998, with feet of little mass.
inline constexpr walker garcia{1, 0.009, 1, 1e-6, 1};

/// A foot that swings scuffs the slope behind the hip; it lands only in front of it.
template <key_type Leg>
struct leg_in_front {
  template <class State>
  bool operator()(const State& s) const {
    return s[Leg{}].q > 0;
  }
};

inline auto chain_of(const walker& w) {
  const auto leg = planar_body(w.leg_mass, 0.0, along_y(-w.place));
  const contact_law law{.friction = 2.0};
  return chain(prismatic_joint_2D(x_of_hip, slope, slide, axis::x), prismatic_joint_2D(y_of_hip, slide, hip, axis::y),
               inertia_2D(hip, point_mass(w.hip_mass)), revolute_joint_2D(first, hip, first_leg),
               inertia_2D(first_leg, leg), rigid_link_2D(first_leg, first_tip, along_y(-1.0)),
               revolute_joint_2D(second, hip, second_leg), inertia_2D(second_leg, leg),
               rigid_link_2D(second_leg, second_tip, along_y(-1.0)),
               point_contact_2D(first_foot, slope, first_tip, half_space{}, law).only_if(leg_in_front<first_>{}),
               point_contact_2D(second_foot, slope, second_tip, half_space{}, law).only_if(leg_in_front<second_>{}))
      .gravity(vec3{w.gravity * std::sin(w.angle), -w.gravity * std::cos(w.angle), zero});
}
/// q and v after a strike: the first leg stands at `half`, from the normal of the slope, with a rate; the second, at
/// -half, swings.
struct start_of_step {
  Eigen::Vector4d q, v;
  start_of_step(double half, double stance, double swing)
      : q(0, std::cos(half), half, -half), v(-stance * std::cos(half), -stance * std::sin(half), stance, swing) {}
};
inline const start_of_step compass_cycle{0.27102868049882, -1.09238358988360, -0.37737394890719};

/// The states after the strikes, and their times.
template <class Report>
auto strikes_of(const Report& report) {
  auto all = report.events;
  std::erase_if(all, [](const auto& e) { return e.what.find("impact") == std::string::npos; });
  return all;
}

}  // namespace kte::test::walkers
