#pragma once

#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/elements/registry.hpp>

#include "simulate/plant.hpp"
#include "simulate/time_table.hpp"
#include "state_input.hpp"
#include "text_format.hpp"

namespace kte_tool {

/// The chain with a force on each of its coordinates of one number, as their own inputs.
struct driven_chain {
  kte::runtime_chain chain;
  std::vector<std::string> force_of;  ///< over v: the name of the input, or empty

  explicit driven_chain(const kte::runtime_chain& c) : chain(c), force_of(static_cast<std::size_t>(c.dofs())) {
    const auto registry = kte::element_registry::standard();
    for (const auto& e : kte::layout(c)) {
      if (e.nv != 1) continue;
      auto& input = force_of[static_cast<std::size_t>(e.v)];
      input = "tau/" + e.name;
      while (has_signal(input)) input += '\'';
      chain.append(registry.make({"driving_actuator_gen", 1, {{"coordinate", e.name}, {"input", input}}, {}}));
    }
  }

 private:
  bool has_signal(const std::string& name) const {
    for (const auto& names : chain.wiring().names)
      if (std::find(names.begin(), names.end(), name) != names.end()) return true;
    return false;
  }
};

/// Where inputs stand in u.
inline int place_of_input(const plant::model_type& m, const std::string& name) {
  int place = -1;
  kte::detail::for_each_input(m, [&](std::string_view known, int u, int n) {
    if (known == name && n == 1) place = u;
  });
  return place;
}

/// PD control of the coordinates of one number to a table of targets, within the limits of their efforts:
///
///   tau = kp (q* - q) + kd (v* - v) + g(q)          (1)
///
/// v* is that of the table, or the slope of q*; g, the forces against gravity, is optional. Gains that
/// are not given are those of a critically damped oscillator of 10 rad/s with the largest mass that the coordinate
/// feels at the start and at targets: kp = 100 M_ii, kd = 20 M_ii.
class pd_control {
 public:
  struct joint {
    std::string name;
    int q, v, u;
    double kp, kd, effort;
  };

  pd_control(const evaluate::state_table& table, const mechanism& m, const kte::runtime_chain& c, bool compensates)
      : input_(table, m, c, true),
        chain_(c),
        state_(c.make_state()),
        compensates_(compensates),
        q_(table, c.nq(), [this](std::size_t row, Eigen::VectorXd& x) { input_.read_q(row, x); }),
        v_(table, c.dofs(), [this](std::size_t row, Eigen::VectorXd& x) { input_.read_v(row, x); }) {}

  /// A coordinate, if the table has a target for it.
  void add(const joint& j) {
    if (input_.has_q(j.q)) joints_.push_back(j);
  }
  const std::vector<joint>& joints() const { return joints_; }
  /// The largest M_ii at q, where the table says nothing, and at up to 50 of its rows.
  Eigen::VectorXd largest_masses(Eigen::VectorXd q) {
    Eigen::VectorXd most = kte::mass_matrix(chain_, state_, q).diagonal();
    const std::size_t rows = input_.rows(), step = rows / 50 + 1;
    for (std::size_t row = 0; row < rows; row += step) {
      input_.read_q(row, q);
      most = most.cwiseMax(kte::mass_matrix(chain_, state_, q).diagonal());
    }
    return most;
  }
  void put_forces(double t, const plant::state& x, Eigen::Index nq, Eigen::VectorXd& u) {
    q_.at(t, target_, slope_);
    if (input_.has_v()) v_.at(t, rates_, none_);
    if (compensates_) weight_ = kte::gravity_forces(chain_, state_, x.head(nq).eval());
    for (const auto& j : joints_) {
      const double v = input_.has_v(j.v) ? rates_[j.v] : slope_[j.q];
      const double weight = compensates_ ? weight_[j.v] : 0;
      const double dq = target_[j.q] - x[j.q], dv = v - x[nq + j.v];
      const double tau = std::clamp(j.kp * dq + j.kd * dv + weight, -j.effort, j.effort);  // (1)
      if (!std::isfinite(tau * tau))
        throw kte::bad_argument("kte: PD control of '" + j.name +
                                "': its force, or the square of that, is not finite: kp " + short_number(j.kp) +
                                " times " + short_number(dq) + ", kd " + short_number(j.kd) + " times " +
                                short_number(dv));
      u[j.u] += tau;
    }
  }

 private:
  state_input input_;
  const kte::runtime_chain& chain_;
  kte::runtime_state state_;
  bool compensates_;
  time_table q_, v_;
  std::vector<joint> joints_;
  Eigen::VectorXd target_, slope_, rates_, none_, weight_;
};

/// Inputs over time, by their names, or forces tau_0, tau_1, ... on coordinates in the order of the file.
class input_table {
 public:
  /// Throws `bad_file` for columns that are neither, with the names that there are.
  input_table(const evaluate::state_table& table, const mechanism& m, const plant::model_type& model,
              const std::vector<std::string>& force_of) {
    const evaluate::column_order order(kte::layout(m.chain()), coordinates_of(m, m.chain()));
    for (const auto& [name, column] : table.names()) {
      if (name == "t") continue;
      int u = place_of_input(model, name);
      for (std::size_t i = 0; i < order.v.size(); ++i)
        if (name == "tau_" + std::to_string(i))
          u = place_of_input(model, force_of[static_cast<std::size_t>(order.v[i])]);
      if (u < 0) refuse(table, name, model, order.v.size());
      places_.emplace_back(column, u);
    }
    values_ = time_table(table, model.input().size(), [&](std::size_t row, Eigen::VectorXd& x) {
      for (const auto& [column, u] : places_) x[u] = table.at(row, column);
    });
  }
  void put_inputs(double t, Eigen::VectorXd& u) {
    values_.at(t, now_, none_);
    for (const auto& [column, place] : places_) u[place] = now_[place];
  }

 private:
  [[noreturn]] static void refuse(const evaluate::state_table& table, const std::string& name,
                                  const plant::model_type& model, std::size_t forces) {
    std::string known =
        forces == 0 ? "" : " tau_0 to tau_" + std::to_string(forces - 1) + " (of coordinates of one number)";
    kte::detail::for_each_input(model, [&](std::string_view input, int, int n) {
      if (n == 1 && !input.starts_with("tau/")) known.append(known.empty() ? " '" : ", '").append(input).append("'");
    });
    throw kte::bad_file("kte: " + table.path().string() + ":1: '" + name + "' is no input; there are" + known);
  }

  std::vector<std::pair<std::size_t, int>> places_;  ///< column, place in u
  time_table values_;
  Eigen::VectorXd now_, none_;
};

}  // namespace kte_tool
