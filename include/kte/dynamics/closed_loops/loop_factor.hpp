#pragma once

#include <kte/dynamics/closed_loops/loop_equations.hpp>
#include <kte/kernels/pivoted_qr.hpp>

/// The independent rows of closures, and the least change of a motion in kinetic energy that they ask for.
///
///   M = L^T L, L with entries only on the way to the base                        (1)
///   B = L^-T J^T,   so that B^T B = J M^-1 J^T                                     (2)
///   B_S = Q R,  S: the rows of J that column pivoting chooses                      (3)
///   d = L^-1 Q R^-T c:  J_S d = c_S with the least d^T M d                         (4)
///   lambda_S = R^-1 R^-T c: M d = J_S^T lambda_S                                   (5)
///
/// L: Featherstone, Rigid Body Dynamics Algorithms, 2008, 6.5. (2), not the mass of the loops J M^-1 J^T, whose
/// conditioning is squared.
namespace kte::detail {

class loop_factor {
 public:
  /// (1) to (3), after `at_positions` with J. Rows of which pivots are below `least` times the first are dependent.
  void choose(const runtime_chain& c, runtime_state& s, const loop_equations& e, double least) {
    factorize(c, s, e.places);
    parts.resize(e.places.blocks.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Eigen::MatrixXd b = half_solved(e, i);
      double most = 0;  // of what a row could be: less than its rounding is none
      for (const int k : e.places.blocks[i].places) most = (std::max)(most, 1 / l_(k, k));
      parts[i].choose(b, least, 1e-13 * most * (std::min)(1.0, 1 / e.places.length));
    }
  }
  /// The same for rows that were chosen elsewhere. False where they are dependent here.
  bool keep(const runtime_chain& c, runtime_state& s, const loop_equations& e, const loop_factor& chosen,
            double least) {
    factorize(c, s, e.places);
    parts.resize(e.places.blocks.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& rows = chosen.parts[i].chosen;
      const Eigen::MatrixXd all = half_solved(e, i);
      Eigen::MatrixXd b(all.rows(), static_cast<Eigen::Index>(rows.size()));
      for (std::size_t k = 0; k < rows.size(); ++k) b.col(static_cast<Eigen::Index>(k)) = all.col(rows[k]);
      if (!parts[i].take(b, rows, least)) return false;
    }
    return true;
  }
  int rank() const {
    std::size_t n = 0;
    for (const auto& p : parts) n += p.chosen.size();
    return static_cast<int>(n);
  }
  /// (4) for c of all rows; by degrees of freedom.
  Eigen::VectorXd least_change(const loop_equations& e, const Eigen::VectorXd& c) const {
    const auto& at = e.places;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(at.row_of_place.size()));
    for_each_part(e, c, [&](const pivoted_qr& p, const loop_block& b, Eigen::VectorXd& x, const std::vector<int>&) {
      p.r.transpose().triangularView<Eigen::Lower>().solveInPlace(x);
      const Eigen::VectorXd z = p.q * x;
      for (std::size_t k = 0; k < b.places.size(); ++k) y[b.places[k]] = z[static_cast<Eigen::Index>(k)];
    });
    for (Eigen::Index k = 0; k < y.size(); ++k) {  // L^-1
      for (int i = at.below[static_cast<std::size_t>(k)]; i >= 0; i = at.below[static_cast<std::size_t>(i)])
        y[k] -= l_(i, k) * y[i];
      y[k] /= l_(k, k);
    }
    Eigen::VectorXd d(y.size());
    for (Eigen::Index k = 0; k < y.size(); ++k) d[at.row_of_place[static_cast<std::size_t>(k)]] = y[k];
    return d;
  }
  /// (5), zero for rows that are not chosen.
  Eigen::VectorXd multipliers(const loop_equations& e, const Eigen::VectorXd& c) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(e.places.rows);
    for_each_part(e, c, [&](const pivoted_qr& p, const loop_block&, Eigen::VectorXd& x, const std::vector<int>& rows) {
      p.r.transpose().triangularView<Eigen::Lower>().solveInPlace(x);
      p.r.triangularView<Eigen::Upper>().solveInPlace(x);
      for (std::size_t k = 0; k < p.chosen.size(); ++k)
        all[rows[static_cast<std::size_t>(p.chosen[k])]] = x[static_cast<Eigen::Index>(k)];
    });
    return all;
  }
  /// The part of c in chosen rows, zero elsewhere.
  Eigen::VectorXd chosen_of(const loop_equations& e, const Eigen::VectorXd& c) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(e.places.rows);
    for_each_part(e, c, [&](const pivoted_qr& p, const loop_block&, Eigen::VectorXd& x, const std::vector<int>& rows) {
      for (std::size_t k = 0; k < p.chosen.size(); ++k)
        all[rows[static_cast<std::size_t>(p.chosen[k])]] = x[static_cast<Eigen::Index>(k)];
    });
    return all;
  }
  /// visit(factor of a block, the block, c of its chosen rows, the rows of the block among all).
  template <class Visit>
  void for_each_part(const loop_equations& e, const Eigen::VectorXd& c, const Visit& visit) const {
    std::vector<int> rows;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& b = e.places.blocks[i];
      rows.clear();
      for (const int k : b.closures) {
        const auto& x = e.places.closures[static_cast<std::size_t>(k)];
        for (int r = 0; r < x.rows.count(); ++r) rows.push_back(x.first + r);
      }
      Eigen::VectorXd x(static_cast<Eigen::Index>(parts[i].chosen.size()));
      for (std::size_t k = 0; k < parts[i].chosen.size(); ++k)
        x[static_cast<Eigen::Index>(k)] = c[rows[static_cast<std::size_t>(parts[i].chosen[k])]];
      visit(parts[i], b, x, rows);
    }
  }

  std::vector<pivoted_qr> parts;  ///< of blocks

 private:
  /// (1); l_(i, k) is L of place k and i on its way to the base.
  void factorize(const runtime_chain& c, runtime_state& s, const closure_places& at) {
    mass_of_coordinates(runtime_elements{c}, s);
    check_masses(s, s.work.mass);
    const auto n = static_cast<Eigen::Index>(at.row_of_place.size());
    if (l_.rows() != n) l_.resize(n, n);
    const auto& m = s.work.mass;
    const auto row = [&at](Eigen::Index k) { return at.row_of_place[static_cast<std::size_t>(k)]; };
    const auto below = [&at](Eigen::Index k) { return at.below[static_cast<std::size_t>(k)]; };
    for (Eigen::Index k = 0; k < n; ++k)
      for (auto i = k; i >= 0; i = below(i)) l_(i, k) = m(row(i), row(k));
    for (Eigen::Index k = n; k-- > 0;) {
      const double own = m(row(k), row(k));
      if (!(l_(k, k) > 4 * std::numeric_limits<double>::epsilon() * own)) [[unlikely]]
        diagnose_mass(s, row(k), true);
      l_(k, k) = std::sqrt(l_(k, k));
      for (auto i = below(k); i >= 0; i = below(i)) l_(i, k) /= l_(k, k);
      for (auto i = below(k); i >= 0; i = below(i))
        for (auto j = i; j >= 0; j = below(j)) l_(j, i) -= l_(i, k) * l_(j, k);
    }
  }
  /// (2) of block i.
  Eigen::MatrixXd half_solved(const loop_equations& e, std::size_t i) const {
    const auto& places = e.places.blocks[i].places;
    Eigen::MatrixXd b = e.jacobian[i].transpose();
    for (std::size_t k = places.size(); k-- > 0;) {
      const int place = places[k];
      b.row(static_cast<Eigen::Index>(k)) /= l_(place, place);
      for (int j = e.places.below[static_cast<std::size_t>(place)]; j >= 0;
           j = e.places.below[static_cast<std::size_t>(j)])
        b.row(e.places.column_of_place[static_cast<std::size_t>(j)]) -=
            l_(j, place) * b.row(static_cast<Eigen::Index>(k));
    }
    return b;
  }

  Eigen::MatrixXd l_;
};

}  // namespace kte::detail
