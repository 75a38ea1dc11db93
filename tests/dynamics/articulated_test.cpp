#include <boost/multiprecision/cpp_bin_float.hpp>

#include <limits>

#include "catch.hpp"
#include "chain/models.hpp"
#include "random.hpp"

// Forward dynamics by articulated bodies against M^-1 (tau - bias) in chains with everything that it can do, M and bias
// by inverse dynamics at 50 digits; and what it must leave to the mass matrix.

using namespace kte;
using models::element_by_element;
using big = boost::multiprecision::cpp_bin_float_50;

namespace {

// clang-format off
inline constexpr struct q1_     final : coord_key<"q1">           {} q1;
inline constexpr struct q2_     final : coord_key<"q2">           {} q2;
inline constexpr struct q3_     final : coord_key<"q3">           {} q3;
inline constexpr struct q4_     final : coord_key<"q4">           {} q4;
inline constexpr struct q5_     final : coord_key<"q5">           {} q5;
inline constexpr struct lone_   final : coord_key<"lone">         {} lone;
inline constexpr struct drive_  final : coord_key<"drive">        {} drive;
inline constexpr struct motor_  final : input_key<"motor">        {} motor;
inline constexpr struct pull_   final : input_key<"pull">         {} pull;
inline constexpr struct ball_   final : rotation_3D_key<"ball">   {} ball;
inline constexpr struct float_  final : pose_3D_key<"float">      {} floating;
inline constexpr struct slide_  final : pose_2D_key<"slide">      {} sliding;
inline constexpr struct base_   final : frame_3D_key<"base">      {} base;
inline constexpr struct cart_   final : frame_3D_key<"cart">      {} cart;
inline constexpr struct a_      final : frame_3D_key<"a">         {} a;
inline constexpr struct b_      final : frame_3D_key<"b">         {} b;
inline constexpr struct c_      final : frame_3D_key<"c">         {} c;
inline constexpr struct d_      final : frame_3D_key<"d">         {} d;
inline constexpr struct e_      final : frame_3D_key<"e">         {} e;
inline constexpr struct f_      final : frame_3D_key<"f">         {} f;
inline constexpr struct g_      final : frame_3D_key<"g">         {} g;
inline constexpr struct h_      final : frame_3D_key<"h">         {} h;
inline constexpr struct floor_  final : frame_2D_key<"floor">     {} floor_2D;
inline constexpr struct wall_   final : frame_2D_key<"wall">      {} wall;
inline constexpr struct k_      final : frame_2D_key<"k">         {} k;
inline constexpr struct l_      final : frame_2D_key<"l">         {} l;
inline constexpr struct m_      final : frame_2D_key<"m">         {} m;
inline constexpr struct n_      final : frame_2D_key<"n">         {} n;
inline constexpr struct o_      final : frame_2D_key<"o">         {} o;
inline constexpr struct p_      final : frame_2D_key<"p">         {} p;
inline constexpr struct foot_   final : frame_3D_key<"foot">      {} foot;
// clang-format on

constexpr rigid_body body{1.5, vec3{0.125, -0.25, 0.0625}, sym3{0.25, 0.03125, -0.0625, 0.1875, 0.015625, 0.1875}};
constexpr rigid_body light{0.25, vec3{0.03125, 0.125, -0.0625}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
constexpr vec3 oblique{2.0 / 3, -1.0 / 3, 2.0 / 3};
constexpr vec3 fall{0.5, -0.25, -9.81};

/// A coordinate, frame or input of a state of either sort.
template <class State, class Key>
auto& at(State& s, const Key& key) {
  if constexpr (is_chain_state<State>) {
    return s[key];
  } else {
    return s.template get<Key::what>(s.made_for()->find(Key::name, Key::what));
  }
}
template <class State>
using scalar_of = std::remove_cvref_t<decltype(std::declval<State&>().coordinate(0).q)>;

/// A base that is anywhere and moves in any way.
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

template <class X>
double largest(const X& x) {
  double most = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto y = std::fabs(static_cast<double>(x.data()[i]));
    most = y == y ? std::max(most, y) : HUGE_VAL;
  }
  return most;
}
/// The largest difference, relative to the largest number.
template <class X, class Y>
double gap(const X& x, const Y& exact) {
  REQUIRE(x.size() == exact.size());
  big most = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const big y = abs(big(x.data()[i]) - big(exact.data()[i]));
    if (!(y <= most)) most = y;
  }
  const double size = largest(exact);
  return static_cast<double>(most) / (size == 0 ? 1 : size);
}
/// M^-1 f by elimination.
template <class M, class F>
std::vector<big> solved(M mass, F force) {
  const Eigen::Index size = force.size();
  for (Eigen::Index j = 0; j < size; ++j)
    for (Eigen::Index i = j + 1; i < size; ++i) {
      const big share = mass(i, j) / mass(j, j);
      for (Eigen::Index r = j; r < size; ++r) mass(i, r) -= share * mass(j, r);
      force[i] -= share * force[j];
    }
  std::vector<big> x(static_cast<std::size_t>(size));
  for (Eigen::Index i = size; i-- > 0;) {
    big sum = force[i];
    for (Eigen::Index r = i + 1; r < size; ++r) sum -= mass(i, r) * x[static_cast<std::size_t>(r)];
    x[static_cast<std::size_t>(i)] = sum / mass(i, i);
  }
  return x;
}

