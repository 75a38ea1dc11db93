#include "simulations/drops.hpp"

#include "catch.hpp"

// Bodies that fall, rock, slide and come to rest, by events: every simulation reaches its end, no body is inside the
// ground, no event gains energy.
//
// Accuracy is that of the integrator, except where sliding is slow (dynamics/contacts/slow_sliding.hpp); independent
// equations of the plane, and runs at 1e-12 with other speeds v, give the numbers below.

namespace drops_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::drops;

/// A cube of 0.1 m and 0.4 kg from q, at rest.
scene cube(const std::vector<double>& q, const contact_law& law, double duration,
           const vec3<>& half = {0.05, 0.05, 0.05}) {
  scene s;
  const double m = 0.4, x = half.x * half.x, y = half.y * half.y, z = half.z * half.z;
  s.chain << base_3D("ground") << free_joint_3D("pose", "ground", "body")
          << inertia_3D("body", rigid_body{m, vec3{0.0, 0.0, 0.0},
                                           sym3{m / 3 * (y + z), 0.0, 0.0, m / 3 * (x + z), 0.0, m / 3 * (x + y)}})
          << box_contact_3D("sole", "ground", "body", half_space{}, half, law);
  s.chain.gravity(vec3<>{0, 0, -g});
  s.q = Eigen::Map<const Eigen::VectorXd>(q.data(), 7), s.v.setZero(6);
  s.size = 0.1, s.duration = duration;
  return s;
}
void check(const outcome& out, double penetration = 1e-8) {
  CHECK(out.failure == "");
  CHECK(out.penetration < penetration);
  CHECK(out.gain < 1e-12);
}
contact_law law(double friction, double restitution) { return {.friction = friction, .restitution = restitution}; }

TEST_CASE("a cube on an edge begins to slide while it falls") {
  const double half_angle = 20 * std::acos(-1.0) / 180,
               z = 0.05 * (std::sin(2 * half_angle) + std::cos(2 * half_angle));
  const std::vector<double> on_edge{0, 0, z, std::cos(half_angle), 0, std::sin(half_angle), 0};
  struct motion {
    double friction, x, z;
  };
  // by the equations of the plane, to 13 digits
  for (const auto& m : {motion{0.1, -0.0154479341556, 0.0647105681554}, motion{0.2, -0.0173871063980, 0.0666261832046}})
    for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
      CAPTURE(m.friction, tolerance);
      const auto out = simulate(cube(on_edge, law(m.friction, 0), 0.2), tolerance * 10);  // of 0.1 m
      check(out);
      CHECK(out.q[0] == within(m.x, 100 * tolerance));
      CHECK(out.q[2] == within(m.z, 100 * tolerance));
      if (tolerance > 1e-10) CHECK(out.steps < 100);
    }
}

TEST_CASE("a box slips on one corner") {
  const vec3<> half{0.047, 0.015, 0.0525};
  const std::vector<double> start{
      0, 0, 0.0999044563380104, 0.78145040877351968, 0.56775695550113559, 0.20938900595583529, -0.15213001772368215};
  const auto slips = simulate(cube(start, law(1, 0), 0.16, half), 1e-11);
  check(slips);
  const double at_end[]{-0.01680898767, -0.0152018381836, 0.0156007712651};
  for (Eigen::Index i = 0; i < 3; ++i) CHECK(slips.q[i] == within(at_end[i], 1e-11));
  const auto rests = simulate(cube(start, law(1, 0), 5, half), 1e-8);
  check(rests);
  CHECK(rests.speed < 1e-9);
  CHECK(rests.steps < 500);
}

TEST_CASE("rocking boxes come to rest") {
  struct start {
    std::vector<double> q;
    vec3<> half;
  };
  const vec3<> box{0.047, 0.015, 0.0525}, same{0.05, 0.05, 0.05};
  for (const auto& s : {start{{0, 0, 0.12981334607140971, -0.50114078520979926, 0.35715026042392356,
                               0.088969225517804715, 0.78318967802594019},
                              same},
                        start{{0, 0, 0.11250833014041567, 0.10224211102562622, -0.68326388448997022,
                               -0.71545589201031823, 0.10401865925121505},
                              same},
                        start{{0, 0, 0.11554765074387925, -0.19201340083127941, 0.51435904086314554,
                               0.16533573938792934, 0.81928610647599664},
                              box}}) {
    const auto out = simulate(cube(s.q, law(1, 0), 3, s.half), 1e-8);
    check(out);
    CHECK(out.speed < 1e-9);
    CHECK(out.steps < 400);
  }
}

