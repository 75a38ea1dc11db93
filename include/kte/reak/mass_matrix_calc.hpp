#pragma once

#include <kte/reak/mass_blocks.hpp>
#include <kte/reak/motion_jacobians.hpp>
#include <kte/reak/static_mass_matrix_calc.hpp>
#include <kte/runtime_chain.hpp>

#include <algorithm>
#include <utility>
#include <vector>

/// The mass matrix of a runtime chain by twist shaping: reak/twist_shaping.hpp.
namespace kte {

template <>
class mass_matrix_calc<runtime_chain> {
 public:
  /// It owns a copy of the chain, and accepts the states of the chain.
  explicit mass_matrix_calc(runtime_chain c) : chain_(std::move(c)) { (void)chain_.wiring(); }
  /// With the names of inertias and of coordinates.
  mass_matrix_calc(runtime_chain c, const std::vector<std::string>& on, const std::vector<std::string>& by)
      : mass_matrix_calc(std::move(c)) {
    for (const auto& n : on) *this << inertia_on(n);
    for (const auto& n : by) *this << moved_by(n);
  }

  /// Throws `unknown_name`; `bad_argument` if there is no mass, or it was inserted before.
  mass_matrix_calc& operator<<(const inertia_on<>& x) {
    rollback feeding(*this);
    bool found = false;
    for (const bool frame : {false, true}) {  // both may have this name
      const kind k = chain_.wiring().kind_of(x.name, frame);
      if (is_frame(k) != frame) continue;
      const int index = chain_.wiring().find(x.name, k);
      for (std::size_t e = 0; e < chain_.wiring().elements.size(); ++e) {
        const auto& at = chain_.wiring().elements[e];
        if (at.ports[0].what == k && at.index[0] == index)
          found |= add_body(e);
        else if (at.distributed_mass && !at.rigid)
          for (std::size_t p = 1; p < at.ports.size(); ++p)
            if (at.ports[p].what == k && at.index[p] == index) refuse_distributed(e);
      }
    }
    if (!found) throw bad_argument("kte: mass_matrix_calc: there is no mass on '" + x.name + "'");
    inertias_.push_back(x.name);
    return feeding.kept();
  }
  /// Throws `unknown_name`; `bad_argument` for a name that is not a degree of freedom, or was inserted before.
  mass_matrix_calc& operator<<(const moved_by<>& x) {
    const kind k = chain_.wiring().kind_of(x.name, false);
    const int index = chain_.wiring().find(x.name, k);
    for (const auto& f : chain_.wiring().free)
      if (f.what == k && f.slot == index) {
        add_coordinate(f), moved_by_.push_back(x.name);
        return *this;
      }
    throw bad_argument("kte: mass_matrix_calc: '" + x.name + "' is not a degree of freedom");
  }

  mass_matrix_calc& operator<<(all_inertias_t) {
    rollback feeding(*this);
    for (std::size_t e = 0; e < chain_.wiring().elements.size(); ++e)
      if (add_body(e)) {
        const auto& at = chain_.wiring().elements[e];
        const auto& name =
            chain_.wiring().names[static_cast<std::size_t>(at.ports[0].what)][static_cast<std::size_t>(at.index[0])];
        if (std::find(inertias_.begin(), inertias_.end(), name) == inertias_.end()) inertias_.push_back(name);
      }
    return feeding.kept();
  }
  mass_matrix_calc& operator<<(all_coordinates_t) {
    rollback feeding(*this);
    for (const auto& f : chain_.wiring().free) {
      add_coordinate(f);
      moved_by_.push_back(chain_.wiring().names[static_cast<std::size_t>(f.what)][static_cast<std::size_t>(f.slot)]);
    }
    return feeding.kept();
  }

  [[nodiscard]] const runtime_chain& chain() const { return chain_; }
  // The inserted names, in order: inertias, and coordinates.
  [[nodiscard]] const std::vector<std::string>& inertias() const { return inertias_; }
  [[nodiscard]] const std::vector<std::string>& coordinates() const { return moved_by_; }

  /// The indices of the columns in v.
  [[nodiscard]] std::vector<int> columns() const {
    std::vector<int> all;
    for (const auto& f : coordinates_)
      for (int k = 0; k < nv_of(f.what); ++k) all.push_back(f.v + k);
    return all;
  }