template <class Chain>
struct trial {
  static constexpr int dofs = Chain::dofs;
  using vector = joint_vector<double, dofs>;
  joint_vector<double, Chain::nq> q;
  vector v, a, tau;
  explicit trial(random_numbers& random) {
    for (auto& x : q) x = random(3);
    for (auto& x : v) x = random(2);
    for (auto& x : a) x = random(5);
    for (auto& x : tau) x = random(9);
  }
};

/// What is allowed, relative to the largest number:
///   rounding        inverse dynamics and mass matrix, static against runtime and 50 digits; the forces that are
///   missing
///                   at the accelerations found, against the largest force of inertia
///   accelerations   against the exact ones
struct bounds {
  double rounding, accelerations;
};

/// All algorithms on one chain, static and runtime, in random states; `outside` are the bases, inputs and coordinates
/// that are given.
template <class Chain, class... Outside>
void check(const Chain& chain, unsigned seed, const bounds& most, const Outside&... outside) {
  random_numbers random(seed);
  const auto model = element_by_element(chain);
  auto s = make_state(chain);
  auto r = model.make_state();
  auto exact = make_state<big>(chain);
  struct {
    double same = 0, torques = 0, mass = 0, missing = 0, accelerations = 0;
  } worst;
  for (int round = 0; round < 20; ++round) {
    const trial<Chain> x(random);
    const unsigned outside_seed = 1000 * seed + static_cast<unsigned>(round);
    const auto set = [&](auto& state) {
      set_positions(state, x.q), set_velocities(state, x.v), set_accelerations(state, x.a);
      random_numbers draw(outside_seed);
      (move(at(state, outside), draw), ...);
    };
    set(s), set(r), set(exact);

    // with all that the state says
    const auto tau = inverse_dynamics(chain, s);
    worst.same = std::max(worst.same, gap(inverse_dynamics(model, r), tau));
    worst.torques = std::max(worst.torques, gap(tau, inverse_dynamics(chain, exact)));
    set_accelerations(exact, typename trial<Chain>::vector(trial<Chain>::vector::Zero()));
    const auto bias = inverse_dynamics(chain, exact);
    joint_matrix<big, Chain::dofs> M;
    for (int j = 0; j < Chain::dofs; ++j) {
      set_accelerations(exact, typename trial<Chain>::vector(trial<Chain>::vector::Unit(j)));
      M.col(j) = inverse_dynamics(chain, exact) - bias;
    }
    worst.mass = std::max(worst.mass, gap(mass_matrix(model, r), M));
    if constexpr (!(std::is_same_v<Outside, drive_> || ...))
      worst.mass = std::max(worst.mass, gap(mass_matrix(chain, s), M));
    const auto truth = solved(M, decltype(bias)(-bias));
    const Eigen::Map<const joint_vector<big, Chain::dofs>> y(truth.data());
    worst.accelerations = std::max(worst.accelerations, gap(forward_dynamics(chain, s), y));
    worst.accelerations = std::max(worst.accelerations, gap(forward_dynamics(model, r), y));
    // no forces are needed to make this motion happen: those of inertia and all others cancel
    const auto found = forward_dynamics(chain, s);
    const double size = largest(bias) + largest(M) * largest(found);
    set_accelerations(s, found), set_accelerations(r, found);
    worst.missing = std::max(worst.missing, largest(inverse_dynamics(chain, s)) / size);
    worst.missing = std::max(worst.missing, largest(inverse_dynamics(model, r)) / size);

    // with bases at rest and forces
    const auto driven = forward_dynamics(chain, x.q, x.v, x.tau);
    auto rest = model.make_state();
    worst.accelerations = std::max(worst.accelerations, gap(forward_dynamics(model, rest, x.q, x.v, x.tau), driven));
    auto still = make_state(chain);
    set_positions(still, x.q), set_velocities(still, x.v), set_accelerations(still, driven);
    const typename trial<Chain>::vector missing = inverse_dynamics(chain, still) - x.tau;
    worst.missing = std::max(worst.missing, largest(missing) / (largest(x.tau) + largest(M) * largest(driven)));
  }
  CHECK(worst.same < most.rounding);
  CHECK(worst.torques < most.rounding);
  CHECK(worst.mass < most.rounding);
  CHECK(worst.missing < most.rounding);
  CHECK(worst.accelerations < most.accelerations);
}