/// Drops of all shapes, one of each law for each of these seeds.
template <class Check>
void drop_all(unsigned first, unsigned seeds, const std::vector<double>& restitutions,
              const std::vector<double>& frictions, const Check& each) {
  for (const shape what : shapes)
    for (const double e : restitutions)
      for (const double mu : frictions)
        for (unsigned seed = first; seed < first + seeds; ++seed) {
          CAPTURE(static_cast<int>(what), e, mu, seed);
          random_numbers random(100 * seed + static_cast<unsigned>(what));
          each(drop(what, 0.05, law(mu, e), seed % 2 == 1, random));
        }
}
void check_drop(const scene& s) {
  const auto out = simulate(s, 1e-8);
  check(out);
  if (s.rests) CHECK(out.speed < 1e-9);
  CHECK(out.steps < 5000);
  CHECK(out.bridges == 0);
}
TEST_CASE("random drops reach their end") { drop_all(0, 1, {0.3}, {0.3, 1}, check_drop); }
TEST_CASE("243 random drops reach their end", "[long]") { drop_all(0, 5, {0, 0.3, 0.8}, {0, 0.3, 1}, check_drop); }

TEST_CASE("a bridge at every event") {
  drop_all(0, 1, {0}, {0.3}, [](const scene& s) {
    const auto out = simulate(s, 1e-8, bridging::at_every_event);
    check(out, 1e-5);  // 1e-6 m
    CHECK(out.bridges > 0);
  });
}

TEST_CASE("drops of any size on any surface", "[long]") {
  for (unsigned number = 0; number < 48; ++number) {
    CAPTURE(number);
    const auto drop = drop_of(number);
    check(simulate(drop.what, drop.tolerance));
  }
}

TEST_CASE("two bodies that a closure joins come to their end", "[long]") {
  for (unsigned seed = 0; seed < 6; ++seed) {
    CAPTURE(seed);
    random_numbers random(seed);
    const contact_law of = law(std::abs(random(1.0)), std::abs(random(0.8)));
    check(simulate(drop_joined(shapes[seed], 0.05, of, seed % 2 == 1, random), 1e-8));
  }
}

/// The impulses of two boxes on a hinge that fall on their faces are known to a residual of some 1e-10.
TEST_CASE("impacts of redundant contacts need no bridge", "[long]") {
  for (const unsigned number : {1042U, 1906U}) {
    CAPTURE(number);
    const auto drop = drop_of(number);
    const auto out = simulate(drop.what, drop.tolerance);
    check(out);
    CHECK(out.bridges == 0);
  }
}

/// Faces that share their load in many ways, contacts whose rank changes in a step (16, 5116), faces of two bodies that
/// lie flat by a hinge (2014), a corner whose sliding jams (2314), corners that begin to slip together (4957), a face
/// that tips while steps are long (5392), and a force that crosses zero within its rounding errors (1973).
TEST_CASE("redundant contacts that stop, and jams, need no bridge", "[long]") {
  for (const unsigned number : {16U, 634U, 1973U, 2014U, 2314U, 3016U, 3466U, 3971U, 4957U, 5116U, 5392U}) {
    CAPTURE(number);
    const auto drop = drop_of(number);
    const auto out = simulate(drop.what, drop.tolerance);
    check(out);
    CHECK(out.bridges == 0);
  }
}

// clang-format off
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct body_   final : frame_3D_key<"body">   {} body;
inline constexpr struct pose_   final : pose_3D_key<"pose">    {} pose;
inline constexpr struct left_   final : contact_key<"left">    {} left_corner;
inline constexpr struct right_  final : contact_key<"right">   {} right_corner;
// clang-format on

