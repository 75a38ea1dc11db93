#pragma once

#include <kte/dynamics/contacts/impact_derivatives.hpp>
#include <kte/models/detail/contact_steps.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#ifdef KTE_FUNCTION
namespace kte::detail {

/// An event of contacts, for `saltation_matrix`.
class contact_saltation {
 public:
  using model_type = manipulator_dynamics_model<runtime_chain>;

  contact_saltation(const model_type& model, double t, const Eigen::VectorXd& before, const Eigen::VectorXd& after)
      : model_(model),
        time_(t),
        before_(before),
        n_(model.velocity_count()),
        s_(make_state(model.chain())),
        f_before_(model_(t, before).head(2 * n_)),
        f_after_(model_(t, after).head(2 * n_)),
        m_(contact_memory(model.chain(), s_)) {
    const chain_constraints c = contacts_of(model.chain());
    model.setJointStates(t, after, s_);
    for (const auto& x : m_.contacts) states_after_.push_back(s_.get<kind::contact>(x.slot));
    model.setJointStates(t, before, s_);
    note_passing(m_);
    auto& e = m_.equations;
    e.at_positions(c, s_, true);
    e.at_rates(c, s_);
    m_.find(c, s_);
    jacobian_ = e.places.length * e.scaled_jacobian();
    v_ = model.velocities_of(before), v_after_ = model.velocities_of(after);
  }
  /// The projection of displacements from the state, before and after are the same, onto those that keep contacts
  /// closed.
  Eigen::MatrixXd projection() {
    Eigen::MatrixXd closing = Eigen::MatrixXd::Identity(2 * n_, 2 * n_);
    for (Eigen::Index k = 0; k < n_; ++k) {
      Eigen::VectorXd d = Eigen::VectorXd::Unit(model_.rates(), k);
      model_.tangential(before_, d);
      closing.col(k).head(n_) = d.head(n_);
    }
    return stop() * closing;
  }
  /// S.
  Eigen::MatrixXd matrix() {
    const double length = m_.equations.places.length;
    const Eigen::MatrixXd same = Eigen::MatrixXd::Identity(2 * n_, 2 * n_);
    std::vector<std::size_t> causes;
    for (std::size_t i = 0; i < m_.contacts.size(); ++i)
      if (mode_before(i) == contact_mode::open && m_.touches(m_.contacts[i]) &&
          normal_velocity(m_, m_.contacts[i]) < -1)
        causes.push_back(i);
    if (!causes.empty()) return by(land(), causes, true);
    if ((v_after_ - v_).cwiseAbs().maxCoeff() > 1e-6 * length) refuse("the impact is not that of a contact that lands");
    bool stops = false;
    for (std::size_t i = 0; i < m_.contacts.size(); ++i) {
      if (mode_before(i) != contact_mode::slides) continue;
      const bool sticks = mode_of(states_after_[i]) == contact_mode::sticks;
      const bool turns = m_.contacts[i].planar && mode_of(states_after_[i]) == contact_mode::slides &&
                         dot(states_after_[i].direction, state_before(i).direction) < 0;
      if (sticks || turns) causes.push_back(i), stops |= sticks;
    }
    if (!causes.empty()) return by(stops ? stop() : same, causes, false);
    if ((f_after_ - f_before_).cwiseAbs().maxCoeff() > 1e-6 * (1 + f_before_.cwiseAbs().maxCoeff()))
      refuse("accelerations jump, but no contact lands or stops sliding");
    return same;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw bad_argument("kte: this event of contacts has no known saltation matrix: " + why);
  }
  const contact_state<>& state_before(std::size_t i) const { return s_.get<kind::contact>(m_.contacts[i].slot); }
  contact_mode mode_before(std::size_t i) const { return mode_of(state_before(i)); }
  /// Contacts that have just landed may have passed through their surface before.
  void note_passing(contact_solver& m) const {
    for (std::size_t i = 0; i < m.contacts.size(); ++i) m.contacts[i].passes = states_after_[i].mode == passing_mode;
  }
  /// DR of an impact.
  Eigen::MatrixXd land() {
    const chain_constraints c = contacts_of(model_.chain());
    impact_memory memory;
    Eigen::VectorXd after = v_;
    runtime_state s = s_;
    auto& m = contact_memory(model_.chain(), s);
    note_passing(m);
    strike(c, s, m, memory, impact_law::at_once, after, [&](const contact_at& x) {
      const bool bounces =
          mode_of(states_after_[static_cast<std::size_t>(&x - m.contacts.data())]) == contact_mode::open;
      return bounces ? x.place.law.restitution : 0.0;
    });
    if (memory.result.restitution != 1) refuse("restitution is reduced so that energy does not grow");
    if ((after - v_after_).cwiseAbs().maxCoeff() > 1e-8 * (1 + v_.cwiseAbs().maxCoeff()))
      refuse("there are several impacts at one time");
    return of_reset(derive_impact(model_.chain(), s, m, v_, after, closed_in_impact(m, memory)));
  }
  /// DR where sliding stops: velocities are put on the rows of closed contacts.
  Eigen::MatrixXd stop() {
    std::vector<contact_in_impact> contacts;
    for (std::size_t i = 0; i < m_.contacts.size(); ++i) {
      const auto mode = mode_of(states_after_[i]);
      if (mode == contact_mode::open) continue;
      const auto& x = m_.contacts[i];
      contacts.push_back(
          {x.closure, x.planar, mode == contact_mode::sticks, 0, 0, {}, basis_at(x.place.normal, x.planar)});
    }
    runtime_state s = s_;
    return of_reset(derive_impact(model_.chain(), s, contact_memory(model_.chain(), s), v_, v_after_, contacts));
  }
  Eigen::MatrixXd of_reset(const impact_derivatives_result& r) const {
    Eigen::MatrixXd reset = Eigen::MatrixXd::Identity(2 * n_, 2 * n_);
    reset.bottomLeftCorner(n_, n_) = r.by_q, reset.bottomRightCorner(n_, n_) = r.by_v;
    return reset;
  }
  /// The derivative of the velocity u of a contact along an axis, by q.
  Eigen::RowVectorXd velocity_by_q(std::size_t contact, const vec3<>& axis) {
    using D = derivative_number;
    const auto& c = model_.chain();
    runtime_state s = s_;
    write_numbers<vector_of::a>(s, Eigen::VectorXd(Eigen::VectorXd::Zero(n_)), "a");
    derivative_state& d = state_in_duals(c, s);
    inverse_dynamics_result<double, Eigen::Dynamic> forces;
    forces.tau.resize(n_), forces.by_q.setZero(n_, n_), forces.by_v.setZero(n_, n_);
    Eigen::RowVectorXd row(n_);
    const auto& at = m_.place(m_.contacts[contact]);
    const auto derive = [&](const directions& moving) -> const auto& {
      inverse_dynamics_in_duals(runtime_elements{c}, s, d, moving, [&](derivative_state&) {
        if (moving.by != vector_of::q) return;
        const auto found = runtime_elements{c}.element(at.element).touch_at(closing_motion_in_duals(s, d, at));
        const D along = dot(as<D>(axis), found.slip);
        for (int k = 0; k < D::variables && moving.first + k < n_; ++k)
          row[moving.first + k] = along.derivative[static_cast<std::size_t>(k)];
      });
      return d.forces;
    };
    derive_by_duals(s.freedoms(), std::span(d.q), std::span(d.v), std::span(d.a), false, derive, forces);
    return row;
  }
  /// Dg of a contact: of its gap, or of its velocity along the direction of sliding.
  Eigen::RowVectorXd gradient(std::size_t contact, bool lands) {
    const auto& x = m_.contacts[contact];
    const auto& at = m_.place(x);
    const vec3<> axis = lands ? x.place.normal : state_before(contact).direction;
    const double parts[3]{axis.x, axis.y, axis.z};
    Eigen::RowVectorXd of_velocity = Eigen::RowVectorXd::Zero(n_), g = Eigen::RowVectorXd::Zero(2 * n_);
    for (int k = 0; k < at.rows.count(); ++k) of_velocity += parts[k] * jacobian_.row(at.first + k);
    if (lands)
      g.head(n_) = of_velocity;
    else
      g << velocity_by_q(contact, axis), of_velocity;
    return g;
  }
  /// (1) of `saltation_matrix`, if all causes occur at one time for all displacements of closed contacts.
  Eigen::MatrixXd by(const Eigen::MatrixXd& reset, const std::vector<std::size_t>& causes, bool lands) {
    Eigen::RowVectorXd time;  // -dt of the event
    for (const std::size_t i : causes) {
      Eigen::RowVectorXd g = gradient(i, lands);
      g /= g.dot(f_before_);
      if (i == causes.front()) {
        time = g;
        continue;
      }
      const Eigen::MatrixXd all = contact_saltation(model_, time_, before_, before_).projection();
      if (((g - time) * all).cwiseAbs().maxCoeff() > 1e-7 * time.cwiseAbs().maxCoeff())
        refuse("contacts '" + name(causes.front()) + "' and '" + name(i) +
               "' change at one time, and near it one after the other");
    }
    return reset + (f_after_ - reset * f_before_) * time;
  }
  std::string name(std::size_t i) const { return contacts_of(model_.chain()).loop_name(m_.place(m_.contacts[i]).loop); }

  const model_type model_;
  double time_;
  Eigen::VectorXd before_;
  Eigen::Index n_;
  runtime_state s_;
  Eigen::VectorXd f_before_, f_after_, v_, v_after_;
  contact_solver& m_;
  Eigen::MatrixXd jacobian_;
  std::vector<contact_state<>> states_after_;
};

}  // namespace kte::detail
#endif
