#pragma once

#include <kte/dynamics/closed_loops/closure_path.hpp>
#include <kte/dynamics/closed_loops/loop_dynamics.hpp>
#include <kte/dynamics/runtime/derivatives.hpp>

/// Derivatives of the equations of a chain with loops by q, along the numbers of v, and by v, four directions at a
/// time: in trees whose elements provide the derivatives of their forces along the paths of closures
/// (closure_path.hpp), in other chains with all bodies in dual numbers.
namespace kte::detail {

/// Derivatives at constant accelerations a and closure forces lambda:
///
///   forces          inverse dynamics - J^T lambda          (1)
///   accelerations   J a + J_dot v, rows in m divided by the length of the chain          (2)
///   velocities      J v, rows in m divided by the length of the chain          (3)
struct loop_variations {
  Eigen::MatrixXd forces_by_q, forces_by_v, accelerations_by_q, accelerations_by_v, velocities_by_q;
};

/// The load on the second frame of a closure of frames, from its wrenches for unit rates:
///
///   (F, T) . (v, w) = lambda . residual_dot(v, w)          (4)
template <class D>
tree::dense_wrench<D> load_of_rows(const closure_rows& rows, const loop_state<>& loop, const D* units) {
  D load[6];
  for (int i = 0; i < 6; ++i, units += closing_stride) {
    load[i] = D(0);
    for (int k = 0; k < rows.count(); ++k) load[i] = load[i] + row_of(loop.force, loop.torque, rows, k) * units[k];
  }
  return {{load[0], load[1], load[2]}, {load[3], load[4], load[5]}};
}
inline tree::dense_wrench<derivative_number> load_of_closure(const kte_element& closure, const loop_state<>& loop,
                                                             const closing_motion<derivative_number>& m) {
  derivative_number units[6 * closing_stride];
  closure.close_frames(m, closing::wrenches, units);
  return load_of_rows(closure.rows(), loop, units);
}
/// Adds a wrench on a frame to the loads of its body.
template <class D>
void add_load(const tree::frame_place<double>& at, const tree::dense_wrench<D>& w,
              std::vector<tree::dense_wrench<D>>& loads) {
  const auto seen = transmit(at.at, w);
  auto& load = loads[static_cast<std::size_t>(at.slot)];
  load = {load.force + as<D>(seen.force), load.torque + as<D>(seen.torque)};
}

/// The motion of frame2 of a closure in frame1; move the bodies of the state with derivatives first.
inline closing_motion<derivative_number> closing_motion_in_duals(const runtime_state& s, const derivative_state& d,
                                                                 const closure_place& x) {
  using D = derivative_number;
  const auto& f = s.tree().body_tree;
  const auto motion_of = [&](const runtime_frame& frame) {
    const auto& at = f.frame(frame.what, frame.index);
    const auto slot = static_cast<std::size_t>(at.slot);
    return engine::motion_of_frame(d.work.world[slot], d.work.bodies[slot], at.at);
  };
  auto m = as_closing_motion<D>(relative(motion_of(x.frame1), motion_of(x.frame2)));
  // Position and rotation without the rounding errors of their places in the world
  const auto from = loop_equations::motion_between(s, x);
  const auto take = [](const vec3<>& y, vec3<D>& to) { to.x.value = y.x, to.y.value = y.y, to.z.value = y.z; };
  take(from.position, m.position);
  take(from.rotation.x, m.rotation.x), take(from.rotation.y, m.rotation.y), take(from.rotation.z, m.rotation.z);
  return m;
}
/// The closures of a chain in a state with derivatives; move its bodies first.
class closures_in_duals {
  using D = derivative_number;

 public:
  closures_in_duals(const runtime_chain& c, runtime_state& s, const closure_places& places, derivative_state& d)
      : chain_(c), state_(s), places_(places), d_(d) {}

  /// Adds J^T lambda; calls visit(row, J v, J a + J_dot v), for rows in m and rad.
  template <class Visit>
  void push(const Visit& visit) const {
    for (const auto& x : places_.closures) x.of_frames() ? push_frames(x, visit) : push_coordinates(x, visit);
  }

