#pragma once

#include <atomic>
#include <memory>
#include <type_traits>
#include <utility>

/// What calculations with a static chain keep for the next ones, where making it takes as long as they do.
namespace kte::detail {

/// Of chains that keep nothing: a state for each calculation.
template <bool Keeps>
class kept_states {
 public:
  template <class State, class Chain>
  static State borrow(const Chain& c) {
    return State(c);
  }
};

/// One state of each type, lent to one calculation at a time; to others, copies of it. May be used by several threads.
/// What a chain keeps is never copied with it.
template <>
class kept_states<true> {
  struct node {
    explicit node(const void* k) : kind(k) {}
    node(const node&) = delete;
    node& operator=(const node&) = delete;
    virtual ~node() = default;
    const void* const kind;
    node* next = nullptr;
  };
  template <class State>
  struct node_of final : node {
    template <class Chain>
    explicit node_of(const Chain& c) : node(&kind_of<State>), original(c) {}
    ~node_of() override { delete spare.load(); }
    const State original;
    std::atomic<State*> spare{nullptr};
  };
  template <class State>
  static inline const char kind_of = 0;

  template <class State>
  class loan {
   public:
    explicit loan(node_of<State>& from) : from_(from), state_(from.spare.exchange(nullptr)) {
      if (!state_) state_ = std::make_unique<State>(from.original);
    }
    loan(const loan&) = delete;
    loan& operator=(const loan&) = delete;
    ~loan() { const std::unique_ptr<State> another(from_.spare.exchange(state_.release())); }
    operator State&() { return *state_; }

   private:
    node_of<State>& from_;
    std::unique_ptr<State> state_;
  };

 public:
  constexpr kept_states() = default;
  constexpr kept_states(const kept_states&) {}
  constexpr kept_states& operator=(const kept_states&) {
    clear();
    return *this;
  }
  constexpr ~kept_states() { clear(); }

  template <class State, class Chain>
  loan<State> borrow(const Chain& c) const {
    for (node* n = first_.load(); n; n = n->next)
      if (n->kind == &kind_of<State>) return loan<State>(static_cast<node_of<State>&>(*n));
    auto made = std::make_unique<node_of<State>>(c);
    made->next = first_.load();
    while (!first_.compare_exchange_weak(made->next, made.get())) {
    }
    return loan<State>(*made.release());
  }

 private:
  /// Nothing is kept by constants.
  constexpr void clear() {
    if (std::is_constant_evaluated()) return;
    for (node* n = first_.exchange(nullptr); n;) delete std::exchange(n, n->next);
  }
  mutable std::atomic<node*> first_{nullptr};
};

}  // namespace kte::detail
