#pragma once

#include <kte/integrators/tableau.hpp>

#include <vector>

/// Butcher's order conditions: weights b have order p if sum_i b_i phi_i(t) = theta^r / gamma(t) for all rooted trees t
/// of r <= p nodes (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, II.2).
///
///   phi(.) = 1, gamma(.) = 1;   phi([t1 ... tm]) = A phi(t1) * ... * A phi(tm),   gamma([t1 ... tm]) = r gamma(t1) ...
namespace kte::test {

/// In exact arithmetic, or in any other.
template <class Number, class Tableau>
class order_conditions {
 public:
  using vector = std::vector<Number>;
  static constexpr std::size_t stages = Tableau::stages;

  explicit order_conditions(int most) : trees_(static_cast<std::size_t>(most) + 1) {
    trees_[1].push_back({1, vector(stages, Number(1)), a_times(vector(stages, Number(1)))});
    for (int r = 2; r <= most; ++r)
      grow({1, vector(stages, Number(1)), {}}, r - 1, r - 1, trees_[size(r - 1)].size(), r);
  }

  static Number exact(const ratio& r) { return Number(r.num) / Number(r.den); }
  static vector exact(const typename Tableau::row& w) {
    vector v;
    for (const auto& r : w) v.push_back(exact(r));
    return v;
  }
  /// The largest difference in the conditions of an order, at theta.
  Number defect(const vector& b, int order, const Number& theta = Number(1)) const {
    Number power(1), most(0);
    for (int i = 0; i < order; ++i) power *= theta;
    for (const auto& t : trees_[size(order)]) {
      const Number d = dot(b, t.phi) - power / t.gamma, magnitude = d < 0 ? Number(-d) : d;
      most = most < magnitude ? magnitude : most;
    }
    return most;
  }
  /// How many trees there are of an order.
  std::size_t count(int order) const { return trees_[size(order)].size(); }
  /// Rows of `a` sum up to c.
  Number defect_of_rows() const {
    Number most(0);
    for (std::size_t i = 0; i < stages; ++i) {
      const Number d = trees_[1][0].a_phi[i] - exact(Tableau::c[i]), magnitude = d < 0 ? Number(-d) : d;
      most = most < magnitude ? magnitude : most;
    }
    return most;
  }

 private:
  struct tree {
    Number gamma;
    vector phi, a_phi;
  };
  static std::size_t size(int n) { return static_cast<std::size_t>(n); }
  static Number dot(const vector& a, const vector& b) {
    Number sum(0);
    for (std::size_t i = 0; i < stages; ++i) sum += a[i] * b[i];
    return sum;
  }
  static vector a_times(const vector& x) {
    vector v;
    for (std::size_t i = 0; i < stages; ++i) v.push_back(dot(exact(Tableau::a[i]), x));
    return v;
  }
  /// Hangs subtrees with `left` nodes together under the root of `t`, none behind number `last` of those with `most`
  /// nodes, so that each set of subtrees comes once.
  void grow(const tree& t, int left, int most, std::size_t last, int order) {
    if (left == 0) {
      trees_[size(order)].push_back({t.gamma * Number(order), t.phi, a_times(t.phi)});
      return;
    }
    for (int r = most < left ? most : left; r > 0; --r) {
      const auto& branches = trees_[size(r)];
      const std::size_t n = r == most ? last : branches.size();
      for (std::size_t k = 0; k < n; ++k) {
        tree next{t.gamma * branches[k].gamma, t.phi, {}};
        for (std::size_t i = 0; i < stages; ++i) next.phi[i] *= branches[k].a_phi[i];
        grow(next, left - r, r, k + 1, order);
      }
    }
  }

  std::vector<std::vector<tree>> trees_;  ///< by their number of nodes
};

}  // namespace kte::test
