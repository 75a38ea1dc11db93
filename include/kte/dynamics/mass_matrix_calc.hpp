#pragma once

#include <kte/dynamics/detail/mass_blocks.hpp>
#include <kte/dynamics/motion_jacobians.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

/// The mass matrix of some bodies of a runtime chain over some of its coordinates, by their Jacobians. (That of all, in
/// O(n d) instead of O(n^3): dynamics/mass_matrix.hpp.)
namespace kte {

/// The bodies on a frame, or the masses on a generalized coordinate, of that name.
struct inertia_on {
  explicit inertia_on(std::string_view n) : name(n) {}
  std::string name;
};
/// A coordinate that is a degree of freedom, or several: a number, or that of a free or spherical joint.
struct moved_by {
  explicit moved_by(std::string_view n) : name(n) {}
  std::string name;
};

/// The twist-shaping matrix T, by which the rates of all bodies follow from those of the coordinates, its time
/// derivative, and the masses M_c of the bodies, block by block.
struct twist_shaping_result {
  Eigen::MatrixXd value, rate, masses;
};
/// M and dM/dt.
struct mass_matrix_with_rate {
  Eigen::MatrixXd value, rate;
};

/// Fed with bodies and coordinates by name, in any order:
///
///   kte::mass_matrix_calc calc(arm);
///   calc << kte::inertia_on("upper_end") << kte::inertia_on("tool") << kte::moved_by("shoulder");
///   calc.mass_matrix(s);          // at the positions of a state of the chain
///
/// gives, with T the motion Jacobians of the bodies' frames in their own axes, one below the other,
///
///   M = T^T M_c T,   dM/dt = dT/dt^T M_c T + T^T M_c dT/dt          (1)
///
/// Which coordinate moves what is found from the chain. Rows of T: generalized coordinates (1 each), frames in the
/// plane (3: velocity, then angular velocity), in space (6). Columns, of T and M: generalized coordinates, poses in the
/// plane (3), in space (6), rotations (3). In both, within a kind as they were fed. M_c has for a body of mass m, first
/// moment h and inertia I about the origin of its frame the block
///
///   ( m 1  -[h]x )
///   ( [h]x    I  )          (2)
class mass_matrix_calc {
 public:
  /// Works with a copy of the chain, of which it takes the same states.
  explicit mass_matrix_calc(kte_map_chain c) : chain_(std::move(c)) { (void)chain_.wiring(); }
  /// Fed with names, of inertias and of coordinates.
  mass_matrix_calc(kte_map_chain c, const std::vector<std::string>& on, const std::vector<std::string>& by)
      : mass_matrix_calc(std::move(c)) {
    for (const auto& n : on) *this << inertia_on(n);
    for (const auto& n : by) *this << moved_by(n);
  }
  /// All bodies and all coordinates of a chain, as they come.
  static mass_matrix_calc of_all(const kte_map_chain& c) {
    mass_matrix_calc calc(c);
    calc.of_all_ = true;
    for (std::size_t e = 0; e < c.wiring().elements.size(); ++e) calc.add_body(e);
    for (const auto& f : c.wiring().free) calc.add_coordinate(f);
    return calc;
  }

  /// Throws `unknown_name`; `bad_argument` where there is no mass, or it has been fed already.
  mass_matrix_calc& operator<<(const inertia_on& x) {
    bool found = false;
    for (const bool frame : {false, true}) {  // both may have the name
      const kind k = chain_.wiring().kind_of(x.name, frame);
      if (is_frame(k) != frame) continue;
      const int index = chain_.wiring().find(x.name, k);
      for (std::size_t e = 0; e < chain_.wiring().elements.size(); ++e) {
        const auto& at = chain_.wiring().elements[e];
        if (at.ports[0].what == k && at.index[0] == index) found |= add_body(e);
      }
    }
    if (!found) throw bad_argument("kte: mass_matrix_calc: there is no mass on '" + x.name + "'");
    inertias_.push_back(x.name);
    return *this;
  }
  /// Throws `unknown_name`; `bad_argument` for what is no degree of freedom, or has been fed already.
  mass_matrix_calc& operator<<(const moved_by& x) {
    const kind k = chain_.wiring().kind_of(x.name, false);
    const int index = chain_.wiring().find(x.name, k);
    for (const auto& f : chain_.wiring().free)
      if (f.what == k && f.slot == index) {
        add_coordinate(f), moved_by_.push_back(x.name);
        return *this;
      }
    throw bad_argument("kte: mass_matrix_calc: '" + x.name + "' is no degree of freedom");
  }

  const kte_map_chain& chain() const { return chain_; }
  /// Whether it was made of all, or else what it was fed with, in that order.
  bool is_of_all() const { return of_all_; }
  const std::vector<std::string>& inertias() const { return inertias_; }
  const std::vector<std::string>& coordinates() const { return moved_by_; }

  /// Where the columns stand in v.
  std::vector<int> columns() const {
    std::vector<int> all;
    for (const auto& f : coordinates_)
      for (int k = 0; k < nv_of(f.what); ++k) all.push_back(f.v + k);
    return all;
  }

