#pragma once

#include <kte/tree/body_node.hpp>

#include <span>

/// The body trees of lanes, equal in structure, as one body tree of packs.
namespace kte::tree {

/// Sets lane `lane` of numbers in packs P.
template <class P>
class lane_writer {
  using T = typename P::value_type;

 public:
  explicit lane_writer(std::size_t lane) : lane_(lane) {}

  void operator()(P& to, const T& x) const { to.set(lane_, x); }
  void operator()(vec3<P>& to, const vec3<T>& x) const { put(to.x, x.x), put(to.y, x.y), put(to.z, x.z); }
  void operator()(mat3<vec3<P>>& to, const mat3<vec3<T>>& x) const { put(to.x, x.x), put(to.y, x.y), put(to.z, x.z); }
  void operator()(sym3<P>& to, const sym3<T>& x) const {
    put(to.xx, x.xx), put(to.xy, x.xy), put(to.xz, x.xz), put(to.yy, x.yy), put(to.yz, x.yz), put(to.zz, x.zz);
  }
  void operator()(turn<P>& to, const turn<T>& x) const { put(to.cos, x.cos), put(to.sin, x.sin); }
  void operator()(frame_place<P>& to, const frame_place<T>& x) const {
    to.slot = x.slot, put(to.at.rotation, x.at.rotation), put(to.at.position, x.at.position);
  }
  void operator()(composite<P, vec3<P>, sym3<P>>& to, const composite<T, vec3<T>, sym3<T>>& x) const {
    put(to.mass, x.mass), put(to.moment, x.moment), put(to.inertia, x.inertia);
  }
  /// A joint that is simpler in some lanes than in others has the general form in all.
  void operator()(body_node<P>& to, const body_node<T>& x) const {
    put(to.before, x.before), put(to.tilt, x.tilt), put(to.after, x.after), put(to.position, x.position);
    put(to.turns, x.turns), put(to.slides, x.slides), put(to.weight, x.weight);
    put(to.body.mass, x.body.mass), put(to.body.com, x.body.com), put(to.body.inertia, x.body.inertia);
    to.moves = lane_ == 0 || to.moves == x.moves ? x.moves : joint::screw;
    to.turned |= x.turned;
    to.is_free = x.is_free, to.branches = x.branches, to.axis = x.axis, to.axes = x.axes, to.parent = x.parent;
    to.first = x.first, to.last = x.last, to.what = x.what, to.slot = x.slot, to.element = x.element;
  }
  template <class To, class From>
  void operator()(std::vector<To>& to, const std::vector<From>& x) const {
    to.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) put(to[i], x[i]);
  }

 private:
  template <class To, class From>
  void put(To& to, const From& from) const {
    (*this)(to, from);
  }
  std::size_t lane_;
};

/// `lane(i)`: the body tree of lane i.
template <class P, class Lane>
body_tree<P> tree_in_lanes(const Lane& lane) {
  const auto& one = lane(0);
  body_tree<P> all;
  all.bases = one.bases, all.row = one.row, all.coordinate = one.coordinate, all.inward = one.inward;
  all.in_order = one.in_order, all.varying = one.varying;
  for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i) {
    const lane_writer<P> write(i);
    const auto& x = lane(i);
    write(all.nodes, x.nodes), write(all.base_weight, x.base_weight);
    for (std::size_t k = 0; k < all.frames.size(); ++k) write(all.frames[k], x.frames[k]);
  }
  return all;
}

}  // namespace kte::tree
