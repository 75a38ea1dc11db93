#pragma once

#include <kte/robots/detail/xml_item.hpp>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <set>

namespace kte::detail {

/// The classes of defaults of a file in MJCF. All <default> at the top are the class "main", by whatever names; a class
/// begins with what the class around it has until then.
class mjcf_classes {
 public:
  mjcf_classes(const xml_item& root, robot_description& d) : d_(d) {
    for (const auto& x : root.children("default")) {
      main_.insert(x.text_or("class", "main"));
      add(x, classes_["main"]);
    }
  }

  bool has(const std::string& name) const { return main_.contains(name) || classes_.contains(name); }
  /// The element with the attributes that its class gives it: its own, or else `around`. Empty attributes are as none.
  /// Of a size of fewer numbers than that of the class the class gives the rest. `kind`: of which elements the defaults
  /// are, its own unless told.
  xml_item resolved(const xml_item& x, const std::string& around, const std::string& kind = {}) const {
    xml_node n = x.node();
    std::erase_if(n.attributes, [](const auto& a) { return a.second.empty(); });
    const xml_item own(n, d_);
    const auto name = own.text_or("class", around.empty() ? "main" : around.c_str());
    const auto known = classes_.find(main_.contains(name) ? "main" : name);
    if (known == classes_.end()) x.fail("there is no default class '" + excerpt(name) + "'");
    if (const auto of = known->second.find(kind.empty() ? kind_of(n.name) : kind); of != known->second.end())
      for (const auto& [key, value] : of->second) {
        if (value.empty()) continue;
        const auto written = std::find_if(n.attributes.begin(), n.attributes.end(),
                                          [&key = key](const auto& a) { return a.first == key; });
        if (written == n.attributes.end())
          n.attributes.emplace_back(key, value);
        else if (key == "size")
          written->second = completed(written->second, value);
      }
    return {kept_.emplace_back(std::move(n)), d_};
  }
  /// The same without defaults.
  xml_item cleaned(const xml_item& x) const {
    xml_node n = x.node();
    std::erase_if(n.attributes, [](const auto& a) { return a.second.empty(); });
    return {kept_.emplace_back(std::move(n)), d_};
  }

 private:
  using attributes = std::map<std::string, std::string, std::less<>>;
  using by_element = std::map<std::string, attributes, std::less<>>;

  /// These numbers, and behind them those that the others have more.
  static std::string completed(std::string numbers, std::string_view others) {
    const auto next = [](std::string_view t, std::size_t& at) {
      while (at < t.size() && is_blank(t[at])) ++at;
      const auto from = at;
      while (at < t.size() && !is_blank(t[at])) ++at;
      return t.substr(from, at - from);
    };
    std::size_t written = 0;
    for (std::size_t at = 0; !next(numbers, at).empty();) ++written;
    std::size_t at = 0;
    for (std::size_t i = 0;; ++i) {
      const auto word = next(others, at);
      if (word.empty()) return numbers;
      if (i >= written) numbers.append(" ").append(word);
    }
  }
  /// All actuators share their defaults, and all tendons.
  static std::string kind_of(const std::string& element) {
    if (element == "spatial" || element == "fixed") return "tendon";
    static constexpr std::array actuators{"motor",  "position", "velocity", "intvelocity", "damper",
                                          "muscle", "cylinder", "adhesion", "plugin"};
    return std::find(actuators.begin(), actuators.end(), element) != actuators.end() ? "general" : element;
  }
  void add(const xml_item& x, by_element& all) {
    for (const auto& c : x.children())
      if (c.name() != "default")
        for (const auto& [key, value] : c.node().attributes) all[kind_of(c.node().name)][key] = value;
    for (const auto& c : x.children("default")) {
      const auto name = c.text("class");
      auto below = all;
      add(c, below);
      if (!classes_.emplace(name, below).second) c.fail("there is another default class '" + excerpt(name) + "'");
    }
  }

  robot_description& d_;
  std::map<std::string, by_element, std::less<>> classes_{{"main", {}}};
  std::set<std::string, std::less<>> main_{"main"};
  mutable std::deque<xml_node> kept_;
};

}  // namespace kte::detail
