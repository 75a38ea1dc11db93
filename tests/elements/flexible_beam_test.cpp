#include <kte/dynamics.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <numbers>

#include "catch.hpp"
#include "chain/cantilever.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace flexible_beam_test {

using namespace kte;
using namespace kte::test;

using std::numbers::pi;
constexpr planar_beam_section flat{.EA = 7, .EI = 3, .GA = 20};
constexpr beam_section solid{.EA = 7, .EI_y = 2, .EI_z = 3, .GJ = 1.5, .GA_y = 20, .GA_z = 30};

/// The worst violation of a law of one trial, in 20 in which the line of the ends is not turned back onto the frames:
/// there the energy goes to infinity, and its higher derivatives with it.
template <class S, class Element, class Violation>
S worst_of_open(const Element& beam, const Violation& violation) {
  S worst(0);
  for (unsigned seed = 1, tries = 0; tries < 20; ++seed) {
    auto x = trial_of<S>(beam, seed);
    const auto m = detail::midway_between<Element::core_type::ports[0].what>(spatial(x.template at<0>()),
                                                                             spatial(x.template at<1>()));
    if (m.d.x < S(0.1)) continue;
    ++tries;
    worst = testing::detail::worse(worst, S(violation(x)));
  }
  return worst;
}
template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& beam) {
    CHECK(testing::loads_are_opposite<S>(beam, draw) <= 8 * rounding<S>);
    // The law of testing/element_laws.hpp, and that of laws.hpp.
    const S off = worst_of_open<S>(beam, [&](auto& x) {
      x.doForce();
      S sum(0);
      x.for_each([&sum](const port&, auto& thing) { sum = sum + testing::detail::power(thing).first; });
      const auto change = testing::detail::derivatives<S>([&](const S& t) {
        auto y = x;
        y.move(t);
        return std::array<S, 1>{y.apply(energy_of(beam))};
      });
      return testing::detail::difference<S, 1>({sum}, {S(-change.first[0])});
    });
    CHECK(off <= 1000 * by_differences<S>);  // fifth derivatives by 1/d_x
    CHECK(worst_of_open<S>(beam, [&](auto& x) {
            auto y = x;
            const auto world = trial_of<S>(beam, 99).template at<0>();
            y.for_each([&world](const port&, auto& frame) {
              const auto moved = compose(spatial(world), spatial(frame));
              set_motion(frame, moved);
            });
            x.doForce(), y.doForce();
            return worse(load_difference(x.template at<0>(), y.template at<0>()),
                         load_difference(x.template at<1>(), y.template at<1>()));
          }) <= 8 * rounding<S>);
  };
  check(flexible_beam_2D("a", "b", 1.5, flat, 0.3));
  check(flexible_beam_3D("a", "b", 1.5, solid));
  check(flexible_beam_3D("a", "b", 1.5, {.EA = 7, .EI_y = 2, .EI_z = 3, .GJ = 1.5, .GA_y = 20}, vec3{0.3, 0.2, -0.4}));
  const auto flat_beam = flexible_beam_2D("a", "b", 1.5, flat);
  CHECK(worst_of_open<S>(flat_beam, [](auto& x) {
          auto y = trial_of<S>(flexible_beam_3D("a", "b", 1.5, solid), 1);
          set_motion(y.template at<0>(), spatial(x.template at<0>()));
          set_motion(y.template at<1>(), spatial(x.template at<1>()));
          x.doForce(), y.doForce();
          return worse(load_difference(x.template at<0>(), y.template at<0>()),
                       load_difference(x.template at<1>(), y.template at<1>()));
        }) <= 4 * rounding<S>);
}

/// Where all forces vanish under a load that is put on part by part, by Newton's method from q.
template <class Load>
Eigen::VectorXd balanced(const runtime_chain& beams, Eigen::VectorXd q, int parts, const Load& load) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(beams.dofs());
  for (int part = 1; part <= parts; ++part) {
    runtime_chain c = beams;
    c << load(static_cast<double>(part) / parts);
    auto s = c.make_state();
    double size = 1;
    for (int i = 0; size > 1e-9; ++i) {
      REQUIRE(i < 30);
      const auto& d = inverse_dynamics_derivatives(c, s, q, none, none);
      const Eigen::VectorXd step = d.by_q.lu().solve(d.tau);
      q = integrate(c, q, -step, 1.0);
      size = step.norm();
    }
  }
  return q;
}
template <class V>
bool near_tip(const V& tip, const vec3<>& exact, double tolerance) {
  return near(vec3{tip[0], tip[1], tip[2]}, exact, tolerance);
}

TEST_CASE("flexible beams obey the laws") { check_laws<double>(), check_laws<digits50>(); }

