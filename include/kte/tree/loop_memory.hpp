#pragma once

#include <kte/kernels/joint_vector.hpp>
#include <kte/tree/articulated_clusters.hpp>
#include <kte/tree/coriolis.hpp>
#include <kte/tree/followed_masses.hpp>
#include <kte/tree/variations.hpp>

namespace kte::detail {

/// Working memory of the loops over body nodes. Only the first call that needs a part of it allocates.
template <class P, class S>
struct loop_memory : tree::memory<P, S> {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  template <class Tree>
  loop_memory(const Tree& t, int dofs, std::size_t elements)
      : tree::memory<P, S>(t.body_tree),
        forces(dofs),
        kept(2 * static_cast<std::size_t>(dofs)),
        prescribed(static_cast<std::size_t>(dofs)),
        wanted(elements),
        friction(t.readers.size()) {
    for (std::size_t k = 0; k < this->own_mass.size(); ++k)
      this->own_mass[k] = t.own_mass[static_cast<std::size_t>(t.body_tree.row[k])];
    tree::set_free(t.body_tree, *this, [&t](std::size_t i) {
      return t.body_tree.nodes[i].is_free && !t.clusters.has(static_cast<int>(i));
    });
  }
  vector forces;                 ///< results: forces or accelerations
  std::vector<S> kept;           ///< rates and accelerations that are saved
  std::vector<char> prescribed;  ///< by row: whether its acceleration is given
  bool some_prescribed = false;
  std::vector<char> wanted;  ///< by element: whether the result depends on it
  std::vector<S> friction;   ///< by element of `chain_tree::readers`
  /// Of the size of M or larger; allocated by the first call that returns them.
  matrix mass, inverse, coriolis, regressor;
  tree::axis_rows<S> axis_velocities;  ///< of the regressor
  tree::mass_memory<S> masses;
  tree::followed_memory<S> followed;
  tree::cluster_memory<S> clusters;
  tree::coriolis_memory<S> of_coriolis;
  std::vector<int> rows;  ///< rows of nonzero entries in a column of derivatives
  tree::variation_memory<S> variations;
  inverse_dynamics_result<S, Eigen::Dynamic> of_forces;
  forward_dynamics_result<S, Eigen::Dynamic> of_accelerations;
};

}  // namespace kte::detail
