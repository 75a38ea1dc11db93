#pragma once

#include <kte/dynamics/arguments/coordinate_motion.hpp>
#include <kte/dynamics/closed_loops/closure_loads.hpp>
#include <kte/dynamics/looped/rare_shapes.hpp>

#include <limits>

/// The equations of closures at a state: residuals, their Jacobian, and the velocity-dependent part of their
/// accelerations. Rows in m are divided by the length of the chain.
namespace kte::detail {

/// A filter of closures that all pass.
struct every_closure {
  constexpr bool operator()(int) const { return true; }
};

class loop_equations : public closure_loads {
 public:
  loop_equations(const chain_constraints& c, const runtime_state& s) : closure_loads(c, s) {
    for (const auto& b : places.blocks) jacobian.emplace_back(b.rows, static_cast<Eigen::Index>(b.places.size()));
    residual.resize(places.rows);
  }

  Eigen::VectorXd residual;               ///< g
  std::vector<Eigen::MatrixXd> jacobian;  ///< J of each block: rows by places

  /// Computes g, and optionally J, at valid positions. `placed`: the bodies are placed already.
  void at_positions(const chain_constraints& c, runtime_state& s, bool with_jacobian, bool placed = false);
  /// As `at_positions`, for the closures k with filter(k).
  template <class Filter>
  void at_positions_of(const chain_constraints& c, runtime_state& s, bool with_jacobian, bool placed,
                       const Filter& filter) {
    if (!placed) place_bodies(c.elements(), s);
    for (std::size_t i = 0; i < places.blocks.size(); ++i) {
      if (with_jacobian) jacobian[i].setZero();
      int row = 0;
      for (const int k : places.blocks[i].closures) {
        const auto& x = places.closures[static_cast<std::size_t>(k)];
        if (!filter(k)) {
          row += x.rows.count();
          continue;
        }
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
  void at_rates(const chain_constraints& c, runtime_state& s);
  /// Moves bodies at the rates of the state, for `motion` of the closures k with filter(k); call `at_positions` first.
  template <class Filter = every_closure>
  void at_velocities(const chain_constraints& c, runtime_state& s, const Filter& filter = {}) {
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
      if (places.closures[k].of_frames() && filter(static_cast<int>(k))) find_places(s, places.closures[k], ends_[k]);
  }
  /// Computes the rates of residuals by given motions, those of bases and of coordinates that signals move, while the
  /// degrees of freedom are at rest; call `at_positions` first. Zero without such motions. Overwrites the motion in the
  /// working memory of the state.
  void put_given_rates(const chain_constraints& c, runtime_state& s, Eigen::VectorXd& rates);
  /// Computes the second derivatives of residuals at the motions of bodies in the working memory; call `at_positions`
  /// first. a(i): the accelerations of degrees of freedom.
  template <class A>
  void accelerate_residuals(const chain_constraints& c, runtime_state& s, const A& a) {
    for (int k = 0; k < static_cast<int>(places.closures.size()); ++k) accelerate_residual(c, s, k, a);
  }
  /// As `accelerate_residuals`, for one closure.
  template <class A>
  void accelerate_residual(const chain_constraints& c, runtime_state& s, int closure, const A& a) {
    const auto& x = places.closures[static_cast<std::size_t>(closure)];
    if (x.of_frames()) return accelerate_residual_of_frames(c, closure, motion(s, closure));
    coordinate_rows(c, s, x, [&](const auto& values, const double* by) {
      double sum = values[1];
      for (std::size_t n = 0; n < x.dofs.size(); ++n) sum += by[n] * a(x.dofs[n]);
      acceleration[x.first] = places.scale(x, 0) * sum;
    });
  }
  /// As `accelerate_residual`, for a closure of frames, in the motion m of frame2 in frame1.
  void accelerate_residual_of_frames(const chain_constraints& c, int closure, const closing_motion<double>& m);
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
  /// The rounding errors that residuals have by those of the numbers q, which may be large: angles after many turns,
  /// bodies far away. Call `at_positions` with J first.
  template <class Q>
  double rounding(const runtime_state& s, const Q& q) const {
    Eigen::VectorXd sizes(s.dofs());
    for (const auto& f : s.freedoms()) magnitudes_of<double>(f, q, sizes);
    return 4 * std::numeric_limits<double>::epsilon() * times_sizes(sizes).maxCoeff();
  }
  /// J by degrees of freedom, for residuals in m and rad.
  Eigen::MatrixXd scaled_jacobian() const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(places.rows, static_cast<Eigen::Index>(places.row_of_place.size()));
    each_entry([&all](int row, int dof, double j) { all(row, dof) = j; });
    return all;
  }
  Eigen::MatrixXd dense_jacobian() const;

 private:
  int column_of_row(int row) const {
    return places.column_of_place[static_cast<std::size_t>(places.place_of_row[static_cast<std::size_t>(row)])];
  }
  static void put_accelerations(runtime_state& s, const Eigen::VectorXd& a) {
    for_each_listed_freedom(s, [&a](auto& x, const freedom& at) { put<vector_of::a>(x, at, a); });
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
          for (const int place : x.places) {
            const auto at = static_cast<std::size_t>(place);
            visit(x.first + r, places.row_of_place[at], jacobian[i](row, places.column_of_place[at]));
          }
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
  void fill(const chain_constraints& c, runtime_state& s, const closure_place& x, closing_motion<double> m,
            Eigen::MatrixXd& j, int first) const;
};

/// The closure with the largest residual, and this residual, m or rad.
struct loop_gap {
  double size = 0;
  const closure_place* closure = nullptr;
  bool linear = false;
};
loop_gap widest_gap(const loop_equations& e);
/// "'pin' is open by 0.1 m".
inline std::string gap_text(const chain_constraints& c, const loop_equations& e) {
  const auto widest = widest_gap(e);
  return "'" + c.loop_name(widest.closure->loop) + "' is open by " + number(widest.size) +
         (widest.linear ? " m" : " rad");
}

#ifdef KTE_FUNCTION
KTE_FUNCTION void loop_equations::at_positions(const chain_constraints& c, runtime_state& s, bool with_jacobian,
                                               bool placed) {
  at_positions_of(c, s, with_jacobian, placed, every_closure{});
}
KTE_FUNCTION void loop_equations::at_rates(const chain_constraints& c, runtime_state& s) {
  at_velocities(c, s);
  accelerate_residuals(c, s, [](int) { return 0.0; });
}
KTE_FUNCTION void loop_equations::put_given_rates(const chain_constraints& c, runtime_state& s,
                                                  Eigen::VectorXd& rates) {
  rates.setZero(places.rows);
  std::vector<double> kept(2 * static_cast<std::size_t>(s.dofs()));
  const rates_aside aside(s, true, kept);
  bring_up_to_date(c.elements(), s);
  take_rates(s), take_bases(s);
  tree::move_bodies<true>(s.tree().body_tree, s.work);
  for (std::size_t k = 0; k < places.closures.size(); ++k) {
    const auto& x = places.closures[k];
    if (!x.of_frames()) continue;
    double rows[6];
    find_places(s, x, ends_[k]);
    c.close_frames(x.element, accelerated(s, x, ends_[k], motions_[k]), closing::residual_dot, rows);
    for (int r = 0; r < x.rows.count(); ++r) rates[x.first + r] = places.scale(x, r) * rows[r];
  }
}
KTE_FUNCTION void loop_equations::accelerate_residual_of_frames(const chain_constraints& c, int closure,
                                                                const closing_motion<double>& m) {
  const auto& x = places.closures[static_cast<std::size_t>(closure)];
  double rows[6];
  c.close_frames(x.element, m, closing::residual_ddot, rows);
  for (int r = 0; r < x.rows.count(); ++r) acceleration[x.first + r] = places.scale(x, r) * rows[r];
}
KTE_FUNCTION Eigen::MatrixXd loop_equations::dense_jacobian() const {
  Eigen::MatrixXd all = scaled_jacobian();
  for (const auto& x : places.closures)
    for (int r = 0; r < x.rows.count(); ++r) all.row(x.first + r) /= places.scale(x, r);
  return all;
}
KTE_FUNCTION void loop_equations::fill(const chain_constraints& c, runtime_state& s, const closure_place& x,
                                       closing_motion<double> m, Eigen::MatrixXd& j, int first) const {
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
KTE_FUNCTION loop_gap widest_gap(const loop_equations& e) {
  loop_gap widest{0, &e.places.closures.front(), true};
  double most = -1;
  for (const auto& x : e.places.closures)
    for (int r = 0; r < x.rows.count(); ++r)
      if (const double g = std::abs(e.residual[x.first + r]); !(g <= most))
        most = g, widest = {g / e.places.scale(x, r), &x, r < x.rows.linear};
  return widest;
}
#endif

}  // namespace kte::detail
