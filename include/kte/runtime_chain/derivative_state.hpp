#pragma once

#include <kte/contract/thing_lists.hpp>
#include <kte/runtime_chain/runtime_tree.hpp>
#include <kte/tree/dual_motion.hpp>

namespace kte::detail {

/// The part of a runtime state in dual numbers, for elements with their own laws: coordinates, frames and bodies. It
/// complements a state of numbers. A template, although for one scalar only, so that headers do not instantiate its
/// members.
template <class D>
class basic_derivative_state {
 public:
  using scalar = D;
  static constexpr bool has_sines = false;

  basic_derivative_state(const topology& t, std::shared_ptr<const runtime_tree<double>> tree)
      : layout_(t.layout),
        freedoms_(t.free),
        tree_(std::move(tree)),
        things_([&t](kind k) { return t.count(k); }),
        work(tree_->body_tree),
        q(static_cast<std::size_t>(t.nq)),
        v(static_cast<std::size_t>(t.nv)),
        a(v),
        forces(v) {}

  template <kind K>
  auto& get(int i) {
    return things_.template get<K>(i);
  }
  template <kind K>
  const auto& get(int i) const {
    return things_.template get<K>(i);
  }
  std::span<const freedom> freedoms() const { return freedoms_; }
  const runtime_tree<double>& tree() const { return *tree_; }
  /// The identity of the wiring for which it was made.
  const std::shared_ptr<const char>& layout() const { return layout_; }

 private:
  std::shared_ptr<const char> layout_;
  std::vector<freedom> freedoms_;
  std::shared_ptr<const runtime_tree<double>> tree_;
  thing_lists<scalar> things_;

 public:
  tree::dual_memory<scalar> work;
  std::vector<scalar> q, v, a, forces;
};

}  // namespace kte::detail
