#pragma once

#include <kte/tree/articulated.hpp>
#include <kte/tree/cluster_memory.hpp>

/// Forward dynamics of the body nodes of a tree with clusters (recursions/cluster.hpp).
namespace kte::tree {

/// A joint that is free to move and has no mass on its coordinate, or a joint in a cluster.
struct joint_that_may_be_in_cluster {
  static constexpr bool always = false;
  static constexpr zero_t mass{};
  bool free;
};
/// The body nodes of a tree with clusters, where most joints are in one.
template <class P, class S>
class clustered_bodies : public articulated_bodies<P, S> {
 public:
  clustered_bodies(const body_tree<P>& f, const memory<P, S>& m, const cluster_layout& layout)
      : articulated_bodies<P, S>(f, m),
        in_cluster_(layout.of_node.data()),
        free_(m.is_free.data()),
        mass_(m.own_mass.data()) {}
  KTE_INLINE bool usual(int i) const {
    return this->nodes_[i].moves == joint::revolute &&
           (in_cluster_[i] >= 0 || (free_[i] && mass_[this->nodes_[i].first] == P(0)));
  }
  KTE_INLINE jointed_body<about_z, P, S, joint_that_may_be_in_cluster> body(int i) const {
    return {this->nodes_[i], this->joint_transforms_[i], {free_[i] != 0}};
  }

 private:
  const int* in_cluster_;
  const char* free_;
  const P* mass_;
};

/// Steps of the recursion for bodies of clusters; for others those of trees.
template <class P, class S>
struct in_clusters {
  const body_tree<P>& f;
  const cluster_layout& layout;
  cluster_memory<S>& x;

  /// Which body node it is; -1: in no cluster.
  template <class B>
  KTE_INLINE int node_of(const B& b) const {
    if constexpr (B::always_free) {
      return -1;
    } else {
      const auto node = static_cast<int>(&b.r - f.nodes.data());
      return layout.has(node) ? node : -1;
    }
  }
  KTE_INLINE const S* ratios(int node) const { return x.rates.data() + layout.rates[static_cast<std::size_t>(node)]; }
  KTE_INLINE dense_wrench<S>* column(int node) const {
    return x.columns.data() + layout.columns[static_cast<std::size_t>(node)];
  }
};
template <class P, class S, class Eliminate>
struct cluster_elimination {
  in_clusters<P, S> in;
  const bias_motion<S>* biases;  ///< of slots
  Eliminate eliminate;
  int& unmoved;
  template <class B, class X, class Ends>
  KTE_INLINE auto operator()(const B& b, const X& x, const Ends& ends) const {
    if (const int node = in.node_of(b); node >= 0) add(b, node, x);
    return eliminate(b, x, ends);
  }

 private:
  template <class B, class X>
  KTE_INLINE void add(const B& b, int node, const X& x) const {
    const cluster& c = in.layout.at(node);
    const auto values = in.x.of(c);
    const int parent = b.r.parent;
    dense_wrench<S>* const to = parent == c.base ? values.load : in.column(parent - in.f.bases);
    const auto add_bodies = [&](const auto& n) KTE_INLINE_LAMBDA {
      engine::add_to_cluster(b, x, biases[in.f.bases + node], in.ratios(node), in.column(node), to, values, n);
    };
    if (values.n == 1) [[likely]]
      add_bodies(std::integral_constant<std::size_t, 1>{});
    else
      add_bodies(values.n);
    if (node == c.first_node && !close_cluster(values) && unmoved < 0) unmoved = b.first();
  }
};
template <class P, class S, class ToParent>
struct cluster_to_parent {
  in_clusters<P, S> in;
  ToParent to_parent;
  template <class B, class M, class Y>
  KTE_INLINE auto operator()(const B& b, const M& m, const Y& y) const {
    if constexpr (B::always_free) {
      return to_parent(b, m, y);
    } else {
      const int node = in.node_of(b);
      const auto sum = to_parent(b, m, y);
      engine::dense<S, decltype(engine::articulated_body{sum.inertia, sum.bias})> left;
      if (node >= 0 && node == in.layout.at(node).first_node)
        engine::assign(left, engine::less_cluster(sum, in.x.of(in.layout.at(node))));
      else
        engine::assign(left, sum);
      return left;
    }
  }
};
template <class P, class S>
struct acceleration_in_cluster {
  in_clusters<P, S> in;
  engine::acceleration_of_child<S> of_child;
  template <class B, class M, class A>
  KTE_INLINE auto operator()(const B& b, const M& m, const A& parent) const {
    if constexpr (B::always_free) {
      return of_child(b, m, parent);
    } else {
      auto moved = of_child(b, m, parent);
      if (const int node = in.node_of(b); node >= 0) add(b, node, parent, moved);
      return moved;
    }
  }

