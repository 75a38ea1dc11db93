#pragma once

#include <kte/dynamics/derivatives.hpp>
#include <kte/static.hpp>

#include <string>
#include <vector>

namespace evaluate {

/// A static chain as rows want it (rows.hpp), in numbers S; Frames are the keys of frames.
template <class S, class Chain, class... Frames>
class static_model {
 public:
  using scalar = S;
  using vector = std::vector<S>;

  explicit static_model(const Chain& chain) : chain_(chain) {}

  auto layout() const { return kte::layout(chain_); }
  auto inverse_dynamics(const vector& q, const vector& v, const vector& a) const {
    return kte::inverse_dynamics(chain_, q, v, a);
  }
  auto forward_dynamics(const vector& q, const vector& v, const vector& tau) const {
    return kte::forward_dynamics(chain_, q, v, tau);
  }
  auto mass_matrix(const vector& q) const { return kte::mass_matrix(chain_, q); }
  auto energy(const vector& q, const vector& v) const { return kte::energy(chain_, q, v); }
  auto centre_of_mass(const vector& q) const { return kte::centre_of_mass(chain_, q); }
  auto inverse_derivatives(const vector& q, const vector& v, const vector& a) const {
    return kte::inverse_dynamics_derivatives(chain_, q, v, a);
  }
  auto forward_derivatives(const vector& q, const vector& v, const vector& tau) const {
    return kte::forward_dynamics_derivatives(chain_, q, v, tau);
  }
  template <class Visit>
  void for_each_frame(const vector& q, const Visit& visit) const {
    (visit(std::string(Frames::name), kte::forward_kinematics(chain_, q, Frames{}),
           kte::jacobian(chain_, q, Frames{}, kte::in_world_axes)),
     ...);
  }

 private:
  const Chain& chain_;
};

}  // namespace evaluate
