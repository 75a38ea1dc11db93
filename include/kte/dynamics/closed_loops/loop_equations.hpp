#pragma once

#include <kte/dynamics/closed_loops/closure_places.hpp>

/// The equations of closures at a state: residuals, their Jacobian, and what rates alone make of their accelerations.
/// Rows in m are divided by the length of the chain.
namespace kte::detail {

class loop_equations {
 public:
  loop_equations(const runtime_chain& c, const runtime_state& s) : places(c, s) {
    for (const auto& b : places.blocks) jacobian.emplace_back(b.rows, static_cast<Eigen::Index>(b.places.size()));
    residual.resize(places.rows), acceleration.resize(places.rows);
  }

  closure_places places;
  Eigen::VectorXd residual;               ///< g
  std::vector<Eigen::MatrixXd> jacobian;  ///< J of each block, its rows by its places
  Eigen::VectorXd acceleration;           ///< J_dot v

  /// g, and optionally J, at valid positions.
  void at_positions(const runtime_chain& c, runtime_state& s, bool with_jacobian) {
    place_bodies(runtime_elements{c}, s);
    for (std::size_t i = 0; i < places.blocks.size(); ++i) {
      if (with_jacobian) jacobian[i].setZero();
      int row = 0;
      for (const int k : places.blocks[i].closures) {
        const auto& x = places.closures[static_cast<std::size_t>(k)];
        double g[6];
        if (x.of_frames()) {
          const auto m = placed(s, x);
          element(c, x).close_frames(m, 0, g);
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
  /// J_dot v, after `at_positions`, at the rates of the state.
  void at_rates(const runtime_chain& c, runtime_state& s) {
    const auto& f = s.tree().body_tree;
    if (!s.tree().followers.empty()) {  // which accelerate with what they follow, and by its rates
      const Eigen::VectorXd a = read_numbers<vector_of::a>(s);
      write_numbers<vector_of::a>(s, Eigen::VectorXd::Zero(a.size()), "a");
      bring_up_to_date(runtime_elements{c}, s);
      take_rates(s);
      write_numbers<vector_of::a>(s, a, "a");
      bring_up_to_date(runtime_elements{c}, s);
    } else {
      take_rates(s);
    }
    take_bases(s);
    for (std::size_t k = 0; k < f.row.size(); ++k)
      if (f.row[k] < s.dofs()) s.work.acceleration[k] = 0;
    tree::move_bodies<true>(f, s.work);
    for (const auto& x : places.closures) {
      double rows[6];
      if (x.of_frames()) {
        const pose<mat3<vec3<>>, vec3<>> here{as<double>(matrix(no_rotation{})), {}};
        const auto m = placed(s, x);
        const auto a = moved(s, x.frame1, here), b = moved(s, x.frame2, {m.rotation, m.position});
        element(c, x).close_frames(as_closing_motion<double>(relative(a, b)), 2, rows);
      } else {
        coordinate_rows(c, s, x, [&rows](const auto& values, const double*) { rows[0] = values[1]; });
      }
      for (int r = 0; r < x.rows.count(); ++r) acceleration[x.first + r] = places.scale(x, r) * rows[r];
    }
  }
  /// J x of all rows, of x by degrees of freedom, and of the sizes of all numbers.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    return product(x, [](const Eigen::MatrixXd& j, const Eigen::VectorXd& part) { return (j * part).eval(); });
  }
  Eigen::VectorXd times_sizes(const Eigen::VectorXd& x) const {
    return product(x, [](const Eigen::MatrixXd& j, const Eigen::VectorXd& part) {
      return (j.cwiseAbs() * part.cwiseAbs()).eval();
    });
  }
  /// J by degrees of freedom, and of residuals in m and rad.
  Eigen::MatrixXd scaled_jacobian() const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(places.rows, static_cast<Eigen::Index>(places.row_of_place.size()));
    for (std::size_t i = 0; i < places.blocks.size(); ++i) {
      const auto& b = places.blocks[i];
      Eigen::Index row = 0;
      for (const int k : b.closures) {
        const auto& x = places.closures[static_cast<std::size_t>(k)];
        for (int r = 0; r < x.rows.count(); ++r, ++row)
          for (std::size_t n = 0; n < b.places.size(); ++n)
            all(x.first + r, places.row_of_place[static_cast<std::size_t>(b.places[n])]) =
                jacobian[i](row, static_cast<Eigen::Index>(n));
      }
    }
    return all;
  }
  Eigen::MatrixXd dense_jacobian() const {
    Eigen::MatrixXd all = scaled_jacobian();
    for (const auto& x : places.closures)
      for (int r = 0; r < x.rows.count(); ++r) all.row(x.first + r) /= places.scale(x, r);
    return all;
  }
  /// The motion of frame2 in frame1, at rest.
  static closing_motion<double> placed(runtime_state& s, const closure_place& x) {
    const auto& f = s.tree().body_tree;
    const auto &a = f.frame(x.frame1.what, x.frame1.index), &b = f.frame(x.frame2.what, x.frame2.index);
    const int common = tree::common_slot(f, a.slot, b.slot);
    tree::dense_pose<double> in_a, in_b;
    const int base_a = tree::pose_in_base(f, s.work, a, in_a, common);
    const int base_b = tree::pose_in_base(f, s.work, b, in_b, common);
    if (common < 0) in_a = in_world(s, base_a, in_a), in_b = in_world(s, base_b, in_b);
    const auto at = compose(inverse(in_a), in_b);
    return {as<double>(at.position), as<double>(matrix(at.rotation)), {}, {}, {}, {}};
  }
  static const kte_element& element(const runtime_chain& c, const closure_place& x) {
    return runtime_elements{c}.element(x.element);
  }

 private:
  int column_of_row(int row) const {
    return places.column_of_place[static_cast<std::size_t>(places.place_of_row[static_cast<std::size_t>(row)])];
  }
  template <class Visit>
  static void coordinate_rows(const runtime_chain& c, runtime_state& s, const closure_place& x, const Visit& visit) {
    double q[4]{}, v[4]{}, by[4]{};
    for (std::size_t n = 0; n < x.coordinates.size(); ++n) {
      const auto& at = s.get<kind::gen>(x.coordinates[n]);
      q[n] = at.q, v[n] = at.q_dot;
    }
    visit(element(c, x).close_coordinates(q, v, by), by);
  }
  template <class Product>
  Eigen::VectorXd product(const Eigen::VectorXd& x, const Product& of) const {
    Eigen::VectorXd out(places.rows);
    for (std::size_t i = 0; i < places.blocks.size(); ++i) {
      const auto& b = places.blocks[i];
      Eigen::VectorXd part(static_cast<Eigen::Index>(b.places.size()));
      for (std::size_t k = 0; k < b.places.size(); ++k)
        part[static_cast<Eigen::Index>(k)] = x[places.row_of_place[static_cast<std::size_t>(b.places[k])]];
      const Eigen::VectorXd y = of(jacobian[i], part);
      Eigen::Index row = 0;
      for (const int k : b.closures) {
        const auto& closure = places.closures[static_cast<std::size_t>(k)];
        for (int r = 0; r < closure.rows.count(); ++r) out[closure.first + r] = y[row++];
      }
    }
    return out;
  }
  /// Rows of J of a closure of frames, from row `first` of its block on.
  void fill(const runtime_chain& c, runtime_state& s, const closure_place& x, closing_motion<double> m,
            Eigen::MatrixXd& j, int first) const {
    const auto put = [&](int column, const double* six) {
      m.velocity = {six[0], six[1], six[2]}, m.ang_velocity = {six[3], six[4], six[5]};
      double rows[6];
      element(c, x).close_frames(m, 1, rows);
      for (int r = 0; r < x.rows.count(); ++r) j(first + r, column) += places.scale(x, r) * rows[r];
    };
    const auto& f = s.tree().body_tree;
    const auto &at_a = f.frame(x.frame1.what, x.frame1.index), &at_b = f.frame(x.frame2.what, x.frame2.index);
    const int common = tree::common_slot(f, at_a.slot, at_b.slot);
    const tree::frame_place<double> b_on_a{
        at_a.slot, plain_pose<double>(compose(pose{at_a.at.rotation, at_a.at.position}, pose{m.rotation, m.position}))};
    const auto each_column = [&](const auto& visit) {  // visit(axis, six numbers)
      const auto with_sign = [&visit](double sign) {
        return [&visit, sign](int k, const tree::direction<double>& v, const tree::direction<double>& w) {
          double six[6];
          tree::put_column<false, double>(six, sign * v, sign * w);
          visit(static_cast<std::size_t>(k), six);
        };
      };
      tree::dense_pose<double> seen;
      (void)tree::jacobian_columns(f, s.work, at_b, seen, with_sign(1), common);
      (void)tree::jacobian_columns(f, s.work, b_on_a, seen, with_sign(-1), common);
    };
    if (s.tree().plan.tree) {
      each_column([&](std::size_t k, const double* six) {
        if (const int place = places.place_of_axis[k]; place >= 0)
          put(places.column_of_place[static_cast<std::size_t>(place)], six);
      });
      return;
    }
    runtime_jacobian all = runtime_jacobian::Zero(6, s.tree().plan.coordinates);
    each_column([&](std::size_t k, const double* six) {
      all.col(f.row[k]) += Eigen::Map<const Eigen::Matrix<double, 6, 1>>(six);
    });
    all = folded(c, s, std::move(all));
    for (int row = 0; row < s.dofs(); ++row) put(column_of_row(row), all.col(row).data());
  }
  static tree::dense_pose<double> in_world(runtime_state& s, int base, const tree::dense_pose<double>& x) {
    tree::dense_pose<double> at = x;
    for_each_base(s, [&](const auto& m, std::size_t slot) {
      if (static_cast<int>(slot) == base) at = plain_pose<double>(compose(plain_pose<double>(m), x));
    });
    return at;
  }
  /// The motion of a frame that stands at a pose, in axes in which bodies are not placed: rates are in its own.
  static closing_motion<double> moved(const runtime_state& s, const runtime_frame& x,
                                      const pose<mat3<vec3<>>, vec3<>>& at) {
    const auto& place = s.tree().body_tree.frame(x.what, x.index);
    const auto& body = s.work.bodies[static_cast<std::size_t>(place.slot)];
    const motion of_body{vec3<>{},          no_rotation{},     body.velocity,
                         body.ang_velocity, body.acceleration, body.ang_acceleration};
    auto m = as_closing_motion<double>(compose(of_body, at_rest(place.at.rotation, place.at.position)));
    m.position = at.position, m.rotation = at.rotation;
    return m;
  }
};

/// The closure with the largest residual, and that, m or rad.
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
