#pragma once

#include <kte/contract/rigid_numbers.hpp>
#include <kte/tree/body_node.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

/// Makes the body nodes of a chain from the numbers of its joints, links and bodies.
namespace kte::tree {

template <class P>
struct body_tree_builder {
  using pose_type = pose<mat3<vec3<P>>, vec3<P>>;
  using place_type = frame_place<P>;

  body_tree<P> result;

  static pose_type nowhere() { return {as<P>(matrix(no_rotation{})), {}}; }

  /// A frame that no element writes.
  place_type add_base() {
    result.base_weight.push_back({});
    return {result.bases++, nowhere()};
  }
  static place_type link(const place_type& base, const detail::rigid_numbers<P>& x) {
    return {base.slot, compose(base.at, x.at_zero)};
  }
  /// `row`: row of its first axis. Body nodes are numbered in the order of the calls; `finish` puts the bases before
  /// them.
  place_type add_joint(const place_type& base, const detail::rigid_numbers<P>& x, kind what, int slot, int row,
                       bool is_free) {
    body_node<P> r;
    r.what = what, r.slot = slot, r.first = row, r.axes = nv_of(what), r.is_free = is_free, r.parent = base.slot;
    const pose_type body = what == kind::gen ? axis_to_z(x, r) : canonical(x, what, r);  // finally at zero
    placements_.push_back(compose(base.at, compose(x.at_zero, body)));
    result.nodes.push_back(r);
    return {number_of(result.nodes.size() - 1), inverse(body)};
  }
  /// Adds a joint with varying axes; `slots` and `rows` are those of its generalized coordinates.
  place_type add_varying_joint(const place_type& base, int element, std::span<const int> slots,
                               std::span<const int> rows, bool is_free) {
    body_node<P> r;
    r.slot = slots[0], r.first = rows[0], r.axes = static_cast<int>(slots.size()), r.is_free = is_free;
    r.parent = base.slot, r.element = element, r.moves = joint::varying;
    placements_.push_back(base.at);
    result.nodes.push_back(r);
    varying_.resize(result.nodes.size());
    varying_.back() = {{slots.begin(), slots.end()}, {rows.begin(), rows.end()}};
    return {number_of(result.nodes.size() - 1), nowhere()};
  }
  /// Whether the joint added last moves by (1) or (2) of contract/rigid_numbers.hpp.
  bool moves_by_axes(const detail::rigid_numbers<P>& x, const place_type& end) const {
    const body_node<P>& r = result.nodes.back();
    pose_type moved = nowhere();
    if (r.moves == joint::several) {
      moved.rotation = r.what == kind::pose_2D
                           ? mat3<vec3<P>>{{P(0.8), P(-0.6), P(0)}, {P(0.6), P(0.8), P(0)}, {P(0), P(0), P(1)}}
                           : as<P>(detail::tried_rotation);
      if (r.what != kind::rotation_3D) moved.position = as<P>(detail::tried_position);
      if (r.what == kind::pose_2D) moved.position.z = P(0);
    } else {
      using std::cos;
      using std::sin;
      const P q = static_cast<P>(detail::tried_angle), angle = r.turns * q;
      const P c = cos(angle), s = sin(angle);
      moved = {{{c, -s, P(0)}, {s, c, P(0)}, {P(0), P(0), P(1)}}, {P(0), P(0), r.slides * q}};
    }
    // at zero the end is at at_zero in the base, and the body at at_zero end^-1
    const pose_type y = compose(compose(compose(x.at_zero, inverse(end.at)), moved), end.at);
    const double least = 1e-8, rounding = 64 * static_cast<double>(std::numeric_limits<P>::epsilon());
    const P squared = static_cast<P>((std::max)(least * least, rounding * rounding));
    const auto close_to = [&squared](const vec3<P>& a, const vec3<P>& b) {
      const vec3<P> d = a - b;
      return dot(d, d) <= squared * (P(1) + dot(a, a));
    };
    return close_to(y.position, x.tried.position) && close_to(y.rotation.x, x.tried.rotation.x) &&
           close_to(y.rotation.y, x.tried.rotation.y) && close_to(y.rotation.z, x.tried.rotation.z);
  }
  void add_body(const place_type& at, const rigid_body<P, vec3<P>, sym3<P>>& b) {
    const rigid_body<P, vec3<P>, sym3<P>> moved{b.mass, to_parent(at.at, b.com), congruence(at.at.rotation, b.inertia)};
    add_weight(at, to_composite(b));
    if (is_node(at.slot)) {
      auto& to = node_at(at.slot).body;
      to = together(to, moved);
    }
  }
  /// Adds a mass that moves by its own law.
  void add_weight(const place_type& at, const composite<P, vec3<P>, sym3<P>>& c) {
    auto& to = is_node(at.slot) ? node_at(at.slot).weight : result.base_weight[static_cast<std::size_t>(at.slot)];
    const auto moved = transported(at.at.rotation, at.at.position, c);
    to = {to.mass + moved.mass, to.moment + moved.moment, to.inertia + moved.inertia};
  }

