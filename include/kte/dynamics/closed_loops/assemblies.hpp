#pragma once

#include <kte/dynamics/closed_loops/assemble.hpp>

namespace kte {

namespace detail {
std::vector<Eigen::VectorXd> all_assemblies(const runtime_chain& c, runtime_state& s, int starts,
                                            const Eigen::VectorXd& q, const std::vector<std::string>& held);
}  // namespace detail

/// All configurations with closed loops that `assemble` finds from n random starts, with coordinates held at their
/// values in q. So many must be held that no others move.
///
///   kte::assemblies(four_bar, s, 100, q, kte::held("crank"))    // elbow up, elbow down
///
/// Angles are in (-pi, pi] and quaternions have a scalar part that is not negative, as far as closures of coordinates
/// allow; two configurations that are equal but for whole turns and signs are one. They are sorted by their numbers,
/// and calls with equal arguments give equal results: starts have a fixed seed. Each is closed to rounding. That none
/// is missing is certain only for n to infinity: one that is reached from a share p of all starts is missing with the
/// probability (1 - p)^n.
///
/// Starts are uniform: angles over a turn, lengths over three lengths of the largest link to either side. Throws
/// `bad_argument` if the held coordinates leave the mechanism movable, `unknown_name`.
template <indexable Q>
std::vector<Eigen::VectorXd> assemblies(const runtime_chain& c, runtime_state& s, int n, const Q& q,
                                        const held_coordinates& held) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call(
      [&] { return detail::all_assemblies(c, s, n, detail::read_numbers<detail::vector_of::q>(s), held.names); });
}
/// Those of a chain in which no coordinate is held.
inline std::vector<Eigen::VectorXd> assemblies(const runtime_chain& c, runtime_state& s, int n) {
  return assemblies(c, s, n, neutral_configuration(c), {});
}

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <Eigen/QR>

#  include <random>

namespace kte::detail {

/// What tells the assemblies of a chain apart.
class assembly_list {
 public:
  assembly_list(const runtime_chain& c, runtime_state& s, const std::vector<std::string>& held)
      : chain_(c), state_(s), free_(static_cast<std::size_t>(s.dofs()), 1), turns_(free_.size(), 0) {
    const auto closures = closures_of(c);
    const auto nothing = [](const auto&...) {};
    const assembly all(closures, s, loops_of(c, s).equations, rows_of_coordinates(c, s, held), nothing, nothing);
    unit_ = all.units();
    for (const auto& f : s.freedoms()) turns_[static_cast<std::size_t>(f.v)] = f.what == kind::gen && !all.slides(f.v);
    for (const int row : rows_of_coordinates(c, s, held))
      free_[static_cast<std::size_t>(row)] = turns_[static_cast<std::size_t>(row)] = 0;
  }

  /// Uniform numbers over a turn or three lengths to either side, 0 for what is held.
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
  /// Each angle in (-pi, pi], each quaternion with w >= 0, where the loops stay closed.
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
           1e-5;  // where two meet they are known to the root of rounding
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
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(of_free);
    qr.setThreshold(1e-8);
    return qr.rank() < of_free.cols();
  }

  const runtime_chain& chain_;
  runtime_state& state_;
  Eigen::VectorXd unit_;
  std::vector<char> free_, turns_;  ///< of degrees of freedom
  std::vector<Eigen::VectorXd> all_;
  int movable_ = 0;
  std::mt19937 engine_{1};
};

KTE_FUNCTION std::vector<Eigen::VectorXd> all_assemblies(const runtime_chain& c, runtime_state& s, int starts,
                                                         const Eigen::VectorXd& q,
                                                         const std::vector<std::string>& held) {
  if (!has_loops(c)) throw bad_argument("kte: this chain has no loops, and no assemblies to find");
  assembly_list found(c, s, held);
  for (int i = 0; i < starts; ++i) {
    try {
      found.add(assembled(c, s, integrate(c, q, found.random_step(), 1.0), held));
    } catch (const cannot_assemble&) {  // not from there
    }
  }
  return found.sorted();
}

}  // namespace kte::detail
#endif
