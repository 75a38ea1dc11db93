#pragma once

#include <kte/errors.hpp>
#include <kte/robots/detail/orientation.hpp>
#include <kte/robots/detail/triangle_mesh.hpp>

#include <algorithm>
#include <cmath>

namespace kte::detail {

/// The convex hull of points, by Quickhull (Barber, Dobkin and Huhdanpaa, ACM Transactions on Mathematical Software 22,
/// 1996): of the points outside of a facet the farthest is added, and new facets replace those that it sees. Visibility
/// is decided exactly (orientation.hpp), so that points on or near planes, edges and other points are harmless; the
/// remaining computations are in doubles. Facets wait in a queue. With a stack, one side of a prism with many corners
/// would be refined before the others, with a quadratic number of facets.
class hull_builder {
 public:
  explicit hull_builder(const std::vector<vec3<>>& points) : points_(scaled(points)) {}

  /// The faces as indices of the points; throws `bad_argument` if all points are in a plane.
  std::vector<std::array<std::uint32_t, 3>> build() {
    begin();
    for (std::size_t next = 0; next < pending_.size();) {  // grows in take_in
      const auto f = pending_[next++];
      if (!facets_[f].gone && !facets_[f].seen_by.empty()) take_in(farthest(f), f);
    }
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (const auto& f : facets_)
      if (!f.gone) faces.push_back(f.corners);
    return faces;
  }
  /// The number of facets created so far.
  std::size_t made() const { return facets_.size(); }

 private:
  using index = std::uint32_t;
  struct facet {
    std::array<index, 3> corners{};     ///< counterclockwise from outside
    std::array<index, 3> neighbours{};  ///< neighbour k shares the edge from corner k to corner k + 1
    std::vector<index> seen_by{};
    bool gone = false;
    index visit = 0;  ///< the last point for which it was visited
    bool visible = false;
  };
  /// An edge between visible and hidden facets.
  struct border {
    index from, to, beyond;
  };

