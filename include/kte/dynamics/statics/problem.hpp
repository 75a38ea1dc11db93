#pragma once

#include <kte/detail/interruption.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/external_wrenches.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/dynamics/statics/force_pattern.hpp>
#include <kte/dynamics/statics/loaded_elements.hpp>
#include <kte/elements/constant_force.hpp>
#include <kte/runtime_chain.hpp>

#include <Eigen/SparseCore>

#include <limits>
#include <string_view>
#include <utility>
#include <vector>

/// The forces that hold a runtime chain at rest, and their derivatives, as functions of q and of a parameter.
namespace kte::detail {

using sparse_matrix = Eigen::SparseMatrix<double>;
inline double largest_number(const sparse_matrix& m) {
  double most = 0;
  for (Eigen::Index i = 0; i < m.nonZeros(); ++i) most = (std::max)(most, std::abs(m.valuePtr()[i]));
  return most;
}

/// tau(q, p) = `static_forces` with a parameter p. By default p is the load factor: accelerations of bases (gravity),
/// elements that are loads, and given wrenches are multiplied by p. If p has a name, it is an input or a prescribed
/// coordinate. On request, forces (1 - p) times those at the start hold the chain. Has its own state, at rest.
class static_problem {
 public:
  static_problem(const runtime_chain& c, const runtime_state& s, const std::vector<external_wrench>& loads,
                 std::string_view parameter)
      : chain_(with_loads(c, s, loads)), state_(chain_.make_state()) {
    unroll<kinds>([&]<std::size_t K>() {
      constexpr auto what = static_cast<kind>(K);
      for (int i = 0; i < chain_.wiring().count(what); ++i) state_.get<what>(i) = s.get<what>(i);
    });
    for_each_listed_freedom(state_, [](auto& x, const freedom&) {
      const auto rest = [](double& number) { number = 0; };
      visit_v(x, rest), visit_a(x, rest);
    });
    for (const auto& base : state_.tree().plan.bases)
      with_frame(state_, base.first, base.second, [&](const auto& x) {
        const auto m = spatial(x);
        bases_.push_back({base, as<double>(m.acceleration), as<double>(m.ang_acceleration)});
      });
    find_parameter(parameter);
    pattern_ = pattern_of_forces(chain_, state_);
    make_tangent();
  }

  int size() const { return state_.dofs(); }
  const runtime_chain& chain() const { return chain_; }
  const runtime_state& state() const { return state_; }
  const force_pattern& pattern() const { return pattern_; }
  bool by_load() const { return parameter_.first == kind::frame_3D; }
  /// The size of the box around all frames at the last evaluation, m; 1 if they coincide.
  double extent() {
    place_in_world(state_);
    Eigen::Array3d low = Eigen::Array3d::Constant((std::numeric_limits<double>::max)()), high = -low;
    const auto& body_tree = state_.tree().body_tree;
    for (const auto& frames : body_tree.frames)
      for (const auto& frame : frames) {
        if (frame.slot < 0) continue;
        const auto& body = state_.work.world[static_cast<std::size_t>(frame.slot)];
        const vec3<> x = body.position + body.rotation * frame.at.position;
        low = (low.min)(Eigen::Array3d(x.x, x.y, x.z)), high = (high.max)(Eigen::Array3d(x.x, x.y, x.z));
      }
    const double size = (high - low).maxCoeff();
    return size > 0 ? size : 1;
  }
  /// Sets the forces that hold the chain, times (1 - p).
  void hold(Eigen::VectorXd forces) { held_ = std::move(forces); }

