#pragma once

#include <kte/chain/plan.hpp>
#include <kte/kernels/articulate.hpp>
#include <kte/kernels/derivatives.hpp>
#include <kte/kernels/variation.hpp>

#include <Eigen/Core>

#include <algorithm>

/// Working memory of the algorithms that are loops over elements (chain/plan.hpp), so that they allocate nothing. Each
/// has a part of its own, of the sizes of the chain.
namespace kte::detail {

template <class S, std::size_t N>
using vector_of_size = Eigen::Matrix<S, static_cast<int>(N), 1>;
template <class S, std::size_t N>
using matrix_of_size = Eigen::Matrix<S, static_cast<int>(N), static_cast<int>(N)>;

/// Whatever is wanted of every frame.
template <class Sizes, class T>
struct of_each_frame {
  std::array<T, Sizes::in_plane> in_plane;
  std::array<T, Sizes::in_space> in_space;
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
  vector_of_size<S, Sizes::dofs> forces;
};

/// The mass matrix.
template <class S, class Sizes>
struct mass_memory {
  of_each_frame<Sizes, dense_composite<S>> carried;
  /// The wrench that accelerates an axis, as felt further down, by its components.
  std::array<std::array<S, Sizes::columns>, 6> column;
  std::array<int, Sizes::columns> row_of_column;
  matrix_of_size<S, (Sizes::coordinates > Sizes::dofs ? Sizes::coordinates : 0)> all;  ///< if there are others
  matrix_of_size<S, Sizes::dofs> mass;
};

/// The one that the algorithm fills.
template <class Memory>
auto& matrix_over_all(Memory& w) {
  if constexpr (decltype(w.all)::SizeAtCompileTime > 0) {
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
  std::array<S, Sizes::coordinates> own_mass;
  std::array<dense_wrench<S>, Sizes::dofs> gains;
  std::array<S, Sizes::dofs> rates;
  std::array<std::array<S, 6>, Sizes::dofs> inverses;
  std::array<char, Sizes::dofs> prescribed;  ///< whether its acceleration is given
  bool good = true;
};

/// The inverse of the mass matrix, beside articulated bodies: what comes down from a unit force on row `unit`, what it
/// leaves on all axes and how fast they answer; of all rows before, row by row
/// (dynamics/detail/local_inverse_mass.hpp).
template <class S, class Sizes>
struct inverse_memory {
  dense_wrench<S> load{};
  int unit = -1;
  vector_of_size<S, Sizes::dofs> left, rate;
  matrix_of_size<S, Sizes::dofs> all_left;
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
  std::array<axis, Sizes::columns> axes;
  std::array<int, Sizes::columns> row_of_axis;  ///< or -1
  inverse_dynamics_result<S, static_cast<int>(Sizes::dofs)>* derivatives = nullptr;
};

}  // namespace kte::detail