  /// Orders the body nodes and splits their placements. `places`: the places of all frames.
  body_tree<P> finish(std::array<std::vector<place_type>, 2> places) {
    order();
    for (auto& of_kind : places)
      for (auto& x : of_kind)
        if (is_node(x.slot)) x.slot = result.bases + position_[static_cast<std::size_t>(index_of(x.slot))];
    split_placements();
    for (auto& of_kind : places)
      for (auto& x : of_kind) {
        if (x.slot >= result.bases) turn_back(about_z_[static_cast<std::size_t>(x.slot - result.bases)], x.at);
        x.parallel = x.at.rotation == as<P>(matrix(no_rotation{}));
      }
    result.frames = std::move(places);
    return std::move(result);
  }

 private:
  // The slot of body node i while the number of bases is unknown: -1 - i.
  static int number_of(std::size_t node) { return -1 - static_cast<int>(node); }
  static bool is_node(int slot) { return slot < 0; }
  static int index_of(int slot) { return -1 - slot; }
  body_node<P>& node_at(int slot) { return result.nodes[static_cast<std::size_t>(index_of(slot))]; }

  /// Two bodies merged into one.
  static rigid_body<P, vec3<P>, sym3<P>> together(const rigid_body<P, vec3<P>, sym3<P>>& a,
                                                  const rigid_body<P, vec3<P>, sym3<P>>& b) {
    const P mass = a.mass + b.mass;
    if (!(mass > P(0))) return {mass, {}, a.inertia + b.inertia};
    const vec3<P> c = a.com + (b.mass / mass) * (b.com - a.com);
    const auto seen = [&c](const auto& x) {
      const vec3<P> d = x.com - c;
      return detail::shifted(x.inertia, d, detail::half(x.mass) * d);
    };
    return {mass, c, seen(a) + seen(b)};
  }

