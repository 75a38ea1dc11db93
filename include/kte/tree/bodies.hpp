#pragma once

#include <kte/engine/axes.hpp>
#include <kte/frames/articulated.hpp>
#include <kte/tree/placement.hpp>

/// The body nodes of a tree as bodies of recursions (engine/body.hpp), a type for each kind of joint.
namespace kte::tree {

/// The axes of a joint. They read the entries of the body node that are not typed constants.
struct about_z {
  static constexpr int axes = 1;
  template <int, class P>
  KTE_INLINE static constexpr auto axis(const body_node<P>&) {
    return engine::motion_vector{zero3{}, vec3{zero, zero, one}};
  }
};
struct along_z {
  static constexpr int axes = 1;
  template <int, class P>
  KTE_INLINE static constexpr auto axis(const body_node<P>&) {
    return engine::motion_vector{vec3{zero, zero, one}, zero3{}};
  }
};
struct along_and_about_z {
  static constexpr int axes = 1;
  template <int, class P>
  KTE_INLINE static constexpr auto axis(const body_node<P>& r) {
    return engine::motion_vector{vec3{zero, zero, r.slides}, vec3{zero, zero, r.turns}};
  }
};
/// f(axis k of a joint), as a type if possible.
template <class P, class S, class F>
KTE_INLINE auto with_axis(const body_node<P>& r, const joint_transform<S>& at, int k, const F& f) {
  if (r.moves == joint::revolute) return f(about_z::axis<0>(r));
  if (r.moves == joint::varying) return f(at.axis(k));
  if (r.moves == joint::screw) return f(along_and_about_z::axis<0>(r));
  return engine::with_unit_axis(r.axis[static_cast<std::size_t>(k)], f);
}
/// Joints that are free to move without masses on their coordinates, joints whose acceleration is given, and others.
struct free_joint {
  static constexpr bool always = true, free = true;
  static constexpr zero_t mass{};
};
struct given_joint {
  static constexpr bool always = false, free = false;
  static constexpr zero_t mass{};
};
template <class P>
struct joint_with_rotor {
  static constexpr bool always = false;
  bool free;
  P mass;
};

/// A body node with its joint transform.
template <class Axes, class P, class S, class Freedom = free_joint>
struct jointed_body {
  using scalar = S;
  const body_node<P>& r;
  const joint_transform<S>& at;

  [[no_unique_address]] Freedom freedom = {};

  static constexpr bool always_free = Freedom::always, never_free = std::is_same_v<Freedom, given_joint>;
  KTE_INLINE constexpr bool free() const { return freedom.free; }
  template <int>
  KTE_INLINE constexpr auto mass() const {
    return freedom.mass;
  }
  static constexpr int axes = Axes::axes;
  template <int K>
  KTE_INLINE constexpr auto axis() const {
    return Axes::template axis<K>(r);
  }
  KTE_INLINE int first() const { return r.first; }
  KTE_INLINE auto along_axes(const S* x) const { return engine::sum_along_axes(*this, x); }
  template <class W, class Put>
  KTE_INLINE void powers_along(const W& w, const Put& put) const {
    engine::each_power(*this, w, put);
  }
  KTE_INLINE const vec3<S>& position() const { return at.position; }
  KTE_INLINE const auto& inertia() const { return r.body; }
  KTE_INLINE const auto& composite() const { return r.weight; }
  KTE_INLINE static constexpr skip in(skip) { return {}; }
  KTE_INLINE static constexpr zero3 in(zero3) { return {}; }
  KTE_INLINE static constexpr skip out(skip) { return {}; }
  template <class U>
  KTE_INLINE auto in(const U& u) const {
    vec3<S> x;
    engine::assign(x, u);
    if (r.turned) engine::assign(x, in_z(r.before, x));
    return in_z(at.angle, in_x(r.tilt, x));
  }
  template <class A>
  KTE_INLINE auto out(const A& a) const {
    engine::dense<S, A> x;
    engine::assign(x, out_x(r.tilt, out_z(at.angle, a)));
    if (r.turned) engine::assign(x, out_z(r.before, x));
    return x;
  }
};
/// `jointed_body` for several unit axes with numbers known at run time, or for axes given by numbers.
template <class P, class S>
struct several_axes_body {
  using scalar = S;
  const body_node<P>& r;
  const joint_transform<S>& at;
  bool is_free = true;
  const P* masses = nullptr;  ///< masses on its coordinates, if there are any

