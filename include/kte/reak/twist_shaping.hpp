#pragma once

#include <kte/contract/key.hpp>

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <utility>

/// The mass matrix of selected bodies of a chain over selected coordinates, by Jacobians. (For all of them,
/// dynamics/mass_matrix.hpp needs O(n d) operations instead of O(n^3).)
namespace kte {

/// Selects the bodies on a frame, or the masses on a generalized coordinate, by name: a key of a static chain, or a
/// text.
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
/// Selects a coordinate by its `name`: a number, or the coordinate of a free or spherical joint, which has several
/// degrees of freedom.
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

/// Bodies and coordinates are inserted by name, in any order:
///
///   kte::mass_matrix_calc calc(arm);
///   calc << kte::inertia_on("upper_end") << kte::inertia_on("tool") << kte::moved_by("shoulder");
///   calc.mass_matrix(s);          // at the positions of a state of the chain
///
/// For static chains the selection is part of the type, so that sizes are fixed:
///
///   const auto calc = kte::mass_matrix_calc(arm) << kte::inertia_on(tool) << kte::moved_by(shoulder);
///   calc.mass_matrix(q);
///
/// With the motion Jacobians T of the bodies' frames, in their own axes, one below the other, the results are
///
///   M = T^T M_c T,   dM/dt = dT/dt^T M_c T + T^T M_c dT/dt          (1)
///
/// Which coordinate moves which body follows from the chain. Rows of T: generalized coordinates (1 each), planar frames
/// (3: velocity, then angular velocity), spatial frames (6). Columns of T and M: generalized coordinates, planar poses
/// (3), spatial poses (6), rotations (3). Within a kind they are in the order of insertion. For a body of mass m, first
/// moment h and inertia I about the origin of its frame, M_c has the block
///
///   ( m 1  -[h]x )
///   ( [h]x    I  )          (2)
///
/// Throws `bad_argument` for duplicates, for names that are not degrees of freedom or have no mass, and for distributed
/// masses.
template <class Chain, class Bodies = std::index_sequence<>, class Coordinates = std::index_sequence<>>
class mass_matrix_calc;

}  // namespace kte
