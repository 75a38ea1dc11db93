#pragma once

#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/closed_loops/constrained_dynamics.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/runtime_chain.hpp>

#include <string>
#include <vector>

namespace evaluate {

/// Throws `kte::unknown_name` for frames that the chain has not, and `kte::bad_argument` for those of the plane.
inline void check_frames(const kte::runtime_chain& chain, const std::vector<std::string>& frames) {
  for (const auto& name : frames)
    if (chain.frame(name).what() != kte::kind::frame_3D)
      throw kte::bad_argument("kte: the frame '" + name + "' is a frame in the plane: its Jacobian is not printed");
}

/// A runtime chain as rows want it (rows.hpp), in numbers S.
template <class S>
class runtime_model {
 public:
  using scalar = S;
  using vector = std::vector<S>;

  /// Throws as `check_frames`.
  runtime_model(const kte::runtime_chain& chain, const std::vector<std::string>& frames)
      : chain_(chain), state_(chain.make_state<S>()), frames_(frames) {
    check_frames(chain, frames);
  }

  auto layout() const { return kte::layout(chain_); }
  const auto& inverse_dynamics(const vector& q, const vector& v, const vector& a) {
    return kte::inverse_dynamics(chain_, state_, q, v, a);
  }
  /// Throws `kte::bad_argument` where loops are open by more than 1e-8 m or rad.
  const auto& forward_dynamics(const vector& q, const vector& v, const vector& tau) {
    if constexpr (std::is_same_v<S, double>) {
      if (kte::detail::has_loops(chain_))
        if (const auto at = kte::loops(chain_, state_, q); !(at.gap <= 1e-8))
          throw kte::bad_argument("kte: the loops are open: '" + at.widest + "' by " + kte::detail::number(at.gap) +
                                  " m or rad");
    }
    return kte::forward_dynamics(chain_, state_, q, v, tau);
  }
  const auto& mass_matrix(const vector& q) { return kte::mass_matrix(chain_, state_, q); }
  /// Of numbers other than double from M and the centre of mass: states of such have no springs.
  kte::energies<S> energy(const vector& q, const vector& v) {
    if constexpr (std::is_same_v<S, double>) {
      return kte::energy(chain_, state_, q, v);
    } else {
      const auto& m = mass_matrix(q);
      S twice = 0;
      for (Eigen::Index i = 0; i < m.rows(); ++i)
        for (Eigen::Index j = 0; j < m.cols(); ++j)
          twice += v[static_cast<std::size_t>(i)] * m(i, j) * v[static_cast<std::size_t>(j)];
      const auto all = centre_of_mass(q);
      return {twice / 2, S(-all.mass * dot(kte::as<S>(chain_.gravity()), all.position))};
    }
  }
  auto centre_of_mass(const vector& q) { return kte::centre_of_mass(chain_, state_, q); }
  const auto& inverse_derivatives(const vector& q, const vector& v, const vector& a) {
    return kte::inverse_dynamics_derivatives(chain_, state_, q, v, a);
  }
  const auto& forward_derivatives(const vector& q, const vector& v, const vector& tau) {
    return kte::forward_dynamics_derivatives(chain_, state_, q, v, tau);
  }
  /// visit(name, pose, Jacobian in axes of the world)
  template <class Visit>
  void for_each_frame(const vector& q, const Visit& visit) {
    for (const auto& name : frames_)
      visit(name, kte::forward_kinematics(chain_, state_, q, name),
            kte::jacobian(chain_, state_, q, name, kte::in_world_axes));
  }

 private:
  const kte::runtime_chain& chain_;
  kte::basic_runtime_state<S> state_;
  std::vector<std::string> frames_;
};

}  // namespace evaluate
