#pragma once

#include <kte/robots/description.hpp>

#include <string_view>
#include <unordered_map>
#include <vector>

namespace kte::detail {

/// The numbers of the links of a description by their names, and those of the ends of its joints. The links must stay
/// where they are.
class link_numbers {
 public:
  struct ends {
    std::size_t parent, child;
  };

  explicit link_numbers(const robot_description& d) : count_(d.links.size()) {
    numbers_.reserve(count_);
    for (std::size_t i = 0; i < count_; ++i) numbers_.emplace(d.links[i].name, i);
  }
  std::size_t count() const { return count_; }
  std::size_t of(std::string_view link) const { return numbers_.at(link); }
  /// The number, or the number of links for a name that no link has.
  std::size_t find(std::string_view link) const {
    const auto at = numbers_.find(link);
    return at == numbers_.end() ? count_ : at->second;
  }
  std::vector<ends> of(const std::vector<robot_joint>& joints) const {
    std::vector<ends> all;
    all.reserve(joints.size());
    for (const auto& j : joints) all.push_back({of(j.parent), of(j.child)});
    return all;
  }

 private:
  std::size_t count_;
  std::unordered_map<std::string_view, std::size_t> numbers_;
};

/// Sets that grow together; those of links that joints connect.
class joined_sets {
 public:
  explicit joined_sets(std::size_t count) : up_(count) {
    for (std::size_t i = 0; i < count; ++i) up_[i] = i;
  }
  /// The number that stands for the set of i.
  std::size_t top(std::size_t i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }
  /// Joins the sets of two; false if they are one already.
  bool join(std::size_t a, std::size_t b) {
    a = top(a), b = top(b);
    up_[a] = b;
    return a != b;
  }

 private:
  std::vector<std::size_t> up_;
};

}  // namespace kte::detail