  /// tau(q, p). Throws `bad_argument` where it is not finite.
  const Eigen::VectorXd& forces(const Eigen::VectorXd& q, double p);
  /// d tau / dp: exact for the load factor, in which tau is linear; otherwise by central differences.
  Eigen::VectorXd forces_by_parameter(const Eigen::VectorXd& q, double p) {
    const double h = by_load() ? 1.0 : 6e-6 * (1 + std::abs(p));
    const Eigen::VectorXd after = forces(q, p + h);
    return (after - forces(q, p - h)) / (2 * h);
  }
  /// q after a step in which bodies first translate and then rotate. A screw motion would shorten a beam by more than
  /// its bending does and compress it; Newton's method continues better from a stretched beam.
  Eigen::VectorXd displaced(const Eigen::VectorXd& q, const Eigen::VectorXd& step) const {
    Eigen::VectorXd slide = Eigen::VectorXd::Zero(step.size());
    for (const freedom& x : state_.freedoms()) {
      const int lengths = x.what == kind::pose_2D ? 2 : x.what == kind::pose_3D ? 3 : 0;
      slide.segment(x.v, lengths) = step.segment(x.v, lengths);
    }
    return integrate(chain_, integrate(chain_, q, slide, 1.0), step - slide, 1.0);
  }
  /// d tau / dq along the numbers of v, for steps of `displaced`, in axes that do not rotate during the step. For
  /// forces with a potential it is the second derivative, and symmetric even if forces are not zero. With the forces f
  /// and torques t at q, it is the derivative in body axes plus
  ///
  ///   w x f of rows of forces,  w x t / 2 of rows of torques          (1)
  const sparse_matrix& tangent(const Eigen::VectorXd& q, double p) {
    const Eigen::VectorXd tau = forces(q, p);
    if (is_known_by_elements(chain_, state_))
      take_known();
    else
      derive(elements(p));
    for (const freedom& x : state_.freedoms()) add_turning(x, tau);
    if (!tree::all_finite_in_row(tangent_.valuePtr(), static_cast<std::size_t>(tangent_.nonZeros())))
      diagnose("a derivative", state_);
    return tangent_;
  }

 private:
  struct base_acceleration {
    std::pair<kind, int> base;
    vec3<> linear, angular;
  };

  static runtime_chain with_loads(const runtime_chain& c, const runtime_state& s,
                                  const std::vector<external_wrench>& loads);
  void find_parameter(std::string_view name) {
    if (name.empty()) return;
    const topology& t = chain_.wiring();
    const kind k = t.kind_of(name, false);
    const int i = t.find(name, k);
    const bool given = t.writers[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] < 0;
    const bool is_input = k == kind::input && given;
    const bool is_coordinate =
        k == kind::gen && given && state_.tree().plan.row_of_gen[static_cast<std::size_t>(i)] >= state_.dofs();
    if (!is_input && !is_coordinate)
      throw bad_argument("kte: '" + std::string(name) +
                         "' is not a parameter: parameters are external inputs and declared coordinates (base_gen)");
    parameter_ = {k, i};
  }
  loaded_elements elements(double p) const { return {{chain_}, by_load() ? p : 1.0}; }
  void put(const Eigen::VectorXd& q, double p) {
    for_each_listed_freedom(state_, [&q](auto& x, const freedom& at) { detail::put<vector_of::q>(x, at, q); });
    const auto [k, i] = parameter_;
    if (k == kind::input) state_.get<kind::input>(i) = p;
    if (k == kind::gen) state_.get<kind::gen>(i).q = p;
    if (!by_load()) return;
    for (const auto& b : bases_)
      with_frame(state_, b.base.first, b.base.second, [&](auto& x) {
        using angular = std::remove_reference_t<decltype(x.ang_acceleration)>;
        if constexpr (std::is_same_v<angular, double>)
          x.acceleration = {p * b.linear.x, p * b.linear.y}, x.ang_acceleration = p * b.angular.z;
        else
          x.acceleration = p * b.linear, x.ang_acceleration = p * b.angular;
      });
  }

