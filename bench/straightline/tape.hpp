#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <vector>

/// Arithmetic written down instead of done: what straight-line code is printed from.
namespace straightline {

/// What a value is made by: a number, an input, or an operation on earlier values.
enum class op : unsigned char { number, input, sine, cosine, root, sum, difference, product, quotient };

/// A value up to its sign, so that a*-b shares with a*b, and b-a with a-b.
struct node {
  op by;
  std::size_t a, b;  ///< operands; the index of an input
  double number;
  friend auto operator<=>(const node&, const node&) = default;
};

/// All values so far, each once.
class tape {
 public:
  std::size_t find(const node& n) {
    const auto [at, fresh] = index_.try_emplace(n, nodes_.size());
    if (fresh) nodes_.push_back(n);
    return at->second;
  }
  const node& operator[](std::size_t i) const { return nodes_[i]; }
  std::size_t size() const { return nodes_.size(); }

 private:
  std::vector<node> nodes_;
  std::map<node, std::size_t, std::less<>> index_;
};

inline tape& current() {
  static tape t;
  return t;
}

}  // namespace straightline
