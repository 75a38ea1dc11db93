#pragma once

namespace kte::tree {

/// Forces tau(i) on coordinates, in addition to those of elements: numbers by row, which must stay where they are, or
/// none. One type for all callers, so that forward dynamics is compiled once.
template <class S>
class given_forces {
 public:
  given_forces() = default;
  explicit given_forces(const S* by_row) : by_row_(by_row) {}
  S operator()(int i) const { return by_row_ ? by_row_[i] : S(0); }

 private:
  const S* by_row_ = nullptr;
};

}  // namespace kte::tree
