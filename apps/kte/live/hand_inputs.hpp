#pragma once

#include <kte/dynamics/mass_matrix.hpp>
#include <kte/io/model_inputs.hpp>
#include <kte/view/live_page.hpp>

#include "live/motor_command.hpp"
#include "simulate/law.hpp"

namespace kte_tool {

/// Sliders for the inputs of a chain, or without any for forces on coordinates, and for viscous damping of all:
///
///   tau_i = u_i - c M_ii v_i           (1)
///
/// with c the slider, 1/s, and M_ii the mass that the coordinate feels at the start, kg or kg m^2.
class hand_inputs {
 public:
  /// For a chain that `driven_chain` has made of that of a mechanism, with its inputs at the start.
  hand_inputs(const mechanism& m, const driven_chain& driven, const plant::model_type& model, const Eigen::VectorXd& q)
      : u_(model.input()), now_(u_) {
    const auto picture = kte::scene_of(m.robot);
    kte::detail::for_each_input(model, [&](std::string_view name, int u, int n) {
      if (is_force(driven, name) || add_motor(m, picture, name, u, q)) return;
      for (int i = 0; i < n; ++i)
        add(n == 1 ? std::string(name) : std::string(name) + '/' + "xyz"[i], u + i,
            rounded(std::max(10.0, 2 * std::abs(u_[u + i]))), "1");
    });
    auto s = m.chain().make_state();
    const Eigen::MatrixXd mass = kte::mass_matrix(m.chain(), s, q);
    const bool forces = sliders_.empty();
    for (const auto& c : picture.coordinates) {
      if (c.follows || c.v_size != 1 || c.v < 0) continue;
      const int u = place_of_input(model, driven.force_of[static_cast<std::size_t>(c.v)]);
      const double felt = mass(c.v, c.v), effort = m.robot.limits.effort[static_cast<std::size_t>(c.v)];
      damped_.push_back({u, c.v, felt});
      if (forces)
        add(c.name, u, effort > 0 && effort < 1e6 ? effort : rounded(20 * felt), c.kind == "length" ? "N" : "N m");
    }
  }

  void show(kte::live_server& page) {
    for (auto& s : sliders_) {
      while (!taken_.insert(s.name).second) s.name += '\'';
      page.slider(s.name, s.lower, s.upper, s.start, s.unit);
    }
    while (!taken_.insert(damping_).second) damping_ += '\'';
    page.slider(damping_, 0, 10, 0, "1/s");
  }
  /// What sliders say from now on.
  void take(const kte::live_server& page) {
    for (const auto& s : sliders_) now_[s.u] = page.value(s.name);
    rate_ = page.value(damping_);
  }
  /// (1)
  void put(const plant::state& x, Eigen::Index nq, Eigen::VectorXd& u) const {
    u = now_;
    for (const auto& d : damped_) u[d.u] -= rate_ * d.felt * x[nq + d.v];
  }

 private:
  struct slider {
    std::string name;
    int u;
    double lower, upper, start;
    std::string unit;
  };
  struct damped {
    int u, v;
    double felt;
  };

  void add(const std::string& name, int u, double range, const char* unit) {
    sliders_.push_back({name, u, u_[u] - range, u_[u] + range, u_[u], unit});
  }
  static bool is_force(const driven_chain& driven, std::string_view name) {
    return std::find(driven.force_of.begin(), driven.force_of.end(), name) != driven.force_of.end();
  }
  /// A motor by the range and the unit of its command. Servos begin where they stand.
  bool add_motor(const mechanism& m, const kte::scene& picture, std::string_view name, int u,
                 const Eigen::VectorXd& q) {
    const auto motor = motor_of_input(m.chain(), name);
    if (!motor) return false;
    const auto c = std::find_if(picture.coordinates.begin(), picture.coordinates.end(),
                                [&](const auto& x) { return x.name == motor->coordinate && x.v >= 0; });
    if (c == picture.coordinates.end()) return false;
    const auto& l = m.robot.limits;
    const auto v = static_cast<std::size_t>(c->v);
    const motor_command command(motor->law, {c->kind != "length", l.lower[v], l.upper[v], l.rate[v]});
    const double start = command.at_start(q[c->q], u_[u]);
    sliders_.push_back({std::string(name), u, command.lower(), command.upper(), start, command.unit()});
    return true;
  }
  /// The next 1, 2 or 5 times a power of ten.
  static double rounded(double x) {
    if (!(x > 1e-9)) return 1;
    const double power = std::pow(10, std::floor(std::log10(x)));
    for (const double digit : {1.0, 2.0, 5.0})
      if (digit * power >= x) return digit * power;
    return 10 * power;
  }

  Eigen::VectorXd u_, now_;
  std::vector<slider> sliders_;
  std::vector<damped> damped_;
  std::set<std::string> taken_;
  std::string damping_ = "damping";
  double rate_ = 0;
};

}  // namespace kte_tool
