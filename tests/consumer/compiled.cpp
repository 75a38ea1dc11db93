// What a user of kte::compiled writes: the pendulum of main.cpp from a model file.
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/elements/registry.hpp>
#include <kte/io/model_reader.hpp>

#include <cmath>

#ifndef KTE_COMPILED
#  error "kte::compiled says nothing to who links it"
#endif

int main() {
  const auto pendulum =
      kte::to_chain(kte::from_json(R"({"kte_model": {"version": 1, "gravity": "0 -9.81 0", "elements": [
    {"type": "revolute_joint_3D", "version": 1, "ports": {"coordinate": "q", "base": "base", "end": "arm"},
     "parameters": {"axis": "0 0 1"}},
    {"type": "inertia_3D", "version": 1, "ports": {"frame": "arm"},
     "parameters": {"mass": "2", "com": "0.5 0 0", "inertia": "0.1 0 0 0.1 0 0.1"}}]}})"));
  auto s = pendulum.make_state();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  const double moment = 2 * 0.5 * 9.81, inertia = 0.1 + 2 * 0.5 * 0.5;
  const bool good = std::abs(kte::inverse_dynamics(pendulum, s, zero, zero, zero)[0] - moment) < 1e-12 &&
                    std::abs(kte::mass_matrix(pendulum, s, zero)(0, 0) - inertia) < 1e-12 &&
                    std::abs(kte::forward_dynamics(pendulum, s, zero, zero, zero)[0] + moment / inertia) < 1e-12;
  return good ? 0 : 1;
}
