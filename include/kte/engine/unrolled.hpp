#pragma once

#include <kte/engine/body.hpp>

#include <cstddef>

/// The driver that unrolls over a tree of types. It applies the steps of recursions like the driver of
/// engine/looped.hpp, but all values are local variables of the types that the steps return.
namespace kte::engine {

/// `Bodies` is a tree that is known at compile time. Frames are types with parts: bodies with their joints, by number,
/// and inertias fixed to the frame. A rigid link is a body without axes. It has
///   each_base(f)                 calls f(frame) for each base
///   parts<Frame>                 number of parts of a frame
///   body_on<Frame, N>            number of the body that is part N, or -1
///   end<I>, parent<I>            the frame that body I moves; number of its parent, or -1
///   body<I>()                    the body. Steps are instantiated once for each type that it has
///   fixed<Frame, N>(), none()    part N, which is fixed to the frame; an empty part
template <class Bodies>
struct unrolled {
  const Bodies& bodies;

  /// The position of body I in the tree; true if it is on a base, where the recursion ends.
  template <std::size_t I, bool Ends>
  struct tree_place {
    static constexpr std::size_t number = I;
    const unrolled& driver;
    KTE_INLINE constexpr operator bool() const { return Ends; }  // NOLINT(google-explicit-constructor)
    /// value = step(body, value) for each body from the parent to the base.
    template <class Value, class Step>
    KTE_INLINE constexpr void ancestors(const Value& value, const Step& step) const {
      driver.template ancestors<I>(value, step);
    }
  };

  /// From children to parents, like `looped`: a frame carries own(fixed part, value) for all fixed parts, plus the
  /// values of its bodies. Nothing is stored, so there are no arrays. meet(body, carried, tree_place).
  template <bool Keep, class Hand, bool Bases, class Values, class Own, class Meet, class PullBack>
  KTE_INLINE constexpr void inward(no_value, const Values& values, const Own& own, const Meet& meet,
                                   const PullBack& pull_back) const {
    static_assert(!Keep && !Bases);
    const inward_steps<Values, Own, Meet, PullBack> steps{values, own, meet, pull_back};
    bodies.each_base([&]<class Frame>(Frame)
                         KTE_INLINE_LAMBDA { (void)with_parts<true, Frame, 0>(steps, steps.alone()); });
  }
  /// The sum of the values on a frame.
  template <class Frame, class Values, class Own, class Meet, class PullBack>
  KTE_INLINE constexpr auto carried(const Values& values, const Own& own, const Meet& meet,
                                    const PullBack& pull_back) const {
    const inward_steps<Values, Own, Meet, PullBack> steps{values, own, meet, pull_back};
    return with_parts<false, Frame, 0>(steps, steps.alone());
  }

  /// From parents to children: step(body, kept value, value of its parent), with base(frame) for bodies on bases.
  template <class Hand, class Base, class Values, class Step>
  KTE_INLINE constexpr void descend(const Base& base, const Values& values, const Step& step) const {
    bodies.each_base([&]<class Frame>(Frame f) KTE_INLINE_LAMBDA { from<Frame, 0>(base(f), values, step); });
  }

  /// From body I to its base: value = step(body, value) for each body.
  template <std::size_t I, class Value, class Step>
  KTE_INLINE constexpr void to_base(const Value& value, const Step& step) const {
    ancestors<I>(step(bodies.template body<I>(), value), step);
  }

 private:
  template <class Values, class Own, class Meet, class PullBack>
  struct inward_steps {
    const Values& values;
    const Own& own;
    const Meet& meet;
    const PullBack& pull_back;
    /// What a frame without parts carries.
    KTE_INLINE constexpr auto alone() const {
      const auto none = Bodies::none();
      return own(none, values.at(none));
    }
  };

  template <std::size_t I, class Value, class Step>
  KTE_INLINE constexpr void ancestors(const Value& value, const Step& step) const {
    constexpr int parent = Bodies::template parent<I>;
    if constexpr (parent >= 0) to_base<std::size_t{parent}>(value, step);
  }
  /// Adds the parts from N on to `sum`, one after the other. In a single expression g++ would compute the last part
  /// first, whose numbers then wait in memory.
  template <bool Ends, class Frame, std::size_t N, class Steps, class Sum>
  KTE_INLINE constexpr auto with_parts(const Steps& steps, const Sum& sum) const {
    if constexpr (N == Bodies::template parts<Frame>) {
      return sum;
    } else {
      constexpr int number = Bodies::template body_on<Frame, N>;
      if constexpr (number < 0) {
        const auto part = bodies.template fixed<Frame, N>();
        return with_parts<Ends, Frame, N + 1>(steps, sum + steps.own(part, steps.values.at(part)));
      } else {
        constexpr std::size_t i{number};
        const auto carried = with_parts<false, typename Bodies::template end<i>, 0>(steps, steps.alone());
        const auto b = bodies.template body<i>();
        const auto met = steps.meet(b, carried, tree_place<i, Ends>{*this});
        if constexpr (Ends) {
          return with_parts<Ends, Frame, N + 1>(steps, sum);
        } else {
          return with_parts<Ends, Frame, N + 1>(steps, sum + steps.pull_back(b, steps.values.of(b), met));
        }
      }
    }
  }
  template <class Frame, std::size_t N, class Hand, class Values, class Step>
  KTE_INLINE constexpr void from(const Hand& hand, const Values& values, const Step& step) const {
    if constexpr (N < Bodies::template parts<Frame>) {
      constexpr int number = Bodies::template body_on<Frame, N>;
      if constexpr (number >= 0) {
        constexpr std::size_t i{number};
        const auto b = bodies.template body<i>();
        from<typename Bodies::template end<i>, 0>(step(b, values.of(b), hand), values, step);
      }
      from<Frame, N + 1>(hand, values, step);
    }
  }
};

}  // namespace kte::engine