TEST_CASE("flexible beams in numbers of fewer and of more digits") {
  const auto off = []<class S>(const S&) {
    auto x = trial_of<S>(flexible_beam_3D("a", "b", 1.5, solid), 4);
    auto exact = trial_of<digits50>(flexible_beam_3D("a", "b", 1.5, solid), 4);
    x.doForce(), exact.doForce();
    const auto f = as<digits50>(x.template at<1>().torque) - exact.template at<1>().torque;
    return static_cast<double>(sqrt(dot(f, f)) / eps<S>);
  };
  CHECK(off(1.0f) < 200);  // of torques up to 10
  CHECK(off(1.0) < 200);
  CHECK(off(1.0L) < 200);
}

TEST_CASE("small motions of one beam are those of the linear beam") {
  const double L = 2, P = 1e-6, EI = 3, EI_y = 2, EA = 7, GA = 20, GJ = 1.5;  // what is left out is of P^2
  const auto small = [](double x, double exact) { return std::abs(x - exact) <= 1e-5 * std::abs(exact); };
  auto c = cantilever(1, L, planar_beam_section{.EA = EA, .EI = EI});
  auto q = balanced(c, straight(c, 1, L), 1, [&](double) { return constant_force_2D("1", vec2{P, P}); });
  CHECK(small(q[0] - L, P * L / EA));
  CHECK(small(q[1], P * L * L * L / (3 * EI)));
  CHECK(small(q[2], P * L * L / (2 * EI)));
  c = cantilever(1, L, planar_beam_section{.EA = EA, .EI = EI, .GA = GA});
  q = balanced(c, straight(c, 1, L), 1, [&](double) { return constant_force_2D("1", vec2{0.0, P}); });
  CHECK(small(q[1], P * L * L * L / (3 * EI) + P * L / GA));
  c = cantilever(1, L, beam_section{.EA = EA, .EI_y = EI_y, .EI_z = EI, .GJ = GJ, .GA_z = GA});
  q = balanced(c, straight(c, 1, L), 1, [&](double) {
    return constant_force_3D("1", vec3{0.0, P, P}, vec3{P, P, 0.0});
  });
  CHECK(small(q[1], P * L * L * L / (3 * EI)));
  CHECK(small(q[2], P * L * L * L / (3 * EI_y) + P * L / GA - P * L * L / (2 * EI_y)));
  CHECK(small(2 * q[4], P * L / GJ));  // of the quaternion
}

TEST_CASE("a cantilever is rolled up by an end moment") {
  // 2 pi EI/L bends it to a circle, whatever its stiffness along: each of four beams to a quarter.
  const auto c = cantilever(4, 1, planar_beam_section{.EA = 1e4, .EI = 1});
  const auto q = balanced(c, straight(c, 4, 1), 40, [](double share) {
    return constant_force_2D("4", vec2{zero, zero}, share * 2 * pi);
  });
  CHECK(near_tip(q.tail(3), {0, 0, 2 * pi}, 1e-8));
}

TEST_CASE("a beam under a force at its end is the elastica") {
  // Bisshopp and Drucker: P = alpha EI/L^2, x/L, y/L by elliptic integrals; inextensible, so within alpha/EA = 1e-4.
  struct point {
    double alpha, x, y;
  };
  const auto c = cantilever(8, 1, planar_beam_section{.EA = 1e5, .EI = 1});
  auto q = straight(c, 8, 1);
  double before = 0;
  for (const auto& [alpha, x, y] : {point{1, 0.943566763716623117, 0.301720773799813530},
                                    {2, 0.839358279174832764, 0.493457480396711820},
                                    {4, 0.671058757753154043, 0.669964181277666751},
                                    {5, 0.612371639275570128, 0.713791523611912728},
                                    {10, 0.445004402246248730, 0.810609024880296453}}) {
    q = balanced(c, q, static_cast<int>(2 * (alpha - before)), [from = before, to = alpha](double share) {
      return constant_force_2D("8", along_y(from + share * (to - from)));
    });
    CHECK(near_tip(q.tail(3), {x, y, q.tail(1)[0]}, 1e-4));
    before = alpha;
  }
}

/// The error of the tip of 4, 8 and 16 beams, and that it falls with the fourth power of their number.
template <class Error>
std::array<double, 3> errors_of_fourth_order(const Error& error) {
  const std::array e{error(4), error(8), error(16)};
  CHECK(std::log2(e[0] / e[1]) == within(4, 0.1));
  CHECK(std::log2(e[1] / e[2]) == within(4, 0.15));
  return e;
}
double distance(const Eigen::VectorXd& q, const vec3<>& exact) {
  return (q.tail(7).head(3) - Eigen::Vector3d(exact.x, exact.y, exact.z)).norm();
}

