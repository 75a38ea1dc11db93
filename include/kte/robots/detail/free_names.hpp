#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>

namespace kte::detail {

/// Names that are taken, and unused ones like them, each in constant time.
class free_names {
 public:
  /// Whether the name was free.
  bool take(const std::string& name) { return taken_.insert(name).second; }
  bool empty() const { return taken_.empty(); }
  void reserve(std::size_t count) { taken_.reserve(count); }
  bool has(const std::string& name) const { return taken_.contains(name); }
  /// The name; where it is taken, with an apostrophe, and further ones with a number: "pin", "pin'", "pin'2".
  std::string fresh(const std::string& name) {
    if (take(name)) return name;
    for (auto& count = copies_[name];;) {
      const auto next = name + (++count == 1 ? "'" : "'" + std::to_string(count));
      if (take(next)) return next;
    }
  }

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, std::size_t> copies_;  ///< by name, how often it was asked for again
};

}  // namespace kte::detail