  static constexpr bool always_free = false;
  KTE_INLINE bool free() const { return is_free; }
  KTE_INLINE int first() const { return r.first; }
  KTE_INLINE int axis_count() const { return r.axes; }
  KTE_INLINE bool has_unit_axes() const { return r.moves == joint::several; }
  KTE_INLINE int axis_number(int k) const { return r.axis[static_cast<std::size_t>(k)]; }
  KTE_INLINE const world_axis<S>& axis(int k) const { return at.axis(k); }
  KTE_INLINE S mass(int k) const { return masses == nullptr ? S(0) : S(masses[k]); }
  KTE_INLINE auto along_axes(const S* x) const {
    engine::motion_vector<vec3<S>, vec3<S>> sum{};
    tree::along_axes(r, at, x, sum.linear, sum.angular);
    return sum;
  }
  /// dS/dt q_dot
  auto bias(const S* rate) const {
    engine::motion_vector<vec3<S>, vec3<S>> sum{};
    if (!has_unit_axes()) [[unlikely]] {
      const auto [linear, angular] = bias_of_varying(r, at, rate);
      sum = {linear, angular};
    }
    return sum;
  }
  template <class Put>
  KTE_INLINE void powers_along(const dense_wrench<S>& w, const Put& put) const {
    tree::powers_along(r, at, w, r.axes, put);
  }
  template <class F>
  KTE_INLINE void each_axis(const F& f) const {
    for (int k = 0; k < r.axes; ++k)
      if (has_unit_axes())
        engine::with_unit_axis(axis_number(k), [&f, k](const auto& s) KTE_INLINE_LAMBDA { f(k, s); });
      else
        f(k, axis(k));
  }
  KTE_INLINE const vec3<S>& position() const { return at.position; }
  KTE_INLINE const auto& inertia() const { return r.body; }
  KTE_INLINE const auto& composite() const { return r.weight; }
  KTE_INLINE static constexpr skip in(skip) { return {}; }
  KTE_INLINE static constexpr skip out(skip) { return {}; }
  KTE_INLINE vec3<S> in(const vec3<S>& u) const {
    return transpose(at.rotation()) * placed<P, S>{r, at}.in_placement(u);
  }
  KTE_INLINE vec3<S> out(const vec3<S>& u) const {
    return placed<P, S>{r, at}.out_placement(vec3<S>(at.rotation() * u));
  }
  template <class A>
  KTE_INLINE A out(const A& a) const {
    return placed<P, S>{r, at}.out_placement(as<S>(turned_by(at.rotation(), a)));
  }
};
/// The body without its joint.
template <class P>
struct rigid_node {
  const body_node<P>& r;
  int slot;
  KTE_INLINE const auto& inertia() const { return r.body; }
  KTE_INLINE const auto& composite() const { return r.weight; }
};

/// All body nodes of a tree, in the form of engine/looped.hpp.
template <class P, class S>
class tree_bodies {
 public:
  tree_bodies(const body_tree<P>& f, const std::vector<joint_transform<S>>& joint_transforms)
      : nodes_(f.nodes.data()),
        joint_transforms_(joint_transforms.data()),
        bases_(f.bases),
        count_(static_cast<int>(f.nodes.size())) {}
  KTE_INLINE int count() const { return count_; }
  KTE_INLINE int bases() const { return bases_; }
  KTE_INLINE int parent(int i) const { return nodes_[i].parent; }
  KTE_INLINE bool branches(int i) const { return nodes_[i].branches; }
  KTE_INLINE bool usual(int i) const { return nodes_[i].moves == joint::revolute; }
  KTE_INLINE jointed_body<about_z, P, S> body(int i) const { return {nodes_[i], joint_transforms_[i]}; }
  KTE_INLINE rigid_node<P> rigid(int i) const { return {nodes_[i], bases_ + i}; }
  template <class F>
  KTE_INLINE void with_body(int i, const F& f) const {
    const body_node<P>& r = nodes_[i];
    const joint_transform<S>& at = joint_transforms_[i];
    if (r.has_matrix())
      f(several_axes_body<P, S>{r, at});
    else
      f(jointed_body<along_and_about_z, P, S>{r, at});
  }

 protected:
  const body_node<P>* nodes_;
  const joint_transform<S>* joint_transforms_;
  int bases_, count_;
};

/// `tree_bodies` with one type for all joints of one axis, for algorithms that gain little from the axes.
template <class P, class S>
class one_axis_bodies : public tree_bodies<P, S> {
 public:
  using tree_bodies<P, S>::tree_bodies;
  KTE_INLINE bool usual(int i) const { return !this->nodes_[i].has_matrix(); }
  KTE_INLINE jointed_body<along_and_about_z, P, S> body(int i) const {
    return {this->nodes_[i], this->joint_transforms_[i]};
  }
  template <class F>
  KTE_INLINE void with_body(int i, const F& f) const {
    f(several_axes_body<P, S>{this->nodes_[i], this->joint_transforms_[i]});
  }
};
/// `tree_bodies` with joints whose motion may be prescribed, and with masses on their coordinates.
template <class P, class S>
class articulated_bodies : public tree_bodies<P, S> {
 public:
  articulated_bodies(const body_tree<P>& f, const memory<P, S>& m) : articulated_bodies(f, m, m.joint_transforms) {}
  /// In other positions.
  articulated_bodies(const body_tree<P>& f, const memory<P, S>& m,
                     const std::vector<joint_transform<S>>& joint_transforms)
      : tree_bodies<P, S>(f, joint_transforms),
        free_(m.is_free.data()),
        plain_(m.plain.data()),
        mass_(m.own_mass.data()) {}
  KTE_INLINE bool usual(int i) const { return plain_[i] != 0; }
  template <class F>
  KTE_INLINE void with_body(int i, const F& f) const {
    const body_node<P>& r = this->nodes_[i];
    const joint_transform<S>& at = this->joint_transforms_[i];
    const bool free = free_[i] != 0;
    if (r.has_matrix())
      f(several_axes_body<P, S>{r, at, free, r.moves == joint::varying ? mass_ + r.first : nullptr});
    else if (r.moves == joint::prismatic && free && all(mass_[r.first] == P(0)))
      f(jointed_body<along_z, P, S>{r, at});
    else
      f(jointed_body<along_and_about_z, P, S, joint_with_rotor<P>>{r, at, {free, mass_[r.first]}});
  }

 private:
  const char *free_, *plain_;
  const P* mass_;
};

}  // namespace kte::tree
