#include <kte/testing/detail/states.hpp>

#include <cstring>

#include "catch.hpp"
#include "chain/models.hpp"
#include "random.hpp"
#include "robots/iiwa14.hpp"
#include "robots/ur5.hpp"

namespace passes_test {

using namespace kte;

#if defined(__FMA__)
/// Products are fused into sums, not at the same places in both chains: what is rounded of terms of the size of the
/// largest number, some ten a joint or link, 21 of them in a row.
constexpr double roundings = 10 * 21 * 0x1p-53;
#else
constexpr double roundings = 0;
#endif

/// Whether all numbers of two things agree: bit for bit, but for roundings.
template <class T>
bool agree(const T& a, const T& b) {
  if (std::memcmp(&a, &b, sizeof(T)) == 0) return true;
  using numbers = std::array<double, sizeof(T) / sizeof(double)>;
  const auto x = std::bit_cast<numbers>(a), y = std::bit_cast<numbers>(b);
  double size = 0, off = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    size = kte::test::worse(size, std::abs(x[i])), off = kte::test::worse(off, std::abs(x[i] - y[i]));
  return off <= roundings * size && roundings > 0;
}

// clang-format off
inline constexpr struct elbow_    final : coord_key<"elbow">       {} elbow;
inline constexpr struct wheel_    final : coord_key<"wheel">       {} wheel;
inline constexpr struct trunk_    final : pose_3D_key<"trunk">     {} trunk;
inline constexpr struct ball_     final : rotation_3D_key<"ball">  {} ball;
inline constexpr struct puck_     final : pose_2D_key<"puck">      {} puck;
inline constexpr struct bristles_ final : internal_key<"bristles"> {} bristles;
inline constexpr struct drive_    final : input_key<"drive">       {} drive;
inline constexpr struct world_    final : frame_3D_key<"world">    {} world;
inline constexpr struct body_     final : frame_3D_key<"body">     {} body;
inline constexpr struct palm_     final : frame_3D_key<"palm">     {} palm;
inline constexpr struct finger_   final : frame_3D_key<"finger">   {} finger;
inline constexpr struct table_    final : frame_2D_key<"table">    {} table;
inline constexpr struct disc_     final : frame_2D_key<"disc">     {} disc;
// clang-format on

/// Things of all kinds: beside coordinates, poses, a rotation, an input, an internal state, and frames of both kinds.
constexpr auto all_kinds = chain(
    free_joint_3D(trunk, world, body), inertia_3D(body, rigid_body{2.0, along_x(0.1), diagonal(0.2, 0.3, 0.4)}),
    spherical_joint_3D(ball, body, palm), revolute_joint_3D(elbow, palm, finger, vec3{0.6, 0.0, 0.8}),
    inertia_3D(finger, point_mass(0.3, along_y(0.2))), inertia_gen(wheel, 0.01),
    joint_backlash_gen(elbow, wheel, 0.1, 50.0, 0.5), driving_actuator_gen(wheel, drive),
    joint_lugre_gen(
        elbow, bristles,
        {.sigma0 = 100.0, .sigma1 = 1.0, .sigma2 = 0.4, .coulomb = 1.0, .stiction = 1.5, .stribeck_velocity = 0.1}),
    torsion_spring_3D(world, body, 3.0), spring_3D(world, finger, 0.5, 20.0), base_2D(table),
    free_joint_2D(puck, table, disc), inertia_2D(disc, planar_body(0.3, 0.02)), damper_2D(table, disc, 0.7));

/// From the same random numbers in all that both states hold, all of it agrees after each pass.
template <class Static>
void compare_bits(const Static& fixed, const runtime_chain& loose, unsigned seed) {
  auto s = make_state(fixed);
  auto r = loose.make_state();
  random_numbers random(seed);
  const auto compare = [&] {
    int things = 0, differ = 0;
    testing::detail::for_each_pair(s, r, [&](const auto& a, const auto& b) { ++things, differ += !agree(a, b); });
    CHECK(things > 0);
    CHECK(differ == 0);
  };
  for (int round = 0; round < 20; ++round) {
    testing::detail::for_each_pair(s, r, [&]<class T>(T& a, T& b) {
      std::array<double, sizeof(T) / sizeof(double)> numbers;
      for (double& x : numbers) x = random(3.0);
      a = b = std::bit_cast<T>(numbers);
    });
    fixed.doMotion(s), loose.doMotion(r), compare();
    fixed.clearForce(s), loose.clearForce(r), compare();
    fixed.doForce(s), loose.doForce(r), compare();
  }
}

// Both kinds execute equal arithmetic in equal order. Compilers that may fuse products into sums (-mfma, -march=native,
// unless -ffp-contract=off) do so where they inline, which differs: then results agree to rounding.
TEST_CASE("the passes of static and runtime chains agree bit for bit where products are not fused into sums") {
  SECTION("pendulum") { compare_bits(models::pendulum, models::by_own_elements(models::pendulum), 1); }
  SECTION("tree") { compare_bits(models::tree, models::by_own_elements(models::tree), 2); }
  SECTION("iiwa14") { compare_bits(robots::iiwa14, models::by_own_elements(robots::iiwa14), 3); }
  SECTION("ur5") { compare_bits(robots::ur5, models::by_own_elements(robots::ur5), 4); }
  SECTION("things of all kinds") { compare_bits(all_kinds, models::by_own_elements(all_kinds), 7); }
  SECTION("a static chain appended as one element") {
    runtime_chain c;
    c.gravity(models::tree.gravity()) << models::tree;
    compare_bits(models::tree, c, 5);
  }
  SECTION("a runtime chain in a runtime chain") {
    runtime_chain c;
    c.gravity(robots::iiwa14.gravity()) << models::by_own_elements(robots::iiwa14);
    compare_bits(robots::iiwa14, c, 6);
  }
}

TEST_CASE("motion leaves forces and what is given, clearing leaves motion, forces add up") {
  const runtime_chain c = models::by_own_elements(all_kinds);
  auto r = c.make_state();
  random_numbers random(8);
  const auto number = [&] { return random(); };
  const auto vector = [&] { return vec3{number(), number(), number()}; };
  r.coordinate("elbow") = {number(), number(), number(), number(), 5, 6};
  r.coordinate("wheel") = {number(), number(), number(), number(), 5, 6};
  r.frame_3D("world").velocity = vector(), r.frame_3D("world").force = vector();
  r.frame_3D("finger").force = vector(), r.frame_3D("finger").torque = vector();
  r.pose_3D("trunk").force = vector(), r.pose_3D("trunk").velocity = vector();
  r.rotation_3D("ball").torque = vector(), r.pose_2D("puck").torque = number();
  r.internal("bristles") = {number(), number()}, r.input("drive") = number();
  const runtime_state before = r;
  const auto loads_of = [](const runtime_state& x) {
    std::vector<vec3<>> all{{x.coordinate("elbow").f, x.coordinate("wheel").f, x.pose_2D("puck").torque},
                            x.pose_3D("trunk").force,
                            x.pose_3D("trunk").torque,
                            x.rotation_3D("ball").torque,
                            vec3{x.pose_2D("puck").force.x, x.pose_2D("puck").force.y, 0.0}};
    for (const char* name : {"world", "body", "palm", "finger"})
      all.push_back(x.frame_3D(name).force), all.push_back(x.frame_3D(name).torque);
    for (const char* name : {"table", "disc"})
      all.push_back({x.frame_2D(name).force.x, x.frame_2D(name).force.y, x.frame_2D(name).torque});
    return all;
  };
  c.doMotion(r);
  CHECK(loads_of(r) == loads_of(before));
  CHECK(r.coordinate("elbow").q == before.coordinate("elbow").q);
  CHECK(r.coordinate("elbow").cos == within(std::cos(before.coordinate("elbow").q), 1.2e-16));  // one ulp of 1
  CHECK(agree(r.coordinate("wheel"), before.coordinate("wheel")));  // no joint turns by it: 5 and 6 stay
  CHECK(agree(r.frame_3D("world"), before.frame_3D("world")));
  CHECK(r.internal("bristles").z == before.internal("bristles").z);
  CHECK(r.internal("bristles").z_dot != before.internal("bristles").z_dot);
  CHECK(r.input("drive") == before.input("drive"));

  const runtime_state moved = r;
  c.clearForce(r);
  const auto none = loads_of(r);
  CHECK(none == std::vector<vec3<>>(none.size(), vec3<>{}));
  CHECK(r.input("drive") == before.input("drive"));  // inputs are no loads
  CHECK(agree(r.internal("bristles"), moved.internal("bristles")));
  CHECK(r.coordinate("elbow").q_ddot == before.coordinate("elbow").q_ddot);
  CHECK(r.frame_3D("finger").acceleration == moved.frame_3D("finger").acceleration);
  CHECK(r.pose_3D("trunk").velocity == before.pose_3D("trunk").velocity);

  c.doForce(r);
  CHECK(r.frame_3D("finger").acceleration == moved.frame_3D("finger").acceleration);
  CHECK(agree(r.internal("bristles"), moved.internal("bristles")));
  runtime_chain motor;
  motor << inertia_gen("wheel", 0.0) << driving_actuator_gen("wheel", "drive");
  auto m = motor.make_state();
  m.input("drive") = 0.5, m.coordinate("wheel").f = 2.0;
  motor.doMotion(m), motor.doForce(m), motor.doForce(m);
  CHECK(m.coordinate("wheel").f == 3.0);
}

struct keeper {
  static constexpr std::array<port, 3> ports{{{kind::gen, access::on, "coordinate"},
                                              {kind::input, access::in, "input"},
                                              {kind::internal, access::keep, "state"}}};
};
static_assert(detail::load_index<keeper, 0> == 0 && detail::load_index<core::driving_actuator_gen, 1> == 1);
static_assert(detail::kept_port<keeper> == 2 && detail::kept_count<keeper> == 1);
static_assert(detail::kept_port<core::joint_lugre_gen> == 1);
static_assert(detail::kept_port<core::driving_actuator_gen> == 2 &&
              detail::kept_count<core::driving_actuator_gen> == 0);
/// Loads belong to the ports that are no signals, wherever those stand.
struct signal_first {
  static constexpr std::array<port, 3> ports{
      {{kind::input, access::in, "input"}, {kind::gen, access::on, "anchor1"}, {kind::gen, access::on, "anchor2"}}};
};
static_assert(detail::load_index<signal_first, 1> == 0 && detail::load_index<signal_first, 2> == 1);

static_assert(!detail::has_skip<double> && !detail::has_skip<vec3<>> && !detail::has_skip<wrench<vec3<>, zero3>>);
static_assert(detail::has_skip<skip> && detail::has_skip<vec3<double, skip, double>>);
static_assert(detail::has_skip<wrench<vec3<>, vec3<double, double, skip>>>);
static_assert(detail::has_skip<values<double, skip>> && !detail::has_skip<values<double>>);

}  // namespace passes_test