  /// Adds (1).
  void add_turning(const freedom& x, const Eigen::VectorXd& tau) {
    if (x.what == kind::pose_2D) {
      tangent_.coeffRef(x.v, x.v + 2) -= tau[x.v + 1], tangent_.coeffRef(x.v + 1, x.v + 2) += tau[x.v];
    } else if (x.what == kind::pose_3D) {
      add_turning(x.v, x.v + 3, tau.segment<3>(x.v)), add_turning(x.v + 3, x.v + 3, 0.5 * tau.segment<3>(x.v + 3));
    } else if (x.what == kind::rotation_3D) {
      add_turning(x.v, x.v, 0.5 * tau.segment<3>(x.v));
    }
  }
  void add_turning(int row, int column, const Eigen::Vector3d& f) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      tangent_.coeffRef(row + i, column + j) += f[k], tangent_.coeffRef(row + i, column + k) -= f[j];
    }
  }
  void make_tangent() {
    const int n = size();
    std::vector<Eigen::Triplet<double>> all;
    for (int j = 0; j < n; ++j)
      for (const int i : pattern_.rows[static_cast<std::size_t>(j)]) all.emplace_back(i, j, 0.0);
    tangent_.resize(n, n);
    tangent_.setFromTriplets(all.begin(), all.end());
  }
  /// Calls visit(row, column, entry) for each entry.
  template <class Visit>
  void each_entry(const Visit& visit) {
    double* number = tangent_.valuePtr();
    for (int j = 0; j < size(); ++j)
      for (const int i : pattern_.rows[static_cast<std::size_t>(j)]) visit(i, j, *number++);
  }
  void take_known();
  /// Computes derivatives by dual numbers, all columns of a colour at once.
  void derive(const loaded_elements& elements);

  runtime_chain chain_;
  runtime_state state_;
  std::vector<base_acceleration> bases_;
  std::pair<kind, int> parameter_{kind::frame_3D, -1};  ///< frame_3D: the load factor
  force_pattern pattern_;
  sparse_matrix tangent_;
  Eigen::VectorXd held_;
};

#ifdef KTE_FUNCTION
KTE_FUNCTION const Eigen::VectorXd& static_problem::forces(const Eigen::VectorXd& q, double p) {
  put(q, p);
  forces_on_coordinates(elements(p), state_, acting::all);
  take_generalized_forces(state_);
  auto& tau = state_.work.forces;
  check_result(state_, [this] { diagnose("a force", state_); });
  if (held_.size() > 0) tau -= (1 - p) * held_;
  return tau;
}
KTE_FUNCTION runtime_chain static_problem::with_loads(const runtime_chain& c, const runtime_state& s,
                                                      const std::vector<external_wrench>& loads) {
  check_regular(c, s);
  runtime_chain all = c;
  for (const auto& w : loads) {
    const auto at = find_frame(c, w.frame);
    const auto& name = c.wiring().names[static_cast<std::size_t>(at.what)][static_cast<std::size_t>(at.index)];
    six_numbers<double>(w, name);
    if (at.what == kind::frame_2D)
      all << follower_force_2D(name, vec2{w.force.x, w.force.y}, w.torque.z);
    else
      all << follower_force_3D(name, w.force, w.torque);
  }
  return all;
}
KTE_FUNCTION void static_problem::take_known() {
  derive_forces(runtime_elements{chain_}, state_);
  const auto& by_q = state_.work.of_forces.by_q;
  each_entry([&by_q](int i, int j, double& number) { number = by_q(i, j); });
}
KTE_FUNCTION void static_problem::derive(const loaded_elements& elements) {
  using number = derivative_number;
  auto& d = state_in_duals(chain_, state_);
  const int* const colour = pattern_.colour.data();
  for (int first = 0; first < pattern_.colours; first += number::variables) {
    look_for_interruption();
    const directions moving{vector_of::q, first, colour};
    point_along(moving, d.freedoms(), std::span(d.q), std::span(d.v), std::span(d.a));
    inverse_dynamics_in_duals(elements, state_, d, moving);
    each_entry([&](int i, int j, double& to) {
      if (const int lane = moving.lane(j); lane >= 0 && lane < number::variables)
        to = d.forces[static_cast<std::size_t>(i)].derivative[static_cast<std::size_t>(lane)];
    });
  }
}
#endif

}  // namespace kte::detail
