#pragma once

#include <kte/dynamics/closed_loops/closure_places.hpp>

/// The equations of closures at a state: residuals, their Jacobian, and the velocity-dependent part of their
/// accelerations. Rows in m are divided by the length of the chain.
namespace kte::detail {

class loop_equations {
 public:
  template <class Closures, class State>
  loop_equations(const Closures& c, const State& s)
      : places(c, s), motions_(places.closures.size()), ends_(places.closures.size()) {
    for (const auto& b : places.blocks) jacobian.emplace_back(b.rows, static_cast<Eigen::Index>(b.places.size()));
    residual.resize(places.rows), acceleration.resize(places.rows);
  }

  closure_places places;
  Eigen::VectorXd residual;               ///< g
  std::vector<Eigen::MatrixXd> jacobian;  ///< J of each block: rows by places
  Eigen::VectorXd acceleration;           ///< J_dot v, or the second derivatives of residuals

  /// Computes g, and optionally J, at valid positions. `placed`: the bodies are placed already.
  template <class Closures, class State>
  void at_positions(const Closures& c, State& s, bool with_jacobian, bool placed = false) {
    if (!placed) place_bodies(c.elements(), s);
    for (std::size_t i = 0; i < places.blocks.size(); ++i) {
      if (with_jacobian) jacobian[i].setZero();
      int row = 0;
      for (const int k : places.blocks[i].closures) {
        const auto& x = places.closures[static_cast<std::size_t>(k)];
        double g[6];
        if (x.of_frames()) {
          find_places(s, x, ends_[static_cast<std::size_t>(k)]);
          auto& m = motions_[static_cast<std::size_t>(k)];
          m = between(ends_[static_cast<std::size_t>(k)]);
          c.close_frames(x.element, m, closing::residual, g);
          if (with_jacobian) fill(c, s, x, m, jacobian[i], row);
        } else {
          coordinate_rows(c, s, x, [&](const auto& values, const double* by) {
            g[0] = values[0];
            for (std::size_t n = 0; with_jacobian && n < x.dofs.size(); ++n)
              jacobian[i](row, column_of_row(x.dofs[n])) += by[n];
          });
        }
        for (int r = 0; r < x.rows.count(); ++r, ++row) residual[x.first + r] = places.scale(x, r) * g[r];
      }
    }
  }
  /// Computes J_dot v at the rates of the state; call `at_positions` first.
  template <class Closures, class State>
  void at_rates(const Closures& c, State& s) {
    if (!s.tree().followers.empty()) {  // these accelerate with the leading coordinates, and by their rates
      Eigen::VectorXd a(s.dofs());
      read_listed_numbers<vector_of::a>(s, a);
      const Eigen::VectorXd none = Eigen::VectorXd::Zero(a.size());
      put_accelerations(s, none), bring_up_to_date(c, s);
      take_rates(s);
      put_accelerations(s, a), bring_up_to_date(c, s);
    } else {
      take_rates(s);
    }
    take_bases(s);
    const auto& f = s.tree().body_tree;
    for (std::size_t k = 0; k < f.row.size(); ++k)
      if (f.row[k] < s.dofs()) s.work.acceleration[k] = 0;
    tree::move_bodies<true>(f, s.work);
    for (std::size_t k = 0; k < places.closures.size(); ++k)
      if (places.closures[k].of_frames()) find_places(s, places.closures[k], ends_[k]);
    accelerate_residuals(c, s, [](int) { return 0.0; });
  }
  /// Computes the second derivatives of residuals at the motions of bodies in the working memory; call `at_positions`
  /// first. a(i): the accelerations of degrees of freedom.
  template <class Closures, class State, class A>
  void accelerate_residuals(const Closures& c, State& s, const A& a) {
    for (std::size_t k = 0; k < places.closures.size(); ++k) {
      const auto& x = places.closures[k];
      double rows[6];
      if (x.of_frames()) {
        c.close_frames(x.element, accelerated(s, x, ends_[k], motions_[k]), closing::residual_ddot, rows);
      } else {
        coordinate_rows(c, s, x, [&](const auto& values, const double* by) {
          rows[0] = values[1];
          for (std::size_t n = 0; n < x.dofs.size(); ++n) rows[0] += by[n] * a(x.dofs[n]);
        });
      }
      for (int r = 0; r < x.rows.count(); ++r) acceleration[x.first + r] = places.scale(x, r) * rows[r];
    }
  }
  /// Calls put(column of its block, row, entry) for L^-T J^T of the rows of a closure, in a tree whose articulated
  /// inertias are in the working memory; call `at_positions` first. `root`: D^-1/2 by place. With `Accelerate` it also
  /// computes the second derivatives of the residuals, from bias motions and forces in the working memory.
  template <bool Accelerate, class Closures, class State, class Put>
  void half_solve(const Closures& c, State& s, int closure, const Eigen::VectorXd& root, const Put& put) {
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
      tree::add_to<S>(loads[static_cast<std::size_t>(x.enters[port])],
                      tree::seen_from<S>(place.rotation, place.position, load));
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
  /// The motion of frame2 in frame1 with bias accelerations, in a tree.
  template <class State>
  auto biased_motion(const State& s, int closure) {
    const auto k = static_cast<std::size_t>(closure);
    find_places(s, places.closures[k], ends_[k]);
    motions_[k] = between(ends_[k]);
    return accelerated<false>(s, places.closures[k], ends_[k], motions_[k]);
  }
  /// J x of all rows for x by degrees of freedom; `times_sizes`: the sums of |J| |x|.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    return product(x, [](double j, double v) { return j * v; });
  }
  void times(const Eigen::VectorXd& x, Eigen::VectorXd& out) const {
    out.setZero(places.rows);
    each_entry([&](int row, int dof, double j) { out[row] += j * x[dof]; });
  }
  Eigen::VectorXd times_sizes(const Eigen::VectorXd& x) const {
    return product(x, [](double j, double v) { return std::abs(j * v); });
  }
  /// J by degrees of freedom, for residuals in m and rad.
  Eigen::MatrixXd scaled_jacobian() const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(places.rows, static_cast<Eigen::Index>(places.row_of_place.size()));
    each_entry([&all](int row, int dof, double j) { all(row, dof) = j; });
    return all;
  }
  Eigen::MatrixXd dense_jacobian() const {
    Eigen::MatrixXd all = scaled_jacobian();
    for (const auto& x : places.closures)
      for (int r = 0; r < x.rows.count(); ++r) all.row(x.first + r) /= places.scale(x, r);
    return all;
  }
  /// Calls visit(axis, v, w) for the velocity of frame2 relative to frame1 by each axis, in axes of frame2; bodies are
  /// placed. m: the motion of frame2 in frame1.
  template <class State, class S, class Visit>
  static void each_relative_column(const State& s, const closure_place& x, const closing_motion<S>& m,
                                   const Visit& visit) {
    const auto& f = s.tree().body_tree;
    const auto &at_a = f.frame(x.frame1.what, x.frame1.index), &at_b = f.frame(x.frame2.what, x.frame2.index);
    const int common = tree::common_slot(f, at_a.slot, at_b.slot);
    const tree::frame_place<S> b_on_a{
        at_a.slot, plain_pose<S>(compose(pose{at_a.at.rotation, at_a.at.position}, pose{m.rotation, m.position}))};
    const auto with_sign = [&visit](double sign) {
      return [&visit, by = S(sign)](int k, const tree::direction<S>& v, const tree::direction<S>& w) {
        visit(k, by * v, by * w);
      };
    };
    tree::dense_pose<S> seen;
    (void)tree::jacobian_columns(f, s.work, at_b, seen, with_sign(1), common);
    (void)tree::jacobian_columns(f, s.work, b_on_a, seen, with_sign(-1), common);
  }
  /// The motion of frame2 in frame1 at rest.
  template <class State>
  static auto motion_between(const State& s, const closure_place& x) {
    ends_of_closure<typename State::scalar> at;
    find_places(s, x, at);
    return between(at);
  }
  /// As `biased_motion`, which is that of the place.
  template <class State>
  static auto biased_motion_between(const State& s, const closure_place& x) {
    ends_of_closure<typename State::scalar> at;
    find_places(s, x, at);
    return accelerated<false>(s, x, at, between(at));
  }
  /// The motion of frame2 in frame1 for moving bodies.
  template <class State>
  static auto moving_between(const State& s, const closure_place& x) {
    ends_of_closure<typename State::scalar> at;
    find_places(s, x, at);
    return accelerated(s, x, at, between(at));
  }