  static bool is_unit(const P& x) {
    using std::abs;
    return abs(x - P(1)) <= P(8) * std::numeric_limits<P>::epsilon();
  }
  /// A rotation whose z is the unit vector n; a permutation of axes if n is one of them.
  static mat3<vec3<P>> rotation_to(const vec3<P>& n) {
    using std::abs;
    using std::sqrt;
    if (n.z == P(1)) return {{P(1), P(0), P(0)}, {P(0), P(1), P(0)}, {P(0), P(0), P(1)}};
    // x of the new axes is normal to n and to the axis with the smallest component of n
    const vec3<P> across = abs(n.x) <= abs(n.y) && abs(n.x) <= abs(n.z) ? vec3<P>{P(1), P(0), P(0)}
                           : abs(n.y) <= abs(n.z)                       ? vec3<P>{P(0), P(1), P(0)}
                                                                        : vec3<P>{P(0), P(0), P(1)};
    const vec3<P> u = cross(across, n);
    const vec3<P> x = (P(1) / sqrt(P(dot(u, u)))) * u, y = cross(n, x);
    return {{x.x, y.x, n.x}, {x.y, y.y, n.y}, {x.z, y.z, n.z}};
  }
  /// For a joint of one coordinate: the pose in its end of the frame that moves along or about its own z.
  static pose_type axis_to_z(const detail::rigid_numbers<P>& x, body_node<P>& r) {
    using std::sqrt;
    const vec3<P>&v = x.linear[0], &w = x.angular[0];
    const P ww = dot(w, w), vv = dot(v, v);
    if (ww == P(0)) {
      const P length = sqrt(vv);
      r.slides = is_unit(length) ? P(1) : length;
      r.moves = r.slides == P(1) ? joint::prismatic : joint::screw;
      r.axis[0] = 2;
      return {rotation_to(is_unit(length) ? v : vec3<P>((P(1) / length) * v)), {}};
    }
    const P length = sqrt(ww);
    const bool unit = is_unit(length);
    const vec3<P> n = unit ? w : vec3<P>((P(1) / length) * w);
    r.turns = unit ? P(1) : length;
    r.slides = dot(v, n);
    r.moves = unit && r.slides == P(0) ? joint::revolute : joint::screw;
    r.axis[0] = 5;
    return {rotation_to(n), (P(1) / ww) * cross(w, v)};
  }
  /// B^-1 of (2): the unit motions of a rotation or pose, given in the axes of the end.
  static pose_type canonical(const detail::rigid_numbers<P>& x, kind what, body_node<P>& r) {
    r.moves = joint::several;
    const auto& w = x.angular;
    const auto& v = x.linear;
    if (what == kind::pose_2D) {
      r.axis = {0, 1, 5};
      const mat3<vec3<P>> b{{v[0].x, v[1].x, w[2].x}, {v[0].y, v[1].y, w[2].y}, {v[0].z, v[1].z, w[2].z}};
      // the end is at c in the body: v of the rotation is z x c
      const vec3<P> zc = transpose(b) * v[2];
      return inverse(pose_type{transpose(b), {zc.y, -zc.x, P(0)}});
    }
    for (int k = 0; k < r.axes; ++k)
      r.axis[static_cast<std::size_t>(k)] = static_cast<unsigned char>(what == kind::pose_3D ? k : 3 + k);
    const std::size_t f = what == kind::pose_3D ? 3 : 0;  // first angular axis
    const mat3<vec3<P>> b{
        {w[f].x, w[f + 1].x, w[f + 2].x}, {w[f].y, w[f + 1].y, w[f + 2].y}, {w[f].z, w[f + 1].z, w[f + 2].z}};
    const vec3<P> xc = transpose(b) * v[f], yc = transpose(b) * v[f + 1];  // e_x x c = (0, -c.z, c.y) ...
    return inverse(pose_type{transpose(b), {-yc.z, xc.z, -xc.y}});
  }

  /// Orders parents before children, makes the bodies beyond each one contiguous, and puts bases first.
  void order() {
    const auto n = result.nodes.size();
    std::vector<std::vector<int>> on(n);  // children by body node
    std::vector<int> stack;
    position_.assign(n, -1);
    for (std::size_t i = n; i-- > 0;) {  // the stack gives the first child first
      const int parent = result.nodes[i].parent;
      if (is_node(parent))
        on[static_cast<std::size_t>(index_of(parent))].push_back(static_cast<int>(i));
      else
        stack.push_back(static_cast<int>(i));
    }
    std::vector<int> order;
    while (!stack.empty()) {
      const int i = stack.back();
      stack.pop_back();
      position_[static_cast<std::size_t>(i)] = static_cast<int>(order.size());
      order.push_back(i);
      for (const int child : on[static_cast<std::size_t>(i)]) stack.push_back(child);
    }
    std::vector<body_node<P>> nodes;
    std::vector<pose_type> placements;
    for (const int i : order) {
      body_node<P> r = result.nodes[static_cast<std::size_t>(i)];
      if (is_node(r.parent)) r.parent = result.bases + position_[static_cast<std::size_t>(index_of(r.parent))];
      const int row = r.first;
      r.first = static_cast<int>(result.row.size());
      r.last = r.first + r.axes;
      if (r.moves == joint::varying) {
        const auto& [slots, rows] = varying_[static_cast<std::size_t>(i)];
        result.coordinate.resize(result.row.size());
        result.coordinate.insert(result.coordinate.end(), slots.begin(), slots.end());
        result.row.insert(result.row.end(), rows.begin(), rows.end());
        result.varying.push_back(static_cast<int>(nodes.size()));
      } else {
        for (int k = 0; k < r.axes; ++k) result.row.push_back(row + k);
      }
      nodes.push_back(r);
      placements.push_back(placements_[static_cast<std::size_t>(i)]);
    }
    for (std::size_t i = n; i-- > 0;)
      if (const int p = nodes[i].parent - result.bases; p >= 0)
        nodes[static_cast<std::size_t>(p)].last = (std::max)(nodes[static_cast<std::size_t>(p)].last, nodes[i].last);
    for (std::size_t i = 0; i < n; ++i)
      if (const int p = nodes[i].parent - result.bases; p >= 0 && p + 1 != static_cast<int>(i))
        nodes[static_cast<std::size_t>(p)].branches = true;
    for (std::size_t k = 0; k < result.row.size(); ++k) result.in_order &= result.row[k] == static_cast<int>(k);
    for (std::size_t i = 0; i < n; ++i) {  // a body leaves the stack when its last axis is passed
      for (; !stack.empty() && nodes[static_cast<std::size_t>(stack.back())].last <= nodes[i].first; stack.pop_back())
        result.inward.push_back(stack.back());
      stack.push_back(static_cast<int>(i));
    }
    result.inward.insert(result.inward.end(), stack.rbegin(), stack.rend());
    result.nodes = std::move(nodes), placements_ = std::move(placements);
  }

