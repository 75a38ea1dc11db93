#pragma once

#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/elements/registry.hpp>
#include <kte/io/model_inputs.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/math/axis_angle.hpp>

#include "acting.hpp"
#include "damping.hpp"

namespace kte::page {

/// The mechanism of a model file: poses of its frames, energies, and its chain with the forces of the viewer.
class mechanism {
 public:
  /// A model file's text in JSON. Throws `bad_file` and what chains throw.
  explicit mechanism(std::string_view json)
      : record_(from_json(json, "the model")),
        chain_(to_chain(record_)),
        model_(modelled(chain_)),
        state_(chain_.make_state()) {}

  const dynamics_model& model() const { return model_; }
  /// A model of a chain with these elements, its inputs as the file has them.
  dynamics_model modelled(const runtime_chain& c) const {
    dynamics_model m(c);
    detail::restore_inputs(record_, m);
    return m;
  }

  /// Chooses the frames of `poses`. Throws `unknown_name`; then all is as before.
  void track(const std::vector<std::string>& names) {
    std::vector<handle> all;
    for (const auto& name : names) all.push_back(chain_.frame(name));
    tracks_ = std::move(all);
  }
  /// Poses of the tracked frames at q: x y z and the quaternion w x y z of each.
  template <indexable Q>
  const std::vector<double>& poses(const Q& q) {
    put(0, model_.make_x(q, Eigen::VectorXd::Zero(model_.dofs()).eval()));
    poses_.clear();
    for (const auto& frame : tracks_) {
      const auto at = forward_kinematics(chain_, state_, frame);
      const auto turn = to_quaternion(at.rotation);
      poses_.insert(poses_.end(), {at.position.x, at.position.y, at.position.z, turn.w, turn.x, turn.y, turn.z});
    }
    return poses_;
  }
  /// Forward dynamics, with the inputs of the file.
  template <indexable Q, indexable V>
  const Eigen::VectorXd& accelerations(const Q& q, const V& v) {
    rate_ = model_.computeStateRate(0, model_.make_x(q, v)).segment(model_.dofs(), model_.dofs());
    return rate_;
  }
  /// The energies of the mechanism alone, J.
  energies<double> energy_at(double t, const Eigen::VectorXd& x) {
    put(t, x);
    return energy(chain_, state_);
  }

  /// The chain and a pull on a frame. Throws `unknown_name`.
  runtime_chain pulled(runtime_chain c, const page_pull& by) const {
    if (chain_.frame(by.frame).what() == kind::frame_2D)
      c << pull_2D(by.frame, by);
    else
      c << pull_3D(by.frame, by);
    return c;
  }
  /// The chain and damping of all coordinates.
  runtime_chain damped(runtime_chain c, const double& damping) const {
    for (const auto& f : chain_.wiring().free)
      for (int i = 0; i < f.in_row; ++i) {
        const auto& name =
            chain_.wiring().names[static_cast<std::size_t>(f.what)][static_cast<std::size_t>(f.slot + i)];
        switch (f.what) {
          case kind::rotation_3D:
            c << connect(coordinate_damping<kind::rotation_3D>{{}, &damping}, name);
            break;
          case kind::pose_2D:
            c << connect(coordinate_damping<kind::pose_2D>{{}, &damping}, name);
            break;
          case kind::pose_3D:
            c << connect(coordinate_damping<kind::pose_3D>{{}, &damping}, name);
            break;
          default:
            c << connect(coordinate_damping<kind::gen>{{}, &damping}, name);
        }
      }
    return c;
  }
  const runtime_chain& chain() const { return chain_; }
  /// Loads in the model of a chain with these elements, and perhaps more.
  acting acting_in(const dynamics_model& m) const { return {m, tracks_}; }
  std::size_t track_count() const { return tracks_.size(); }

 private:
  void put(double t, const Eigen::VectorXd& x) { model_.setJointStates(t, x, state_); }

  model_record record_;
  runtime_chain chain_;
  dynamics_model model_;
  runtime_state state_;
  std::vector<handle> tracks_;
  std::vector<double> poses_;
  Eigen::VectorXd rate_;
};

}  // namespace kte::page
