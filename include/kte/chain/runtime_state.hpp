#pragma once

#include <kte/chain/state.hpp>
#include <kte/chain/workspace.hpp>

#include <memory>

namespace kte {

/// The state of a runtime chain: every coordinate, frame and input by name, and the working memory of the algorithms.
///
///   s.frame_2D("joint").position,  s.coordinate("q").q_ddot,  s.input("motor") = 2.0
class runtime_state {
 public:
  explicit runtime_state(std::shared_ptr<const topology> t) : topology_(std::move(t)), work(*topology_) {
    resize(std::make_index_sequence<kinds>{});
    for (const auto& f : topology_->free)
      if (f.what == kind::gen) free_coordinates_.push_back(f.slot);
  }

  /// Thing i of kind K, for the passes.
  template <kind K>
  auto& get(int i) {
    return detail::of_kind<K>(things_)[static_cast<std::size_t>(i)];
  }
  template <kind K>
  const auto& get(int i) const {
    return detail::of_kind<K>(things_)[static_cast<std::size_t>(i)];
  }

 private:
  template <kind K, class Self>
  static auto& at(Self& s, std::string_view name) {
    return detail::of_kind<K>(s.things_)[static_cast<std::size_t>(s.topology_->find(name, K))];
  }

 public:
  /// By name; throws `unknown_name`.
  gen_coord<>& coordinate(std::string_view name) { return at<kind::gen>(*this, name); }
  const gen_coord<>& coordinate(std::string_view name) const { return at<kind::gen>(*this, name); }
  kte::frame_2D<>& frame_2D(std::string_view name) { return at<kind::frame_2D>(*this, name); }
  const kte::frame_2D<>& frame_2D(std::string_view name) const { return at<kind::frame_2D>(*this, name); }
  kte::frame_3D<>& frame_3D(std::string_view name) { return at<kind::frame_3D>(*this, name); }
  const kte::frame_3D<>& frame_3D(std::string_view name) const { return at<kind::frame_3D>(*this, name); }
  double& input(std::string_view name) { return at<kind::input>(*this, name); }
  double input(std::string_view name) const { return at<kind::input>(*this, name); }
  rotation_coord_3D<>& rotation_3D(std::string_view name) { return at<kind::rotation_3D>(*this, name); }
  const rotation_coord_3D<>& rotation_3D(std::string_view name) const { return at<kind::rotation_3D>(*this, name); }
  pose_coord_2D<>& pose_2D(std::string_view name) { return at<kind::pose_2D>(*this, name); }
  const pose_coord_2D<>& pose_2D(std::string_view name) const { return at<kind::pose_2D>(*this, name); }
  pose_coord_3D<>& pose_3D(std::string_view name) { return at<kind::pose_3D>(*this, name); }
  const pose_coord_3D<>& pose_3D(std::string_view name) const { return at<kind::pose_3D>(*this, name); }

  /// Number i of the generalized coordinates that are degrees of freedom.
  gen_coord<>& coordinate(int i) { return get<kind::gen>(free_coordinates_[static_cast<std::size_t>(i)]); }
  const gen_coord<>& coordinate(int i) const { return get<kind::gen>(free_coordinates_[static_cast<std::size_t>(i)]); }
  /// Degrees of freedom, and numbers of a configuration.
  int dofs() const { return topology_->nv; }
  int nq() const { return topology_->nq; }

  /// What this state was made for.
  const std::shared_ptr<const topology>& made_for() const { return topology_; }

 private:
  template <std::size_t... K>
  void resize(std::index_sequence<K...>) {
    (std::get<K>(things_).resize(topology_->names[K].size()), ...);
  }
  template <class Kinds>
  struct lists;
  template <std::size_t... K>
  struct lists<std::index_sequence<K...>> {
    using type = std::tuple<std::vector<detail::thing_of<static_cast<kind>(K), double>>...>;
  };

  std::shared_ptr<const topology> topology_;
  typename lists<std::make_index_sequence<kinds>>::type things_;
  std::vector<int> free_coordinates_;

 public:
  /// Working memory of the algorithms; nothing in it needs to be read or kept.
  detail::workspace work;
};

}  // namespace kte
