#pragma once

#include <kte/dynamics/closed_loops/loop_variations.hpp>

/// Derivatives of the equations of closures by their own parameters.
namespace kte::detail {

class closure_variations {
  using D = derivative_number;

 public:
  /// Derivatives at constant q, v, a and closure forces lambda, one column per parameter; rows in m are divided by the
  /// length of the chain:
  ///
  ///   residuals g,   velocities J v,   accelerations J a + J_dot v,   forces J^T lambda          (1)
  struct result {
    Eigen::MatrixXd residuals, velocities, accelerations, forces;
  };

  /// Throws `unknown_name`.
  closure_variations(const runtime_chain& c, runtime_state& s, const std::vector<closure_parameter>& parameters) {
    if (!has_loops(c)) throw bad_argument("kte: this chain has no closures");
    for (const auto& p : parameters) wanted_.push_back(find(c, loops_of(c, s).equations.places, p));
  }
  result at_state(const runtime_chain& c, runtime_state& s) const {
    const auto& e = loops_of(c, s).equations;
    bring_up_to_date(runtime_elements{c}, s);
    take_rates(s), take_bases(s);
    tree::move_bodies<true>(s.tree().body_tree, s.work);
    result r;
    const auto count = static_cast<Eigen::Index>(wanted_.size());
    for (auto* m : {&r.residuals, &r.velocities, &r.accelerations}) m->setZero(e.places.rows, count);
    r.forces.setZero(s.dofs(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto& w = wanted_[static_cast<std::size_t>(k)];
      const auto& x = e.places.closures[static_cast<std::size_t>(w.closure)];
      rows_at rows;
      if (!x.of_frames())
        by_coordinates(c, s, x, w.number, rows, r.forces, k);
      else if (const closing_motion<double> m = loop_equations::moving_between(s, x); w.number >= 0)
        by_number(c, s, x, m, w.number, rows, r.forces, k);
      else
        by_displacement(c, s, x, m, w, rows, r.forces, k);
      for (int i = 0; i < x.rows.count(); ++i)
        for (int order = 0; order < 3; ++order)
          (order == 0   ? r.residuals
           : order == 1 ? r.velocities
                        : r.accelerations)(x.first + i, k) = e.places.scale(x, i) * rows.of[order][i];
    }
    return r;
  }

 private:
  struct wanted {
    int closure;
    int number = -1;       ///< among the parameters of the closure
    int frame = 0;         ///< the displaced frame, 1 or 2
    bool turns = false;    ///< whether the displacement is a rotation
    std::size_t axis = 0;  ///< about or along this axis
  };
  struct rows_at {
    double of[3][6]{};
  };

  static wanted find(const runtime_chain& c, const closure_places& places, const closure_parameter& p) {
    for (std::size_t i = 0; i < places.closures.size(); ++i) {
      const auto& x = places.closures[i];
      if (closures_of(c).loop_name(x.loop) != p.closure) continue;
      wanted w{static_cast<int>(i)};
      const auto own = runtime_elements{c}.element(x.element).closure_parameters();
      const auto at = std::find(own.begin(), own.end(), p.parameter);
      if (at != own.end()) {
        w.number = static_cast<int>(at - own.begin());
        return w;
      }
      const std::string_view text = p.parameter;
      const bool of_frame = x.of_frames() && (text.starts_with("frame1.") || text.starts_with("frame2."));
      std::string_view way = of_frame ? text.substr(7) : "";
      w.frame = of_frame ? text[5] - '0' : 0;
      w.turns = way.size() == 2 && way[0] == 'r';
      if (w.turns) way.remove_prefix(1);
      const bool in_plane = x.frame1.what == kind::frame_2D;
      if (way.size() == 1 && way[0] >= 'x' && way[0] <= 'z' && (!in_plane || w.turns == (way[0] == 'z'))) {
        w.axis = static_cast<std::size_t>(way[0] - 'x');
        return w;
      }
      throw unknown_name("kte: closure '" + p.closure + "' has no parameter '" + p.parameter + "'");
    }
    throw unknown_name("kte: this chain has no closure '" + p.closure + "'");
  }

  static void by_coordinates(const runtime_chain& c, runtime_state& s, const closure_place& x, int number,
                             rows_at& rows, Eigen::MatrixXd& forces, Eigen::Index column) {
    double q[4]{}, v[4]{}, by[4]{};
    for (std::size_t n = 0; n < x.coordinates.size(); ++n) {
      const auto& at = s.get<kind::gen>(x.coordinates[n]);
      q[n] = at.q, v[n] = at.q_dot;
    }
    const auto [value, curvature] = runtime_elements{c}.element(x.element).coordinates_by_parameter(number, q, v, by);
    rows.of[0][0] = value, rows.of[2][0] = curvature;
    for (std::size_t n = 0; n < x.coordinates.size(); ++n) {
      rows.of[1][0] += by[n] * v[n], rows.of[2][0] += by[n] * s.get<kind::gen>(x.coordinates[n]).q_ddot;
      forces(x.dofs[n], column) += by[n] * s.get<kind::loop>(x.loop).torque.x;
    }
  }
  static void by_number(const runtime_chain& c, runtime_state& s, const closure_place& x,
                        const closing_motion<double>& m, int number, rows_at& rows, Eigen::MatrixXd& forces,
                        Eigen::Index column) {
    const auto& element = runtime_elements{c}.element(x.element);
    for (int order = 0; order < 3; ++order)
      element.frames_by_parameter(number, m, static_cast<closing>(order), rows.of[order]);
    double units[6 * closing_stride];
    element.frames_by_parameter(number, m, closing::wrenches, units);
    const auto on_b = load_of_rows(x.rows, s.get<kind::loop>(x.loop), units);
    push(c, s, x.frame2, on_b, forces, column);
    const auto on_a = transmit(m, on_b);
    push(c, s, x.frame1, {-on_a.force, -on_a.torque}, forces, column);
  }
  /// The frame F' displaced from a frame F of the closure, on its body: lane 0.
  static void by_displacement(const runtime_chain& c, runtime_state& s, const closure_place& x,
                              const closing_motion<double>& between, const wanted& w, rows_at& rows,
                              Eigen::MatrixXd& forces, Eigen::Index column) {
    const D none(0);
    D by(0);
    by.derivative[0] = 1;
    vec3<D> step{none, none, none}, turn = step;
    (&(w.turns ? turn : step).x)[w.axis] = by;
    const pose<mat3<vec3<D>>, vec3<D>> moved{
        {{D(1), -turn.z, turn.y}, {turn.z, D(1), -turn.x}, {-turn.y, turn.x, D(1)}}, step};
    const pose<mat3<vec3<D>>, vec3<D>> stays{{{D(1), none, none}, {none, D(1), none}, {none, none, D(1)}},
                                             {none, none, none}};
    const auto &on_1 = w.frame == 1 ? moved : stays, &on_2 = w.frame == 2 ? moved : stays;
    const auto m =
        as_closing_motion<D>(compose(inverse(at_rest(on_1.rotation, on_1.position)),
                                     compose(as_closing_motion<D>(between), at_rest(on_2.rotation, on_2.position))));
    const auto& element = runtime_elements{c}.element(x.element);
    for (int order = 0; order < 3; ++order) {
      D all[6];
      element.close_frames(m, static_cast<closing>(order), all);
      for (int r = 0; r < x.rows.count(); ++r) rows.of[order][r] = all[r].derivative[0];
    }
    const auto on_b = load_of_closure(element, s.get<kind::loop>(x.loop), m);
    const auto on_a = transmit(m, on_b);
    push(c, s, x.frame2, derivative_of(transmit(on_2, on_b)), forces, column);
    push(c, s, x.frame1, derivative_of(transmit(on_1, wrench{-on_a.force, -on_a.torque})), forces, column);
  }
  template <class W>
  static tree::dense_wrench<double> derivative_of(const W& w) {
    const auto of = [](const auto& x) { return vec3<>{x.x.derivative[0], x.y.derivative[0], x.z.derivative[0]}; };
    return {of(w.force), of(w.torque)};
  }
  /// Adds the effect of a wrench on a frame to the forces on coordinates.
  static void push(const runtime_chain& c, runtime_state& s, const runtime_frame& x,
                   const tree::dense_wrench<double>& w, Eigen::MatrixXd& forces, Eigen::Index column) {
    runtime_jacobian j(6, s.dofs());
    write_jacobian(c, s, x, false, {j.data(), 6});
    Eigen::Matrix<double, 6, 1> all;
    all << w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z;
    forces.col(column) += j.transpose() * all;
  }

  std::vector<wanted> wanted_;
};

}  // namespace kte::detail
