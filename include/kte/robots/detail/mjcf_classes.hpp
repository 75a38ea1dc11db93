#pragma once

#include <kte/robots/detail/xml_item.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace kte::detail {

/// The classes of defaults of a file in MJCF. All <default> elements at the top form the class "main", whatever their
/// names; a class begins with the values that the enclosing class has at that point.
class mjcf_classes {
 public:
  explicit mjcf_classes(const xml_item& root) {
    for (const auto& x : root.children("default")) {
      main_.insert(x.text_or("class", "main"));
      add(x);
    }
    classes_["main"] = now_;
  }

  bool has(const std::string& name) const { return main_.contains(name) || classes_.contains(name); }
  /// The element with the attributes of its class: the class that it names, otherwise `around`. Empty attributes count
  /// as missing. `kind`: the elements whose defaults apply, by default its own.
  xml_item resolved(const xml_item& x, const std::string& around, const std::string& kind = {}) const {
    const auto own = cleaned(x);
    const auto name = own.text_or("class", around.empty() ? "main" : around.c_str());
    const auto known = classes_.find(main_.contains(name) ? "main" : name);
    if (known == classes_.end()) x.fail("there is no default class '" + excerpt(name) + "'");
    const auto of = kinds_.find(kind.empty() ? kind_of(x.node().name) : kind);
    return of == kinds_.end() ? own : x.with(of->second, known->second);
  }
  /// The element without defaults.
  xml_item cleaned(const xml_item& x) const { return x.with(none_, 0); }

 private:
  struct change {
    xml_defaults* of;
    const std::string* attribute;
    std::size_t before;
  };

  /// The kind of an element for defaults: all actuators share one, and all tendons.
  static std::string kind_of(const std::string& element) {
    if (element == "spatial" || element == "fixed") return "tendon";
    static constexpr std::array actuators{"motor",  "position", "velocity", "intvelocity", "damper",
                                          "muscle", "cylinder", "adhesion", "plugin"};
    return std::find(actuators.begin(), actuators.end(), element) != actuators.end() ? "general" : element;
  }
  /// Adds a <default> and the classes in it. Returns the changes in order, with the values before.
  std::vector<change> add(const xml_item& x, const std::string& name = {}) {
    std::vector<change> changes;
    ++now_;
    for (const auto& c : x.children()) {
      if (c.name() == "default") continue;
      auto& of = kinds_[kind_of(c.node().name)];
      of.wrote(c.node());
      for (const auto& [key, value] : c.node().attributes)
        if (!value.empty()) changes.push_back({&of, &key, of.set(key, value, now_)});
    }
    if (!name.empty() && !classes_.emplace(name, now_).second)
      x.fail("there is another default class '" + excerpt(name) + "'");
    for (const auto& c : x.children("default")) {
      const auto own = add(c, c.text("class"));
      ++now_;
      for (auto i = own.rbegin(); i != own.rend(); ++i) i->of->reset(*i->attribute, i->before, now_);
    }
    return changes;
  }

  std::map<std::string, xml_defaults::moment, std::less<>> classes_{{"main", 0}};
  std::set<std::string, std::less<>> main_{"main"};
  mutable std::map<std::string, xml_defaults, std::less<>> kinds_;  ///< by element; mutable for `take_writers`
  mutable xml_defaults none_;
  xml_defaults::moment now_ = 0;
};

}  // namespace kte::detail
