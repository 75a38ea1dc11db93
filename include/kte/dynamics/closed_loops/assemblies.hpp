#pragma once

#include <kte/dynamics/closed_loops/assemble.hpp>

namespace kte {

namespace detail {
std::vector<Eigen::VectorXd> all_assemblies(const runtime_chain& c, runtime_state& s, int starts,
                                            const Eigen::VectorXd& q, const std::vector<std::string>& held);
}  // namespace detail

/// All configurations with closed loops that `assemble` finds from n random starts, with coordinates held at their
/// values in q. The held coordinates must fix all others.
///
///   kte::assemblies(four_bar, s, 100, q, kte::held("crank"))    // elbow up, elbow down
///
/// Angles are in (-pi, pi] and quaternions have a non-negative scalar part, as far as closures of coordinates allow;
/// configurations that differ only by full turns and signs count as one. They are sorted by their numbers. Starts have
/// a fixed seed, so that equal arguments give equal results. Each is closed to rounding. If a fraction p of all starts
/// leads to a configuration, it is missing with the probability (1 - p)^n.
///
/// Starts are uniform: angles over a turn, lengths up to three lengths of the largest link in both directions. The
/// state is then at q. Throws `bad_argument` if n is not positive or the held coordinates leave the mechanism movable,
/// `unknown_name`.
template <indexable Q>
std::vector<Eigen::VectorXd> assemblies(const runtime_chain& c, runtime_state& s, int n, const Q& q,
                                        const held_coordinates& held) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call(
      [&] { return detail::all_assemblies(c, s, n, detail::read_numbers<detail::vector_of::q>(s), held.names); });
}
/// The assemblies of a chain in which no coordinate is held.
inline std::vector<Eigen::VectorXd> assemblies(const runtime_chain& c, runtime_state& s, int n) {
  return assemblies(c, s, n, neutral_configuration(c), {});
}

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <Eigen/QR>

#  include <random>

namespace kte::detail {

/// Collects the different assemblies of a chain.
class assembly_list {
 public:
  assembly_list(const runtime_chain& c, runtime_state& s, const std::vector<std::string>& held)
      : chain_(c), state_(s), free_(static_cast<std::size_t>(s.dofs()), 1), turns_(free_.size(), 0) {
    const auto slides = sliding_rows(s);
    unit_.setOnes(s.dofs());
    for (const auto& f : s.freedoms())
      for (int i = f.v; i < f.v + nv_of(f.what); ++i) {
        const auto row = static_cast<std::size_t>(i);
        if (slides[row]) unit_[i] = loops_of(c, s).equations.places.length;
        turns_[row] = f.what == kind::gen && !slides[row];
      }
    for (const int row : rows_of_coordinates(c, s, held))
      free_[static_cast<std::size_t>(row)] = turns_[static_cast<std::size_t>(row)] = 0;
  }

  /// Uniform numbers over a turn, or over three lengths in both directions; 0 for held coordinates.
  Eigen::VectorXd random_step() {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(unit_.size());
    for (Eigen::Index i = 0; i < d.size(); ++i) {
      const double x = static_cast<double>(engine_()) * 0x1p-31 - 1;
      if (free_[static_cast<std::size_t>(i)]) d[i] = 3.1415926535897931 * x * unit_[i];
    }
    return d;
  }
  void add(const Eigen::VectorXd& assembled) {
    const Eigen::VectorXd q = canonical(assembled);
    for (const auto& other : all_)
      if (same(other, q)) return;
    all_.push_back(q);
    movable_ += is_movable();
  }
  std::vector<Eigen::VectorXd> sorted() {
    if (!all_.empty() && movable_ == static_cast<int>(all_.size()))
      throw bad_argument("kte: the mechanism moves, and has no countable assemblies: hold more coordinates");
    std::sort(all_.begin(), all_.end(), [](const auto& a, const auto& b) {
      for (Eigen::Index i = 0; i < a.size(); ++i)
        if (const double x = std::round(a[i] * 1e5), y = std::round(b[i] * 1e5); x != y) return x < y;
      return false;
    });
    return std::move(all_);
  }