 private:
  template <class B, class A, class Moved>
  KTE_INLINE void add(const B& b, int node, const A& base, Moved& moved) const {
    const cluster& c = in.layout.at(node);
    S* const y = in.x.acceleration.data() + c.column;
    if (node == c.first_node)
      for (std::size_t d = 0; d < c.dofs.size(); ++d) y[d] = engine::cluster_acceleration(base, in.x.of(c), d);
    S more[6]{};
    const S* ratio = in.ratios(node);
    for (int k = 0; k < b.r.axes; ++k) {
      for (std::size_t d = 0; d < c.dofs.size(); ++d) more[k] += *ratio++ * y[d];
      of_child.change[b.first() + k] += more[k];
    }
    const auto [linear, angular] = b.along_axes(more);
    engine::assign(moved.acceleration, moved.acceleration + linear);
    engine::assign(moved.ang_acceleration, moved.ang_acceleration + angular);
  }
};

/// As `bias_motions`.
template <class P, class S>
auto bias_motions_of_clusters(const body_tree<P>& f, memory<P, S>& m, const cluster_layout& layout) {
  for (std::size_t b = 0; b < static_cast<std::size_t>(f.bases); ++b)
    m.biases[b].ang_velocity = m.bodies[b].ang_velocity;
  const clustered_bodies<P, S> bodies(f, m, layout);
  return engine::bias_motions<bias_motion<S>>(engine::looped<clustered_bodies<P, S>>{bodies}, m.biases.data(),
                                              m.rate.data(), m.acceleration.data());
}
/// As `articulate`, with clusters that are open. Those without bodies are closed too.
template <class P, class S, class Biases>
int articulate_clusters(const body_tree<P>& f, memory<P, S>& m, const cluster_layout& layout, cluster_memory<S>& x,
                        const Biases& biases) {
  const clustered_bodies<P, S> bodies(f, m, layout);
  int unmoved = -1;
  const auto force = [force = m.force.data()](const auto& b) KTE_INLINE_LAMBDA {
    return [of_joint = force + b.first()](int k) KTE_INLINE_LAMBDA { return of_joint[k]; };
  };
  const auto own = [load = load_of_slot<S>{m.loads.data()}](const auto& b, const auto& y)
                       KTE_INLINE_LAMBDA { return engine::velocity_wrench(b, y.ang_velocity) - load(b); };
  using force_type = decltype(force);
  using eliminate = engine::joint_elimination<S, force_type, int>;
  using to_parent = engine::articulated_to_parent<force_type>;
  const in_clusters<P, S> in{f, layout, x};
  engine::looped<clustered_bodies<P, S>>{bodies}.template inward<false, articulated_body<S>, false>(
      m.articulated.data(), biases, engine::articulated_alone<std::remove_const_t<decltype(own)>>{own},
      cluster_elimination<P, S, eliminate>{in, m.biases.data(), eliminate{force, m.factors.data(), unmoved}, unmoved},
      cluster_to_parent<P, S, to_parent>{in, to_parent{force}});
  return unmoved;
}
/// As `accelerate`.
template <class P, class S, class Biases>
void accelerate_clusters(const body_tree<P>& f, memory<P, S>& m, const cluster_layout& layout, cluster_memory<S>& x,
                         const Biases& biases) {
  using hand = engine::body_motion<skip, vec3<S>, vec3<S>, vec3<S>>;
  const clustered_bodies<P, S> bodies(f, m, layout);
  engine::looped<clustered_bodies<P, S>>{bodies}.template descend<hand>(
      m.bodies.data(), biases,
      acceleration_in_cluster<P, S>{{f, layout, x}, {m.factors.data(), m.acceleration.data()}});
}

}  // namespace kte::tree
