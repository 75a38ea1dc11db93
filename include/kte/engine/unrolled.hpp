#pragma once

#include <kte/engine/body.hpp>

#include <cstddef>

/// The driver that unrolls over a tree of types. It takes the steps of recursions, as the driver of engine/looped.hpp
/// does, but all values are local variables, each of the type that the step before returned.
namespace kte::engine {

/// `Bodies` is a tree that is known to the compiler. Frames, which are types, have parts: bodies with their joints, and
/// what is fixed to the frame. A rigid link is a body without axes. It has
///   each_base(f)           f(frame) for each base
///   parts<Frame>           how many parts a frame has
///   part<Frame, N>()       part N: a body, whose type `end` is the frame that it moves; or what is fixed to the frame
///   none<Frame>()          in place of what is fixed to the frame: nothing at all
///   with_parent(body, f)   f(parent) of a body that does not stand on a base
template <class Bodies>
struct unrolled {
  const Bodies& bodies;

  /// The steps of a way in, with what each body has kept.
  template <class Values, class Own, class Meet, class PullBack>
  struct inward_steps {
    const Values& values;
    const Own& own;
    const Meet& meet;
    const PullBack& pull_back;
  };

  /// From children to parents, as `looped`: a frame carries own(fixed part, value) of all that is fixed to it, and what
  /// bodies hand on. Nothing is kept, so there are no arrays.
  template <bool Keep, class Hand, bool Bases, class Values, class Own, class Meet, class PullBack>
  KTE_INLINE constexpr void inward(nothing, const Values& values, const Own& own, const Meet& meet,
                                   const PullBack& pull_back) const {
    static_assert(!Keep && !Bases);
    const inward_steps<Values, Own, Meet, PullBack> steps{values, own, meet, pull_back};
    bodies.each_base([&]<class Frame>(Frame) KTE_INLINE_LAMBDA { (void)carried_by<true, Frame>(steps); });
  }
  /// What a frame carries.
  template <class Frame, class Values, class Own, class Meet, class PullBack>
  KTE_INLINE constexpr auto carried(const Values& values, const Own& own, const Meet& meet,
                                    const PullBack& pull_back) const {
    return carried_by<false, Frame>(inward_steps<Values, Own, Meet, PullBack>{values, own, meet, pull_back});
  }

  /// From parents to children: step(body, kept value, value of its parent), with `base` for bodies on bases.
  template <class Hand, class Base, class Values, class Step>
  KTE_INLINE constexpr void descend(const Base& base, const Values& values, const Step& step) const {
    bodies.each_base([&]<class Frame>(Frame f) KTE_INLINE_LAMBDA {
      from<Frame>(base(f), values, step, std::make_index_sequence<Bodies::template parts<Frame>>{});
    });
  }

  /// From a body to its base: value = step(body, value) of each body on the way; of its ancestors alone.
  template <body B, class Value, class Step>
  KTE_INLINE constexpr void to_base(const B& b, const Value& value, const Step& step) const {
    ancestors(b, step(b, value), step);
  }
  template <body B, class Value, class Step>
  KTE_INLINE constexpr void ancestors(const B& b, const Value& value, const Step& step) const {
    bodies.with_parent(
        b, [&](const auto& parent) KTE_INLINE_LAMBDA { this->ancestors(parent, step(parent, value), step); });
  }

 private:
  template <bool Ends, class Frame, class Steps>
  KTE_INLINE constexpr auto carried_by(const Steps& steps) const {
    const auto none = bodies.template none<Frame>();
    return with_parts<Ends, Frame, 0>(steps, steps.own(none, steps.values.at(none)));
  }
  /// `sum`, and all parts from N on, one after the other: of a sum in one expression g++ makes the last part first,
  /// whose numbers then wait in memory.
  template <bool Ends, class Frame, std::size_t N, class Steps, class Sum>
  KTE_INLINE constexpr auto with_parts(const Steps& steps, const Sum& sum) const {
    if constexpr (N == Bodies::template parts<Frame>) {
      return sum;
    } else {
      const auto part = bodies.template part<Frame, N>();
      if constexpr (!body<std::remove_const_t<decltype(part)>>) {
        return with_parts<Ends, Frame, N + 1>(steps, sum + steps.own(part, steps.values.at(part)));
      } else {
        using end = typename std::remove_const_t<decltype(part)>::end;
        const auto met = steps.meet(part, carried_by<false, end>(steps), Ends);
        if constexpr (Ends) {
          return with_parts<Ends, Frame, N + 1>(steps, sum);
        } else {
          return with_parts<Ends, Frame, N + 1>(steps, sum + steps.pull_back(part, steps.values.of(part), met));
        }
      }
    }
  }
  template <class Frame, class Hand, class Values, class Step, std::size_t... N>
  KTE_INLINE constexpr void from(const Hand& hand, const Values& values, const Step& step,
                                 std::index_sequence<N...>) const {
    const int done[]{(onto(bodies.template part<Frame, N>(), hand, values, step), 0)..., 0};
    (void)done;
  }
  template <class Part, class Hand, class Values, class Step>
  KTE_INLINE constexpr void onto(const Part& part, const Hand& hand, const Values& values, const Step& step) const {
    if constexpr (body<Part>) {
      using end = typename Part::end;
      from<end>(step(part, values.of(part), hand), values, step,
                std::make_index_sequence<Bodies::template parts<end>>{});
    }
  }
};

}  // namespace kte::engine