TEST_CASE("the Princeton beam, in both planes with torsion") {
  // A blade of 508 mm with a weight of 13.345 N at 30 degrees: reference by shooting of the exact equations.
  const double h = 12.3777e-3, w = 3.2024e-3, E = 71.7e9, G = E / 2.62, L = 0.508, P = 13.345;
  const double I_y = h * w * w * w / 12, I_z = w * h * h * h / 12;
  const beam_section blade{.EA = E * h * w,
                           .EI_y = E * I_y,
                           .EI_z = E * I_z,
                           .GJ = 0.198 * G * (I_y + I_z),
                           .GA_y = G * h * w,
                           .GA_z = G * h * w};
  const auto e = errors_of_fourth_order([&](int n) {
    const auto c = cantilever(n, L, blade);
    const auto load = [&](double share) {
      return constant_force_3D(std::to_string(n), share * P * vec3{0.0, -std::cos(pi / 6), std::sin(pi / 6)});
    };
    return distance(balanced(c, straight(c, n, L), 4, load),
                    {0.490741077741663147, -0.016989798932700564, 0.118179534218106});
  });
  CHECK(e[1] < 6e-7);
  CHECK(e[2] < 4e-8);
}

TEST_CASE("the bend of 45 degrees of Bathe and Bolourchi") {
  // An arc of radius 100, 300 at its tip across its plane; reference by shooting.
  const double EI = 1e7 / 12, GA = 1e7 / 2.4;
  const auto e = errors_of_fourth_order([&](int n) {
    runtime_chain c;
    Eigen::VectorXd q = Eigen::VectorXd::Zero(7 * n);
    const double a = pi / 4 / n;
    for (int i = 0; i < n; ++i) {
      const auto before = std::to_string(i), node = std::to_string(i + 1);
      c << free_joint_3D("at " + node, "0", node)
        << flexible_beam_3D(before, node, 100 * a, {1e7, EI, EI, EI, GA, GA}, along_z(a));
      const double b = a * (i + 1);
      q.segment(7 * i, 4) << 100 * std::sin(b), 100 * (1 - std::cos(b)), 0, std::cos(b / 2);
      q[7 * i + 6] = std::sin(b / 2);
    }
    q = balanced(c, q, 4, [&](double share) { return constant_force_3D(std::to_string(n), along_z(share * 300)); });
    return distance(q, {58.7788973299747683, 22.2446794266757960, 40.1923923322952523});
  });
  CHECK(e[0] < 6e-3);
  CHECK(e[2] < 3e-5);
}

TEST_CASE("a beam in space that is an arc or a helix rests") {
  // p' = R x, R' = R [r_0]x / L
  const auto loads = [](const vec3<>& r_0, double L) {
    auto x = trial_of(flexible_beam_3D("a", "b", L, solid, r_0), 1);
    vec3<> end{};
    for (int i = 0; i < 1000; ++i) end = end + L / 1000 * (matrix((i + 0.5) / 1000 * r_0) * vec3{1.0, 0.0, 0.0});
    x.at<0>() = {}, x.at<1>() = {.position = end, .rotation = matrix(r_0)};
    x.doForce();
    const auto f = x.at<1>().force, t = x.at<1>().torque;
    return std::sqrt(dot(f, f)) + std::sqrt(dot(t, t));
  };
  const vec3 turn{0.2, 0.15, -0.25};
  const double whole = loads(turn, 2), half = loads(0.5 * turn, 1);
  CHECK(whole < 1e-3);
  CHECK(std::log2(whole / half) > 2.8);  // strains of fourth order, of what bends to both sides third: 12 EI/L^2
}

TEST_CASE("a pushed beam buckles at Euler's load") {
  // pi^2 EI/(4 L^2) of a cantilever; two beams err by 5e-4.
  const auto c = cantilever(2, 1, planar_beam_section{.EA = 1e6, .EI = 1});
  const auto stiffness = [&](double push) {
    const auto load = constant_force_2D("2", along_x(-push));
    const auto q = balanced(c, straight(c, 2, 1), 1, [&](double) { return load; });
    auto loaded = c;
    loaded << load;
    auto s = loaded.make_state();
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(loaded.dofs());
    return Eigen::MatrixXd(inverse_dynamics_derivatives(loaded, s, q, none, none).by_q);
  };
  const double critical = pi * pi / 4;
  CHECK(Eigen::LLT<Eigen::MatrixXd>(stiffness(0.999 * critical)).info() == Eigen::Success);
  CHECK(Eigen::LLT<Eigen::MatrixXd>(stiffness(1.001 * critical)).info() != Eigen::Success);
}

