#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/kte.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>

#include "catch.hpp"

// One element of a runtime chain, as chains and algorithms see it.

namespace kte_map_adapter_test {

using namespace kte;

/// An element, connected to its own chain.
template <class Core>
struct alone {
  explicit alone(const named_element<Core>& e, std::initializer_list<const char*> coordinates = {}) : element(e) {
    for (const char* name : coordinates) wheels.emplace_back(inertia_gen(name, 0.0));
    topology t;
    for (auto& w : wheels) w.connect(t);
    element.connect(t);
    for (const auto& c : t.elements) last = c;
    derivatives = t.has_derivatives;
    wiring.edit() = t;
  }
  kte_map_adapter<Core> element;
  std::vector<kte_map_adapter<core::inertia_gen<double>>> wheels;
  shared_topology wiring;
  topology::connection last;
  bool derivatives = false;
};
constexpr rigid_body body{1.5, vec3{0.1, -0.2, 0.25}, sym3{0.2, 0.01, -0.02, 0.25, 0.03, 0.3}};

/// Forces -2 a on its first coordinate, -5 b on its second, with a and b both ways.
struct pair_of_springs {
  static constexpr std::string_view type = "pair_of_springs_gen";
  static constexpr std::array<port, 2> ports{{{kind::gen, access::on, "a"}, {kind::gen, access::on, "b"}}};
  template <class A, class B>
  constexpr auto doForce(const A& a, const B& b) const {
    return make_loads(-2.0 * a.q + 0.5 * b.q_dot, -5.0 * b.q * a.q);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

TEST_CASE("an element says what it is, to whom it is connected and with which numbers") {
  const alone link(rigid_link_3D("a", "b", along_y(0.5)));
  CHECK(link.last.element == &link.element);
  CHECK(link.last.index == std::vector{0, 1});
  CHECK(link.last.rigid);
  CHECK(link.derivatives);
  CHECK(link.element.ports().size() == 2);
  CHECK(link.element.ports()[1].role == "end");
  CHECK(link.element.unrecorded() == nullptr);
  CHECK(link.element.gravity() == vec3<>{});
  const auto record = link.element.record();
  CHECK(record.type == "rigid_link_3D");
  CHECK(record.connections == std::vector<connection_record>{{"base", "a"}, {"end", "b"}});
  CHECK(record.parameters.front() == parameter_record{"position", {0, 0.5, 0}});
  std::vector<const kte_element*> visited;
  link.element.for_each_element([&](const kte_element& e) { visited.push_back(&e); });
  CHECK(visited == std::vector<const kte_element*>{&link.element});

  const alone spring(spring_gen("p", "q", 0.5, 3.0), {"q", "p"});
  CHECK(spring.last.index == std::vector{1, 0});
  CHECK(!spring.last.rigid);
  const alone between_frames(spring_3D("p", "p", 0.5, 3.0));
  CHECK(between_frames.derivatives);  // which is asked of what stands on coordinates alone
}

TEST_CASE("a copy of an element is another one with the same numbers") {
  const alone link(rigid_link_3D("a", "b", along_y(0.5)));
  const auto copy = link.element.clone();
  const kte_element* found = nullptr;
  copy->for_each_element([&](const kte_element& e) { found = &e; });
  REQUIRE(found != nullptr);
  CHECK(found != &link.element);
  CHECK(found->record() == link.element.record());
  topology t;
  copy->connect(t);
  CHECK(t.elements.at(0).element == found);
}

TEST_CASE("the loops over body nodes are told what each element is") {
  using detail::part;
  CHECK(alone(base_3D("a")).element.numbers().is == part::base);
  CHECK(alone(rigid_link_3D("a", "b", along_y(0.5))).element.numbers().is == part::rigid);
  CHECK(alone(revolute_joint_3D("q", "a", "b", axis::x)).element.numbers().is == part::rigid);
  CHECK(alone(rigid_link_gen("p", "q", 0.5)).element.numbers().is == part::follower);
  CHECK(alone(spring_3D("a", "a", 0.5, 3.0)).element.numbers().is == part::force);
  const auto of_body = alone(inertia_3D("a", body)).element.numbers();
  CHECK(of_body.is == part::body);
  CHECK(of_body.body.mass == 1.5);
  CHECK(of_body.body.com == body.com);
  const auto of_wheel = alone(inertia_gen("q", 0.25)).element.numbers();
  CHECK(of_wheel.is == part::body);
  CHECK(of_wheel.mass == 0.25);
  const auto of_link = alone(rigid_link_3D("a", "b", along_y(0.5))).element.numbers();
  CHECK(of_link.rigid.at_zero.position == vec3{0.0, 0.5, 0.0});
}

TEST_CASE("passes and energies are those of the core") {
  const alone spring(spring_gen("p", "q", 0.5, 3.0, 2.0), {"p", "q"});
  runtime_state s(spring.wiring);
  s.coordinate("p").q = 0.25, s.coordinate("q").q = 1.0;  // 0.25 longer than at rest
  s.coordinate("p").f = 1.0;
  spring.element.doMotion(s);
  CHECK(s.coordinate("p").f == 1.0);
  spring.element.doForce(s);
  CHECK(s.coordinate("p").f == 1.75);
  CHECK(s.coordinate("q").f == -0.75);
  CHECK(spring.element.potential_energy(s) == 0.09375);
  CHECK(spring.element.kinetic_energy(s) == 0);
  CHECK(spring.element.switches());
  CHECK(spring.element.switching(s) == 1.25);  // below its limit
  spring.element.clearForce(s);
  CHECK(s.coordinate("p").f == 0);
  CHECK(s.coordinate("q").f == 0);

  const alone wheel(inertia_gen("q", 0.5));
  runtime_state w(wheel.wiring);
  w.coordinate("q").q_dot = 3.0;
  CHECK(wheel.element.kinetic_energy(w) == 2.25);
  CHECK(wheel.element.potential_energy(w) == 0);
  CHECK(!wheel.element.switches());
  CHECK(wheel.element.switching(w) == 1);
}

TEST_CASE("derivatives of the forces on coordinates are subtracted, by whatever port") {
  // q is the second degree of freedom, p the first; forces of the element: -2 q + 0.5 p_dot on q, -5 p q on p.
  const alone springs(connect(pair_of_springs{}, "q", "p"), {"p", "q"});
  runtime_state s(springs.wiring);
  s.coordinate("p").q = 0.25, s.coordinate("q").q = 2.0;
  auto& d = s.work.of_forces;
  d.by_q = d.by_v = d.by_a = Eigen::Matrix2d::Constant(100);
  springs.element.derive_forces(s);
  CHECK(d.by_q == Eigen::Matrix2d{{100 + 10.0, 100 + 1.25}, {100, 100 + 2.0}});
  CHECK(d.by_v == Eigen::Matrix2d{{100, 100}, {100 - 0.5, 100}});
  CHECK(d.by_a == Eigen::Matrix2d::Constant(100));
}

TEST_CASE("an element with both ports on one coordinate is derived by it once") {
  runtime_chain c;
  c << inertia_gen("q", 1.0) << connect(pair_of_springs{}, "q", "q");
  auto s = c.make_state();
  const std::array q{2.0}, v{3.0}, a{0.0};
  CHECK(inverse_dynamics(c, s, q, v, a)[0] == 2 * 2 - 0.5 * 3 + 5 * 2 * 2);
  const auto& d = inverse_dynamics_derivatives(c, s, q, v, a);
  CHECK(d.by_q(0, 0) == 2 + 2 * 5 * 2);
  CHECK(d.by_v(0, 0) == -0.5);
}

TEST_CASE("loads on frames are not derived by single elements") {
  const alone body_alone(inertia_3D("a", body));
  runtime_state s(body_alone.wiring);
  body_alone.element.derive_forces(s);
  CHECK(s.work.of_forces.by_q.size() == 0);
}

}  // namespace kte_map_adapter_test
