#pragma once

#include <kte/tree/articulated.hpp>
#include <kte/tree/cluster_memory.hpp>

/// Forward dynamics of the body nodes of a tree with clusters (recursions/cluster.hpp).
namespace kte::tree {

/// The body nodes of a tree with clusters, where most joints are in one.
template <class P, class S>
class clustered_bodies : public articulated_bodies<P, S> {
 public:
  clustered_bodies(const body_tree<P>& f, const memory<P, S>& m, const cluster_layout& layout)
      : articulated_bodies<P, S>(f, m), in_cluster_(layout.nodes.data()) {}
  KTE_INLINE bool usual(int i) const { return this->nodes_[i].moves == joint::revolute && in_cluster_[i].cluster >= 0; }
  KTE_INLINE jointed_body<about_z, P, S, given_joint> body(int i) const {
    return {this->nodes_[i], this->joint_transforms_[i]};
  }

 private:
  const cluster_node* in_cluster_;
};

/// Steps of the recursion for bodies of clusters; for others those of trees.
template <class P, class S>
struct in_clusters {
  const body_tree<P>& f;
  const cluster_layout& layout;
  cluster_memory<S>& x;

  /// What a body is in a cluster; null: it is in none.
  template <class B>
  KTE_INLINE const cluster_node* node_of(const B& b) const {
    if constexpr (B::always_free) {
      return nullptr;
    } else {
      const cluster_node* const node = layout.nodes.data() + (&b.r - f.nodes.data());
      return engine::never_free<B> || node->cluster >= 0 ? node : nullptr;
    }
  }
  /// The rates of axis k of a body, by number.
  template <class B>
  KTE_INLINE auto rates_of(const B& b) const {
    const int* const row = f.row.data() + b.first();
    const std::size_t* const place = layout.rates.data();
    const S* const rates = x.rates.data();
    return [=](int k) KTE_INLINE_LAMBDA { return rates + place[row[k]]; };
  }
};
template <class P, class S, class Eliminate>
struct cluster_elimination {
  in_clusters<P, S> in;
  const bias_motion<S>* biases;  ///< of body nodes
  Eliminate eliminate;
  int& unmoved;
  template <class B, class X, class Ends>
  KTE_INLINE auto operator()(const B& b, const X& x, const Ends& ends) const {
    if (const cluster_node* const node = in.node_of(b)) add(b, *node, x);
    return eliminate(b, x, ends);
  }

 private:
  template <class B, class X>
  KTE_INLINE void add(const B& b, const cluster_node& node, const X& x) const {
    const auto values = in.x.of(in.layout.of(node));
    if constexpr (engine::never_free<B>) {
      if (values.n == 1) [[likely]] {
        dense_wrench<S>* const columns = in.x.columns.data();
        engine::add_to_cluster_of_one(b, x, biases[&b.r - in.f.nodes.data()], in.rates_of(b)(0)[0],
                                      columns[node.columns], columns[node.to], values);
      } else {
        const X copy = x;  // so that x stays in registers
        add_any(b, node, copy, values);
      }
    } else {
      add_any(b, node, x, values);
    }
    if (node.first && !close_cluster(values) && unmoved < 0) unmoved = b.first();
  }
  template <class B, class X>
  [[gnu::noinline]] void add_any(const B b, const cluster_node& node, const X& x,
                                 const engine::cluster_values<S>& values) const {
    dense_wrench<S>* const columns = in.x.columns.data();
    engine::add_to_cluster(b, x, biases[&b.r - in.f.nodes.data()], in.rates_of(b), columns + node.columns,
                           columns + node.to, values);
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
      const cluster_node* const node = in.node_of(b);
      const auto sum = to_parent(b, m, y);
      engine::dense<S, decltype(engine::articulated_body{sum.inertia, sum.bias})> left;
      if (node != nullptr && node->first)
        engine::assign(left, engine::less_cluster(sum, in.x.of(in.layout.of(*node))));
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
      if (const cluster_node* const node = in.node_of(b)) add(b, *node, parent, moved);
      return moved;
    }
  }

 private:
  template <class B, class A, class Moved>
  KTE_INLINE void add(const B& b, const cluster_node& node, const A& base, Moved& moved) const {
    const cluster& c = in.layout.of(node);
    const std::size_t n = c.dofs.size();
    S* const y = in.x.acceleration.data() + c.column;
    if (node.first)
      for (std::size_t d = 0; d < n; ++d) y[d] = engine::cluster_acceleration(base, in.x.of(c), d);
    const auto rates = in.rates_of(b);
    const auto more_of = [&](int k) KTE_INLINE_LAMBDA {
      S more(0);
      for (std::size_t d = 0; d < n; ++d) more += rates(k)[d] * y[d];
      of_child.change[b.first() + k] += more;
      return more;
    };
    const auto move = [&](const auto& by) KTE_INLINE_LAMBDA {
      engine::assign(moved.acceleration, moved.acceleration + by.linear);
      engine::assign(moved.ang_acceleration, moved.ang_acceleration + by.angular);
    };
    if constexpr (engine::never_free<B>) {
      static_assert(B::axes == 1);
      move(more_of(0) * b.template axis<0>());
    } else {
      S more[6]{};
      for (int k = 0; k < b.r.axes; ++k) more[k] = more_of(k);
      move(b.along_axes(more));
    }
  }
};

/// Articulated inertias and bias forces of all bodies, with clusters that are open. Those without bodies are closed
/// too. Writes `factors`. Returns the first axis that moves no mass, or -1.
template <class P, class S, class Biases>
int articulate_clusters(const body_tree<P>& f, memory<P, S>& m, const cluster_layout& layout, cluster_memory<S>& x,
                        const Biases& biases) {
  const clustered_bodies<P, S> bodies(f, m, layout);
  int unmoved = -1;
  const forces_on_axes<S> force{m.force.data()};
  using eliminate = engine::joint_elimination<S, forces_on_axes<S>, int>;
  using to_parent = engine::articulated_to_parent<forces_on_axes<S>>;
  const in_clusters<P, S> in{f, layout, x};
  engine::looped{bodies}.template inward<false, articulated_body<S>, false>(
      m.articulated.data(), biases, engine::articulated_alone<bias_wrench<S>>{{{m.loads.data()}}},
      cluster_elimination<P, S, eliminate>{in, m.biases.data() + f.bases, eliminate{force, m.factors.data(), unmoved},
                                           unmoved},
      cluster_to_parent<P, S, to_parent>{in, to_parent{force}});
  return unmoved;
}
/// Accelerations of all bodies and axes, after `articulate_clusters`.
template <class P, class S, class Biases>
void accelerate_clusters(const body_tree<P>& f, memory<P, S>& m, const cluster_layout& layout, cluster_memory<S>& x,
                         const Biases& biases) {
  const clustered_bodies<P, S> bodies(f, m, layout);
  engine::looped{bodies}.template descend<accelerated_body<S>>(
      m.bodies.data(), biases,
      acceleration_in_cluster<P, S>{{f, layout, x}, {m.factors.data(), m.acceleration.data()}});
}

}  // namespace kte::tree
