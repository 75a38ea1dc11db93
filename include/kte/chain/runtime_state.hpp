#pragma once

#include <kte/chain/state.hpp>
#include <kte/chain/topology.hpp>
#include <kte/frames/frame_2D.hpp>
#include <kte/frames/frame_3D.hpp>
#include <kte/frames/gen_coord.hpp>
#include <kte/math/rigid_body.hpp>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace kte {

using wrench_3D = wrench<vec3<>, vec3<>>;
using composite_3D = composite<double, vec3<>, sym3<>>;

/// The state of a runtime chain: every coordinate, frame and input by name, and the working memory of the algorithms,
/// so that they allocate nothing.
///
///   s.frame_2D("joint").position,  s.coordinate("q").q_ddot,  s.input("motor") = 2.0
class runtime_state {
 public:
  explicit runtime_state(std::shared_ptr<const topology> t)
      : topology_(std::move(t)),
        coordinates_(count(kind::gen)),
        frames_2D_(count(kind::frame_2D)),
        frames_3D_(count(kind::frame_3D)),
        inputs_(count(kind::input)),
        work(count(kind::gen), topology_->dofs.size(), count(kind::frame_2D), count(kind::frame_3D)) {}

  /// By name; throws `unknown_name`.
  gen_coord<>& coordinate(std::string_view name) { return coordinates_[find(name, kind::gen)]; }
  const gen_coord<>& coordinate(std::string_view name) const { return coordinates_[find(name, kind::gen)]; }
  kte::frame_2D<>& frame_2D(std::string_view name) { return frames_2D_[find(name, kind::frame_2D)]; }
  const kte::frame_2D<>& frame_2D(std::string_view name) const { return frames_2D_[find(name, kind::frame_2D)]; }
  kte::frame_3D<>& frame_3D(std::string_view name) { return frames_3D_[find(name, kind::frame_3D)]; }
  const kte::frame_3D<>& frame_3D(std::string_view name) const { return frames_3D_[find(name, kind::frame_3D)]; }
  double& input(std::string_view name) { return inputs_[find(name, kind::input)]; }
  double input(std::string_view name) const { return inputs_[find(name, kind::input)]; }

  /// Degree of freedom i.
  gen_coord<>& coordinate(int i) { return coordinates_[static_cast<std::size_t>(dof(i))]; }
  const gen_coord<>& coordinate(int i) const { return coordinates_[static_cast<std::size_t>(dof(i))]; }
  int dofs() const { return static_cast<int>(topology_->dofs.size()); }

  /// Thing i of kind K, for the passes.
  template <kind K>
  auto& get(int i) {
    return get<K>(*this, static_cast<std::size_t>(i));
  }
  template <kind K>
  const auto& get(int i) const {
    return get<K>(*this, static_cast<std::size_t>(i));
  }
  /// What this state was made for.
  const std::shared_ptr<const topology>& made_for() const { return topology_; }

 private:
  std::size_t count(kind k) const { return topology_->names[static_cast<std::size_t>(k)].size(); }
  std::size_t find(std::string_view name, kind k) const { return static_cast<std::size_t>(topology_->find(name, k)); }
  int dof(int i) const { return topology_->dofs[static_cast<std::size_t>(i)]; }
  template <kind K, class Self>
  static auto& get(Self& s, std::size_t i) {
    return detail::of_kind<K>(s.coordinates_, s.frames_2D_, s.frames_3D_, s.inputs_)[i];
  }

  std::shared_ptr<const topology> topology_;
  std::vector<gen_coord<>> coordinates_;
  std::vector<kte::frame_2D<>> frames_2D_;
  std::vector<kte::frame_3D<>> frames_3D_;
  std::vector<double> inputs_;

 public:
  /// Working memory of the algorithms; nothing in it needs to be read or kept.
  struct workspace {
    workspace(std::size_t coordinates, std::size_t dofs, std::size_t in_plane, std::size_t in_space)
        : carried{std::vector<composite_3D>(in_plane), std::vector<composite_3D>(in_space)},
          all(Eigen::MatrixXd::Zero(Eigen::Index(coordinates), Eigen::Index(coordinates))),
          mass(Eigen::MatrixXd::Zero(Eigen::Index(dofs), Eigen::Index(dofs))),
          forces(Eigen::VectorXd::Zero(Eigen::Index(dofs))) {}

    std::vector<composite_3D> carried[2];  ///< inertia carried by each frame, in the plane and in space
    Eigen::MatrixXd all;                   ///< mass matrix over all coordinates
    Eigen::MatrixXd mass;                  ///< over the degrees of freedom
    Eigen::VectorXd forces;
  } work;
};

}  // namespace kte
