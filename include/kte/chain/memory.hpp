#pragma once

#include <kte/chain/plan.hpp>
#include <kte/kernels/articulate.hpp>
#include <kte/kernels/derivatives.hpp>
#include <kte/kernels/variation.hpp>

#include <Eigen/Core>

#include <algorithm>

/// Working memory of the algorithms that are loops over elements (chain/plan.hpp), so that they allocate nothing. Each
/// has a part of its own. Sizes: `growing`, or those of a chain that is known to the compiler.
namespace kte::detail {

/// What there is in a chain.
struct sizes_of_chain {
  std::size_t in_plane, in_space, dofs, coordinates, columns;
};
struct growing {
  static constexpr bool fixed = false;
  static constexpr std::size_t in_plane = 0, in_space = 0, dofs = 0, coordinates = 0, columns = 0;
};
template <class Sizes, class T, std::size_t N>
using list_of = std::conditional_t<Sizes::fixed, std::array<T, N>, std::vector<T>>;
template <class Sizes, class S, std::size_t N>
using vector_of_size = Eigen::Matrix<S, Sizes::fixed ? static_cast<int>(N) : Eigen::Dynamic, 1>;
template <class Sizes, class S, std::size_t N>
using matrix_of_size = Eigen::Matrix<S, Sizes::fixed ? static_cast<int>(N) : Eigen::Dynamic,
                                     Sizes::fixed ? static_cast<int>(N) : Eigen::Dynamic>;

/// Whatever is wanted of every frame.
template <class Sizes, class T>
struct of_each_frame {
  list_of<Sizes, T, Sizes::in_plane> in_plane;
  list_of<Sizes, T, Sizes::in_space> in_space;
  template <kind K>
  T& get(int i) {
    static_assert(is_frame(K));
    if constexpr (K == kind::frame_2D) {
      return in_plane[static_cast<std::size_t>(i)];
    } else {
      return in_space[static_cast<std::size_t>(i)];
    }
  }
  T& at(kind k, int i) { return k == kind::frame_2D ? get<kind::frame_2D>(i) : get<kind::frame_3D>(i); }
  void fill(const T& x) {
    std::fill(in_plane.begin(), in_plane.end(), x);
    std::fill(in_space.begin(), in_space.end(), x);
  }
  void make(const sizes_of_chain& n) { in_plane.resize(n.in_plane), in_space.resize(n.in_space); }
};

template <class S>
using dense_wrench = wrench<vec3<S>, vec3<S>>;
template <class S>
using dense_composite = composite<S, vec3<S>, sym3<S>>;
template <class S>
using dense_articulated = articulated<sym3<S>, mat3<vec3<S>>, sym3<S>>;
template <class S>
using dense_acceleration = acceleration<vec3<S>, vec3<S>>;
template <class S>
using dense_body = turning_body<dense_composite<S>, gyration<mat3<vec3<S>>, mat3<vec3<S>>>>;

/// A frame without position and velocity, which most algorithms do not need.
template <class S>
struct lean_frame {
  vec3<S> ang_velocity{}, acceleration{}, ang_acceleration{};
  dense_wrench<S> load{};
};

/// Motion and forces.
template <class S, class Sizes>
struct pass_memory {
  of_each_frame<Sizes, lean_frame<S>> frames;
  vector_of_size<Sizes, S, Sizes::dofs> forces;
  void make(const sizes_of_chain& n) { frames.make(n), forces.resize(static_cast<Eigen::Index>(n.dofs)); }
};

/// The mass matrix.
template <class S, class Sizes>
struct mass_memory {
  of_each_frame<Sizes, dense_composite<S>> carried;
  /// The wrench that accelerates an axis, as felt further down, by its components.
  std::array<list_of<Sizes, S, Sizes::columns>, 6> column;
  list_of<Sizes, int, Sizes::columns> row_of_column;
  matrix_of_size<Sizes, S, (Sizes::coordinates > Sizes::dofs ? Sizes::coordinates : 0)> all;  ///< if there are others
  matrix_of_size<Sizes, S, Sizes::dofs> mass;
  void make(const sizes_of_chain& n) {
    carried.make(n);
    for (auto& x : column) x.resize(n.columns);
    row_of_column.resize(n.columns);
    const auto size = static_cast<Eigen::Index>(n.coordinates > n.dofs ? n.coordinates : 0);
    all.resize(size, size);
    mass.resize(static_cast<Eigen::Index>(n.dofs), static_cast<Eigen::Index>(n.dofs));
  }
};

/// The one that the algorithm fills.
template <class Memory>
auto& matrix_over_all(Memory& w) {
  using all = decltype(w.all);
  if constexpr (std::is_same_v<all, decltype(w.mass)>) {
    return w.all.size() > 0 ? w.all : w.mass;
  } else if constexpr (all::SizeAtCompileTime > 0) {
    return w.all;
  } else {
    return w.mass;
  }
}

/// Articulated bodies. By row of a coordinate: what is kept of joints (`joint_response`), and masses of their own.
template <class S, class Sizes>
struct articulated_memory {
  of_each_frame<Sizes, burden<dense_articulated<S>, dense_wrench<S>>> burdens;
  of_each_frame<Sizes, dense_acceleration<S>> accelerations;
  list_of<Sizes, S, Sizes::coordinates> own_mass;
  list_of<Sizes, dense_wrench<S>, Sizes::dofs> gains;
  list_of<Sizes, S, Sizes::dofs> rates;
  list_of<Sizes, std::array<S, 6>, Sizes::dofs> inverses;
  list_of<Sizes, char, Sizes::dofs> prescribed;  ///< whether its acceleration is given
  bool good = true;
  void make(const sizes_of_chain& n) {
    burdens.make(n), accelerations.make(n);
    own_mass.resize(n.coordinates), gains.resize(n.dofs), rates.resize(n.dofs), inverses.resize(n.dofs);
    prescribed.resize(n.dofs);
  }
};

/// The inverse of the mass matrix, beside articulated bodies: what comes down from a unit force on row `unit`, what it
/// leaves on all axes and how fast they answer; of all rows before, row by row
/// (dynamics/detail/local_inverse_mass.hpp).
template <class S, class Sizes>
struct inverse_memory {
  dense_wrench<S> load{};
  int unit = -1;
  vector_of_size<Sizes, S, Sizes::dofs> left, rate;  ///< made by the first call, as the next
  matrix_of_size<Sizes, S, Sizes::dofs> all_left;
};

/// Derivatives of the forces. A column is a change of wrench by displacement and by rate, and a sensitivity
/// (kernels/variation.hpp).
template <class S, class Sizes>
struct variation_memory {
  struct axis {
    dense_wrench<S> by_q, by_v;
    sensitivity<vec3<S>, vec3<S>, vec3<S>> row;
  };
  of_each_frame<Sizes, dense_body<S>> bodies;
  list_of<Sizes, axis, Sizes::columns> axes;
  list_of<Sizes, int, Sizes::columns> row_of_axis;  ///< or -1
  inverse_dynamics_result<S, Sizes::fixed ? static_cast<int>(Sizes::dofs) : Eigen::Dynamic>* derivatives = nullptr;
  void make(const sizes_of_chain& n) { bodies.make(n), axes.resize(n.columns), row_of_axis.resize(n.columns); }
};

/// The Jacobian of a frame, over all coordinates, and where the frame stands in the element at hand.
template <class S>
struct jacobian_memory {
  pose<mat3<vec3<S>>, vec3<S>> seen{};
  Eigen::Matrix<S, 6, Eigen::Dynamic> jacobian;
};

}  // namespace kte::detail
