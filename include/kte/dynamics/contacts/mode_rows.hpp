#pragma once

#include <kte/dynamics/contacts/contact_forces.hpp>

#include <algorithm>

/// Rows of closures and contacts in one factor, and the least change of a motion, measured by kinetic energy, that
/// satisfies them:
///
///   B = L^-T J^T,   B_S = Q R,   d = L^-1 Q R^-T c:   J_S d = c_S          (1)
///
/// S: the independent rows, as for closures (dynamics/closed_loops/loop_factor.hpp).
namespace kte::detail {

/// A row of a contact: its velocity along an axis, in axes of the surface.
struct contact_row {
  int contact = 0;
  vec3<> axis{};
  bool selectable = true;  ///< whether the row is an equation; other rows are directions of forces
};

/// The rows of all closures, then those of contacts.
class mode_rows {
 public:
  std::vector<contact_row> rows;  ///< of contacts
  Eigen::MatrixXd all;            ///< B: places by rows
  pivoted_qr factor;              ///< of the rows `columns`
  std::vector<int> columns;       ///< numbers of rows that are equations

  /// Begins a list of rows.
  void clear(const contact_solver& m) {
    rows.clear();
    of_closures = 0;
    for (const int k : m.closures) of_closures += closure(m, k).rows.count();
  }
  int count() const { return of_closures + static_cast<int>(rows.size()); }
  /// B at the positions of the state; call `factorize` or `take_articulated` of m.factor first.
  void fill(const chain_constraints& c, runtime_state& s, contact_solver& m);
  /// (1), for the rows that were chosen before if they are independent enough, otherwise for those found here. Rows
  /// below `least` times the first count as dependent.
  void factorize(const std::vector<int>* chosen, double least = least_pivot);
  /// The chosen rows in order.
  void put_chosen(std::vector<int>& to) const {
    to = factor.chosen;
    std::sort(to.begin(), to.end());
  }
  /// Whether rows depend on each other.
  bool redundant() const { return factor.chosen.size() < columns.size(); }
  /// d of (1) for c by rows, by degrees of freedom.
  void least_change(runtime_state& s, contact_solver& m, const Eigen::VectorXd& c, Eigen::VectorXd& d);
  /// Writes the rows of closures from those of all closures and contacts, and of a contact the components along axes of
  /// of(contact), divided by the length of the chain.
  template <class Of>
  void put_values(const contact_solver& m, const Eigen::VectorXd& of_all, const Of& of, Eigen::VectorXd& to) const {
    to.resize(count());
    int row = 0;
    for (const int k : m.closures)
      for (int r = 0; r < closure(m, k).rows.count(); ++r) to[row++] = of_all[closure(m, k).first + r];
    for (const auto& x : rows)
      to[row++] = dot(x.axis, of(m.contacts[static_cast<std::size_t>(x.contact)])) / m.equations.places.length;
  }
  double largest_of_chosen(const Eigen::VectorXd& of) const;

  int of_closures = 0;

 private:
  static const closure_place& closure(const contact_solver& m, int k) {
    return m.equations.places.closures[static_cast<std::size_t>(k)];
  }
  void put(const std::vector<int>& which) {
    auto b = factor.matrix(all.rows(), static_cast<Eigen::Index>(which.size()));
    for (std::size_t k = 0; k < which.size(); ++k) b.col(static_cast<Eigen::Index>(k)) = all.col(which[k]);
  }
  Eigen::VectorXd part_, half_;
};

#ifdef KTE_FUNCTION
KTE_FUNCTION void mode_rows::fill(const chain_constraints& c, runtime_state& s, contact_solver& m) {
  all.setZero(static_cast<Eigen::Index>(m.equations.places.row_of_place.size()), count());
  int first = 0;
  for (const int k : m.closures) {
    m.factor.half_solve(c, s, m.equations, k, [&](int at, int row, double entry) { all(at, first + row) = entry; });
    first += closure(m, k).rows.count();
  }
  for (std::size_t i = 0, next = 0; i < rows.size(); i = next) {
    const int contact = rows[i].contact;
    while (next < rows.size() && rows[next].contact == contact) ++next;
    m.factor.half_solve(
        c, s, m.equations, m.contacts[static_cast<std::size_t>(contact)].closure, [&](int at, int row, double entry) {
          for (std::size_t r = i; r < next; ++r) {
            const auto& axis = rows[r].axis;
            all(at, of_closures + static_cast<int>(r)) += (row == 0 ? axis.x : row == 1 ? axis.y : axis.z) * entry;
          }
        });
  }
  columns.clear();
  for (int k = 0; k < count(); ++k)
    if (k < of_closures || rows[static_cast<std::size_t>(k - of_closures)].selectable) columns.push_back(k);
}
KTE_FUNCTION void mode_rows::factorize(const std::vector<int>* chosen, double least) {
  if (chosen && std::includes(columns.begin(), columns.end(), chosen->begin(), chosen->end())) {
    put(*chosen);
    if (factor.take(*chosen, 1e-7)) return;
  }
  put(columns);
  factor.choose(least);
  for (int& k : factor.chosen) k = columns[static_cast<std::size_t>(k)];
}
KTE_FUNCTION void mode_rows::least_change(runtime_state& s, contact_solver& m, const Eigen::VectorXd& c,
                                          Eigen::VectorXd& d) {
  part_.setZero(all.rows() + count() + pivoted_qr::padding), half_.setZero(all.rows() + pivoted_qr::padding);
  for (std::size_t k = 0; k < factor.chosen.size(); ++k) part_[static_cast<Eigen::Index>(k)] = c[factor.chosen[k]];
  factor.solve_transposed(part_.data());
  factor.times_q(part_.data(), half_.data());
  m.factor.other_half(s, m.equations, half_, d);
}
KTE_FUNCTION double mode_rows::largest_of_chosen(const Eigen::VectorXd& of) const {
  double most = 0;
  for (const int k : factor.chosen)
    if (!(std::abs(of[k]) <= most)) most = std::abs(of[k]);
  return most;
}
#endif

}  // namespace kte::detail
