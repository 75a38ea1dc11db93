#include <kte/contacts.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/kte.hpp>
#include <kte/math/quaternion.hpp>

#include <Eigen/QR>

#include <array>
#include <limits>

#include "catch.hpp"
#include "random.hpp"

namespace static_chains_test {

using namespace kte;
using namespace kte::test;

using vector = Eigen::VectorXd;

// clang-format off
inline constexpr struct knee_ final : coord_key<"knee"> {} knee;
inline constexpr struct ankle_ final : coord_key<"ankle"> {} ankle;
inline constexpr struct pose_ final : pose_3D_key<"pose"> {} pose_of_body;
inline constexpr struct flat_ final : pose_2D_key<"flat"> {} flat_pose;
inline constexpr struct world_ final : frame_3D_key<"world"> {} world;
inline constexpr struct slope_ final : frame_3D_key<"slope"> {} slope;
inline constexpr struct hill_ final : frame_3D_key<"hill"> {} hill;
inline constexpr struct pit_ final : frame_3D_key<"pit"> {} pit;
inline constexpr struct body_ final : frame_3D_key<"body"> {} body;
inline constexpr struct hip_ final : frame_3D_key<"hip"> {} hip;
inline constexpr struct shank_ final : frame_3D_key<"shank"> {} shank;
inline constexpr struct heel_ final : frame_3D_key<"heel"> {} heel;
inline constexpr struct toe_ final : frame_3D_key<"toe"> {} toe;
inline constexpr struct plane_ final : frame_2D_key<"plane"> {} plane;
inline constexpr struct box_ final : frame_2D_key<"box"> {} box;
inline constexpr struct arm_ final : frame_2D_key<"arm"> {} arm;
inline constexpr struct tip_ final : frame_2D_key<"tip"> {} tip;
inline constexpr struct on_slope_ final : contact_key<"on slope"> {} on_slope;
inline constexpr struct on_hill_ final : contact_key<"on hill"> {} on_hill;
inline constexpr struct above_ final : contact_key<"above"> {} above;
inline constexpr struct corner_ final : contact_key<"corner"> {} corner;
inline constexpr struct end_ final : contact_key<"end"> {} end_of_arm;
// clang-format on

/// A body on a slope with a leg of two joints on a hill; the slope is at `height`, the hill has the radius `size`.
struct leg {
  double height, size, friction;
  auto operator()() const {
    const auto slant = to_quaternion(vec3<>{0.3, -0.2, 0.4});
    return chain(free_joint_3D(pose_of_body, world, body),
                 inertia_3D(body,
                            rigid_body<>{2.0, vec3<>{0.02, 0.01, 0.03}, sym3<>{0.05, 0.002, 0.001, 0.06, 0.003, 0.04}}),
                 rigid_link_3D(world, slope, slant * vec3<>{0, 0, height}, slant),
                 rigid_link_3D(world, hill, vec3<>{0.3, 0.1, -2}), rigid_link_3D(body, hip, vec3<>{0.2, 0, 0}),
                 revolute_joint_3D(knee, hip, shank, axis::y),
                 inertia_3D(shank, rigid_body<>{0.4, vec3<>{0, 0, -0.1}, sym3<>{0.004, 0, 0, 0.003, 0, 0.002}}),
                 rigid_link_3D(shank, heel, vec3<>{0, 0, -0.25}), revolute_joint_3D(ankle, heel, toe, axis::x),
                 inertia_3D(toe, rigid_body<>{0.1, vec3<>{0, 0.05, 0}, sym3<>{0.001, 0, 0, 0.001, 0, 0.001}}),
                 sphere_contact_3D(on_slope, slope, body, half_space{}, 0.07, {friction, 0}, vec3<>{-0.2, 0.1, -0.15}),
                 rigid_link_3D(world, pit, vec3<>{0, 0, -50}),
                 sphere_contact_3D(above, pit, shank, half_space{}, 0.01, {friction, 0}),
                 sphere_contact_3D(on_hill, hill, toe, ball_surface(size), 0.05, {friction, 0}))
        .gravity(along_z(-9.81));
  }
};
/// A box in the plane with an arm: a corner on the ground, the end of the arm on a ball of the radius `size`.
struct planar {
  double height, size, friction;
  auto operator()() const {
    return chain(free_joint_2D(flat_pose, plane, box), inertia_2D(box, planar_body(2.0, 0.02)),
                 revolute_joint_2D(knee, box, arm), inertia_2D(arm, planar_body(0.5, 0.01)),
                 rigid_link_2D(arm, tip, along_x(0.4)),
                 sphere_contact_2D(corner, plane, box, half_space{}, height, {friction, 0}, vec2{-0.1, 0.05}),
                 point_contact_2D(end_of_arm, plane, tip, ball_surface(size), {friction, 0}))
        .gravity(along_y(-9.81));
  }
};

static_assert(detail::unrolls_contacts<decltype(leg{}()), double>);
static_assert(detail::unrolls_contacts<decltype(planar{}()), double>);

double largest(const vector& x) { return x.cwiseAbs().maxCoeff(); }
/// Compares a static chain with the same at run time, at random states where the contacts `first` and `last` touch.
/// Returns how often contacts had each mode.
template <class Scene>
std::array<int, 3> check_against_runtime(const char* first, const char* last, vec3<> up, random_numbers& draw) {
  std::array<int, 3> modes{};
  for (int trial = 0; trial < 24; ++trial) {
    Scene at{0.6, 0.9, trial % 3 == 0 ? 3.0 : 0.4};
    runtime_chain far;
    far << at();
    auto s = far.make_state();
    const int n = far.dofs();
    const auto some = [&] { return vector(vector::NullaryExpr(n, [&] { return draw(); })); };
    const vector none = vector::Zero(n), q = integrate(far, neutral_configuration(far), some(), 1.0);
    const auto contacts_in = [&](const runtime_chain& c) {
      s = c.make_state();
      detail::take(c, s, q, none).call([&] { c.doMotion(s); });
    };
    contacts_in(far);
    at.height += s.contact(first).gap, at.size += s.contact(last).gap;
    if (!(at.height > 0 && at.size > 0.1)) continue;
    const auto c = at();
    runtime_chain same;
    same << c;
    contacts_in(same);
    const vec3<> p = s.contact(last).point;
    const std::array normals{up, (1 / std::sqrt(dot(p, p))) * p};
    Eigen::MatrixXd rows = contact_jacobian(same, s, q, at_contacts(first, last));
    if (trial % 2 == 1) {  // slides: normal velocities only are zero
      const Eigen::MatrixXd all = rows;
      const Eigen::Index m = all.rows() / 2;
      rows.resize(2, n);
      for (Eigen::Index i = 0; i < 2; ++i) {
        const vec3<>& d = normals[static_cast<std::size_t>(i)];
        rows.row(i) = Eigen::RowVector3d(d.x, d.y, d.z).head(m) * all.middleRows(i * m, m);
      }
    }
    vector v = some();
    v -= rows.completeOrthogonalDecomposition().solve(rows * v);
    const vector tau = 5 * some();
    const auto has_forces = [](const auto& find) {
      try {
        find();
      } catch (const no_solution&) {
        return false;
      }
      return true;
    };
    const bool solvable = has_forces([&] { (void)contact_dynamics(c, q, v, tau); });  // otherwise it is jammed
    CHECK(solvable == has_forces([&] { (void)contact_dynamics(same, s, q, v, tau); }));
    if (!solvable) continue;
    const auto x = contact_dynamics(c, q, v, tau);
    const auto& y = contact_dynamics(same, s, q, v, tau);
    CHECK(largest(vector(x.a) - y.a) <= 1e-12 * (1 + largest(y.a)));
    CHECK(x.several == y.several);
    for (std::size_t i = 0; i < x.contacts.size(); ++i) {
      const auto &a = x.contacts[i], &b = y.contacts[i];
      ++modes[static_cast<std::size_t>(b.mode)];
      CHECK(a.mode == b.mode);
      CHECK(std::abs(a.gap - b.gap) <= 1e-14 * (1 + std::abs(b.gap)));
      for (const vec3<>& d : {a.slip - b.slip, a.point - b.point, a.direction - b.direction})
        CHECK(std::sqrt(dot(d, d)) <= 1e-13);
      const vec3<> d = a.force - b.force;
      CHECK(std::sqrt(dot(d, d)) <= 1e-12 * (1 + std::sqrt(dot(b.force, b.force))));
    }
  }
  return modes;
}

TEST_CASE("contact dynamics of a static chain is that of the same at run time") {
  random_numbers draw(3);
  for (const auto& modes : {check_against_runtime<leg>("on slope", "on hill", {0, 0, 1}, draw),
                            check_against_runtime<planar>("corner", "end", {0, 1, 0}, draw)})
    for (const int n : modes) CHECK(n >= 3);  // open, sticks, slides
}

TEST_CASE("without contacts that touch, contact dynamics is free forward dynamics") {
  const planar at{0.1, 0.3, 0.5};
  const vector q = Eigen::Vector4d(0.3, 7, 0.2, 0.4), v = Eigen::Vector4d(1, 2, 3, 4),
               tau = Eigen::Vector4d(4, 3, 2, 1);
  const auto c = at();
  const auto r = contact_dynamics(c, q, v, tau);
  const auto free = chain(free_joint_2D(flat_pose, plane, box), inertia_2D(box, planar_body(2.0, 0.02)),
                          revolute_joint_2D(knee, box, arm), inertia_2D(arm, planar_body(0.5, 0.01)))
                        .gravity(along_y(-9.81));
  CHECK(largest(vector(r.a) - vector(forward_dynamics(free, q, v, tau))) == 0);
  CHECK((mode_of(r.contact(corner)) == contact_mode::open && r.force(end_of_arm) == vec3<>{}));
}

TEST_CASE("contact dynamics of a static chain names what it refuses") {
  const auto c = planar{0.1, 0.3, 0.5}();
  const vector q = Eigen::Vector4d(-0.3, 0.05, 0, 0), still = vector::Zero(4), down = Eigen::Vector4d(0, -2, 0, 0);
  CHECK_THROWS_MATCHES(contact_dynamics(c, q, down, still), bad_argument,
                       says("kte: contact 'corner' approaches at 2 m/s: kte::impact"));
  vector broken = still;
  broken[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(contact_dynamics(c, Eigen::Vector4d(0, 7, 0, 0), still, broken), bad_argument);
  broken = q, broken[0] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(contact_dynamics(c, broken, still, still), bad_argument);
  const auto in_ball = chain(free_joint_2D(flat_pose, plane, box), inertia_2D(box, planar_body(2.0, 0.02)),
                             sphere_contact_2D(corner, plane, box, ball_surface(0.5), 0.1, {0.5, 0}));
  const Eigen::Vector3d none(0, 0, 0);
  CHECK_THROWS_MATCHES(contact_dynamics(in_ball, none, none, none), bad_argument,
                       says("kte: contact 'corner': its surface has no normal here"));
}

}  // namespace static_chains_test
