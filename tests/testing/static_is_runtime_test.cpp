#include <kte/elements/position_measure.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/spring.hpp>
#include <kte/testing/static_is_runtime.hpp>

#include "catch.hpp"
#include "random.hpp"

namespace static_is_runtime_test {

using namespace kte;

/// A damper that is another every other time that one of its kind is asked.
struct fickle_damper {
  static constexpr std::string_view type = "fickle_damper_gen";
  static constexpr std::array<port, 1> ports{{{kind::gen, access::on, "coordinate"}}};
  static inline int calls = 0;
  template <class C>
  constexpr auto doForce(const C& c) const {
    return make_loads(-(++calls % 2 + 1.0) * c.q_dot);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

TEST_CASE("elements do in static chains what they do in runtime chains") {
  random_numbers draw(1);
  // Some hundred products along two bodies, and as much again in forward dynamics by masses of one size.
  CHECK(testing::static_is_runtime(spring_3D("a", "b", 0.3, 50.0), draw) < 1e-13);
  CHECK(testing::static_is_runtime(revolute_joint_3D("q", "a", "b", vec3{0.6, 0.0, 0.8}), draw) < 1e-13);
  CHECK(testing::static_is_runtime(position_measure_2D("a", "y"), draw) < 1e-13);
}

TEST_CASE("an element that is another every other time") {
  random_numbers draw(2);
  CHECK(testing::static_is_runtime(connect(fickle_damper{}, "q"), draw) > 0.1);
}

}  // namespace static_is_runtime_test
