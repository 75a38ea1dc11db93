#include "catch.hpp"
#include "closed_loops/linkages.hpp"

namespace assemblies_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

/// Whether all are assemblies, in order and without duplicates.
bool good(const runtime_chain& c, const std::vector<vector>& all) {
  auto s = c.make_state();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!(kte::loops(c, s, all[i]).gap < 1e-13)) return false;
    for (std::size_t k = 0; k < i; ++k) {
      vector d = all[i] - all[k];
      for (auto& x : d) x = std::remainder(x, 2 * pi);
      if (d.cwiseAbs().maxCoeff() < 1e-4) return false;
    }
  }
  return std::is_sorted(all.begin(), all.end(), [](const vector& a, const vector& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                        [](double x, double y) { return std::round(x * 1e5) < std::round(y * 1e5); });
  });
}

/// A platform on three legs, each a hinge, a slide and a hinge (Merlet, Parallel Robots, 2006: six solutions).
struct planar_platform {
  double x2 = 15.91, y3 = 10, b2 = 17.04, b3 = 20.84, angle = 0.8822, l1 = 14.98, l2 = 15.38, l3 = 12;

  runtime_chain chain() const {
    runtime_chain c;
    const auto leg = [&](const std::string& n, const vec2<>& at) {
      c << revolute_joint_2D("a" + n, "base", "h" + n).at(at) << prismatic_joint_2D("l" + n, "h" + n, "e" + n, axis::x)
        << inertia_2D("e" + n, planar_body(1.0, 1.0));
    };
    leg("1", {0, 0}), leg("2", {x2, 0}), leg("3", {0, y3});
    c << revolute_joint_2D("p", "e1", "platform") << inertia_2D("platform", planar_body(1.0, 10.0))
      << rigid_link_2D("platform", "c2", along_x(b2))
      << rigid_link_2D("platform", "c3", vec2<>{b3 * std::cos(angle), b3 * std::sin(angle)})
      << coincident_points_2D("second", "c2", "e2") << coincident_points_2D("third", "c3", "e3");
    return c;
  }
  /// |p|^2 - l1^2 of the point p of the first leg at the platform's angle phi, times the square of the determinant of
  /// the differences of the legs' equations, which are linear in p: a polynomial of degree six in tan(phi / 2) but for
  /// its denominator.
  double residual(double phi) const {
    const double ux = b2 * std::cos(phi) - x2, uy = b2 * std::sin(phi);
    const double wx = b3 * std::cos(phi + angle), wy = b3 * std::sin(phi + angle) - y3;
    const double r = (l2 * l2 - l1 * l1 - ux * ux - uy * uy) / 2, q = (l3 * l3 - l1 * l1 - wx * wx - wy * wy) / 2;
    const double det = ux * wy - uy * wx, x = r * wy - q * uy, y = q * ux - r * wx;
    return x * x + y * y - l1 * l1 * det * det;
  }
};

TEST_CASE("all assemblies of a four-bar, and of two") {
  const auto c = parallelogram(1.0);
  auto s = c.make_state();
  const vector q = four_bar_q(1, 0.4);
  const auto all = assemblies(c, s, 40, q, held("q0"));
  REQUIRE((all.size() == 2 && good(c, all)));
  CHECK(((all[0] - q).cwiseAbs().maxCoeff() < 1e-13 || (all[1] - q).cwiseAbs().maxCoeff() < 1e-13));
  CHECK(all == assemblies(c, s, 40, q, held("q0")));

  // two in a row: the rocker of the first is the crank of the second
  runtime_chain two;
  const auto add = [&two](const std::string& n, double x, double y, double rocker) {
    two << revolute_joint_2D("r" + n, "base", "R" + n).at(vec2<>{x, y}) << inertia_2D("R" + n, bar)
        << rigid_link_2D("R" + n, "tip" + n, along_x(rocker));
  };
  const auto couple = [&two](const std::string& from, const std::string& to, double coupler) {
    two << revolute_joint_2D("c" + to, "tip" + from, "C" + to) << inertia_2D("C" + to, bar)
        << rigid_link_2D("C" + to, "end" + to, along_x(coupler))
        << coincident_points_2D("pin" + to, "end" + to, "tip" + to);
  };
  add("0", 0, 0, 0.4), add("1", 1, 0, 0.8), add("2", 1.9, 0.1, 0.7);
  couple("0", "1", 1.1), couple("1", "2", 0.9);
  auto t = two.make_state();
  const auto four = assemblies(two, t, 60, numbers({1.1, 0, 0, 0, 0}), held("r0"));
  CHECK((four.size() == 4 && good(two, four)));
  // where two assemblies meet they are one
  const auto folded = four_bars(2);
  auto f = folded.make_state();
  CHECK(assemblies(folded, f, 60, four_bar_q(2, 0.4), held("q0")).size() == 3);
}

TEST_CASE("all assemblies of a five-bar with both cranks held") {
  runtime_chain c;
  c << revolute_joint_2D("a", "base", "A").at(vec2<>{0, 0}) << inertia_2D("A", bar)
    << rigid_link_2D("A", "A1", along_x(1.0)) << revolute_joint_2D("b", "base", "B").at(vec2<>{1, 0})
    << inertia_2D("B", bar) << rigid_link_2D("B", "B1", along_x(1.0)) << revolute_joint_2D("k", "A1", "K")
    << inertia_2D("K", bar) << rigid_link_2D("K", "K1", along_x(1.2)) << revolute_joint_2D("l", "B1", "L")
    << inertia_2D("L", bar) << rigid_link_2D("L", "L1", along_x(1.2)) << coincident_points_2D("tip", "K1", "L1");
  auto s = c.make_state();
  const auto all = assemblies(c, s, 40, numbers({2.0, 1.0, 0, 0}), held("a", "b"));
  CHECK((all.size() == 2 && good(c, all)));
  CHECK((all[0][0] == 2.0 && all[0][1] == 1.0));
  CHECK(assemblies(c, s, 40, numbers({2.8, 0.2, 0, 0}), held("a", "b")).empty());  // too far apart
  CHECK_THROWS_AS(assemblies(c, s, 10, numbers({2.8, 0.2, 0, 0}), held("a")), bad_argument);
  CHECK_THROWS_AS(assemblies(c, s, 10), bad_argument);
  runtime_chain tree;
  tree << revolute_joint_2D("a", "base", "A") << inertia_2D("A", bar);
  auto t = tree.make_state();
  CHECK_THROWS_AS(assemblies(tree, t, 10), bad_argument);
}

TEST_CASE("the six assemblies of a planar platform are the roots of its polynomial") {
  const planar_platform p;
  std::vector<double> angles;  // of the platform, by sign changes
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    double low = -pi + 2 * pi * i / n, high = -pi + 2 * pi * (i + 1) / n;
    if ((p.residual(low) > 0) == (p.residual(high) > 0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      ((p.residual(middle) > 0) == (p.residual(low) > 0) ? low : high) = middle;
    }
    angles.push_back(low);
  }
  REQUIRE(angles.size() == 6);
  const auto c = p.chain();
  auto s = c.make_state();
  const auto all = assemblies(c, s, 400, numbers({0, p.l1, 0, p.l2, 0, p.l3, 0}), held("l1", "l2", "l3"));
  CHECK(good(c, all));
  // a slide that is held at a length may point away: legs of length l alone count
  std::vector<double> found;
  for (const auto& q : all) found.push_back(std::remainder(q[0] + q[6], 2 * pi));
  std::sort(found.begin(), found.end());
  REQUIRE(found.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) CHECK(found[i] == within(angles[i], 1e-9));
}

}  // namespace assemblies_test