 private:
  static constexpr int lanes = static_cast<int>(tree::simd_of<double>::count);
  /// The frames of a closure in the body that carries both, or in the world; the slot of this body, or -1.
  template <class S>
  struct ends_of_closure {
    tree::moving_place<S> first, second;
    int common = -1;
  };
  template <class State, class S>
  static void find_places(const State& s, const closure_place& x, ends_of_closure<S>& at) {
    const auto& f = s.tree().body_tree;
    const auto &a = f.frame(x.frame1.what, x.frame1.index), &b = f.frame(x.frame2.what, x.frame2.index);
    at.common = tree::common_slot(f, a.slot, b.slot);
    const int base_a = tree::place_and_velocity(f, s.work, a, at.common, at.first);
    const int base_b = tree::place_and_velocity(f, s.work, b, at.common, at.second);
    if (at.common < 0) into_world(s, base_a, at.first), into_world(s, base_b, at.second);
  }
  template <class S>
  static closing_motion<S> between(const ends_of_closure<S>& at) {
    const auto to_a = transpose(at.first.rotation);
    return {to_a * (at.second.position - at.first.position), to_a * at.second.rotation, {}, {}, {}, {}};
  }
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
  int column_of_row(int row) const {
    return places.column_of_place[static_cast<std::size_t>(places.place_of_row[static_cast<std::size_t>(row)])];
  }
  template <class Load>
  static void clear_loads(std::vector<Load>& loads, const tree::load_way& way) {
    loads.resize((std::max)(loads.size(), way.nodes.size()));
    for (std::size_t n = 0; n < way.nodes.size(); ++n)
      if (way.loaded[n]) loads[n] = Load{};
  }
  template <class State>
  static void put_accelerations(State& s, const Eigen::VectorXd& a) {
    for_each_listed_freedom(s, [&a](auto& x, const freedom& at) { put<vector_of::a>(x, at, a); });
  }
  template <class Closures, class State, class Visit>
  static void coordinate_rows(const Closures& c, State& s, const closure_place& x, const Visit& visit) {
    double q[4]{}, v[4]{}, by[4]{};
    if constexpr (may_have<State, kind::gen>)
      for (std::size_t n = 0; n < x.coordinates.size(); ++n) {
        const auto& at = s.template get<kind::gen>(x.coordinates[n]);
        q[n] = at.q, v[n] = at.q_dot;
      }
    visit(c.close_coordinates(x.element, q, v, by), by);
  }
  template <bool Accelerate, class Closures, class State, class Put>
  void half_solve_coordinates(const Closures& c, State& s, const closure_place& x, const Eigen::VectorXd& root,
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
  /// Calls visit(row, degree of freedom, entry of J).
  template <class Visit>
  void each_entry(const Visit& visit) const {
    for (std::size_t i = 0; i < places.blocks.size(); ++i) {
      const auto& b = places.blocks[i];
      Eigen::Index row = 0;
      for (const int k : b.closures) {
        const auto& x = places.closures[static_cast<std::size_t>(k)];
        for (int r = 0; r < x.rows.count(); ++r, ++row)
          for (std::size_t n = 0; n < b.places.size(); ++n)
            visit(x.first + r, places.row_of_place[static_cast<std::size_t>(b.places[n])],
                  jacobian[i](row, static_cast<Eigen::Index>(n)));
      }
    }
  }
  template <class Product>
  Eigen::VectorXd product(const Eigen::VectorXd& x, const Product& of) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(places.rows);
    each_entry([&](int row, int dof, double j) { out[row] += of(j, x[dof]); });
    return out;
  }
  /// Computes the rows of J of a closure of frames, from row `first` of its block on.
  template <class Closures, class State>
  void fill(const Closures& c, State& s, const closure_place& x, closing_motion<double> m, Eigen::MatrixXd& j,
            int first) const {
    const auto put = [&](int column, const double* six) {
      m.velocity = {six[0], six[1], six[2]}, m.ang_velocity = {six[3], six[4], six[5]};
      double rows[6];
      c.close_frames(x.element, m, closing::residual_dot, rows);
      for (int r = 0; r < x.rows.count(); ++r) j(first + r, column) += places.scale(x, r) * rows[r];
    };
    const auto each_column = [&](const auto& visit) {  // visit(axis, six numbers)
      each_relative_column(s, x, m, [&](int k, const tree::direction<double>& v, const tree::direction<double>& w) {
        double six[6];
        tree::put_column<false, double>(six, v, w);
        visit(static_cast<std::size_t>(k), six);
      });
    };
    if (s.tree().plan.tree) {
      each_column([&](std::size_t k, const double* six) {
        if (const int place = places.place_of_axis[k]; place >= 0)
          put(places.column_of_place[static_cast<std::size_t>(place)], six);
      });
      return;
    }
    const auto& f = s.tree().body_tree;
    Eigen::Matrix<double, 6, Eigen::Dynamic> all =
        Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, s.tree().plan.coordinates);
    each_column([&](std::size_t k, const double* six) {
      all.col(f.row[k]) += Eigen::Map<const Eigen::Matrix<double, 6, 1>>(six);
    });
    if (all.cols() != s.dofs())
      pull_back_followers(c, s, [&all](int to, int from, double ratio) { all.col(to) += ratio * all.col(from); });
    for (int row = 0; row < s.dofs(); ++row) put(column_of_row(row), all.col(row).data());
  }
  /// The motion of frame2 in frame1 with all its derivatives; its pose is given. With the position p in the axes of
  /// frame1, and the velocities that frames have in the body or base that carries both,
  ///
  ///   p' = v_2 - v_1 - w_1 x p,   w = w_2 - R^T w_1                                        (1)
  ///   p'' = R a_2 - (a_1 + al_1 x p + w_1 x (w_1 x p) + 2 w_1 x p')                        (2)
  ///   al = al_2 - R^T al_1 + w x R^T w_1                                                   (3)
  ///
  /// where w_1 in (1) is relative to the common body. Without `Bodies` the accelerations of bodies count as zero, and
  /// angular velocities are those of bias motions.
  template <bool Bodies = true, class State, class S>
  static closing_motion<S> accelerated(const State& s, const closure_place& x, const ends_of_closure<S>& ends,
                                       closing_motion<S> m) {
    const auto& f = s.tree().body_tree;
    const auto &at_a = f.frame(x.frame1.what, x.frame1.index), &at_b = f.frame(x.frame2.what, x.frame2.index);
    const auto body_of = [&s](int slot) -> const auto& {
      if constexpr (Bodies)
        return s.work.bodies[static_cast<std::size_t>(slot)];
      else
        return s.work.biases[static_cast<std::size_t>(slot)];
    };
    const auto& [a, b, common] = ends;
    const auto to_a = transpose(a.rotation);
    const auto frame_motion = [&](const auto& at) {
      const auto& body = body_of(at.slot);
      const auto& p = at.at.position;
      const auto& w = body.ang_velocity;
      const auto back = transpose(at.at.rotation);
      if constexpr (Bodies)
        return std::array<vec3<S>, 3>{
            back * w, back * (body.acceleration + cross(body.ang_acceleration, p) + cross(w, cross(w, p))),
            back * body.ang_acceleration};
      else
        return std::array<vec3<S>, 3>{back * w, back * cross(w, cross(w, p)), vec3<S>{}};
    };
    const auto [w1, a1, al1] = frame_motion(at_a);
    const auto [w2, a2, al2] = frame_motion(at_b);
    const vec3<S> turns =
        common < 0 ? w1 : vec3<S>(w1 - to_a * body_of(common).ang_velocity);  // world: different bases
    const auto to_b = transpose(m.rotation);
    const vec3<S> rate = to_a * (b.velocity - a.velocity) - cross(turns, m.position);
    const vec3<S> w1_in_b = to_b * w1;
    m.velocity = to_b * rate, m.ang_velocity = w2 - w1_in_b;
    m.acceleration = a2 - to_b * (a1 + cross(al1, m.position) + cross(w1, cross(w1, m.position)) + 2 * cross(w1, rate));
    m.ang_acceleration = al2 - to_b * al1 + cross(m.ang_velocity, w1_in_b);
    return m;
  }
  /// In the world, for moving bases.
  template <class State, class S>
  static void into_world(const State& s, int base, tree::moving_place<S>& x) {
    for_each_base(s, [&](const auto& m, std::size_t slot) {
      if (static_cast<int>(slot) != base) return;
      const mat3<vec3<S>> r = as<S>(matrix(m.rotation));
      const vec3<S> v = as<S>(m.velocity), w = as<S>(m.ang_velocity);
      x.velocity = r * (v + cross(w, x.position) + x.velocity);
      x.position = as<S>(m.position) + r * x.position, x.rotation = r * x.rotation;
    });
  }

  std::vector<closing_motion<double>> motions_;  ///< by closure of frames, at rest
  std::vector<ends_of_closure<double>> ends_;
  std::vector<simd_load> loads_;  ///< on the bodies of a path
  std::vector<double> forces_;
};

/// The closure with the largest residual, and this residual, m or rad.
struct loop_gap {
  double size = 0;
  const closure_place* closure = nullptr;
  bool linear = false;
};
inline loop_gap widest_gap(const loop_equations& e) {
  loop_gap widest{0, &e.places.closures.front(), true};
  double most = -1;
  for (const auto& x : e.places.closures)
    for (int r = 0; r < x.rows.count(); ++r)
      if (const double g = std::abs(e.residual[x.first + r]); !(g <= most))
        most = g, widest = {g / e.places.scale(x, r), &x, r < x.rows.linear};
  return widest;
}

}  // namespace kte::detail