  /// Expresses a pose in axes that are then rotated by t about z.
  static void turn_back(const turn<P>& t, pose_type& x) {
    x.rotation = rows_out_z(t.back(), x.rotation), x.position = in_z(t, x.position);
  }
  static void turn_back(const turn<P>& t, body_node<P>& r) {
    r.body = {r.body.mass, in_z(t, r.body.com), out_z(t.back(), r.body.inertia)};
    r.weight = {r.weight.mass, in_z(t, r.weight.moment), out_z(t.back(), r.weight.inertia)};
  }
  /// The first Euler angle: R z = (sin before, -cos before, .) sin tilt.
  static turn<P> before_of(const mat3<vec3<P>>& r) {
    using std::sqrt;
    if (r.x.z == P(0)) return {};
    const P length = sqrt(P(r.x.z * r.x.z + r.y.z * r.y.z));
    return {-r.y.z / length, r.x.z / length};
  }
  /// Splits placements by (1) of tree/body_node.hpp. If the first child of a z-joint needs `before`, the joint is
  /// rotated by it instead, together with everything fixed to its body.
  void split_placements() {
    const auto n = result.nodes.size();
    about_z_.assign(n, {});
    std::vector<char> has_child(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      body_node<P>& r = result.nodes[i];
      pose_type placement = placements_[i];
      r.before = before_of(placement.rotation);
      const mat3<vec3<P>> rest = rows_out_z(r.before.back(), placement.rotation);  // Rx(tilt) Rz(after)
      r.tilt = {rest.z.z, -rest.y.z};
      r.after = {rest.x.x, -rest.x.y};
      if (const int p = r.parent - result.bases; p >= 0) {
        body_node<P>& on = result.nodes[static_cast<std::size_t>(p)];
        turn<P>& turned = about_z_[static_cast<std::size_t>(p)];
        if (!on.has_matrix() && !has_child[static_cast<std::size_t>(p)]) {
          turned = r.before;
          on.after = on.after * turned;
          turn_back(turned, on);
          r.before = {};
        } else {
          r.before = turned.back() * r.before;
        }
        has_child[static_cast<std::size_t>(p)] = 1;
        turn_back(turned, placement);
      }
      r.turned = r.before.cos != P(1) || r.before.sin != P(0);
      r.position = placement.position;
    }
  }

  struct varying_coordinates {
    std::vector<int> slots, rows;
  };
  std::vector<varying_coordinates> varying_;  ///< by body node; empty for other joints
  std::vector<pose_type> placements_;
  std::vector<int> position_;
  std::vector<turn<P>> about_z_;
};

}  // namespace kte::tree