constexpr auto tree_3D =
    chain(rigid_link_3D(base, foot, along_z(0.5)), base_3D(cart), revolute_joint_3D(q1, foot, a), inertia_3D(a, body),
          rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x), free_joint_3D(floating, b, c),
          inertia_3D(c, body), spherical_joint_3D(ball, c, d), inertia_3D(d, light),
          rigid_link_3D(d, e, vec3{0.0, 0.5, 0.25}), revolute_joint_3D(q2, e, f, oblique), inertia_3D(f, body),
          prismatic_joint_3D(q3, c, g, axis::minus_y), inertia_3D(g, light), revolute_joint_3D(q4, cart, h, axis::y),
          inertia_3D(h, body), spring_3D(f, h, 0.5, 40.0), damper_3D(g, base, 0.75), torsion_spring_3D(a, d, 3.0),
          torsion_damper_3D(c, h, 0.5), spring_gen(q1, q3, 0.25, 20.0), damper_gen(q2, q4, 0.25),
          driving_actuator_gen(q4, motor))
        .gravity(fall);

/// Prescribed motion between a tree and its branches, a coordinate without a joint; general axes everywhere.
constexpr auto driven_3D =
    chain(base_gen(drive), prismatic_joint_3D(q1, base, a, oblique), inertia_3D(a, body),
          prismatic_joint_3D(drive, a, b, vec3{0.0, 0.6, 0.8}), inertia_3D(b, body),
          rigid_link_3D(b, c, vec3{0.25, 0.5, -0.375}, quarter_turn_y), revolute_joint_3D(q2, c, d, oblique),
          inertia_3D(d, body), prismatic_joint_3D(q3, b, e, axis::x), inertia_3D(e, light),
          revolute_joint_3D(q4, e, f, axis::minus_z), inertia_3D(f, light), spring_gen(drive, q2, 0.5, 7.0),
          driving_actuator_gen(q1, motor), driving_actuator_gen(q3, pull), spring_3D(d, f, zero, 30.0, 12.0))
        .gravity(fall);

