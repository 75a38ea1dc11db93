#pragma once

#include <kte/contract/parameter_paths.hpp>
#include <kte/dynamics/closed_loops/loops_in_lanes.hpp>
#include <kte/math/pack.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/runtime_chain/element_in_lanes.hpp>

#include <span>

namespace kte {

namespace detail {
/// A parameter with its value in each lane.
struct parameter_in_lanes {
  std::string path;
  std::vector<double> values;
};
/// The chain with these parameters replaced; all have as many values.
runtime_chain chain_in_lanes(const runtime_chain& c, std::span<const parameter_in_lanes> parameters);

template <class S>
parameter_in_lanes in_lanes(const parameter<S>& p) {
  parameter_in_lanes x{std::string(p.path), {}};
  if constexpr (is_pack<S>) {
    for (std::size_t i = 0; i < std::size_t{S::lanes}; ++i) x.values.push_back(static_cast<double>(p.value[i]));
  } else {
    x.values.push_back(static_cast<double>(p.value));
  }
  return x;
}
}  // namespace detail

/// A runtime chain with other parameters in each lane of packs, all of one structure:
///
///   using P = kte::pack<double, 8>;
///   const auto arms = kte::lanes(arm, kte::parameter{"tool/mass", P::load(masses)});
///   auto s = kte::make_state<P>(arms);
///   kte::forward_dynamics(arms, s, q, v, tau);     // of eight arms, in packs
///
/// Its states are those of packs with as many lanes; algorithms are called as for states of equal lanes. A lane has the
/// result of a chain with its parameters. Numbers instead of packs replace parameters of the chain. Throws
/// `unknown_name` for a path that the chain does not have, `bad_argument` for one that several elements have or that is
/// a typed constant, and `bad_parameter`, with the lane, for values that an element rejects.
template <class S>
[[nodiscard]] runtime_chain lanes(const runtime_chain& c, std::span<const parameter<S>> parameters) {
  static_assert(std::is_arithmetic_v<S> || detail::is_pack<S>,
                "kte: parameters of runtime chains are numbers or packs");
  if constexpr (detail::is_pack<S>) detail::enable_loops_in_lanes<S>();
  std::vector<detail::parameter_in_lanes> all;
  for (const auto& p : parameters) all.push_back(detail::in_lanes(p));
  return detail::chain_in_lanes(c, all);
}
template <class S, class... More>
[[nodiscard]] runtime_chain lanes(const runtime_chain& c, const parameter<S>& first, const parameter<More>&... more) {
  static_assert((std::is_same_v<S, More> && ...), "kte: the values of the parameters have one type");
  const std::array<parameter<S>, 1 + sizeof...(More)> all{first, more...};
  return lanes(c, std::span<const parameter<S>>(all));
}

#ifdef KTE_FUNCTION
namespace detail {
/// Sets the numbers of a path; returns whether the element has it. `all`: as for `at_path`.
inline bool set_parameter(kte_element& e, std::string_view path, bool all, double value) {
  bool found = false;
  const auto names = e.names();
  for (std::size_t p = all ? 0 : names.size() - 1; p < names.size(); ++p) {
    const std::string_view rest = after_name(path, names[p]);
    if (rest.empty()) continue;
    e.visit_parameters([&](std::string_view name, std::string_view component, double* number) {
      if (component.empty() ? rest != name : after_name(rest, name) != component) return;
      if (number == nullptr) raise_fixed(path);
      *number = value, found = true;
    });
  }
  return found;
}
/// An element of a chain in as many lanes as needed.
struct lanes_of_element {
  std::vector<std::unique_ptr<kte_element>> all;
  bool changed = false;

  void widen(std::size_t n) {
    while (all.size() < n) all.push_back(element_in_lanes::copy_of(*all.front()));
  }
};
KTE_FUNCTION runtime_chain chain_in_lanes(const runtime_chain& c, std::span<const parameter_in_lanes> parameters) {
  if (const kte_map* part = c.unrecorded())
    throw bad_argument("kte: lanes: the chain holds a '" + type_text(*part) +
                       "', which is neither an element (a kte_element) nor a chain");
  const std::size_t before = c.lanes(), count = parameters.empty() ? before : parameters.front().values.size();
  if (before > 1 && before != count)
    throw bad_argument("kte: lanes: the chain has " + std::to_string(before) + " lanes, the parameter '" +
                       parameters.front().path + "' has " + std::to_string(count));
  std::vector<lanes_of_element> elements;
  c.for_each_element([&](const kte_element& e) {
    auto& x = elements.emplace_back();
    for (std::size_t i = 0; i < e.lanes(); ++i) x.all.push_back(element_in_lanes::copy_of(e.lane(i)));
  });
  std::vector<vec3<>> gravity = c.gravity_of_lanes();
  if (gravity.empty()) gravity.assign(count, c.gravity());
  bool gravity_changed = false;
  for (const auto& p : parameters) {
    const std::string_view of_gravity = after_name(p.path, "gravity");
    if (of_gravity == "x" || of_gravity == "y" || of_gravity == "z") {
      gravity_changed = true;
      for (std::size_t i = 0; i < count; ++i)
        (of_gravity == "x" ? gravity[i].x : of_gravity == "y" ? gravity[i].y : gravity[i].z) = p.values[i];
      continue;
    }
    int hits = 0;
    for (const bool all : {false, true}) {
      for (auto& x : elements) {
        if (!set_parameter(*x.all.front(), p.path, all, p.values.front())) continue;
        ++hits, x.changed = true;
        x.widen(count);
        for (std::size_t i = 1; i < count; ++i) set_parameter(*x.all[i], p.path, all, p.values[i]);
      }
      if (hits > 0) break;
    }
    if (hits > 1) raise_ambiguous_parameter(p.path, hits);
    if (hits == 0) raise_no_parameter(p.path);
  }
  runtime_chain result;
  for (auto& x : elements) {
    for (std::size_t i = 0; x.changed && i < x.all.size(); ++i) {
      try {
        x.all[i]->check_parameters();
      } catch (const bad_parameter& why) {
        throw bad_parameter(in_lane(i, x.all.size(), why.what()));
      }
    }
    if (x.all.size() == 1)
      result.append(std::move(x.all.front()));
    else
      result.append(std::make_unique<element_in_lanes>(std::move(x.all)));
  }
  if (count > 1 && (gravity_changed || !c.gravity_of_lanes().empty()))
    result.gravity_of_lanes(std::move(gravity));
  else
    result.gravity(gravity.front());
  return result;
}
}  // namespace detail
#endif

}  // namespace kte
