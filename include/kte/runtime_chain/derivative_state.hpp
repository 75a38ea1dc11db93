#pragma once

#include <kte/contract/thing_lists.hpp>
#include <kte/runtime_chain/runtime_tree.hpp>
#include <kte/tree/dual_motion.hpp>

namespace kte::detail {

/// What a runtime state has for elements with their own laws, in dual numbers: coordinates and frames, and bodies, on
/// which the frames stand. It goes with a state of numbers, which has all else. A template, though of one scalar alone:
/// headers that know it do not instantiate what is in it.
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
  /// The wiring of the chain for which it was made.
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
