#pragma once

#include <kte/contract/key.hpp>

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <utility>

/// The mass matrix of some bodies of a chain over some of its coordinates, by their Jacobians. (That of all, in O(n d)
/// instead of O(n^3): dynamics/mass_matrix.hpp.)
namespace kte {

/// The bodies on a frame, or the masses on a generalized coordinate, of that name: a key of a static chain, a text.
template <class Name = std::string>
struct inertia_on {
  explicit inertia_on(std::string_view n) : name(n) {}
  Name name;
};
template <key_type Key>
struct inertia_on<Key> {
  explicit constexpr inertia_on(const Key&) {}
};
template <key_type Key>
inertia_on(const Key&) -> inertia_on<Key>;
/// A coordinate, by its `name`, that is a degree of freedom, or several: a number, or that of a free or spherical
/// joint.
template <class Name = std::string>
struct moved_by {
  explicit moved_by(std::string_view n) : name(n) {}
  Name name;
};
template <key_type Key>
struct moved_by<Key> {
  explicit constexpr moved_by(const Key&) {}
};
template <key_type Key>
moved_by(const Key&) -> moved_by<Key>;
/// Selects all bodies of a chain for a `mass_matrix_calc`.
inline constexpr struct all_inertias_t {
} all_inertias;
/// Selects all coordinates of a chain for a `mass_matrix_calc`.
inline constexpr struct all_coordinates_t {
} all_coordinates;

/// The twist-shaping matrix T (`value`), which maps the rates of the coordinates to the twists of all bodies, its time
/// derivative (`rate`), and the masses M_c of the bodies, block by block.
template <class Shaping = Eigen::MatrixXd, class Masses = Eigen::MatrixXd>
struct twist_shaping_result {
  Shaping value, rate;
  Masses masses;
};
/// The mass matrix M (`value`) and its time derivative (`rate`).
template <class Matrix = Eigen::MatrixXd>
struct mass_matrix_with_rate {
  Matrix value, rate;
};

/// Fed with bodies and coordinates by name, in any order,
///
///   kte::mass_matrix_calc calc(arm);
///   calc << kte::inertia_on("upper_end") << kte::inertia_on("tool") << kte::moved_by("shoulder");
///   calc.mass_matrix(s);          // at the positions of a state of the chain
///
/// or of a static chain, where what is fed is part of the type, so that sizes are fixed,
///
///   const auto calc = kte::mass_matrix_calc(arm) << kte::inertia_on(tool) << kte::moved_by(shoulder);
///   calc.mass_matrix(q);
///
/// gives, with T the motion Jacobians of the bodies' frames in their own axes, one below the other,
///
///   M = T^T M_c T,   dM/dt = dT/dt^T M_c T + T^T M_c dT/dt          (1)
///
/// Which coordinate moves what is found from the chain. Rows of T: generalized coordinates (1 each), frames in the
/// plane (3: velocity, then angular velocity), in space (6). Columns, of T and M: generalized coordinates, poses in the
/// plane (3), in space (6), rotations (3). In both, within a kind as they were fed. M_c has for a body of mass m, first
/// moment h and inertia I about the origin of its frame the block
///
///   ( m 1  -[h]x )
///   ( [h]x    I  )          (2)
///
/// What is fed twice is refused, and what is no degree of freedom or has no mass; what has a distributed mass too.
template <class Chain, class Bodies = std::index_sequence<>, class Coordinates = std::index_sequence<>>
class mass_matrix_calc;

}  // namespace kte