constexpr auto tree_2D =
    chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, planar_body(2.0, 0.25, along_x(0.25))),
          rigid_link_2D(k, l, vec2{0.5, 0.125}, quarter_turn), free_joint_2D(sliding, l, m),
          inertia_2D(m, planar_body(1.5, 0.125, along_y(0.25))), prismatic_joint_2D(q2, m, n, vec2{0.6, 0.8}),
          inertia_2D(n, planar_body(0.5, 0.0625)), base_2D(wall), prismatic_joint_2D(q3, wall, o, axis::y),
          inertia_2D(o, point_mass(0.75)), revolute_joint_2D(q4, n, p),
          inertia_2D(p, planar_body(0.75, 0.125, along_x(0.5))), spring_2D(p, o, 0.25, 30.0), damper_2D(k, wall, 2.0),
          torsion_spring_2D(k, p, 4.0, 3.0, 0.25), torsion_damper_2D(m, wall, 0.5), driving_actuator_gen(q2, motor),
          damper_gen(q1, q4, 0.5))
        .gravity(along_y(-9.81));

/// In the plane and in space at once.
constexpr auto both = chain(base_2D(wall), revolute_joint_3D(q1, base, a, axis::x), inertia_3D(a, body),
                            prismatic_joint_2D(q2, wall, o, axis::x), inertia_2D(o, point_mass(0.75)),
                            revolute_joint_2D(q3, o, p), inertia_2D(p, planar_body(0.75, 0.125, along_x(0.5))),
                            spring_gen(q1, q3, 0.25, 9.0), damper_gen(q1, q2, 0.75));

/// A nut on a screw of pitch h a radian about an axis n, in no library: p = h q n.
template <class Axis>
struct screw : transmission<screw<Axis>> {
  static constexpr type_name type{"screw_joint", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  double pitch;
  Axis axis;
  constexpr screw(double m_per_rad, const Axis& direction) : pitch(m_per_rad), axis(direction) {}

  template <class C>
  KTE_INLINE constexpr auto relative(const C& x) const {
    const auto along = [this](const auto& rate) { return (pitch * rate) * axis; };
    return motion{along(x.q),     rotation_about(axis, x.cos, x.sin), along(x.q_dot), axis * x.q_dot, along(x.q_ddot),
                  axis * x.q_ddot};
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(pitch, "pitch must be finite"), where.unit(axis, "axis must have length 1");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("pitch", self.pitch), visit("axis", self.axis);
  }
};
template <class Q, class B, class E, class Axis>
constexpr auto screw_joint_3D(const Q& coordinate, const B& from, const E& end, double pitch, const Axis& direction) {
  return connect(screw<Axis>(pitch, direction), coordinate, from, end);
}
constexpr auto screws =
    chain(screw_joint_3D(q1, base, a, 0.25, axis::z), inertia_3D(a, body),
          rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x), screw_joint_3D(q2, b, c, -0.5, oblique),
          inertia_3D(c, body), screw_joint_3D(q3, c, d, 1.0, axis::x), inertia_3D(d, light))
        .gravity(fall);

template <class Chain>
constexpr bool by_articulated_bodies = kte::detail::is_tree_of_joints<Chain>;

}  // namespace

// Bounds: numbers on the way are up to some times as large as the largest result, and are rounded by eps/2 some ten
// times in a row: 20 eps; measured 2.3e-15. Accelerations may have some of the condition of M besides; measured 1e-15,
// and 3e-15 by the mass matrix.
constexpr bounds usual{5e-15, 1e-14};

TEST_CASE("a tree in space", "[articulated]") {
  STATIC_REQUIRE(by_articulated_bodies<std::remove_const_t<decltype(tree_3D)>>);
  check(tree_3D, 1, usual, base, cart, motor);
}

TEST_CASE("prescribed motion", "[articulated]") {
  STATIC_REQUIRE(by_articulated_bodies<std::remove_const_t<decltype(driven_3D)>>);
  check(driven_3D, 2, usual, base, drive, motor, pull);
}

TEST_CASE("a tree in the plane", "[articulated]") {
  STATIC_REQUIRE(by_articulated_bodies<std::remove_const_t<decltype(tree_2D)>>);
  check(tree_2D, 3, usual, floor_2D, wall, motor);
}

