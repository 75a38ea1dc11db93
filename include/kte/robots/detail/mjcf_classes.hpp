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
  xml_item resolved(const xml_item& x, const std::string& around) const {
    const auto name = x.text_or("class", around.empty() ? "main" : around.c_str());
    const auto known = classes_.find(main_.contains(name) ? "main" : name);
    if (known == classes_.end()) x.fail("there is no default class '" + excerpt(name) + "'");
    xml_node n = x.node();
    std::erase_if(n.attributes, [](const auto& a) { return a.second.empty(); });
    if (const auto of = known->second.find(kind_of(n.name)); of != known->second.end())
      for (const auto& [key, value] : of->second)
        if (!x.has(key.c_str()) && !value.empty()) n.attributes.emplace_back(key, value);
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

  /// All actuators share their defaults.
  static std::string kind_of(const std::string& element) {
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
      if (!classes_.emplace(name, below).second) c.fail("there is another default class of this name");
    }
  }

  robot_description& d_;
  std::map<std::string, by_element, std::less<>> classes_{{"main", {}}};
  std::set<std::string, std::less<>> main_{"main"};
  mutable std::deque<xml_node> kept_;
};

}  // namespace kte::detail
