#include <kte/contract/force_derivatives.hpp>
#include <kte/elements/damper.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/spring.hpp>

#include <array>
#include <vector>

#include "catch.hpp"

// Derivatives of forces on coordinates, by a state of three coordinates; the last is not a degree of freedom.

namespace force_derivatives_test {

using namespace kte;
using namespace kte::detail;

struct two_by_two {
  std::array<std::array<double, 2>, 2> rows{};
  double& operator()(int i, int j) { return rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]; }
  bool operator==(const two_by_two&) const = default;
};
two_by_two of(double a, double b, double c, double d) { return {{{{a, b}, {c, d}}}}; }

struct three_coordinates {
  using scalar = double;
  struct results {
    two_by_two by_q, by_v, by_a;
  };
  struct tree_of {
    struct {
      std::vector<int> row_of_gen{0, 1, 2};
    } plan;
  };
  std::array<coordinate<double, double, double, skip, skip>, 3> q{
      {{1, 2, 3, {}, {}}, {4, 6, 8, {}, {}}, {9, 9, 9, {}, {}}}};
  struct {
    results of_forces;
  } work;
  tree_of tree_;

  template <kind>
  const auto& get(int i) const {
    return q[static_cast<std::size_t>(i)];
  }
  const tree_of& tree() const { return tree_; }
  static int dofs() { return 2; }
};

template <class Core>
three_coordinates::results derived(const Core& core, std::initializer_list<int> on) {
  three_coordinates s;
  subtract_force_derivatives(core, s, on.begin());
  return s.work.of_forces;
}

TEST_CASE("derivatives of forces between two coordinates") {
  // f = k (q1 - q0 - l), on q0, and the opposite on q1; what must be applied is the opposite of both.
  const auto spring = derived(spring_gen("a", "b", 0.5, 3.0).core, {0, 1});
  CHECK(spring.by_q == of(3, -3, -3, 3));
  CHECK(spring.by_v == two_by_two{});
  CHECK(spring.by_a == two_by_two{});
  const auto damper = derived(damper_gen("a", "b", 5.0).core, {0, 1});
  CHECK(damper.by_v == of(5, -5, -5, 5));
  CHECK(damper.by_q == two_by_two{});
}

TEST_CASE("derivatives of forces on one coordinate") {
  CHECK(derived(inertia_gen("a", 7.0).core, {1}).by_a == of(0, 0, 0, 7));
  CHECK(derived(spring_gen("a", "b", 0.5, 3.0).core, {1, 1}).by_q == two_by_two{});
  // Given ones have no row and no column.
  CHECK(derived(spring_gen("a", "b", 0.5, 3.0).core, {0, 2}).by_q == of(3, 0, 0, 0));
  CHECK(derived(inertia_gen("a", 7.0).core, {2}).by_a == two_by_two{});
}

}  // namespace force_derivatives_test
