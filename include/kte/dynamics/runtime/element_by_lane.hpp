#pragma once

#include <kte/contract/joint_axis.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/runtime_chain/chain.hpp>

#include <array>
#include <cstring>

/// Calls of elements with their own laws on states of packs: lane by lane, in double, each lane with its element.
namespace kte::detail {

/// Copies the numbers of one lane of an item: all members of items are numbers.
template <class S, class Item, class One>
void read_lane(const Item& from, std::size_t lane, One& to) {
  using T = typename S::value_type;
  static_assert(sizeof(Item) / sizeof(S) == sizeof(One) / sizeof(double) && sizeof(Item) % sizeof(S) == 0);
  const auto* source = reinterpret_cast<const char*>(&from) + lane * sizeof(T);
  auto* const target = reinterpret_cast<char*>(&to);
  for (std::size_t k = 0; k < sizeof(One) / sizeof(double); ++k) {
    T x;
    std::memcpy(&x, source + k * sizeof(S), sizeof(T));
    const double y = x;
    std::memcpy(target + k * sizeof(double), &y, sizeof(double));
  }
}
template <class S, class Item, class One>
void write_lane(const One& from, std::size_t lane, Item& to) {
  using T = typename S::value_type;
  const auto* source = reinterpret_cast<const char*>(&from);
  auto* target = reinterpret_cast<char*>(&to) + lane * sizeof(T);
  for (std::size_t k = 0; k < sizeof(One) / sizeof(double); ++k) {
    double y;
    std::memcpy(&y, source + k * sizeof(double), sizeof(double));
    const T x = static_cast<T>(y);
    std::memcpy(target + k * sizeof(S), &x, sizeof(T));
  }
}

/// Calls visit(item in packs, item of a lane) for an item at a port.
template <class S, class Visit>
void with_item(basic_runtime_state<S>& s, runtime_state& one, kind k, int i, const Visit& visit) {
  unroll<kinds>([&]<std::size_t K>() {
    constexpr auto what = static_cast<kind>(K);
    if constexpr (what != kind::loop && what != kind::contact)  // they have their own algorithms
      if (k == what) visit(s.template get<what>(i), one.get<what>(i));
  });
}
/// Calls each(element `number` of the lane, state of the lane, lane); the items at the ports are copied there and back.
template <class S, class Each>
void by_lane(const runtime_chain& c, int number, basic_runtime_state<S>& s, const Each& each) {
  const auto& e = c.wiring().elements[static_cast<std::size_t>(number)];
  auto& one = s.lane.template get<runtime_state>([&c] { return runtime_state(c.shared_wiring()); });
  for (std::size_t lane = 0; lane < std::size_t{S::lanes}; ++lane) {
    for (std::size_t p = 0; p < e.ports.size(); ++p)
      with_item(s, one, e.ports[p].what, e.index[p],
                [lane](const auto& all, auto& own) { read_lane<S>(all, lane, own); });
    each(e.element->lane(lane), one, lane);
    for (std::size_t p = 0; p < e.ports.size(); ++p)
      with_item(s, one, e.ports[p].what, e.index[p],
                [lane](auto& all, const auto& own) { write_lane<S>(own, lane, all); });
  }
}
/// `kte_element::friction` under wrenches in packs.
template <class S>
S friction_by_lane(const runtime_chain& c, int number, basic_runtime_state<S>& s, const wrench<vec3<S>, vec3<S>>& end) {
  S all(0);
  by_lane(c, number, s, [&](const kte_element& x, runtime_state& one, std::size_t lane) {
    wrench<vec3<>, vec3<>> w{};
    read_lane<S>(end, lane, w);
    all.set(lane, static_cast<typename S::value_type>(x.friction(one, w)));
  });
  return all;
}
/// `kte_element::place_joint` at coordinates in packs.
template <class S>
pose<mat3<vec3<S>>, vec3<S>> place_joint_by_lane(const topology::connection& e, const S* q, joint_axis<S>* axes,
                                                 bool second) {
  const std::size_t n = e.ports.size() - 2, count = count_of_axes(static_cast<int>(n), second);
  std::vector<double> at(n);
  std::vector<joint_axis<double>> own(count);
  pose<mat3<vec3<S>>, vec3<S>> all{};
  for (std::size_t lane = 0; lane < std::size_t{S::lanes}; ++lane) {
    for (std::size_t k = 0; k < n; ++k) at[k] = static_cast<double>(q[k][lane]);
    write_lane<S>(e.element->lane(lane).place_joint(at.data(), own.data(), second), lane, all);
    for (std::size_t k = 0; k < count; ++k) write_lane<S>(own[k], lane, axes[k]);
  }
  return all;
}

}  // namespace kte::detail