TEST_CASE("the plane and space in one chain", "[articulated]") {
  STATIC_REQUIRE(by_articulated_bodies<std::remove_const_t<decltype(both)>>);
  check(both, 4, usual, base, wall);
}

TEST_CASE("a joint made by a user", "[articulated]") {
  STATIC_REQUIRE(by_articulated_bodies<std::remove_const_t<decltype(screws)>>);
  check(screws, 5, usual, base);
  // A body of mass m and inertia J about a screw along z, both through its centre of mass, falls by
  // (J + m h^2) q_ddot = - m g h.
  constexpr auto nut = chain(screw_joint_3D(q1, base, a, 0.5, axis::z),
                             inertia_3D(a, rigid_body{2.0, zero3{}, diagonal(1.0, 1.0, 0.75)}))
                           .gravity(along_z(-10.0));
  const std::array one_number{0.3}, none{0.0};
  CHECK(mass_matrix(nut, one_number)(0, 0) == 1.25);
  CHECK(forward_dynamics(nut, one_number, one_number, none)[0] == -8.0);
  CHECK(inverse_dynamics(nut, one_number, one_number, none)[0] == 10.0);
  const auto model = element_by_element(nut);
  auto s = model.make_state();
  CHECK(mass_matrix(model, s, one_number)(0, 0) == 1.25);
  CHECK(forward_dynamics(model, s, one_number, one_number, none)[0] == -8.0);
  CHECK(inverse_dynamics(model, s, one_number, one_number, none)[0] == 10.0);
}

TEST_CASE("chains that are no trees of joints", "[articulated]") {
  constexpr auto shared =
      chain(revolute_joint_3D(q1, base, a, axis::y), inertia_3D(a, body), prismatic_joint_3D(q2, a, b, axis::x),
            inertia_3D(b, light), prismatic_joint_3D(q2, a, c, axis::minus_x), inertia_3D(c, body),
            revolute_joint_3D(q1, c, d, oblique), inertia_3D(d, light), spring_3D(b, c, 0.5, 10.0))
          .gravity(fall);
  STATIC_REQUIRE(!by_articulated_bodies<std::remove_const_t<decltype(shared)>>);
  check(shared, 6, usual, base);
  STATIC_REQUIRE(!by_articulated_bodies<std::remove_const_t<decltype(models::tree)>>);
  check(models::tree, 7, usual, models::ground, models::wall, models::motor);
  constexpr auto follower =
      chain(rigid_link_gen(q1, lone, 0.5), inertia_gen(lone, 0.75), revolute_joint_3D(q1, base, a), inertia_3D(a, body))
          .gravity(fall);
  STATIC_REQUIRE(!by_articulated_bodies<std::remove_const_t<decltype(follower)>>);
  check(follower, 8, usual, base);
}

namespace {
/// No state has an answer. Static chains take long to compile: some stand for all.
template <bool AlsoStatic = false, class Chain>
void check_singular(const Chain& chain, unsigned seed) {
  CAPTURE(seed);
  STATIC_REQUIRE(by_articulated_bodies<Chain>);
  random_numbers random(seed);
  const auto model = element_by_element(chain);
  auto s = model.make_state();
  for (int round = 0; round < 30; ++round) {
    const trial<Chain> x(random);
    if constexpr (AlsoStatic) CHECK_THROWS_AS(forward_dynamics(chain, x.q, x.v, x.tau), singular_mass_matrix);
    CHECK_THROWS_AS(forward_dynamics(model, s, x.q, x.v, x.tau), singular_mass_matrix);
  }
}
constexpr auto without_size(double mass) { return rigid_body{mass, zero3{}, sym3<double>{}}; }
}  // namespace

