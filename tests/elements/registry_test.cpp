#include <kte/elements/base.hpp>
#include <kte/elements/registry.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"

// Cores that a program adds are read by their ports and parameters.

namespace registry_test {

using namespace kte;
using test::contains_text;

/// A joint that slides along x, m, with a stop that is a parameter.
template <kind Dim, class Axis>
struct slide : transmission<slide<Dim, Axis>> {
  static constexpr type_name type{"slide", Dim};
  static constexpr std::array<port, 3> ports{
      {{kind::gen, access::in, "slider"}, {Dim, access::in, "rail"}, {Dim, access::out, "carriage"}}};
  Axis axis{};
  template <class C>
  constexpr auto relative(const C& c) const {
    return motion{axis * c.q, no_rotation{}, axis * c.q_dot, zero3{}, axis * c.q_ddot, zero3{}};
  }
  constexpr void check(const parameter_check& where) const { where.unit(axis, "axis must have length 1"); }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("axis", self.axis);
  }
};
using slides_x = slide<kind::frame_3D, vec3<one_t, zero_t, zero_t>>;
using slides_any = slide<kind::frame_3D, vec3<>>;
using in_plane = slide<kind::frame_2D, vec3<double, double, zero_t>>;

element_record record(std::vector<double> axis) {
  return {"slide_3D", 1, {{"slider", "x"}, {"rail", "bed"}, {"carriage", "tool"}}, {{"axis", std::move(axis)}}};
}
template <class Core>
bool is(const std::unique_ptr<kte_map>& e) {
  return dynamic_cast<const kte_map_adapter<Core>*>(e.get());
}

TEST_CASE("a core is read by its roles and parameters, and a joint with its placement") {
  auto r = models::registry();
  r.add<slides_x, slides_any, in_plane>();
  CHECK(is<slides_x>(r.make(record({1, 0, 0}))));
  CHECK(is<slides_any>(r.make(record({0.6, 0.8, 0}))));
  auto placed = record({1, 0, 0});
  placed.parameters.push_back({"position", {0, 2, 0}});
  CHECK(is<core::placed_3D<slides_x>>(r.make(placed)));
  placed.parameters[0].values = {0, 1, 0};
  const auto e = r.make(placed);
  CHECK(is<core::placed_3D<slides_any>>(e));

  runtime_chain c;
  c.append(e->clone());
  auto s = make_state(c);
  s.coordinate("x").q = 3;
  c.doMotion(s);
  CHECK(s.frame_3D("tool").position == vec3<>{0, 5, 0});
  CHECK(as<double>(matrix(s.frame_3D("tool").rotation)) == as<double>(matrix(no_rotation{})));
}

TEST_CASE("a record that fits no core says what does not fit the last") {
  auto r = models::registry();
  r.add<slides_x, slides_any, in_plane>();
  CHECK_THROWS_WITH(r.make(record({1, 0})), "kte: slide_3D has 2 numbers as 'axis', not 3");
  CHECK_THROWS_MATCHES(r.make(record({2, 0, 0})), bad_parameter, test::says("axis must have length 1"));
  auto bad = record({1, 0, 0});
  bad.type = "slide_2D", bad.parameters[0].values = {0, 0, 1};
  CHECK_THROWS_WITH(r.make(bad), "kte: slide_2D has a 'axis' out of the plane");
  bad = record({1, 0, 0}), bad.parameters.push_back({"colour", {1}});
  CHECK_THROWS_WITH(r.make(bad), "kte: slide_3D has no parameter 'colour'");
  bad = record({1, 0, 0}), bad.connections.pop_back();
  CHECK_THROWS_WITH(r.make(bad), "kte: slide_3D has no connection 'carriage'");
}

TEST_CASE("a revolute joint in the plane has the axis z in files") {
  const element_record r{
      "revolute_joint_2D", 1, {{"coordinate", "q"}, {"base", "a"}, {"end", "b"}}, {{"axis", {0, 0.6, 0.8}}}};
  CHECK_THROWS_WITH(models::registry().make(r), "kte: revolute_joint_2D has a 'axis' other than (0, 0, 1)");
}

TEST_CASE("a type is added once") {
  auto r = models::registry();
  r.add<slides_x>();
  CHECK_THROWS_WITH(r.add<slides_any>(), "kte: the registry has a 'slide_3D' already");
  CHECK_THROWS_AS(r.add<core::base<kind::gen>>(), bad_argument);
}

}  // namespace registry_test
