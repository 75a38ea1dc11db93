#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/unrolled/unit_forces.hpp>
#include <kte/math/pack.hpp>

#include <algorithm>

#include "dynamics/trees.hpp"

namespace unit_forces_test {

using namespace kte;
using namespace kte::test::trees;
using kte::detail::joint_place;

/// Every axis is in one group, and stands on the way of that to the base.
template <std::size_t Width, std::size_t N>
void check_groups(const detail::unit_forces<Width, N>& f) {
  std::array<int, N> times{};
  for (std::size_t g = 0; g < f.groups; ++g) {
    CHECK(f.group[g].count > 0);
    CHECK(f.group[g].count <= Width);
    for (std::size_t k = 0; k < f.group[g].count; ++k) {
      const int row = f.group[g].row[k];
      ++times[static_cast<std::size_t>(row)];
      const auto& way = f.group[g].way;
      const auto end = way.begin() + static_cast<std::ptrdiff_t>(f.group[g].length);
      CHECK(std::find(way.begin(), end, row) != end);
    }
  }
  for (const int n : times) CHECK(n == 1);
}

constexpr int nq = std::remove_cvref_t<decltype(joints_3D)>::nq;
/// The inverse of the mass matrix of joints_3D in scalars S, compared with double.
template <class S>
auto inverse_in(const joint_vector<double, nq>& q) {
  return mass_matrix_inverse(joints_3D, q.cast<S>().eval());
}

TEST_CASE("a trunk of six axes and four legs of three: groups of four") {
  // Elements: the trunk, a body, then of each leg three joints with a link between two of them.
  constexpr auto f = [] {
    std::array<joint_place, 2 + 4 * 4 + 1> places{joint_place{12, 6, -1}, {0, 0, -1}};
    for (int leg = 0; leg < 4; ++leg) {
      const auto e = static_cast<std::size_t>(2 + 4 * leg);
      places[e] = {3 * leg, 1, 0}, places[e + 1] = {3 * leg + 1, 1, static_cast<int>(e)};
      places[e + 2] = {0, 0, static_cast<int>(e + 1)}, places[e + 3] = {3 * leg + 2, 1, static_cast<int>(e + 2)};
    }
    places.back() = {0, 0, -1};
    return detail::side_by_side<4, 18>(places);
  }();
  STATIC_REQUIRE(f.groups == 5);  // each leg takes an axis of the trunk along
  check_groups(f);
  for (std::size_t g = 0; g < 4; ++g) {
    CHECK(f.shared(g, g) == 9);
    CHECK(f.shared(g, 4) == 6);
    for (std::size_t h = 0; h < g; ++h) CHECK(f.shared(g, h) == 6);
  }
  CHECK(f.group[0].way[0] == 12);  // from the base
  CHECK(f.group[0].way[8] == 11);  // to the tip
  const auto alone =
      detail::side_by_side<1, 3>(std::array<joint_place, 4>{{{0, 1, -1}, {1, 1, -1}, {2, 1, 0}, {0, 0, -1}}});
  CHECK(alone.groups == 3);
  check_groups(alone);
  CHECK(alone.shared(0, 1) == 0);  // on different bases
}

TEST_CASE("the inverse of the mass matrix of nothing that moves") {
  constexpr auto fixed = chain(rigid_link_3D(base, foot, along_z(0.5)), inertia_3D(foot, body));
  CHECK(mass_matrix_inverse(fixed, joint_vector<double, 0>()).size() == 0);
}

TEST_CASE("the inverse of the mass matrix in scalars that fill a register by ones, groups of four and eights") {
  random_numbers random(17);
  for (int round = 0; round < 5; ++round) {
    const auto q = trial<std::remove_cvref_t<decltype(joints_3D)>>(random).q;
    const auto x = inverse_in<double>(q);
    const double size = x.cwiseAbs().maxCoeff();
    CHECK((inverse_in<float>(q).cast<double>() - x).cwiseAbs().maxCoeff() <= 1.1e-6 * size);  // 9 eps, as below
    CHECK((inverse_in<long double>(q).cast<double>() - x).cwiseAbs().maxCoeff() <= 2e-15 * size);
    joint_vector<pack<double, 4>, nq> four;
    for (int i = 0; i < nq; ++i) four[i] = q[i];
    const auto packed = mass_matrix_inverse(joints_3D, four);
    for (int i = 0; i < x.rows(); ++i)
      for (int j = 0; j < x.cols(); ++j)
        for (const std::size_t lane : {0u, 3u}) CHECK(std::abs(packed(i, j)[lane] - x(i, j)) <= 2e-15 * size);
  }
}

}  // namespace unit_forces_test
