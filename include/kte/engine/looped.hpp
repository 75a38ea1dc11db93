#pragma once

#include <kte/engine/body.hpp>

#include <cstddef>

/// The driver that loops over arrays of bodies. Recursions consist of steps (values in, values out); a driver applies
/// them from body to body.
namespace kte::engine {

// One function per loop. g++ would pack pairs of numbers into registers, where shuffles cost more than the saved
// products: 8 to 14 % of the time.
#if defined(__GNUC__) && !defined(__clang__) && !defined(KTE_NO_FORCED_INLINE)
#  define KTE_LOOP [[gnu::noinline, gnu::optimize("no-tree-slp-vectorize")]]
#else
#  define KTE_LOOP [[gnu::noinline]]
#endif

/// The values that `outward` has stored for all bodies. `Step` determines which numbers are typed constants for a kind
/// of joint.
template <class Value, class Hand, class Step>
struct kept_values {
  const Value* values;  ///< of bodies
  template <body B>
  using type =
      std::remove_cvref_t<decltype(std::declval<const Step&>()(std::declval<const B&>(), std::declval<const Hand&>()))>;
  /// The value of body i, whose joint is of the kind of B.
  template <body B>
  KTE_INLINE type<B> of(int i) const {
    return typed_as<type<B>>::of(values[i]);
  }
  KTE_INLINE const Value& at(int i) const { return values[i]; }
};
/// Values of all bodies from another source.
template <class Value>
struct kept_array {
  const Value* values;  ///< of bodies
  template <body B>
  KTE_INLINE const Value& of(int i) const {
    return values[i];
  }
  KTE_INLINE const Value& at(int i) const { return values[i]; }
};

/// `Bodies` is an array of bodies, parents first, after their bases. It has
///   count(), bases()        numbers of bodies and bases. Slots of arrays of values: bases, then bodies
///   parent(i), branches(i)  the slot of the parent of body i; whether it has a child other than the next body
///   usual(i)                whether its joint is of the usual kind; optional if there is only one kind
///   body(i)                 the body, if its joint is of the usual kind
///   with_body(i, f)         f(body), for any kind; optional if there is only one kind
///   rigid(i)                the body without its joint: inertia(), composite()
/// The value of the previous body stays in registers, because most bodies are its children. Other kinds of joints have
/// separate functions, so that they do not occupy registers.
template <class Bodies>
struct looped {
  const Bodies& bodies;

  using usual = std::remove_cvref_t<decltype(std::declval<const Bodies&>().body(0))>;

  /// From parents to children: value = step(body, value of its parent). `kept`: values by slot; those of bases are
  /// given. `Hand`: the type in registers, without skipped quantities.
  template <class Hand, class Value, class Step>
  KTE_INLINE auto outward(Value* const kept, const Step& step) const {
    descend<Hand>(kept, kept_constant<no_value>{}, step_without_value<Step>{step});
    return kept_values<Value, Hand, Step>{kept + bodies.bases()};
  }

  /// From parents to children with values of an earlier outward pass: step(body, kept value, value of its parent).
  template <class Hand, class Value, class Values, class Step>
  KTE_LOOP void descend(Value* const kept, const Values values, const Step step) const {
    const int bases = bodies.bases(), count = bodies.count();
    Hand hand{};
    int at_hand = -1;
    for (int i = 0; i < count; ++i) {
      const int parent = bodies.parent(i);
      if (parent != at_hand) assign(hand, kept[parent]);
      at_hand = bases + i;
      if (is_usual(i)) [[likely]]
        assign(hand, step(bodies.body(i), values.template of<usual>(i), hand));
      else
        in_memory(hand, [&](Hand& x) KTE_INLINE_LAMBDA { descend_apart(i, values, step, x); });
      assign(kept[at_hand], hand);
    }
  }

  /// step(body, its value, its number) for each body, with values by slot.
  template <class Value, class Step>
  KTE_INLINE void each(const Value* const values, const Step& step) const {
    const Value* const of_body = values + bodies.bases();
    for (int i = 0; i < bodies.count(); ++i)
      if (is_usual(i)) [[likely]]
        step(bodies.body(i), of_body[i], i);
      else
        each_apart(i, of_body[i], step);
  }