TEST_CASE("static and runtime chains decide alike") {
  for (const auto& of : {law(0.2, 0), law(0.5, 0.5)}) {
    const auto c =
        chain(base_3D(ground), free_joint_3D(pose, ground, body),
              inertia_3D(body, rigid_body{0.4, vec3{0.0, 0.0, 0.0}, sym3{7e-4, 0.0, 0.0, 6e-4, 0.0, 5e-4}}),
              sphere_contact_3D(left_corner, ground, body, half_space{}, 0.01, of, vec3{0.05, 0.05, -0.05}),
              sphere_contact_3D(right_corner, ground, body, half_space{}, 0.01, of, vec3{0.05, -0.05, -0.05}))
            .gravity(vec3{zero, zero, -g});
    runtime_chain r;
    r << c;
    Eigen::VectorXd q(7), v(6);
    q << 0, 0, 0.1, 0.95, 0.05, 0.3, 0.05;
    q.tail(4).normalize();
    v << 0.3, 0.1, 0, 0, 0, 1;
    const auto run = [&](const auto& chain_of_body) {
      manipulator_dynamics_model model(chain_of_body);
      dormand_prince45 solver(std::cref(model), 0.0, settled(model, 0.0, model.make_x(q, v)),
                              {.absolute = 1e-10, .relative = 1e-10});
      const auto report = solver.integrate(0.3, element_events(model));
      return std::make_pair(report.count, Eigen::VectorXd(model.positions_of(solver.state())));
    };
    const auto a = run(c), b = run(r);
    CHECK(a.first == b.first);
    CHECK(a.first > 2);
    CHECK((a.second - b.second).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("the Solo12 falls on its feet") {
  random_numbers random(1);
  const auto out = simulate(drop_robot(law(0.3, 0.3), random), 1e-6);
  check(out);
  CHECK(out.steps < 3000);
}

TEST_CASE("bodies of 1 mm and of 10 m move alike") {
  Eigen::VectorXd q[2];
  int i = 0;
  for (const double half : {0.0005, 5.0}) {
    random_numbers random(7);
    auto s = drop(shape::cube, half, law(0.5, 0), false, random);
    s.duration /= 8;
    const auto out = simulate(s, 1e-10);
    check(out);
    q[i] = out.q, q[i++].head(3) /= half;
  }
  CHECK((q[0] - q[1]).cwiseAbs().maxCoeff() < 1e-7);
}

// A disc that falls without spin lies flat sooner or later; steps would only circle around the rim then.
TEST_CASE("a disc that lies flat is refused by all methods") {
  for (const double restitution : {0.0, 0.3, 0.8}) {
    scene s;
    s.chain << base_3D("ground") << free_joint_3D("pose", "ground", "coin")
            << inertia_3D("coin", rigid_body{0.4, vec3{0.0, 0.0, 0.0}, sym3{2.5e-4, 0.0, 0.0, 2.5e-4, 0.0, 5e-4}})
            << disc_contact_3D("rim", "ground", "coin", half_space{}, axis::z, 0.05, law(0.3, restitution));
    s.chain.gravity(vec3<>{0, 0, -g});
    s.q.setZero(7), s.v.setZero(6);
    s.q << 0, 0, 0.08, 0.96, 0.2, 0.19, 0.05;
    s.q.tail(4).normalize();
    s.size = 0.1;
    CHECK_THAT(simulate(s, 1e-8).failure, Catch::Matchers::Contains("contact 'rim': a disc lies flat"));
    manipulator_dynamics_model model(s.chain);
    moreau_jean solver(std::cref(model), 0.0, model.make_x(s.q, s.v), 1e-3);
    CHECK_THROWS_MATCHES(solver.integrate(3.0), integration_failure, says("contact 'rim': a disc lies flat"));
  }
}

// Newton's law with friction may add energy at an impact of several contacts: here 0.2 to 0.3 m g size, for any step,
// without the limit of `moreau_jean`. The rest is the error of its impacts, of order 1.
TEST_CASE("time stepping gains no energy by restitution") {
  for (const unsigned seed : {2u, 8u, 11u, 15u}) {
    CAPTURE(seed);
    random_numbers random(seed);
    const scene s = drop(shape::cube, 0.05, law(1, 0.8), true, random);
    manipulator_dynamics_model model(s.chain);
    auto at = make_state(s.chain);
    const double h = 2e-4, scale = centre_of_mass(s.chain, at, s.q).mass * g * s.size;
    moreau_jean solver(std::cref(model), 0.0, model.make_x(s.q, s.v), h);
    const auto energy_at = [&](const Eigen::VectorXd& x) {
      const auto e =
          energy(s.chain, at, Eigen::VectorXd(model.positions_of(x)), Eigen::VectorXd(model.velocities_of(x)));
      return (e.kinetic + e.potential) / scale;
    };
    double before = energy_at(solver.state()), most = 0;
    solver.integrate(1.0, every(h), [&](double, const Eigen::VectorXd& x) {
      const double now = energy_at(x);
      most = (std::max)(most, now - before), before = now;
    });
    CHECK(most < 20 * h);
  }
}

}  // namespace drops_test
