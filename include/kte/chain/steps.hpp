#pragma once

#include <kte/chain/working_articulated.hpp>
#include <kte/chain/working_mass.hpp>
#include <kte/chain/working_variation.hpp>

/// What an element does in the algorithms that are loops over elements. A step is a type, by which runtime elements
/// overload `perform`.
namespace kte::detail {

/// The elements that have something to do: all, those that write something, those on generalized coordinates.
enum class who { all, movers, weights };
template <who Who, class Core>
inline constexpr bool concerns = Who == who::all || (Who == who::movers && Core::ports.back().how == access::out) ||
                                 (Who == who::weights && Core::ports[0].what == kind::gen && !is_transmission<Core>);

template <template <class, class> class Working, who Who>
struct step_of {
  static constexpr who of = Who;
  template <class Core, class State>
  static auto on(const Core& core, State& s, const int* index, const place& at) {
    return Working<Core, State>{{core, s, index, at}};
  }
};

/// Steps of inverse dynamics: motion without positions, forces in it.
template <class Core, class State>
struct working_motion : working_element<Core, State> {};
namespace steps {
struct move : step_of<working_motion, who::movers> {
  static constexpr auto act = [](const auto& e) { e.move(); };
};
struct push : step_of<working_motion, who::all> {
  static constexpr auto act = [](const auto& e) { e.template push<false>(); };
};
/// For elements whose forces depend on positions: the full passes, on frames of the state.
struct move_fully : step_of<working_motion, who::movers> {
  static constexpr auto act = [](const auto& e) { e.move_fully(); };
};
struct push_fully : step_of<working_motion, who::all> {
  static constexpr auto act = [](const auto& e) { e.push_fully(); };
};
/// Brings followers, and their sines and cosines, up to date with what they follow.
struct follow : step_of<working_motion, who::movers> {
  static constexpr auto act = [](const auto& e) { e.follow(); };
};

/// The mass matrix: what is carried, and the columns of all joints further out, one element further in.
struct carry : step_of<working_mass, who::all> {
  static constexpr auto act = [](const auto& e) { e.carry(); };
};
/// Masses of coordinates, and followers: their rows and columns to those of what they follow.
struct carry_coordinate : step_of<working_mass, who::weights> {
  static constexpr auto act = [](const auto& e) { e.carry_coordinate(); };
};

/// Forward dynamics: motion by rates alone; articulated inertia one element further in; accelerations further out.
struct move_by_rates : step_of<working_articulated, who::all> {
  static constexpr auto act = [](const auto& e) { e.move_by_rates(); };
};
struct articulate : step_of<working_articulated, who::all> {
  static constexpr auto act = [](const auto& e) { e.articulate(); };
};
struct accelerate : step_of<working_articulated, who::movers> {
  static constexpr auto act = [](const auto& e) { e.accelerate(); };
};
/// The inverse of the mass matrix: no motion; a load one element further in.
struct rest : step_of<working_articulated, who::all> {
  static constexpr auto act = [](const auto& e) { e.rest(); };
};
struct load_down : step_of<working_articulated, who::movers> {
  static constexpr auto act = [](const auto& e) { e.load_down(); };
};

/// Derivatives: what is carried, columns and rows, one element further in; forces on coordinates.
struct vary : step_of<working_variation, who::all> {
  static constexpr auto act = [](const auto& e) { e.vary(); };
};
struct vary_coordinates : step_of<working_variation, who::weights> {
  static constexpr auto act = [](const auto& e) { e.vary_coordinates(); };
};
}  // namespace steps

/// One step of one element.
template <class Step, class Core, class State>
void perform(const Core& core, State& s, const int* index, const place& at) {
  Step::act(Step::on(core, s, index, at));
}

}  // namespace kte::detail