 private:
  template <class Visit>
  void push_frames(const closure_place& x, const Visit& visit) const {
    const auto& f = state_.tree().body_tree;
    const auto &at_a = f.frame(x.frame1.what, x.frame1.index), &at_b = f.frame(x.frame2.what, x.frame2.index);
    const auto& element = runtime_elements{chain_}.element(x.element);
    const auto m = closing_motion_in_duals(state_, d_, x);
    D velocities[6], accelerations[6];
    element.close_frames(m, closing::residual_dot, velocities);
    element.close_frames(m, closing::residual_ddot, accelerations);
    for (int r = 0; r < x.rows.count(); ++r) visit(x.first + r, velocities[r], accelerations[r]);
    const auto on_b = load_of_closure(element, state_.get<kind::loop>(x.loop), m);
    const auto on_a = transmit(m, on_b);
    add_load(at_b, on_b, d_.work.loads);
    add_load(at_a, tree::dense_wrench<D>{as<D>(-on_a.force), as<D>(-on_a.torque)}, d_.work.loads);
  }
  template <class Visit>
  void push_coordinates(const closure_place& x, const Visit& visit) const {
    D q[4]{}, v[4]{}, by[4]{};
    for (std::size_t n = 0; n < x.coordinates.size(); ++n) {
      const auto& at = d_.get<kind::gen>(x.coordinates[n]);
      q[n] = at.q, v[n] = at.q_dot;
    }
    D acceleration = runtime_elements{chain_}.element(x.element).close_coordinates(q, v, by)[1], velocity(0);
    for (std::size_t n = 0; n < x.coordinates.size(); ++n) {
      auto& at = d_.get<kind::gen>(x.coordinates[n]);
      velocity = velocity + by[n] * v[n], acceleration = acceleration + by[n] * at.q_ddot;
      at.f = at.f + by[n] * state_.get<kind::loop>(x.loop).torque.x;
    }
    visit(x.first, velocity, acceleration);
  }

