#pragma once

#include <kte/dynamics/closed_loops/closure_motion.hpp>

/// Loads of closures that pass to the bases of a tree (tree/loop_loads.hpp).
namespace kte::detail {

/// The closures of a chain, with the poses of their frames, and L^-T J^T of their rows (loop_factor.hpp).
class closure_loads : public closure_motion {
 public:
  template <class State>
  closure_loads(const chain_constraints& c, const State& s)
      : places(c, s), motions_(places.closures.size()), ends_(places.closures.size()) {
    acceleration.resize(places.rows);
  }

  closure_places places;
  Eigen::VectorXd acceleration;  ///< J_dot v, or the second derivatives of residuals

  /// Calls put(column of its block, row, entry) for L^-T J^T of the rows of a closure, in a tree whose articulated
  /// inertias are in the working memory; call `at_positions` first. `root`: D^-1/2 by place. With `Accelerate` it also
  /// computes the second derivatives of the residuals, from bias motions and forces in the working memory.
  template <bool Accelerate, class State, class Put>
  void half_solve(const chain_constraints& c, State& s, int closure, const Eigen::VectorXd& root, const Put& put) {
    const auto& x = places.closures[static_cast<std::size_t>(closure)];
    if (!x.of_frames()) return half_solve_coordinates<Accelerate>(c, s, x, root, put);
    double units[6 * closing_stride]{};
    const auto& m = motions_[static_cast<std::size_t>(closure)];
    c.close_frames(x.element, m, closing::wrenches, units);
    for (double* unit = units; unit != units + 6 * closing_stride; unit += closing_stride)
      for (int r = 0; r < x.rows.linear; ++r) unit[r] /= places.length;
    half_solve_units<Accelerate>(
        s, closure, units, x.rows.count(), root,
        [&](std::size_t place, int first, const tree::simd<double>& entries) KTE_INLINE_LAMBDA {
          double left[tree::simd_of<double>::count];
          tree::store<double>(entries, left);
          for (int r = first; r < (std::min)(first + lanes, x.rows.count()); ++r)
            put(places.column_of_place[place], r, left[r - first]);
        },
        [&](int r, double rate) { acceleration[x.first + r] = rate; });
    if constexpr (Accelerate) {
      double rows[6];
      c.close_frames(x.element, accelerated<false>(s, x, ends_[static_cast<std::size_t>(closure)], m),
                     closing::residual_ddot, rows);
      for (int r = 0; r < x.rows.count(); ++r) acceleration[x.first + r] += places.scale(x, r) * rows[r];
    }
  }
  /// As `half_solve`, for rows that are given by their wrenches on frame2, in its axes: six times `closing_stride`
  /// numbers. Calls put(place, first row, entries of as many rows as there are lanes), and with `Accelerate`
  /// accelerate(row, its second derivative without the part of `biased_motion`).
  template <bool Accelerate, class State, class Put, class Accelerated>
  void half_solve_units(State& s, int closure, const double* units, int rows, const Eigen::VectorXd& root,
                        const Put& put, const Accelerated& accelerate) {
    const auto& x = places.closures[static_cast<std::size_t>(closure)];
    const auto& m = motions_[static_cast<std::size_t>(closure)];
    for (int first = 0; first < rows; first += lanes) {
      simd_load on2;
      tree::load_vectors<double>(on2.force, units + first, closing_stride);
      tree::load_vectors<double>(on2.torque, units + 3 * closing_stride + first, closing_stride);
      powers<Accelerate> sum;
      const auto put_lanes = [&](int axis, const tree::simd<double>& e) KTE_INLINE_LAMBDA {
        const auto place = static_cast<std::size_t>(places.place_of_axis[static_cast<std::size_t>(axis)]);
        put(place, first, root[static_cast<Eigen::Index>(place)] * e);
      };
      send_load<Accelerate>(s, x, m, on2, loads_, put_lanes, sum);
      if constexpr (Accelerate) {
        double left[lanes];
        tree::store<double>(sum.sum, left);
        for (int r = first; r < (std::min)(first + lanes, rows); ++r) accelerate(r, left[r - first]);
      }
    }
  }
  /// The effect of a wrench on frame2, in its axes, and of the opposite one on frame1, on the axes of their path:
  /// `tree::send_to_bases`, with `Accelerate` with the powers on moving bases. m: the motion of frame2 in frame1.
  template <bool Accelerate, class State, class S, class Put, class Sum>
  static void send_load(State& s, const closure_place& x, const closing_motion<S>& m, const tree::simd_wrench<S>& on2,
                        std::vector<tree::simd_wrench<S>>& loads, const Put& put, Sum& sum) {
    const auto& f = s.tree().body_tree;
    const auto enter = [&](std::size_t port, const runtime_frame& frame, const tree::simd_wrench<S>& load) {
      const auto& place = f.frame(frame.what, frame.index).at;
      loads[static_cast<std::size_t>(x.enters[port])].add(tree::seen_from<S>(place.rotation, place.position, load));
    };
    clear_loads(loads, x.way);
    if (x.enters[0] >= 0) {
      tree::simd_wrench<S> on1 = tree::seen_from<S>(m.rotation, m.position, on2);
      for (auto* v : {&on1.force, &on1.torque}) v->x = -v->x, v->y = -v->y, v->z = -v->z;
      enter(0, x.frame1, on1);
    } else if constexpr (Accelerate) {
      auto base = seen_from_base(moved_by_base(s, x.frame1), m.rotation, m.position);
      base.acceleration = -base.acceleration, base.ang_acceleration = -base.ang_acceleration;
      sum.at_base(on2, base);
    }
    if (x.enters[1] >= 0)
      enter(1, x.frame2, on2);
    else if constexpr (Accelerate)
      sum.at_base(on2, moved_by_base(s, x.frame2));
    tree::send_to_bases(f, s.work, x.way, loads.data(), static_cast<const S*>(nullptr), put, sum);
  }
  /// The position and rotation of frame2 in frame1 for a closure of frames, after `at_positions` or `biased_motion`.
  const closing_motion<double>& place(int closure) const { return motions_[static_cast<std::size_t>(closure)]; }
  /// The motion of frame2 in frame1 of a closure of frames, at the motions of bodies in the working memory, after
  /// `at_positions` or `at_rates` with these velocities.
  template <class State>
  auto motion(const State& s, int closure) const {
    const auto k = static_cast<std::size_t>(closure);
    return accelerated(s, places.closures[k], ends_[k], motions_[k]);
  }
  /// The motion of frame2 in frame1 with bias accelerations, in a tree.
  template <class State>
  auto biased_motion(const State& s, int closure) {
    const auto k = static_cast<std::size_t>(closure);
    find_places(s, places.closures[k], ends_[k]);
    motions_[k] = between(ends_[k]);
    return accelerated<false>(s, places.closures[k], ends_[k], motions_[k]);
  }

