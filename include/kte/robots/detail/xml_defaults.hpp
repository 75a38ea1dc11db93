#pragma once

#include <kte/robots/detail/xml_node.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string_view>

namespace kte::detail {

/// The default attributes of elements of one kind, by class. The file is read from its beginning, and a class is a
/// moment of this reading: a value holds from the moment at which it is written until another value is written, or
/// until the class that wrote it ends. All classes together therefore need only the memory of the values written.
class xml_defaults {
 public:
  using moment = std::size_t;

  /// Sets the value that holds from now on and returns the one before. Null stands for no value.
  const std::string* set(const std::string& attribute, const std::string* value, moment now) {
    auto& all = values_[attribute];
    const auto* const before = all.empty() ? nullptr : all.back().value;
    all.push_back({now, value});
    return before;
  }
  /// The value at a moment; null if there is none or it is empty.
  const std::string* find(std::string_view attribute, moment at) const {
    const auto all = values_.find(attribute);
    if (all == values_.end()) return nullptr;
    const auto later = std::upper_bound(all->second.begin(), all->second.end(), at,
                                        [](moment m, const held& x) { return m < x.from; });
    if (later == all->second.begin()) return nullptr;
    const auto* const value = std::prev(later)->value;
    return value != nullptr && !value->empty() ? value : nullptr;
  }
  /// Registers an element that wrote defaults; `take_writers` returns and clears the list.
  void wrote(const xml_node& x) { writers_.push_back(&x); }
  std::vector<const xml_node*> take_writers() { return std::exchange(writers_, {}); }

 private:
  struct held {
    moment from;
    const std::string* value;
  };
  std::map<std::string, std::vector<held>, std::less<>> values_;
  std::vector<const xml_node*> writers_;
};

}  // namespace kte::detail