TEST_CASE("coordinates that move no mass of their own", "[articulated]") {
  constexpr auto first = revolute_joint_3D(q1, base, a);
  constexpr auto heavy = inertia_3D(a, body);
  constexpr auto link = rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x);
  SECTION("nothing at the end") {
    check_singular(chain(first), 1);
    check_singular(chain(first, heavy, link, revolute_joint_3D(q2, b, c, axis::x)), 2);
    check_singular<true>(chain(first, heavy, link, revolute_joint_3D(q2, b, c, oblique)), 3);
    check_singular(chain(first, heavy, link, prismatic_joint_3D(q2, b, c, oblique)), 4);
    check_singular(chain(first, heavy, link, spherical_joint_3D(ball, b, c)), 5);
    check_singular<true>(chain(first, heavy, link, free_joint_3D(floating, b, c)), 6);
    check_singular(
        chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, planar_body(1.0, 1.0)), free_joint_2D(sliding, k, l)),
        7);
    check_singular<true>(chain(first, heavy, inertia_gen(lone, 0.0)), 8);
    check_singular(chain(first, heavy, link, revolute_joint_3D(q2, b, c, oblique), inertia_3D(c, without_size(0.0))),
                   9);
  }
  SECTION("only on the axis") {
    check_singular(chain(first, inertia_3D(a, point_mass(1.0))), 11);
    check_singular<true>(chain(first, inertia_3D(a, point_mass(1.0, along_z(0.75)))), 12);
    check_singular(chain(first, heavy, link, revolute_joint_3D(q2, b, c, oblique), inertia_3D(c, without_size(2.0))),
                   13);
    // away along it
    check_singular(chain(first, heavy, link, revolute_joint_3D(q2, b, c, oblique), rigid_link_3D(c, d, 0.375 * oblique),
                         inertia_3D(d, point_mass(2.0))),
                   14);
    check_singular<true>(
        chain(first, heavy, link, spherical_joint_3D(ball, b, c), inertia_3D(c, point_mass(2.0, along_x(0.5)))), 15);
    check_singular(chain(first, heavy, link, spherical_joint_3D(ball, b, c), inertia_3D(c, point_mass(2.0))), 16);
    check_singular(chain(first, heavy, link, free_joint_3D(floating, b, c),
                         inertia_3D(c, point_mass(2.0, vec3{0.25, 0.5, 0.125}))),
                   17);
    check_singular(chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, point_mass(1.0))), 18);
  }
  SECTION("two joints that do the same") {
    constexpr auto last = inertia_3D(c, body);
    check_singular<true>(chain(revolute_joint_3D(q1, base, a), revolute_joint_3D(q2, a, c), last), 21);
    check_singular(chain(revolute_joint_3D(q1, base, a, axis::x), revolute_joint_3D(q2, a, c, axis::minus_x), last),
                   22);
    check_singular<true>(chain(revolute_joint_3D(q1, base, a, oblique), revolute_joint_3D(q2, a, c, oblique), last),
                         23);
    check_singular(chain(prismatic_joint_3D(q1, base, a, axis::y), prismatic_joint_3D(q2, a, c, axis::y), last), 24);
    check_singular(chain(prismatic_joint_3D(q1, base, a, oblique), prismatic_joint_3D(q2, a, c, oblique), last), 25);
    // about z, by a link along it and turned about it
    check_singular(chain(revolute_joint_3D(q1, base, a), rigid_link_3D(a, b, along_z(0.5), quarter_turn_z),
                         revolute_joint_3D(q2, b, c), last),
                   26);
    // about z here, about y there
    check_singular(chain(revolute_joint_3D(q1, base, a), rigid_link_3D(a, b, along_z(0.5), quarter_turn_x),
                         revolute_joint_3D(q2, b, c, axis::y), last),
                   27);
    // parallel sliding joints with a turn between their frames
    check_singular<true>(
        chain(prismatic_joint_3D(q1, base, a, axis::z), rigid_link_3D(a, b, vec3{0.5, 0.25, 1.0}, quarter_turn_x),
              prismatic_joint_3D(q2, b, c, axis::minus_y), last),
        28);
    // three sliding joints in a plane, three revolute ones about two axes
    check_singular(chain(prismatic_joint_3D(q1, base, a, axis::x), prismatic_joint_3D(q2, a, b, axis::y),
                         prismatic_joint_3D(q3, b, c, vec3{0.6, 0.8, 0.0}), last),
                   29);
    check_singular<true>(chain(revolute_joint_3D(q1, base, a), spherical_joint_3D(ball, a, c), last), 31);
    check_singular(chain(prismatic_joint_3D(q1, base, a, axis::x), free_joint_3D(floating, a, c), last), 33);
    check_singular<true>(
        chain(free_joint_2D(sliding, floor_2D, k), revolute_joint_2D(q1, k, l), inertia_2D(l, planar_body(1.0, 1.0))),
        34);
  }
  SECTION("not when there is little") {
    // Joints without mass between them that do different things; and small masses.
    constexpr auto cardan = chain(revolute_joint_3D(q1, base, a, axis::x), revolute_joint_3D(q2, a, b, axis::y),
                                  revolute_joint_3D(q3, b, c, oblique), inertia_3D(c, body));
    const std::array some{0.25, 0.5, 0.75};
    CHECK_NOTHROW(forward_dynamics(cardan, some, some, some));
    constexpr auto tiny =
        chain(revolute_joint_3D(q1, base, a, oblique), inertia_3D(a, body), rigid_link_3D(a, b, along_x(0.5)),
              revolute_joint_3D(q2, b, c), inertia_3D(c, point_mass(1e-12, along_x(1e-3))));
    const std::array two{0.25, 0.5};
    CHECK_NOTHROW(forward_dynamics(tiny, two, two, two));
    const auto model = element_by_element(tiny);
    auto s = model.make_state();
    CHECK_NOTHROW(forward_dynamics(model, s, two, two, two));
  }
}