  /// The points scaled by a power of two to about 1; coordinates too small for exact products become 0.
  static std::vector<vec3<>> scaled(std::vector<vec3<>> points) {
    double size = 0;
    for (const auto& p : points) size = (std::max)({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const int exponent = size > 0 ? std::ilogb(size) + 1 : 0;
    const auto scale = [&](double& x) {
      x = std::scalbn(x, -exponent);
      if (std::abs(x) < 1e-90) x = 0;
    };
    for (auto& p : points) scale(p.x), scale(p.y), scale(p.z);
    return points;
  }

  bool sees(index point, index f) const {
    const auto& [a, b, c] = facets_[f].corners;
    return orientation(points_[a], points_[b], points_[c], points_[point]) > 0;
  }
  vec3<> normal(index a, index b, index c) const { return cross(points_[b] - points_[a], points_[c] - points_[a]); }
  template <class F>
  index largest(const F& measure) const {
    index best = 0;
    double most = -1;
    for (index i = 0; i < points_.size(); ++i)
      if (const double m = measure(points_[i]); m > most) best = i, most = m;
    return best;
  }

  /// Begins with a large tetrahedron, found in linear time.
  void begin() {
    const auto squared = [](const vec3<>& v) { return dot(v, v); };
    const auto flat = [] { raise<bad_argument>("kte: the mesh has no volume: its vertices are in one plane"); };
    if (points_.size() < 4) flat();
    const index a = largest([&](const vec3<>& p) { return squared(p - points_[0]); });
    const index b = largest([&](const vec3<>& p) { return squared(p - points_[a]); });
    const auto edge = points_[b] - points_[a];
    const index c = largest([&](const vec3<>& p) { return squared(cross(edge, p - points_[a])); });
    const auto n = normal(a, b, c);
    index d = largest([&](const vec3<>& p) { return std::abs(dot(n, p - points_[a])); });
    double side = orientation(points_[a], points_[b], points_[c], points_[d]);
    if (side == 0) flat();
    const index u = side > 0 ? c : b, v = side > 0 ? b : c;  // d is below a, u, v
    facets_ = {{{a, u, v}, {1, 2, 3}}, {{u, a, d}, {0, 3, 2}}, {{v, u, d}, {0, 1, 3}}, {{a, v, d}, {0, 2, 1}}};
    std::vector<index> all(points_.size());
    for (index i = 0; i < all.size(); ++i) all[i] = i;
    share(all, 0, [&](index p) {
      index f = 0;
      while (f < 4 && !sees(p, f)) ++f;
      return f;
    });
  }
  /// Assigns each point to a facet from `first` on that it sees, by `seen`, which returns the number of all facets for
  /// points inside.
  template <class F>
  void share(const std::vector<index>& points, index first, const F& seen) {
    for (const auto p : points)
      if (const index f = seen(p); f < facets_.size()) facets_[f].seen_by.push_back(p);
    for (auto f = first; f < facets_.size(); ++f)
      if (!facets_[f].seen_by.empty()) pending_.push_back(f);
  }
  /// A facet that a point sees among those from `first` on, which form a fan about an apex; the number of all facets if
  /// there is none. A point that sees neither of the two facets at the edge from the apex to corner 0 is in their
  /// wedge, which the planes through that edge and the corners divide into sectors: the point can see facet k only in
  /// sector k. Bisection finds the sector.
  index seen_of_fan(index point, index first) const {
    const auto none = static_cast<index>(facets_.size());
    for (const index f : {first, none - 1})
      if (sees(point, f)) return f;
    const auto& apex = points_[facets_[first].corners[2]];
    const auto corner = [&](index k) -> const vec3<>& { return points_[facets_[first + k].corners[0]]; };
    index low = 1, high = none - 1 - first;
    while (high - low > 1) {
      const index middle = low + (high - low) / 2;
      (orientation(corner(0), corner(middle), apex, points_[point]) > 0 ? high : low) = middle;
    }
    return sees(point, first + low) ? first + low : none;
  }
  index farthest(index f) const {
    const auto& corners = facets_[f].corners;
    const auto base = points_[corners[0]], n = normal(corners[0], corners[1], corners[2]);
    const auto height = [&](index i) { return dot(n, points_[i] - base); };
    const auto& all = facets_[f].seen_by;
    return *std::max_element(all.begin(), all.end(), [&](index i, index j) { return height(i) < height(j); });
  }

  void take_in(index point, index seen) {
    std::vector<index> orphans;
    const auto rim = horizon(point, seen, orphans);
    const auto first = static_cast<index>(facets_.size()), n = static_cast<index>(rim.size());
    for (index k = 0; k < n; ++k) {  // a fan about the point, in the order of the horizon
      const auto& [from, to, beyond] = rim[k];
      facets_.push_back({{from, to, point}, {beyond, first + (k + 1) % n, first + (k + n - 1) % n}});
      auto& other = facets_[beyond];
      for (std::size_t e = 0; e < 3; ++e)
        if (other.corners[e] == to && other.corners[(e + 1) % 3] == from) other.neighbours[e] = first + k;
    }
    share(orphans, first, [&](index p) { return seen_of_fan(p, first); });
  }
  /// Removes the facets that the point sees and returns the edges around them in order.
  std::vector<border> horizon(index point, index seen, std::vector<index>& orphans) {
    std::vector<border> rim;
    struct step {
      index f;
      std::size_t entry, turned;
    };
    const auto visible = [&](index f) {
      auto& x = facets_[f];
      if (x.visit != point + 1) x.visit = point + 1, x.visible = sees(point, f);
      return x.visible;
    };
    const auto remove = [&](index f) {
      auto& x = facets_[f];
      x.gone = true;
      orphans.insert(orphans.end(), x.seen_by.begin(), x.seen_by.end());
      x.seen_by = {};
    };
    visible(seen), remove(seen);
    std::vector<step> path{{seen, 0, 0}};
    while (!path.empty()) {
      auto& [f, entry, turned] = path.back();
      if (turned == 3) {
        path.pop_back();
        continue;
      }
      const std::size_t e = (entry + turned++) % 3;
      const index from = facets_[f].corners[e], to = facets_[f].corners[(e + 1) % 3], next = facets_[f].neighbours[e];
      if (!visible(next)) {
        rim.push_back({from, to, next});
      } else if (!facets_[next].gone) {
        std::size_t back = 0;
        while (facets_[next].neighbours[back] != f || facets_[next].corners[back] != to) ++back;
        remove(next);
        path.push_back({next, back, 0});
      }
    }
    return rim;
  }

  std::vector<vec3<>> points_;
  std::vector<facet> facets_;
  std::vector<index> pending_;
};

inline triangle_mesh convex_hull(const std::vector<vec3<>>& points) { return {points, hull_builder(points).build()}; }

}  // namespace kte::detail