  /// From children to parents. A body carries own(rigid body, kept value) plus the values of its children;
  ///   meet(body, carried, ends)                   the value at its joint; `ends`: nothing is passed on
  ///   pull_back(body, kept value, met value)      the contribution to its parent; not for bodies on bases
  ///
  /// `sums`: values by slot; with `Keep` it stores what all bodies carry. `Hand`: the type in registers, which may have
  /// typed constants. With `Bases` values are also added to the entries of bases in `sums`.
  template <bool Keep, class Hand, bool Bases, class Sum, class Values, class Own, class Meet, class PullBack>
  KTE_LOOP void inward(Sum* const sums, const Values values, const Own own, const Meet meet,
                       const PullBack pull_back) const {
    const int bases = bodies.bases();
    for (int i = 0; i < bodies.count(); ++i)
      if (bodies.branches(i)) assign(sums[bases + i], own(bodies.rigid(i), values.at(i)));
    Hand hand{};
    bool at_hand = false;
    for (int i = bodies.count(); i-- > 0;) {
      Sum& sum = sums[bases + i];
      if (bodies.branches(i)) {
        if (at_hand)
          assign(hand, hand + sum);
        else
          assign(hand, sum);
      } else if (at_hand) {
        assign(hand, own(bodies.rigid(i), values.at(i)) + hand);
      } else {
        assign(hand, own(bodies.rigid(i), values.at(i)));
      }
      if constexpr (Keep) assign(sum, hand);
      const int parent = bodies.parent(i);
      const bool ends = !Bases && parent < bases;
      if (is_usual(i)) [[likely]] {
        const auto b = bodies.body(i);
        const auto met = meet(b, hand, ends);
        if (!ends) assign(hand, pull_back(b, values.template of<usual>(i), met));
      } else {
        in_memory(hand, [&](Hand& x) KTE_INLINE_LAMBDA { inward_apart(i, values, meet, pull_back, ends, x); });
      }
      at_hand = parent >= bases && parent + 1 == bases + i;
      if (!ends && !at_hand) assign(sums[parent], sums[parent] + hand);
    }
  }

 private:
  template <class Step>
  struct step_without_value {
    Step step;
    template <body B, class Parent>
    KTE_INLINE auto operator()(const B& b, no_value, const Parent& parent) const {
      return step(b, parent);
    }
  };
  static constexpr bool one_kind = !requires(const Bodies& b) { b.usual(0); };
  KTE_INLINE bool is_usual(int i) const {
    if constexpr (one_kind)
      return true;
    else
      return bodies.usual(i);
  }
  /// Calls f with a copy, because an argument by reference would stay in memory.
  template <class Hand, class F>
  KTE_INLINE static void in_memory(Hand& hand, const F& f) {
    Hand copy{};
    assign(copy, hand);
    f(copy);
    assign(hand, copy);
  }
  template <class Value, class Step>
  [[gnu::noinline]] void each_apart(int i, const Value& value, const Step& step) const {
    if constexpr (!one_kind) bodies.with_body(i, [&](const body auto& b) { step(b, value, i); });
  }
  template <class Values, class Step, class Hand>
  [[gnu::noinline]] void descend_apart(int i, const Values values, const Step step, Hand& hand) const {
    if constexpr (!one_kind)
      bodies.with_body(i, [&](const body auto& b) {
        assign(hand, step(b, values.template of<std::remove_cvref_t<decltype(b)>>(i), fresh(hand)));
      });
  }
  template <class Values, class Meet, class PullBack, class Hand>
  [[gnu::noinline]] void inward_apart(int i, const Values values, const Meet meet, const PullBack pull_back, bool ends,
                                      Hand& hand) const {
    if constexpr (!one_kind)
      bodies.with_body(i, [&](const body auto& b) {
        const auto met = meet(b, fresh(hand), ends);
        if (!ends) assign(hand, pull_back(b, values.template of<std::remove_cvref_t<decltype(b)>>(i), met));
      });
  }
};
template <class Bodies>
looped(const Bodies&) -> looped<Bodies>;

}  // namespace kte::engine
