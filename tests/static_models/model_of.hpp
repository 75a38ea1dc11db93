#pragma once

#include <kte/dynamics.hpp>

#include <optional>
#include <string_view>

#include "chain/models.hpp"
#include "dynamics/small_chains.hpp"
#include "static_models/static_model.hpp"

namespace kte::test::static_models {

template <class S, class Chain, class... Frames>
class model_of final : public static_model<S> {
  using base = static_model<S>;
  using typename base::body, typename base::matrix, typename base::placed, typename base::vector;
  using typename base::vector3, typename base::vector6;
  Chain c_;

  /// f(frame) of the frame of this name.
  template <class Result, class F>
  static Result at(std::string_view name, const F& f) {
    std::optional<Result> result;
    ((Frames::name == name ? void(result = f(Frames{})) : void()), ...);
    return result.value();
  }

 public:
  explicit model_of(const Chain& c) : c_(c) {}
  int dofs() const override { return Chain::dofs; }
  vec3<> gravity() const override { return as<double>(c_.gravity()); }
  vector integrate(const vector& q, const vector& v, const S& t) const override { return kte::integrate(c_, q, v, t); }

  vector inverse_dynamics(const vector& q, const vector& v, const vector& a) const override {
    return kte::inverse_dynamics(c_, q, v, a);
  }
  matrix mass_matrix(const vector& q) const override { return kte::mass_matrix(c_, q); }
  vector static_forces(const vector& q) const override { return kte::static_forces(c_, q); }
  vector gravity_forces(const vector& q) const override { return kte::gravity_forces(c_, q); }
  vector nonlinear_effects(const vector& q, const vector& v) const override { return kte::nonlinear_effects(c_, q, v); }
  vector coriolis_forces(const vector& q, const vector& v) const override { return kte::coriolis_forces(c_, q, v); }

  S potential_energy(const vector& q) const override { return kte::potential_energy(c_, q); }
  S kinetic_energy(const vector& q, const vector& v) const override { return kte::kinetic_energy(c_, q, v); }
  energies<S> energy(const vector& q, const vector& v) const override { return kte::energy(c_, q, v); }
  vector generalized_momenta(const vector& q, const vector& v) const override {
    return kte::generalized_momenta(c_, q, v);
  }

  mass_centre<S> centre_of_mass(const vector& q) const override { return kte::centre_of_mass(c_, q); }
  vector3 centre_of_mass_velocity(const vector& q, const vector& v) const override {
    return small_chains::eigen(kte::centre_of_mass_velocity(c_, q, v));
  }
  vector6 centroidal_momentum(const vector& q, const vector& v) const override {
    return small_chains::eigen(kte::centroidal_momentum(c_, q, v));
  }
  matrix centroidal_momentum_matrix(const vector& q) const override { return kte::centroidal_momentum_matrix(c_, q); }
  std::vector<std::pair<body, frame_3D<S>>> bodies(const vector& q, const vector& v) const override {
    auto s = make_state<S>(c_);
    set_positions(s, q), set_velocities(s, v);
    c_.doMotion(s);
    std::vector<std::pair<body, frame_3D<S>>> all;
    boost::hana::for_each(c_.elements(),
                          [&]<class Core, class Key, class... Keys>(const element<Core, Key, Keys...>& e) {
                            if constexpr (requires { e.core.body; }) {
                              auto& [b, frame] = all.emplace_back();
                              b = {as<S>(e.core.body.mass), as<S>(e.core.body.com), as<S>(e.core.body.inertia)};
                              const auto& x = spatial(s[Key{}]);
                              frame.position = as<S>(x.position), frame.rotation = as<S>(kte::matrix(x.rotation));
                              frame.velocity = as<S>(x.velocity), frame.ang_velocity = as<S>(x.ang_velocity);
                            }
                          });
    return all;
  }

  placed forward_kinematics(const vector& q, const char* frame) const override {
    return at<placed>(frame, [&](auto f) { return small_chains::in_space(kte::forward_kinematics(c_, q, f)); });
  }
  vector6 frame_velocity(const vector& q, const vector& v, const char* frame) const override {
    return at<vector6>(frame, [&](auto f) { return small_chains::eigen(kte::frame_velocity(c_, q, v, f)); });
  }
  vector6 frame_acceleration(const vector& q, const vector& v, const vector& a, const char* frame) const override {
    return at<vector6>(frame, [&](auto f) { return small_chains::eigen(kte::frame_acceleration(c_, q, v, a, f)); });
  }
  matrix jacobian(const vector& q, const char* frame) const override {
    return at<matrix>(frame, [&](auto f) { return kte::jacobian(c_, q, f); });
  }
  matrix jacobian(const vector& q, const char* frame, in_world_axes_t axes) const override {
    return at<matrix>(frame, [&](auto f) { return kte::jacobian(c_, q, f, axes); });
  }
};

template <class Chain, class... Frames>
model made(const Chain& c, const Frames&...) {
  static const model_of<double, Chain, Frames...> in_double(c);
  static const model_of<digits50, Chain, Frames...> exact(c), weightless(c.gravity(c.gravity() * 0.0));
  return {in_double, exact, weightless, models::element_by_element(c)};
}

}  // namespace kte::test::static_models