 private:
  static constexpr double turn = 6.2831853071795865;

  bool is_angle(const freedom& f) const { return turns_[static_cast<std::size_t>(f.v)] != 0; }
  bool closed(const Eigen::VectorXd& q) const { return loops_at(q).residual.cwiseAbs().maxCoeff() <= 1e-10; }
  loop_equations& loops_at(const Eigen::VectorXd& q) const {
    write_numbers<vector_of::q>(state_, q, "q");
    auto& e = loops_of(chain_, state_).equations;
    e.at_positions(closures_of(chain_), state_, true);
    return e;
  }
  /// The configuration with each angle in (-pi, pi] and each quaternion with w >= 0, where the loops stay closed.
  Eigen::VectorXd canonical(Eigen::VectorXd q) const {
    for (const auto& f : state_.freedoms()) {
      const Eigen::VectorXd before = q;
      if (is_angle(f)) {
        q[f.q] = std::remainder(q[f.q], turn);
        if (q[f.q] < -turn / 2 + 1e-9) q[f.q] += turn;
      }
      const int nq = nq_of(f.what);
      if (nq == 4 || nq == 7)
        if (auto r = q.segment(f.q + nq - 4, 4); r[0] < 0) r = -r;
      if (!closed(q)) q = before;
    }
    (void)loops_at(q);
    return q;
  }
  bool same(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    Eigen::VectorXd d = difference(chain_, a, b);
    for (const auto& f : state_.freedoms()) {
      const double turns = is_angle(f) ? std::round(d[f.v] / turn) * turn : 0;
      if (turns == 0) continue;
      Eigen::VectorXd turned = b;
      turned[f.q] -= turns;
      if (closed(turned)) d[f.v] -= turns;
    }
    return d.cwiseQuotient(unit_).cwiseAbs().maxCoeff() <
           1e-5;  // at a point where two meet they have errors of the square root of rounding
  }
  /// Whether the free coordinates can move at the state.
  bool is_movable() const {
    const Eigen::MatrixXd j = loops_of(chain_, state_).equations.scaled_jacobian();
    Eigen::MatrixXd of_free(j.rows(), 0);
    for (Eigen::Index i = 0; i < j.cols(); ++i)
      if (free_[static_cast<std::size_t>(i)]) {
        of_free.conservativeResize(Eigen::NoChange, of_free.cols() + 1);
        of_free.rightCols(1) = unit_[i] * j.col(i);
      }
    if (of_free.cols() == 0) return false;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(of_free);
    qr.setThreshold(1e-8);
    return qr.rank() < of_free.cols();
  }

  const runtime_chain& chain_;
  runtime_state& state_;
  Eigen::VectorXd unit_;
  std::vector<char> free_, turns_;  ///< by degree of freedom
  std::vector<Eigen::VectorXd> all_;
  int movable_ = 0;
  std::mt19937 engine_{1};
};

KTE_FUNCTION std::vector<Eigen::VectorXd> all_assemblies(const runtime_chain& c, runtime_state& s, int starts,
                                                         const Eigen::VectorXd& q,
                                                         const std::vector<std::string>& held) {
  if (!has_loops(c)) throw bad_argument("kte: this chain has no loops, and no assemblies to find");
  if (starts < 1)
    throw bad_argument("kte: assemblies: the number of starts must be positive, got " + std::to_string(starts));
  assembly_list found(c, s, held);
  for (int i = 0; i < starts; ++i) {
    try {
      found.add(assembled(c, s, integrate(c, q, found.random_step(), 1.0), held));
    } catch (const cannot_assemble&) {  // this start does not close
    }
  }
  write_numbers<vector_of::q>(s, q, "q");
  return found.sorted();
}

}  // namespace kte::detail
#endif
