#include <kte/engine/looped.hpp>
#include <kte/math/rigid_body.hpp>

#include <vector>

#include "catch.hpp"

// The driver that loops over arrays of bodies, with bodies that are numbers and nothing else.

namespace looped_test {

using namespace kte;
using namespace kte::engine;

/// Body `number`; of a usual kind or not, to which it adds a hundredth.
template <bool Usual>
struct toy_body {
  using scalar = double;
  int number;
  double id() const { return number + (Usual ? 0 : 0.01); }
  int first() const { return number; }
  template <class U>
  U in(const U& u) const {
    return u;
  }
  template <class U>
  U out(const U& u) const {
    return u;
  }
  zero3 position() const { return {}; }
  rigid_body<double, zero3, sym3<zero_t>> inertia() const { return {1.0, {}, {}}; }
};
/// Two bases. Bodies 0, 1, 2 stand on each other, 3 on body 0, and 4 on the second base.
struct toy_bodies {
  std::vector<char> is_usual{1, 0, 1, 1, 0};
  std::vector<int> parents{0, 2, 3, 2, 1};
  int count() const { return 5; }
  int bases() const { return 2; }
  int parent(int i) const { return parents[static_cast<std::size_t>(i)]; }
  bool branches(int i) const { return i == 0; }
  bool usual(int i) const { return is_usual[static_cast<std::size_t>(i)] != 0; }
  toy_body<true> body(int i) const { return {i}; }
  toy_body<true> rigid(int i) const { return {i}; }
  template <class F>
  void with_body(int i, const F& f) const {
    usual(i) ? f(toy_body<true>{i}) : f(toy_body<false>{i});
  }
};
using numbers = vec3<double>;
numbers plus(const numbers& a, double x) { return {a.x + x, a.y + 1.0, x}; }

TEST_CASE("values go outward from parents to children") {
  const toy_bodies bodies;
  std::vector<numbers> kept(7);
  kept[0] = {100.0, 0.0, 0.0}, kept[1] = {200.0, 0.0, 0.0};
  const auto values = looped<toy_bodies>{bodies}.outward<numbers>(
      kept.data(), [](const auto& b, const numbers& parent) { return plus(parent, b.id()); });
  CHECK(kept[2] == numbers{100.0, 1.0, 0.0});
  CHECK(kept[3] == numbers{101.01, 2.0, 1.01});
  CHECK(kept[4] == numbers{103.01, 3.0, 2.0});
  CHECK(kept[5] == numbers{103.0, 2.0, 3.0});  // on body 0
  CHECK(kept[6] == numbers{204.01, 1.0, 4.01});
  CHECK(values.at(2) == kept[4]);

  std::vector<numbers> again(7);
  looped<toy_bodies>{bodies}.descend<numbers>(again.data(), values,
                                              [](const auto&, const numbers& value, const numbers& parent) -> numbers {
                                                return {parent.x + value.z, value.x, parent.z + 1.0};
                                              });
  CHECK(again[4] == numbers{3.01, 103.01, 3.0});
  CHECK(again[5] == numbers{3.0, 103.0, 2.0});
  CHECK(again[6] == numbers{4.01, 204.01, 1.0});
}

TEST_CASE("what bodies carry goes inward, and branches add up") {
  const toy_bodies bodies;
  std::vector<numbers> sums(7), own(5);
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = {double(1 << i), 0.0, 1.0};
  std::vector<double> met(5);
  const auto inward = [&]<bool Keep, bool Bases>(std::bool_constant<Keep>, std::bool_constant<Bases>) {
    looped<toy_bodies>{bodies}.inward<Keep, numbers, Bases>(
        sums.data(), kept_array<numbers>{own.data()}, [](const auto&, const numbers& value) { return value; },
        [&met](const auto& b, const numbers& carried, bool) {
          met[static_cast<std::size_t>(b.number)] = carried.x;
          return carried;
        },
        [](const auto& b, const numbers&, const numbers& carried) -> numbers {
          return {carried.x, carried.y + b.id(), carried.z};
        });
  };
  inward(std::true_type{}, std::false_type{});
  CHECK(met == std::vector<double>{15.0, 6.0, 4.0, 8.0, 16.0});
  CHECK(sums[2] == numbers{15.0, 2.0 + 1.01 + 3.0, 4.0});
  CHECK(sums[4] == numbers{4.0, 0.0, 1.0});
  CHECK(sums[6] == numbers{16.0, 0.0, 1.0});

  sums.assign(7, {});
  sums[0] = {0.5, 0.0, 0.0}, sums[1] = {0.25, 0.0, 0.0};
  inward(std::false_type{}, std::true_type{});
  CHECK(sums[0] == numbers{15.5, 6.01, 4.0});
  CHECK(sums[1] == numbers{16.25, 4.01, 1.0});
}

}  // namespace looped_test