  /// T, dT/dt and M_c at the positions and rates of a state.
  twist_shaping_result twist_shaping(runtime_state& s) const {
    check(s);
    detail::check_state_velocities(s);
    return shaped(s, true);
  }
  /// M at the positions of a state.
  Eigen::MatrixXd mass_matrix(runtime_state& s) const {
    check(s);
    detail::check_positions(s);
    return product(shaped(s, false));
  }
  /// M and dM/dt at its positions and rates.
  mass_matrix_with_rate mass_matrix_and_rate(runtime_state& s) const {
    const auto t = twist_shaping(s);
    const Eigen::MatrixXd half = t.rate.transpose() * t.masses * t.value;
    mass_matrix_with_rate m{product(t), half + half.transpose()};  // (1)
    detail::check_result(m.rate.data(), static_cast<std::size_t>(m.rate.size()), detail::too_large{"a mass matrix"});
    return m;
  }
  // The same at q, or q and v, which are put into the state.
  template <indexable Q>
  Eigen::MatrixXd mass_matrix(runtime_state& s, const Q& q) const {
    check(s), detail::take(chain_, s, q);
    return mass_matrix(s);
  }
  template <indexable Q, indexable V>
  mass_matrix_with_rate mass_matrix_and_rate(runtime_state& s, const Q& q, const V& v) const {
    check(s), detail::take(chain_, s, q, v);
    return mass_matrix_and_rate(s);
  }
  template <indexable Q, indexable V>
  twist_shaping_result twist_shaping(runtime_state& s, const Q& q, const V& v) const {
    check(s), detail::take(chain_, s, q, v);
    return twist_shaping(s);
  }

 private:
  struct body {
    std::size_t element;
    kind what;
    int index;
    Eigen::MatrixXd masses;
  };
  /// Whether it has a mass.
  bool add_body(std::size_t e) {
    const auto& at = chain_.wiring().elements[e];
    if (at.stiff) return false;
    if (at.spreads)
      throw bad_argument("kte: mass_matrix_calc: " + at.element->record().type + " has a mass between several things");
    const auto n = at.element->numbers();
    if (!n.has_mass && n.is != detail::part::body && n.is != detail::part::weight) return false;
    if (std::any_of(bodies_.begin(), bodies_.end(), [e](const body& b) { return b.element == e; }))
      throw bad_argument("kte: mass_matrix_calc: a mass is fed twice");
    detail::insert_by_kind(bodies_, body{e, at.ports[0].what, at.index[0], detail::mass_block(n, at.ports[0].what)});
    return true;
  }
  void add_coordinate(const detail::freedom& f) {
    if (std::any_of(coordinates_.begin(), coordinates_.end(), [&f](const auto& x) { return x.v == f.v; }))
      throw bad_argument("kte: mass_matrix_calc: a coordinate is fed twice");
    detail::insert_by_kind(coordinates_, f);
  }
  void check(const runtime_state& s) const { detail::check_regular(chain_, s); }

  /// At positions, and rates, that are good.
  twist_shaping_result shaped(runtime_state& s, bool rates) const {
    using namespace detail;
    const auto of = columns();
    Eigen::Index rows = 0;
    for (const auto& b : bodies_) rows += b.masses.rows();
    const auto n = static_cast<Eigen::Index>(of.size());
    twist_shaping_result t{Eigen::MatrixXd::Zero(rows, n), Eigen::MatrixXd::Zero(rates ? rows : 0, n),
                           Eigen::MatrixXd::Zero(rows, rows)};
    constexpr std::array in_plane{0, 1, 5};
    constexpr std::array in_space{0, 1, 2, 3, 4, 5};
    Eigen::Index row = 0;
    for (const auto& b : bodies_) {
      const Eigen::Index count = b.masses.rows();
      t.masses.block(row, row, count, count) = b.masses;
      const auto put = [&](Eigen::MatrixXd& to, const auto& from) {
        if (b.what == kind::frame_2D)
          to.middleRows(row, count) = from(in_plane, of);
        else
          to.middleRows(row, count) = from(in_space, of);
      };
      if (b.what == kind::gen) {
        const auto x = coordinate_row_with_rate(chain_, s, b.index);
        t.value.row(row) = x.value(of);
        if (rates) t.rate.row(row) = x.rate(of);
      } else if (rates) {
        const auto j = jacobian_with_rate_of<in_own_axes_t>(chain_, s, runtime_frame{b.what, b.index});
        put(t.value, j.value), put(t.rate, j.rate);
      } else {
        put(t.value, jacobian_of(chain_, s, runtime_frame{b.what, b.index}, false));
      }
      row += count;
    }
    return t;
  }
  static Eigen::MatrixXd product(const twist_shaping_result& t) {
    Eigen::MatrixXd m = t.value.transpose() * t.masses * t.value;  // (1)
    detail::check_result(m.data(), static_cast<std::size_t>(m.size()), detail::too_large{"a mass matrix"});
    return m;
  }

  kte_map_chain chain_;
  std::vector<body> bodies_;
  std::vector<detail::freedom> coordinates_;
  bool of_all_ = false;
  std::vector<std::string> inertias_, moved_by_;
};

}  // namespace kte