TEST_CASE("articulated bodies with arguments that are no numbers", "[articulated]") {
  const auto model = element_by_element(tree_3D);
  auto s = make_state(tree_3D);
  auto r = model.make_state();
  random_numbers random(10);
  const trial<std::remove_const_t<decltype(tree_3D)>> good(random);
  const auto rejected = [&](const auto& x) {
    CHECK_THROWS_AS(forward_dynamics(tree_3D, x.q, x.v, x.tau), bad_argument);
    CHECK_THROWS_AS(forward_dynamics(model, r, x.q, x.v, x.tau), bad_argument);
    set_positions(s, x.q), set_velocities(s, x.v);
    if (x.tau == good.tau) CHECK_THROWS_AS(forward_dynamics(tree_3D, s), bad_argument);
  };
  CHECK_NOTHROW(forward_dynamics(model, r, good.q, good.v, good.tau));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
    CAPTURE(bad);
    for (Eigen::Index i = 0; i < good.q.size(); ++i) {
      auto x = good;
      x.q[i] = bad;
      rejected(x);
    }
    for (Eigen::Index i = 0; i < good.v.size(); ++i) {
      auto x = good;
      x.v[i] = bad;
      rejected(x);
      x = good;
      x.tau[i] = bad;
      rejected(x);
    }
  }
  // rotations of length 0
  for (const Eigen::Index i : {4, 8}) {
    auto x = good;
    x.q.segment<4>(i).setZero();
    CHECK_THROWS_AS(forward_dynamics(tree_3D, x.q, x.v, x.tau), bad_argument);
  }
  // what comes from outside
  const auto given = [&](const auto& spoil) {
    auto t = make_state(tree_3D);
    set_positions(t, good.q), set_positions(r, good.q), set_velocities(r, good.v);
    spoil(t);
    CHECK_THROWS_AS(forward_dynamics(tree_3D, t), bad_argument);
    auto u = model.make_state();
    set_positions(u, good.q);
    spoil(u);
    CHECK_THROWS_AS(forward_dynamics(model, u), bad_argument);
  };
  const double bad = std::numeric_limits<double>::quiet_NaN();
  given([&](auto& t) { at(t, base).acceleration.y = bad; });
  given([&](auto& t) { at(t, cart).ang_velocity.x = bad; });
  given([&](auto& t) { at(t, cart).position.x = bad; });
  given([&](auto& t) { at(t, motor) = bad; });
}
