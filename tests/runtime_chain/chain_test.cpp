#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <ctime>

#include "catch.hpp"

namespace chain_test {

using namespace kte;
using kte::test::contains_text;

runtime_chain pendulum() {
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "joint") << rigid_link_2D("joint", "tip", along_x(0.5))
    << inertia_2D("tip", point_mass(1.0));
  return c;
}
std::string frame(int i) { return "frame" + std::to_string(i); }
auto link(int i) { return rigid_link_2D(frame(i), frame(i + 1), along_x(0.25)); }

/// An element of a user that holds a chain, or nothing that could be copied.
class holder : public kte_map {
 public:
  explicit holder(runtime_chain c, bool copies = true) : inner(std::move(c)), copies_(copies) {}
  void doMotion(runtime_state& s) const override { inner.doMotion(s); }
  void clearForce(runtime_state& s) const override { inner.clearForce(s); }
  void doForce(runtime_state& s) const override { inner.doForce(s); }
  std::unique_ptr<kte_map> clone() const override { return copies_ ? std::make_unique<holder>(inner) : nullptr; }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const override {
    inner.for_each_element(visit);
  }
  void connect(topology& t) override { inner.connect(t); }
  runtime_chain inner;

 private:
  bool copies_;
};

template <class F>
double seconds(const F& f) {
  const std::clock_t start = std::clock();
  f();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST_CASE("a chain that is moved from is empty and usable") {
  auto a = pendulum();
  a.gravity(along_y(-9.81));
  auto b = std::move(a);
  CHECK(b.dofs() == 1);
  CHECK(a.dofs() == 0);
  CHECK(a.nq() == 0);
  CHECK(a.gravity() == vec3<>{});
  CHECK(record_of(a).elements.empty());
  auto s = a.make_state();
  a.doMotion(s), a.clearForce(s), a.doForce(s);
  CHECK(mass_matrix(a, s).size() == 0);
  CHECK(forward_dynamics(a, s).size() == 0);
  CHECK_THROWS_AS(forward_kinematics(a, s, "tip"), unknown_name);
  CHECK(layout(a).empty());
  const runtime_chain copy = a;
  CHECK(copy.dofs() == 0);
  a << link(0);
  CHECK(record_of(a).elements.size() == 1);
  a = std::move(b);
  CHECK(a.dofs() == 1);
  CHECK(a.gravity() == vec3{0.0, -9.81, 0.0});
  CHECK(b.dofs() == 0);
  b << link(0);
  CHECK(b.make_state().frame_2D(frame(1)).position.x == 0);
}

TEST_CASE("a state that is moved from is one of a chain without elements") {
  const auto c = pendulum();
  auto s = c.make_state();
  s.coordinate("q").q = 0.5;
  auto t = std::move(s);
  CHECK(t.coordinate("q").q == 0.5);
  const auto is_empty = [&c](runtime_state& x) {
    CHECK(x.dofs() == 0);
    CHECK(positions(x).size() == 0);
    CHECK_THROWS_AS(x.coordinate("q"), unknown_name);
    CHECK_THROWS_AS(x.coordinate(0), bad_argument);
    CHECK_THROWS_AS(c.doMotion(x), bad_argument);
    CHECK_THROWS_AS(mass_matrix(c, x), bad_argument);
    const runtime_chain none;
    none.doMotion(x);
    CHECK(mass_matrix(none, x).size() == 0);
  };
  is_empty(s);
  auto u = c.make_state();
  (void)mass_matrix(c, u);
  t = std::move(u);
  is_empty(u);
  CHECK(t.coordinate("q").q == 0);
  s = t;
  CHECK(mass_matrix(c, s)(0, 0) == 0.25);
}

TEST_CASE("coordinates are numbered from 0 to their number") {
  const auto c = pendulum();
  auto s = c.make_state();
  CHECK(&s.coordinate(0) == &s.coordinate("q"));
  CHECK_THROWS_WITH(s.coordinate(7), "kte: there is no generalized coordinate 7 in a state that has 1");
  CHECK_THROWS_AS(std::as_const(s).coordinate(1), bad_argument);
  CHECK_THROWS_AS(s.coordinate(-1), bad_argument);
}

TEST_CASE("what cannot be appended is refused, and changes nothing") {
  auto c = pendulum();
  const auto before = record_of(c);
  auto s = c.make_state();
  CHECK_THROWS_WITH(c.append(nullptr), contains_text("kte:") && contains_text("null pointer"));
  CHECK_THROWS_AS(c << c, bad_wiring);  // every name would be written twice
  CHECK_THROWS_AS(c.append(std::make_unique<holder>(pendulum())), bad_wiring);
  runtime_chain half;
  half << rigid_link_2D("tip", "tool", along_x(0.1)) << rigid_link_2D("tool", "joint", along_x(0.1));
  CHECK_THROWS_AS(c << half, bad_wiring);
  CHECK_THROWS_AS(c.append(half.clone()), bad_wiring);
  CHECK(record_of(c) == before);
  CHECK_NOTHROW(c.doMotion(s));  // still its state
  CHECK(mass_matrix(c, s)(0, 0) == 0.25);
  c << rigid_link_2D("tip", "tool", along_x(0.1));
  CHECK(record_of(c).elements.size() == 4);

  c.append(std::make_unique<runtime_chain>(std::move(c)));  // gives itself back
  CHECK(record_of(c).elements.size() == 4);
  CHECK(mass_matrix(c, s = c.make_state())(0, 0) == 0.25);

  runtime_chain no_copies;
  no_copies.append(std::make_unique<holder>(pendulum(), false));
  CHECK_THROWS_WITH(runtime_chain(no_copies), contains_text("clone()"));
  CHECK_THROWS_AS(c << no_copies, bad_argument);
}

TEST_CASE("a chain that has become part of another has no states") {
  const auto throws = [](const runtime_chain& part, runtime_state& s) {
    CHECK_THROWS_WITH(part.make_state(), contains_text("part of another"));
    CHECK_THROWS_AS(part.dofs(), bad_argument);
    CHECK_THROWS_AS(part.wiring(), bad_argument);
    CHECK_THROWS_AS(mass_matrix(part, s), bad_argument);
  };
  auto given = std::make_unique<runtime_chain>(pendulum());
  runtime_chain& inner = *given;
  runtime_chain outer;
  outer << inertia_2D("base", point_mass(2.0));
  outer.append(std::move(given));
  auto s = outer.make_state();
  CHECK(mass_matrix(outer, s)(0, 0) == 0.25);
  throws(inner, s);
  CHECK_THROWS_AS(inner.doMotion(s), bad_argument);
  CHECK_THROWS_AS(inner << link(0), bad_argument);

  auto held = std::make_unique<holder>(pendulum());
  runtime_chain& deep = held->inner;
  runtime_chain user;
  user.append(std::move(held));
  const runtime_chain copy = user;
  auto t = copy.make_state();
  CHECK(mass_matrix(user, t)(0, 0) == 0.25);
  user.doMotion(t);
  CHECK(t.frame_2D("tip").position.x == 0.5);
  throws(deep, t);
}

TEST_CASE("1e5 elements take linear time and no stack") {
  runtime_chain c;
  const auto fill = [&c](int n, bool as_chains) {
    c = {};
    c << revolute_joint_2D("q", "base", frame(0));
    for (int i = 0; i < n; ++i) as_chains ? c << (runtime_chain() << link(i)) : c << link(i);
  };
  // Ten times the elements in less than forty times the time: a hundred times would be quadratic.
  for (const bool as_chains : {true, false}) {
    const int n = as_chains ? 20000 : 100000;
    const double little = seconds([&] { fill(n / 10, as_chains); }), much = seconds([&] { fill(n, as_chains); });
    CAPTURE(as_chains, little, much);
    CHECK(much < 40 * little);
  }
  const auto copy = c;
  auto s = copy.make_state();
  CHECK(forward_kinematics(copy, s, std::vector{0.0}, frame(100000)).position.x == 25000);
  CHECK(mass_matrix(c, s)(0, 0) == 0);
  const auto moved = std::move(c);
  CHECK(moved.dofs() == 1);
  CHECK(c.dofs() == 0);
}

TEST_CASE("chains nest 30000 deep, in linear time and memory") {  // the square would be gigabytes
  auto inner = std::make_unique<runtime_chain>();
  runtime_chain copied;
  for (int i = 0; i < 30000; ++i) {
    auto outer = std::make_unique<runtime_chain>();
    outer->append(std::move(inner));
    *outer << link(i);
    inner = std::move(outer);
    if (i >= 200) continue;
    runtime_chain next;
    next << copied << link(i);
    copied = std::move(next);
  }
  auto s = inner->make_state();
  CHECK(forward_kinematics(*inner, s, frame(30000)).position.x == 7500);
  CHECK(copied.wiring().names == (runtime_chain() << copied).wiring().names);
  CHECK(copied.wiring().elements.size() == 200);
}

}  // namespace chain_test
