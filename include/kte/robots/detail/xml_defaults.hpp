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

  static constexpr std::size_t none = ~std::size_t{0};

  /// Sets the value that holds from now on and returns the number of the one before, or `none`.
  std::size_t set(const std::string& attribute, const std::string& value, moment now) {
    auto& all = values_[attribute];
    const auto before = all.size() - 1, words = count_words(value);
    auto under = before;  // the value before that has more words
    while (under != none && all[under].words <= words) under = all[under].under;
    all.push_back({now, &value, words, under});
    return before;
  }
  /// Sets again the value that `set` returned.
  void reset(const std::string& attribute, std::size_t before, moment now) {
    auto& all = values_[attribute];
    all.push_back(before == none ? held{now} : all[before]);
    all.back().from = now;
  }
  /// The value at a moment; null if there is none.
  const std::string* find(std::string_view attribute, moment at) const {
    const auto* const x = held_at(attribute, at);
    return x != nullptr ? x->value : nullptr;
  }
  /// The values that held at a moment, each under the one before: those with more words, of enclosing classes. `take`
  /// returns whether it wants another one.
  template <class Take>
  void each(std::string_view attribute, moment at, const Take& take) const {
    const auto* x = held_at(attribute, at);
    while (x != nullptr && x->value != nullptr && take(*x->value) && x->under != none)
      x = &values_.find(attribute)->second[x->under];
  }
  /// Registers an element that wrote defaults; `take_writers` returns and clears the list.
  void wrote(const xml_node& x) { writers_.push_back(&x); }
  std::vector<const xml_node*> take_writers() { return std::exchange(writers_, {}); }

 private:
  struct held {
    moment from;
    const std::string* value = nullptr;
    std::size_t words = 0, under = none;
  };
  static std::size_t count_words(std::string_view text) {
    std::size_t count = 0;
    bool in_word = false;
    for (const char c : text) {
      const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
      count += !blank && !in_word, in_word = !blank;
    }
    return count;
  }
  const held* held_at(std::string_view attribute, moment at) const {
    const auto all = values_.find(attribute);
    if (all == values_.end()) return nullptr;
    const auto later = std::upper_bound(all->second.begin(), all->second.end(), at,
                                        [](moment m, const held& x) { return m < x.from; });
    return later == all->second.begin() ? nullptr : &*std::prev(later);
  }
  std::map<std::string, std::vector<held>, std::less<>> values_;
  std::vector<const xml_node*> writers_;
};

}  // namespace kte::detail