  const runtime_chain& chain_;
  runtime_state& state_;
  const closure_places& places_;
  derivative_state& d_;
};

/// (1) to (3) in dual numbers.
inline void vary_loops_in_duals(const runtime_chain& c, runtime_state& s, const loop_equations& e, loop_variations& r) {
  inverse_dynamics_result<double, Eigen::Dynamic> forces;
  const Eigen::Index n = s.dofs(), rows = e.places.rows;
  forces.tau.resize(n), forces.by_q.setZero(n, n), forces.by_v.setZero(n, n);
  for (auto* m : {&r.accelerations_by_q, &r.accelerations_by_v, &r.velocities_by_q}) m->setZero(rows, n);
  derivative_state& d = state_in_duals(c, s);
  const closures_in_duals closures(c, s, e.places, d);
  const auto derive = [&](const directions& moving) -> const auto& {
    const bool by_q = moving.by == vector_of::q;
    const auto put = [&](int row, const derivative_number& rate, const derivative_number& acceleration) {
      const auto& x = e.places.closure_of_row(row);
      const double scale = e.places.scale(x, row - x.first);
      for (int k = 0; k < derivative_number::variables && moving.first + k < n; ++k) {
        const auto lane = static_cast<std::size_t>(k);
        (by_q ? r.accelerations_by_q : r.accelerations_by_v)(row, moving.first + k) =
            scale * acceleration.derivative[lane];
        if (by_q) r.velocities_by_q(row, moving.first + k) = scale * rate.derivative[lane];
      }
    };
    inverse_dynamics_in_duals(runtime_elements{c}, s, d, moving, [&](derivative_state&) { closures.push(put); });
    return d.forces;
  };
  derive_by_duals(s.freedoms(), std::span(d.q), std::span(d.v), std::span(d.a), false, derive, forces);
  r.forces_by_q = std::move(forces.by_q), r.forces_by_v = std::move(forces.by_v);
}

/// The derivatives of a closure along its own path. Calls put(by, row, degree of freedom, derivatives of J v and of J a
/// + J_dot v) for rows in m and rad, perhaps several times, for their sum. Subtracts the derivatives of J^T lambda by q
/// from `forces`.
template <class Put>
void vary_closure(const runtime_chain& c, const runtime_state& s, const closure_place& x, closure_path& path,
                  Eigen::MatrixXd& forces, const Put& put) {
  using D = derivative_number;
  const auto& element = runtime_elements{c}.element(x.element);
  const auto& loop = s.get<kind::loop>(x.loop);
  if (x.of_frames()) path.find(s, x);
  for (const vector_of by : {vector_of::q, vector_of::v}) {
    const bool by_q = by == vector_of::q;
    for (int first = 0; x.of_frames() && first < path.size(); first += D::variables) {
      const auto m = path.motion_along(by, first);
      D velocities[6]{}, accelerations[6];
      if (by_q) element.close_frames(m, closing::residual_dot, velocities);
      element.close_frames(m, closing::residual_ddot, accelerations);
      path.each_lane(first, [&](std::size_t lane, int dof) {
        for (int r = 0; r < x.rows.count(); ++r)
          put(by, x.first + r, dof, velocities[r].derivative[lane], accelerations[r].derivative[lane]);
      });
      if (by_q) path.subtract_forces(by, first, load_of_closure(element, loop, m), forces);
    }
    if (x.of_frames()) continue;
    D q[4]{}, v[4]{}, gradient[4]{};
    const std::size_t count = x.coordinates.size();
    for (std::size_t n = 0; n < count; ++n) {
      const auto& at = s.get<kind::gen>(x.coordinates[n]);
      q[n] = at.q, v[n] = at.q_dot;
      (by_q ? q : v)[n].derivative[n] = 1;
    }
    D acceleration = element.close_coordinates(q, v, gradient)[1], velocity(0);
    for (std::size_t n = 0; n < count; ++n) {
      velocity = velocity + gradient[n] * v[n];
      acceleration = acceleration + gradient[n] * s.get<kind::gen>(x.coordinates[n]).q_ddot;
    }
    for (std::size_t k = 0; k < count; ++k) {
      put(by, x.first, x.dofs[k], velocity.derivative[k], acceleration.derivative[k]);
      for (std::size_t n = 0; by_q && n < count; ++n)
        forces(x.dofs[n], x.dofs[k]) -= gradient[n].derivative[k] * loop.torque.x;
    }
  }
}
/// (1) to (3), where the elements provide the derivatives of their forces.
inline void vary_loops_along_paths(const runtime_chain& c, runtime_state& s, const loop_equations& e,
                                   closure_path& path, loop_variations& r) {
  const Eigen::Index n = s.dofs(), rows = e.places.rows;
  const auto& forces = forces_derived(c, s);
  r.forces_by_q = forces.by_q, r.forces_by_v = forces.by_v;
  for (auto* m : {&r.accelerations_by_q, &r.accelerations_by_v, &r.velocities_by_q}) m->setZero(rows, n);
  for (const auto& x : e.places.closures)
    vary_closure(c, s, x, path, r.forces_by_q, [&](vector_of by, int row, int dof, double rate, double acceleration) {
      const double scale = e.places.scale(x, row - x.first);
      const bool by_q = by == vector_of::q;
      (by_q ? r.accelerations_by_q : r.accelerations_by_v)(row, dof) += scale * acceleration;
      if (by_q) r.velocities_by_q(row, dof) += scale * rate;
    });
}
/// Writes (1) to (3) at the state; call `constrained_accelerations` first.
inline void vary_loops(const runtime_chain& c, runtime_state& s, const loop_equations& e, closure_path& path,
                       loop_variations& r) {
  if (is_known_by_elements(c, s))
    vary_loops_along_paths(c, s, e, path, r);
  else
    vary_loops_in_duals(c, s, e, r);
}

}  // namespace kte::detail
