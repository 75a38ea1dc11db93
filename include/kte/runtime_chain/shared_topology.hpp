#pragma once

#include <kte/runtime_chain/topology.hpp>

#include <memory>
#include <utility>

namespace kte {

/// The wiring of a chain, shared with its states (copy on write). A moved-from object is the wiring of an empty chain.
class shared_topology {
 public:
  shared_topology() : t_(empty()) {}
  shared_topology(const shared_topology&) = default;
  shared_topology(shared_topology&& o) noexcept : t_(std::exchange(o.t_, empty())) {}
  shared_topology& operator=(shared_topology o) noexcept {
    t_.swap(o.t_);
    return *this;
  }
  ~shared_topology() = default;

  const topology& operator*() const { return *t_; }
  const topology* operator->() const { return t_.get(); }
  /// The wiring for a change; copied first if it is shared.
  topology& edit() {
    if (t_.use_count() > 1) t_ = std::make_shared<topology>(*t_);
    return *t_;
  }

 private:
  static const std::shared_ptr<topology>& empty() {
    static const auto none = std::make_shared<topology>();
    return none;
  }
  std::shared_ptr<topology> t_;
};

}  // namespace kte