  /// T, dT/dt and M_c at the positions and rates of a state.
  [[nodiscard]] twist_shaping_result<> twist_shaping(runtime_state& s) const {
    check(s);
    detail::check_state_velocities(s);
    return shaped(s, true);
  }
  /// M at the positions of a state.
  [[nodiscard]] Eigen::MatrixXd mass_matrix(runtime_state& s) const {
    check(s);
    detail::check_positions(s);
    return product(shaped(s, false), s);
  }
  /// M and dM/dt at its positions and rates.
  [[nodiscard]] mass_matrix_with_rate<> mass_matrix_and_rate(runtime_state& s) const {
    const auto t = twist_shaping(s);
    const Eigen::MatrixXd half = t.rate.transpose() * t.masses * t.value;
    mass_matrix_with_rate<> m{product(t, s), half + half.transpose()};  // (1)
    detail::check_result(m.rate.data(), static_cast<std::size_t>(m.rate.size()),
                         detail::diagnose_state{"a mass matrix", s});
    return m;
  }
  // At q, or at q and v, which are stored in the state.
  template <indexable Q>
  [[nodiscard]] Eigen::MatrixXd mass_matrix(runtime_state& s, const Q& q) const {
    check(s);
    return detail::take(chain_, s, q).call([&] { return mass_matrix(s); });
  }
  template <indexable Q, indexable V>
  [[nodiscard]] mass_matrix_with_rate<> mass_matrix_and_rate(runtime_state& s, const Q& q, const V& v) const {
    check(s);
    return detail::take(chain_, s, q, v).call([&] { return mass_matrix_and_rate(s); });
  }
  template <indexable Q, indexable V>
  [[nodiscard]] twist_shaping_result<> twist_shaping(runtime_state& s, const Q& q, const V& v) const {
    check(s);
    return detail::take(chain_, s, q, v).call([&] { return twist_shaping(s); });
  }

 private:
  struct body {
    std::size_t element;
    kind what;
    int index;
    Eigen::MatrixXd masses;
  };
  /// Removes what an insertion has added if it throws.
  class rollback {
   public:
    explicit rollback(mass_matrix_calc& of)
        : of_(of),
          bodies_(of.bodies_),
          coordinates_(of.coordinates_),
          inertias_(of.inertias_),
          moved_by_(of.moved_by_) {}
    rollback(const rollback&) = delete;
    rollback& operator=(const rollback&) = delete;
    ~rollback() {
      if (kept_) return;
      of_.bodies_.swap(bodies_), of_.coordinates_.swap(coordinates_);
      of_.inertias_.swap(inertias_), of_.moved_by_.swap(moved_by_);
    }
    mass_matrix_calc& kept() {
      kept_ = true;
      return of_;
    }

   private:
    mass_matrix_calc& of_;
    std::vector<body> bodies_;
    std::vector<detail::freedom> coordinates_;
    std::vector<std::string> inertias_, moved_by_;
    bool kept_ = false;
  };
  [[noreturn]] void refuse_distributed(std::size_t e) const {
    throw bad_argument("kte: mass_matrix_calc: " + describe_element(*chain_.wiring().elements[e].element) +
                       " has a distributed mass");
  }
  /// Adds an element; returns whether it has a mass.
  bool add_body(std::size_t e) {
    const auto& at = chain_.wiring().elements[e];
    if (at.rigid) return false;
    if (at.distributed_mass) refuse_distributed(e);
    const auto n = at.element->numbers();
    if (!n.has_mass && n.is != detail::part::body && n.is != detail::part::weight) return false;
    if (std::any_of(bodies_.begin(), bodies_.end(), [e](const body& b) { return b.element == e; }))
      throw bad_argument("kte: mass_matrix_calc: a mass is added twice");
    detail::insert_by_kind(bodies_, body{e, at.ports[0].what, at.index[0], detail::mass_block(n, at.ports[0].what)});
    return true;
  }
  void add_coordinate(const detail::freedom& f) {
    if (std::any_of(coordinates_.begin(), coordinates_.end(), [&f](const auto& x) { return x.v == f.v; }))
      throw bad_argument("kte: mass_matrix_calc: a coordinate is added twice");
    detail::insert_by_kind(coordinates_, f);
  }
  void check(const runtime_state& s) const { detail::check_regular(chain_, s); }

  /// T, dT/dt and M_c at positions, and rates, that have been checked.
  twist_shaping_result<> shaped(runtime_state& s, bool rates) const {
    using namespace detail;
    const auto of = columns();
    Eigen::Index rows = 0;
    for (const auto& b : bodies_) rows += b.masses.rows();
    const auto n = static_cast<Eigen::Index>(of.size());
    twist_shaping_result<> t{Eigen::MatrixXd::Zero(rows, n), Eigen::MatrixXd::Zero(rates ? rows : 0, n),
                             Eigen::MatrixXd::Zero(rows, rows)};
    constexpr auto in_plane = rows_in_space<kind::frame_2D>();
    constexpr auto in_space = rows_in_space<kind::frame_3D>();
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
  static Eigen::MatrixXd product(const twist_shaping_result<>& t, const runtime_state& s) {
    Eigen::MatrixXd m = t.value.transpose() * t.masses * t.value;  // (1)
    detail::check_result(m.data(), static_cast<std::size_t>(m.size()), detail::diagnose_state{"a mass matrix", s});
    return m;
  }

  runtime_chain chain_;
  std::vector<body> bodies_;
  std::vector<detail::freedom> coordinates_;
  std::vector<std::string> inertias_, moved_by_;
};
mass_matrix_calc(runtime_chain)->mass_matrix_calc<runtime_chain>;

}  // namespace kte