TEST_CASE("a body on a beam keeps its energy") {
  // clang-format off
  static constexpr struct at_   final : pose_3D_key<"at">    {} at;
  static constexpr struct wall_ final : frame_3D_key<"wall"> {} wall;
  static constexpr struct tip_  final : frame_3D_key<"tip">  {} tip;
  // clang-format on
  const auto c = chain(free_joint_3D(at, wall, tip), flexible_beam_3D(wall, tip, 1.0, {100, 2, 3, 1.5, 0, 0}),
                       inertia_3D(tip, rigid_body{1.0, along_x(0.1), diagonal(0.1, 0.2, 0.2)}))
                     .gravity(along_z(-9.81));
  const manipulator_dynamics_model model(c);
  const std::array q{1.0, 0.2, 0.1, 1.0, 0.0, 0.0, 0.0};
  const std::array v{0.0, 1.0, -1.0, 2.0, 0.0, 1.0};
  dormand_prince45 solver(std::cref(model), 0.0, model.make_x(q, v), {.absolute = 1e-11, .relative = 1e-11});
  const auto before = energy(c, q, v);
  solver.integrate(2);
  const auto& x = solver.state();
  const auto after = energy(c, x.head(7), x.tail(6));
  CHECK(after.potential - before.potential == within(before.kinetic - after.kinetic, 1e-7));
  CHECK(std::abs(after.potential - before.potential) > 0.1);
}

TEST_CASE("a beam turned round") {
  const auto loads = [](const mat3<vec3<>>& turn, const vec3<>& place) {
    auto x = trial_of(flexible_beam_3D("a", "b", 2.0, solid), 1);
    x.at<0>() = {}, x.at<1>() = {.position = place, .rotation = turn};
    x.doForce();
    return std::array{x.at<0>(), x.at<1>()};
  };
  // About its own axis the torque grows to half a turn, and then jumps.
  const auto twisted = [&](double angle) { return loads(matrix(angle * vec3{1.0, 0.0, 0.0}), {2, 0, 0})[0].torque.x; };
  CHECK(twisted(3.0) == within(3 * 0.75, rounding<double>));
  CHECK(twisted(3.5) == within((3.5 - 2 * pi) * 0.75, rounding<double>));
  // Bent to half a circle, at both sides: the end moment is EI pi / L and little else.
  for (const double angle : {pi - 1e-12, 1e-12 - pi}) {
    const auto bent = loads(matrix(angle * vec3{0.0, 0.0, 1.0}), {0, std::copysign(2 * 2 / pi, angle), 0});
    CHECK(bent[0].torque.z == within(std::copysign(3 * pi / 2, angle), 0.8));  // (2) errs by 5 % there, of EA
    CHECK(bent[0].torque.z == within(-bent[1].torque.z, 1e-10));
  }
  // Ends exchanged change nothing: a beam seen from its other end.
  const auto turn = matrix(vec3{0.3, -0.7, 1.1});
  const vec3 place{1.5, 0.4, -0.3};
  const auto one_way = loads(turn, place);
  const auto flip = as<double>(half_turn_z);
  const auto other_way = loads(flip * transpose(turn) * flip, flip * (transpose(turn) * (-place)));
  CHECK(near(flip * other_way[1].force, one_way[0].force, 16 * rounding<double>));
  CHECK(near(flip * other_way[0].torque, one_way[1].torque, 16 * rounding<double>));
  CHECK(std::isnan(loads(turn, {not_a_number, 0, 0})[1].torque.y));
}

TEST_CASE("flexible beams are saved and loaded, and reject invalid input") {
  runtime_chain c;
  c << base_2D("a") << base_2D("b") << flexible_beam_2D("a", "b", 1.5, flat, 0.1) << base_3D("c") << base_3D("d")
    << flexible_beam_3D("c", "d", 1.5, solid, vec3{0.1, 0.2, 0.3});
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
  const std::string where = "kte: flexible_beam_2D (anchor1 'a', anchor2 'b'): ";
  const auto what = [](double length, const planar_beam_section& section) {
    return complaint([&] { (void)flexible_beam_2D("a", "b", length, section); });
  };
  CHECK(what(0, flat) == where + "rest length must be finite and positive, got 0");
  CHECK(complaint([&] { (void)flexible_beam_2D("a", "b", 1.0, flat, infinity); }) ==
        where + "rest turn must be finite, got inf");
  CHECK(what(1, {.EA = 1, .EI = -2}) == where + "stiffnesses of the section must be finite and not negative, got -2");
}

TEST_CASE("a flexible beam whose ends coincide is named") {
  auto e = trial_of(flexible_beam_3D("a", "b", 1.0, solid), 1);
  e.at<0>() = {}, e.at<1>() = {};
  CHECK_THROWS_MATCHES(e.doForce(), bad_argument, says("flexible_beam_3D: its ends stand in one place"));
}

}  // namespace flexible_beam_test
