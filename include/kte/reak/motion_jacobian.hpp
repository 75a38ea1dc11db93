#pragma once

#include <kte/contract/key.hpp>
#include <kte/frames/frame_2D.hpp>
#include <kte/math/eigen.hpp>

#include <Eigen/Core>

#include <array>

/// Motion Jacobians as values: the derivative of the motion of a frame or coordinate by the rates of one coordinate,
/// with its time derivative.
namespace kte {

/// The motion of a frame or coordinate per unit of one rate: `velocity` and `ang_velocity`, or `q_dot`, in axes of the
/// frame, and their time derivatives `velocity_rate`, `ang_velocity_rate`, `q_dot_rate` as numbers in these axes.
template <kind Moved, class S = double>
struct partial_motion;
template <class S>
struct partial_motion<kind::gen, S> {
  S q_dot{};
  S q_dot_rate{};
};
template <class S>
struct partial_motion<kind::frame_2D, S> {
  vec2<S> velocity{};
  S ang_velocity{};
  vec2<S> velocity_rate{};
  S ang_velocity_rate{};
};
template <class S>
struct partial_motion<kind::frame_3D, S> {
  vec3<S> velocity{};
  vec3<S> ang_velocity{};
  vec3<S> velocity_rate{};
  vec3<S> ang_velocity_rate{};
};

namespace detail {
/// The form for kernels: planar frames as spatial frames, with typed zeros out of the plane.
template <class U, class W>
struct spatial_partial {
  U velocity;
  W ang_velocity;
  U velocity_rate;
  W ang_velocity_rate;
};
template <class S>
constexpr auto spatial(const partial_motion<kind::frame_2D, S>& x) {
  return spatial_partial<vec3<S, S, zero_t>, vec3<zero_t, zero_t, S>>{
      in_plane(x.velocity), about_z(x.ang_velocity), in_plane(x.velocity_rate), about_z(x.ang_velocity_rate)};
}
template <class S>
constexpr const auto& spatial(const partial_motion<kind::frame_3D, S>& x) {
  return x;
}
constexpr int rows_of_moved(kind k) { return k == kind::gen ? 1 : k == kind::frame_2D ? 3 : 6; }

/// Writes numbers to rows i, i + 1 ... of a column.
template <class Column, class S>
void put_numbers(Column& c, int& i, const S& x) {
  c[i++] = x;
}
template <class Column, class S>
void put_numbers(Column& c, int& i, const vec2<S>& x) {
  c[i++] = x.x, c[i++] = x.y;
}
template <class Column, class S>
void put_numbers(Column& c, int& i, const vec3<S>& x) {
  c[i++] = x.x, c[i++] = x.y, c[i++] = x.z;
}
}  // namespace detail

/// The Jacobian of a frame (or generalized coordinate) by the rates of one coordinate, with its time derivative.
///   Joint   the coordinate: gen, rotation_3D, pose_2D, pose_3D
///   Moved   frame_2D, frame_3D, or gen; `joint` and `moved` are these kinds
/// `rows` are velocity before angular velocity, in axes of the frame; each `column` is a rate of the coordinate, linear
/// before angular.
template <kind Joint, kind Moved, class S = double>
requires(is_coordinate(Joint) && !is_signal(Moved)) struct motion_jacobian {
  static constexpr kind joint = Joint, moved = Moved;
  using scalar = S;
  static constexpr int rows = detail::rows_of_moved(Moved), columns = nv_of(Joint);  ///< of the matrix
  using matrix_type = Eigen::Matrix<S, rows, columns>;

  std::array<partial_motion<Moved, S>, std::size_t{columns}> column{};

  /// The Jacobian as a matrix.
  [[nodiscard]] matrix_type matrix() const {
    return filled([](const auto& x, const auto& put) {
      if constexpr (Moved == kind::gen)
        put(x.q_dot);
      else
        put(x.velocity), put(x.ang_velocity);
    });
  }
  /// The time derivative of `matrix()`.
  [[nodiscard]] matrix_type rate() const {
    return filled([](const auto& x, const auto& put) {
      if constexpr (Moved == kind::gen)
        put(x.q_dot_rate);
      else
        put(x.velocity_rate), put(x.ang_velocity_rate);
    });
  }

  /// The Jacobian of another frame X, with the motion `m` in this one: at p, R, with v, w in axes of X
  /// (frames/motion.hpp).
  ///
  ///   u' = R^T (u + w x p),   w' = R^T w                                              (1)
  ///   du'/dt = R^T (du/dt + dw/dt x p) + w' x v - w_X x u',   dw'/dt = R^T dw/dt - w_X x w'          (2)
  template <class M>
  [[nodiscard]] motion_jacobian at(const M& m) const requires(Moved != kind::gen) {
    motion_jacobian there;
    for (std::size_t k = 0; k < column.size(); ++k) {
      const auto x = detail::spatial(column[k]);
      const auto back = transpose(m.rotation);
      const auto u = back * (x.velocity + cross(x.ang_velocity, m.position));  // (1)
      const auto w = back * x.ang_velocity;
      const auto du = back * (x.velocity_rate + cross(x.ang_velocity_rate, m.position)) +
                      (cross(w, m.velocity) - cross(m.ang_velocity, u));  // (2)
      const auto dw = back * x.ang_velocity_rate - cross(m.ang_velocity, w);
      using namespace detail;
      if constexpr (Moved == kind::frame_2D)
        there.column[k] = {planar_part<S>(u), normal_part<S>(w), planar_part<S>(du), normal_part<S>(dw)};
      else
        there.column[k] = {as<S>(u), as<S>(w), as<S>(du), as<S>(dw)};
    }
    return there;
  }

 private:
  template <class Numbers>
  matrix_type filled(const Numbers& numbers) const {
    matrix_type m;
    for (int k = 0; k < columns; ++k) {
      auto to = m.col(k);
      int i = 0;
      numbers(column[static_cast<std::size_t>(k)], [&](const auto& x) { detail::put_numbers(to, i, x); });
    }
    return m;
  }
};

// By joint and frame, in the plane and in space.
/// The Jacobian of a generalized coordinate by one.
template <class S = double>
using jacobian_gen_gen = motion_jacobian<kind::gen, kind::gen, S>;
/// The Jacobian of a frame in the plane by a generalized coordinate.
template <class S = double>
using jacobian_gen_2D = motion_jacobian<kind::gen, kind::frame_2D, S>;
/// The Jacobian of a frame in space by a generalized coordinate.
template <class S = double>
using jacobian_gen_3D = motion_jacobian<kind::gen, kind::frame_3D, S>;
/// The Jacobian of a generalized coordinate by a pose in the plane.
template <class S = double>
using jacobian_2D_gen = motion_jacobian<kind::pose_2D, kind::gen, S>;
/// The Jacobian of a frame in the plane by a pose in the plane.
template <class S = double>
using jacobian_2D_2D = motion_jacobian<kind::pose_2D, kind::frame_2D, S>;
/// The Jacobian of a frame in space by a pose in the plane.
template <class S = double>
using jacobian_2D_3D = motion_jacobian<kind::pose_2D, kind::frame_3D, S>;
/// The Jacobian of a generalized coordinate by a pose in space.
template <class S = double>
using jacobian_3D_gen = motion_jacobian<kind::pose_3D, kind::gen, S>;
/// The Jacobian of a frame in the plane by a pose in space.
template <class S = double>
using jacobian_3D_2D = motion_jacobian<kind::pose_3D, kind::frame_2D, S>;
/// The Jacobian of a frame in space by a pose in space.
template <class S = double>
using jacobian_3D_3D = motion_jacobian<kind::pose_3D, kind::frame_3D, S>;

}  // namespace kte
