#pragma once

#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/rodas.hpp>

#include <variant>

#include "mechanism.hpp"

namespace kte::page {

/// A model in motion. It is integrated in stretches of a few steps, so that who calls can stop in between. What turns
/// out to be stiff goes on with a method for stiff systems.
class simulation {
 public:
  static constexpr double tolerance = 1e-6;
  static constexpr int many = 64;     ///< steps to an end
  static constexpr double worth = 8;  ///< how much longer steps of a stiff method are where it is worth its Jacobians
  static constexpr int most_stiff = 100;  ///< degrees of freedom, for which its equations are solved while one looks
  enum class method : unsigned char { undecided, non_stiff, stiff };

  simulation(dynamics_model model, double t, const Eigen::VectorXd& x, method m)
      : model_(std::move(model)), method_(m), switches_(has_events(model_)) {
    if (model_.dofs() > most_stiff) method_ = method::non_stiff;
    begin(t, x, method_ == method::stiff);
  }
  simulation(const simulation&) = delete;

  double time() const { return is_stiff() ? std::get<stiff_solver>(solver_).time() : std::get<solver>(solver_).time(); }
  /// (q, v, z)
  const Eigen::VectorXd& state() const {
    return is_stiff() ? std::get<stiff_solver>(solver_).state() : std::get<solver>(solver_).state();
  }
  bool is_stiff() const { return std::holds_alternative<stiff_solver>(solver_); }

  /// Goes on to t_end, or by as many steps as a page has time for. Throws `integration_failure`.
  void advance(double t_end) {
    steps_ += is_stiff() ? advance(std::get<stiff_solver>(solver_), t_end) : advance(std::get<solver>(solver_), t_end);
    const bool arrived = time() == t_end;
    if (method_ == method::undecided && steps_ > 0) decide(arrived);
    if (arrived && !is_on_trial()) count_from_here();
  }

 private:
  using solver = dormand_prince45<std::reference_wrapper<const dynamics_model>, Eigen::VectorXd>;
  using stiff_solver = rodas<std::reference_wrapper<const dynamics_model>, Eigen::VectorXd>;

  static bool has_events(const dynamics_model& m) {
    const auto& all = m.wiring().elements;
    return std::any_of(all.begin(), all.end(), [](const auto& e) { return e.element->switches(); });
  }
  bool is_on_trial() const { return is_stiff() && method_ == method::undecided; }
  void count_from_here() { from_ = time(), steps_ = 0; }
  /// What takes many steps is tried by the stiff method, for as many.
  void decide(bool arrived) {
    const double length = (time() - from_) / steps_;
    if (!is_on_trial()) {
      if (arrived || steps_ < many) return;
      non_stiff_length_ = length;
      change(true);
    } else if (length > worth * non_stiff_length_) {
      if (arrived || steps_ >= many) method_ = method::stiff;
    } else if (steps_ >= many) {
      method_ = method::non_stiff;
      change(false);
    }
  }
  void begin(double t, const Eigen::VectorXd& x, bool stiff) {
    const tolerances<double> exact{.absolute = tolerance, .relative = tolerance};
    if (stiff)
      solver_.emplace<stiff_solver>(std::cref(model_), t, x, exact);
    else
      solver_.emplace<solver>(std::cref(model_), t, x, exact);
    count_from_here();
  }
  void change(bool stiff) {
    const double t = time();
    const Eigen::VectorXd x = state();
    begin(t, x, stiff);
  }
  /// Steps without a look at the clock, fewer of large models.
  int stretch() const {
    const int n = (std::max)(1, model_.dofs());
    return std::clamp((is_stiff() ? 40000 / n : 4000) / n, 1, many);
  }
  /// Gives the number of steps.
  template <class Solver>
  int advance(Solver& s, double t_end) {
    int calls = 0;
    const auto count = [&calls, most = stretch()](double, const Eigen::VectorXd&) {
      return calls++ < most ? go_on : stop;
    };
    if (!switches_) {
      s.integrate(t_end, count);
    } else if (const auto report = s.integrate(t_end, element_events(model_).report_to([](const auto&) {}), count);
               report.reason == stop_reason::zeno) {
      throw integration_failure(
          "kte: " + report.stopped_by_name + ": its law changes ever faster at t = " + detail::number(s.time()),
          s.time(), failure_reason::other);
    }
    return calls - 1;  // at the start, and after each step
  }

  dynamics_model model_;
  method method_;
  bool switches_;
  std::variant<std::monostate, solver, stiff_solver> solver_;
  double from_ = 0;  ///< s, from when on steps are counted
  int steps_ = 0;
  double non_stiff_length_ = 0;  ///< s, of a step
};

}  // namespace kte::page