 protected:
  template <class State, class Visit>
  static void coordinate_rows(const chain_constraints& c, State& s, const closure_place& x, const Visit& visit) {
    double q[4]{}, v[4]{}, by[4]{};
    if constexpr (may_have<State, kind::gen>)
      for (std::size_t n = 0; n < x.coordinates.size(); ++n) {
        const auto& at = s.template get<kind::gen>(x.coordinates[n]);
        q[n] = at.q, v[n] = at.q_dot;
      }
    visit(c.close_coordinates(x.element, q, v, by), by);
  }
  std::vector<closing_motion<double>> motions_;  ///< by closure of frames, at rest
  std::vector<ends_of_closure<double>> ends_;

 private:
  static constexpr int lanes = static_cast<int>(tree::simd_of<double>::count);
  using simd_load = tree::simd_wrench<double>;
  template <bool Accelerate>
  using powers = std::conditional_t<Accelerate, tree::load_powers<double>, const tree::no_powers>;
  /// Accelerations of a base at the origin of a frame with rotation R at p, in axes of the frame: R^T (a + al x p).
  template <class S>
  static tree::body_motion<S> seen_from_base(const tree::body_motion<S>& base, const mat3<vec3<S>>& r,
                                             const vec3<S>& p) {
    const auto back = transpose(r);
    tree::body_motion<S> x{};
    x.acceleration = back * (base.acceleration + cross(base.ang_acceleration, p));
    x.ang_acceleration = back * base.ang_acceleration;
    return x;
  }
  template <class State>
  static auto moved_by_base(const State& s, const runtime_frame& frame) {
    using S = typename State::scalar;
    const auto& place = s.tree().body_tree.frame(frame.what, frame.index);
    return seen_from_base<S>(s.work.bodies[static_cast<std::size_t>(place.slot)], as<S>(place.at.rotation),
                             as<S>(place.at.position));
  }
  template <class Load>
  static void clear_loads(std::vector<Load>& loads, const tree::load_way& way) {
    loads.resize((std::max)(loads.size(), way.nodes.size()));
    for (std::size_t n = 0; n < way.nodes.size(); ++n)
      if (way.loaded[n]) loads[n] = Load{};
  }
  template <bool Accelerate, class State, class Put>
  void half_solve_coordinates(const chain_constraints& c, State& s, const closure_place& x, const Eigen::VectorXd& root,
                              const Put& put) {
    coordinate_rows(c, s, x, [&](const auto& values, const double* by) {
      powers<Accelerate> sum;
      double of_jointless = 0;
      clear_loads(loads_, x.way), forces_.assign(tree::most_axes * x.way.nodes.size(), 0);
      for (std::size_t n = 0; n < x.dofs.size(); ++n) {
        const auto place = static_cast<std::size_t>(places.place_of_row[static_cast<std::size_t>(x.dofs[n])]);
        if (x.enters[n] >= 0) {
          forces_[tree::most_axes * static_cast<std::size_t>(x.enters[n]) + static_cast<std::size_t>(x.axes[n])] +=
              by[n];
          continue;
        }
        double all = 0;
        for (std::size_t k = 0; k < x.dofs.size(); ++k) all += x.dofs[k] == x.dofs[n] ? by[k] : 0;
        put(places.column_of_place[place], 0, root[static_cast<Eigen::Index>(place)] * all);
        if constexpr (Accelerate)
          of_jointless += by[n] * s.work.forces[x.dofs[n]] / s.tree().own_mass[static_cast<std::size_t>(x.dofs[n])];
      }
      const auto put_first = [&](int axis, const tree::simd<double>& e) {
        const auto place = static_cast<std::size_t>(places.place_of_axis[static_cast<std::size_t>(axis)]);
        double left[tree::simd_of<double>::count];
        tree::store<double>(e, left);
        put(places.column_of_place[place], 0, root[static_cast<Eigen::Index>(place)] * left[0]);
      };
      tree::send_to_bases(s.tree().body_tree, s.work, x.way, loads_.data(), forces_.data(), put_first, sum);
      if constexpr (Accelerate) {
        double left[tree::simd_of<double>::count];
        tree::store<double>(sum.sum, left);
        acceleration[x.first] = values[1] + of_jointless + left[0];
      }
    });
  }

  std::vector<simd_load> loads_;  ///< on the bodies of a path
  std::vector<double> forces_;
};

}  // namespace kte::detail
