#pragma once

#include <atomic>
#include <memory>
#include <type_traits>
#include <utility>

/// States that calculations with a static chain keep for the next call, because making them takes as long as the
/// calculation.
namespace kte::detail {

/// For chains that keep nothing: a new state for each calculation.
template <bool Keeps>
class kept_states {
 public:
  template <class State, class Chain>
  static State borrow(const Chain& c) {
    return State(c);
  }
};

/// A kept state. All kept states are in one list. Constants are never destroyed (their destructor is `constexpr` and
/// skipped), so their states are released when another object keeps a state at the same address.
struct kept_state {
  kept_state(const void* k, const void* o) : kind(k), owner(o) {}
  kept_state(const kept_state&) = delete;
  kept_state& operator=(const kept_state&) = delete;
  virtual ~kept_state() = default;
  const void* const kind;
  const void* const owner;
  kept_state* next = nullptr;  ///< of the same owner
  kept_state* next_of_all = nullptr;

  /// `first`: the list of the owner; empty for a new owner.
  static void add(kept_state* x, std::atomic<kept_state*>& first) {
    const lock here;
    if (!first.load()) drop_all_of(x->owner);
    x->next = first.load();
    x->next_of_all = std::exchange(all, x);
    first.store(x);
  }
  static void remove(const void* owner) {
    const lock here;
    drop_all_of(owner);
  }

 private:
  static void drop_all_of(const void* owner) {
    for (kept_state** at = &all; *at;) {
      kept_state* const x = *at;
      if (x->owner != owner) {
        at = &x->next_of_all;
        continue;
      }
      *at = x->next_of_all;
      delete x;
    }
  }
  struct lock {
    lock() {
      while (taken.test_and_set(std::memory_order_acquire)) {
      }
    }
    lock(const lock&) = delete;
    lock& operator=(const lock&) = delete;
    ~lock() { taken.clear(std::memory_order_release); }
  };
  static inline std::atomic_flag taken;
  static inline kept_state* all = nullptr;
};

/// One state of each type, lent to one calculation at a time; concurrent calculations get copies. Thread-safe. Copying
/// a chain does not copy its kept states.
template <>
class kept_states<true> {
  using node = kept_state;
  template <class State>
  struct node_of final : node {
    template <class Chain>
    node_of(const Chain& c, const void* whose) : node(&kind_of<State>, whose), original(c) {}
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
    operator State&() { return *state_; }  // NOLINT(google-explicit-constructor)

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
    auto* const made = new node_of<State>(c, this);
    node::add(made, first_);
    return loan<State>(*made);
  }

 private:
  /// Constants keep nothing.
  constexpr void clear() {
    if (std::is_constant_evaluated()) return;
    if (first_.exchange(nullptr)) node::remove(this);
  }
  mutable std::atomic<node*> first_{nullptr};
};

}  // namespace kte::detail
