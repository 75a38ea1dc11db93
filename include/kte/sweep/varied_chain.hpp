#pragma once

#include <kte/contract/parameter_paths.hpp>
#include <kte/elements/registry.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kte {

namespace detail {
/// How paths call the numbers of a parameter of `count` numbers; empty if they do not reach them.
inline std::span<const std::string_view> components_in_paths(std::size_t count) {
  static constexpr std::array<std::string_view, 1> of_number{""};
  static constexpr std::array<std::string_view, 3> of_vector{"x", "y", "z"};
  static constexpr std::array<std::string_view, 6> of_inertia{"xx", "xy", "xz", "yy", "yz", "zz"};
  if (count == 1) return of_number;
  if (count == 3) return of_vector;
  if (count == 6) return of_inertia;
  return {};
}
}  // namespace detail

/// A runtime chain some of whose parameters vary, by their paths (docs/sweeps.md):
///
///   const kte::varied_chain arms(arm, {"tool/mass", "gravity/z"});
///   const kte::runtime_chain on_the_moon = arms.with(std::array{2.0, -1.62});
class varied_chain {
 public:
  /// Throws `unknown_name` for a path that the chain does not have, `bad_argument` for one that several elements have.
  varied_chain(const runtime_chain& c, const std::vector<std::string>& paths,
               element_registry registry = element_registry::standard())
      : registry_(std::move(registry)), gravity_{c.gravity().x, c.gravity().y, c.gravity().z} {
    c.for_each_element([this](const kte_element& e) { elements_.push_back({e.clone()}); });
    for (const auto& path : paths) places_.push_back(place_of(c, path));
  }

  /// The number of paths.
  [[nodiscard]] std::size_t size() const { return places_.size(); }
  /// The chain with these values, one for each path. Throws `bad_parameter` for values that an element rejects, and
  /// `bad_argument` for another number of values.
  [[nodiscard]] runtime_chain with(std::span<const double> values) const {
    if (values.size() != places_.size())
      detail::raise<bad_argument>("kte: " + std::to_string(values.size()) + " values for " +
                                  std::to_string(places_.size()) + " parameters");
    auto gravity = gravity_;
    auto records = records_;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto& p = places_[i];
      (p.of_gravity ? gravity[p.component] : records[p.record].parameters[p.parameter].values[p.component]) = values[i];
    }
    runtime_chain out;
    for (const auto& e : elements_) out.append(e.record ? registry_.make(records[*e.record]) : e.as_it_is->clone());
    return std::move(out.gravity(vec3<>{gravity[0], gravity[1], gravity[2]}));
  }

 private:
  struct part {
    std::shared_ptr<const kte_map> as_it_is;
    std::optional<std::size_t> record{};  ///< if a parameter varies
  };
  /// A number of gravity or of a record.
  struct place {
    bool of_gravity = false;
    std::size_t record = 0, parameter = 0, component = 0;
  };

  /// The index of a component in a parameter of `count` numbers; `count` if there is none.
  static std::size_t component_of(std::string_view component, std::size_t count) {
    const auto all = detail::components_in_paths(count);
    const auto at = std::find(all.begin(), all.end(), component);
    return at == all.end() ? count : static_cast<std::size_t>(at - all.begin());
  }
  place place_of(const runtime_chain& c, const std::string& path) {
    place found;
    found.component = component_of(detail::after_name(path, "gravity"), 3);
    found.of_gravity = found.component < 3;
    if (found.of_gravity) return found;
    for (const bool all : {false, true}) {
      std::size_t hits = 0, element = 0, index = 0;
      element_record record;
      c.for_each_element([&](const kte_element& e) {
        if (auto own = at_path(e, path, all, found)) ++hits, element = index, record = std::move(*own);
        ++index;
      });
      if (hits > 1)
        detail::raise<bad_argument>("kte: the path '" + path + "' names parameters of " + std::to_string(hits) +
                                    " elements");
      if (hits == 0) continue;
      auto& e = elements_[element];
      if (!e.record) e.record = records_.size(), records_.push_back(std::move(record));
      found.record = *e.record;
      return found;
    }
    detail::raise<unknown_name>("kte: the chain has no parameter '" + path +
                                "'; paths are NAME/PARAMETER or NAME/PARAMETER/COMPONENT, as tool/mass or tool/com/x");
  }

  /// The record of an element if the path names a number of it, whose place it then writes; `all`: by any connection.
  static std::optional<element_record> at_path(const kte_element& e, const std::string& path, bool all, place& found) {
    const auto names = e.names();
    for (std::size_t n = all ? 0 : names.size() - 1; n < names.size(); ++n) {
      const auto rest = detail::after_name(path, names[n]);
      if (rest.empty()) continue;
      auto record = e.record();
      for (std::size_t i = 0; i < record.parameters.size(); ++i) {
        const auto& p = record.parameters[i];
        const auto component = detail::after_name(rest, p.name);
        if (rest != p.name && component.empty()) continue;
        const auto k = component_of(component, p.values.size());
        if (k >= p.values.size()) continue;
        found.parameter = i, found.component = k;
        return record;
      }
    }
    return {};
  }

  element_registry registry_;
  std::array<double, 3> gravity_;
  std::vector<part> elements_;
  std::vector<element_record> records_;  ///< of the elements that vary
  std::vector<place> places_;
};

/// The numbers of a chain that a path of `varied_chain` names, in the order of elements: gravity/x, gravity/y,
/// gravity/z, and NAME/PARAMETER, by components as there. NAME is that of the last connection of an element, or of the
/// first other one by which the path is unique.
inline std::vector<std::pair<std::string, double>> parameters_by_path(const runtime_chain& c) {
  const auto ends_of = [](const parameter_record& p) { return detail::components_in_paths(p.values.size()); };
  const auto path_of = [](const std::string& name, const parameter_record& p, std::string_view end) {
    return name + "/" + p.name + (end.empty() ? "" : "/") + std::string(end);
  };
  std::map<std::string, int, std::less<>> of_last, of_all;  // how many elements have a path
  c.for_each_element([&](const kte_element& e) {
    const auto names = e.names();
    std::set<std::string, std::less<>> own;
    for (const auto& p : e.record().parameters)
      for (const auto& end : ends_of(p)) {
        ++of_last[path_of(names.back(), p, end)];
        for (const auto& name : names) own.insert(path_of(name, p, end));
      }
    for (const auto& path : own) ++of_all[path];
  });
  std::vector<std::pair<std::string, double>> all;
  const auto g = c.gravity();
  all = {{"gravity/x", g.x}, {"gravity/y", g.y}, {"gravity/z", g.z}};
  c.for_each_element([&](const kte_element& e) {
    const auto names = e.names();
    for (const auto& p : e.record().parameters) {
      const auto ends = ends_of(p);
      for (std::size_t k = 0; k < ends.size(); ++k) {
        const auto last = path_of(names.back(), p, ends[k]);
        if (of_last[last] == 1) {
          all.emplace_back(last, p.values[k]);
          continue;
        }
        for (const auto& name : names)
          if (const auto path = path_of(name, p, ends[k]); !of_last.contains(path) && of_all[path] == 1) {
            all.emplace_back(path, p.values[k]);
            break;
          }
      }
    }
  });
  return all;
}

}  // namespace kte
