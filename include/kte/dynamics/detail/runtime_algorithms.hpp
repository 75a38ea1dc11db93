#pragma once

#include <kte/dynamics/detail/runtime_arguments.hpp>
#include <kte/dynamics/detail/stored_algorithms.hpp>

#include <algorithm>
#include <utility>

/// The algorithms on runtime chains: loops over elements, which do their part in the working memory of a state.
namespace kte {

namespace detail {

inline void check_masses(const runtime_state& s, const Eigen::MatrixXd& m) {
  check_result(m.diagonal(), static_cast<std::size_t>(s.dofs()), [&s] { blame("a mass", s); });
}

/// Sines, cosines and matrices of the coordinates.
inline void update_angles(runtime_state& s) {
  auto& w = s.work;
  const auto& angles = s.plan.angles;
  for (std::size_t i = 0; i < angles.size(); ++i) w.angle[i] = s.get<kind::gen>(angles[i]).q;
  sincos_each(w.angle.data(), w.sine.data(), w.cosine.data(), w.angle.size());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    auto& c = s.get<kind::gen>(angles[i]);
    c.sin = w.sine[i], c.cos = w.cosine[i];
  }
  const auto& t = *s.made_for();
  for (const auto& f : t.free) {
    if (f.what == kind::rotation_3D) update_angle(s.get<kind::rotation_3D>(f.slot));
    if (f.what == kind::pose_2D) update_angle(s.get<kind::pose_2D>(f.slot));
    if (f.what == kind::pose_3D) update_angle(s.get<kind::pose_3D>(f.slot));
  }
  for_each_given_coordinate(s, [](gen_coord<>& c) { update_angle(c); });
}

/// Frames that no element writes, into the working memory; no forces anywhere.
inline void start(runtime_state& s) {
  for (std::size_t i = 0; i < s.plan.row_of_gen.size(); ++i) s.get<kind::gen>(static_cast<int>(i)).f = 0;
  for_each_listed_freedom(s, [](auto& c, const freedom&) {
    if constexpr (requires { clear_load(c); }) clear_load(c);
  });
  for (const auto& base : s.plan.bases) {
    const auto set = [&s, i = base.second]<kind K>(std::integral_constant<kind, K>) {
      const auto m = spatial(s.get<K>(i));
      s.work.frames.get<K>(i) = {
          as<double>(m.ang_velocity), as<double>(m.acceleration), as<double>(m.ang_acceleration), {}};
    };
    if (base.first == kind::frame_2D)
      set(std::integral_constant<kind, kind::frame_2D>{});
    else
      set(std::integral_constant<kind, kind::frame_3D>{});
  }
}

/// The elements of a runtime chain, in the loops of dynamics/detail/stored_algorithms.hpp.
struct runtime_elements {
  const kte_map_chain& chain;

  template <class Step>
  void forward(runtime_state& s) const {
    const auto& elements = chain.wiring().elements;
    if constexpr (Step::of == who::movers) {
      for (const int e : s.plan.movers) elements[static_cast<std::size_t>(e)].element->perform(Step{}, s);
    } else if constexpr (Step::of == who::weights) {
      for (const int e : s.plan.weights) elements[static_cast<std::size_t>(e)].element->perform(Step{}, s);
    } else {
      for (const auto& e : elements) e.element->perform(Step{}, s);
    }
  }
  template <class Step>
  void backward(runtime_state& s) const {
    const auto& elements = chain.wiring().elements;
    if constexpr (Step::of == who::weights) {
      forward<Step>(s);  // which are listed from the last
    } else {
      for (auto e = elements.rbegin(); e != elements.rend(); ++e) e->element->perform(Step{}, s);
    }
  }
  template <class Step>
  void down_from(int e, runtime_state& s) const {
    const auto& elements = chain.wiring().elements;
    for (; e >= 0; e = s.plan.places[static_cast<std::size_t>(e)].below)
      elements[static_cast<std::size_t>(e)].element->perform(Step{}, s);
  }
  bool reads_positions() const { return chain.wiring().reads_positions; }
};

/// Inverse dynamics, into the state.
inline void coordinate_forces(const kte_map_chain& c, runtime_state& s) {
  c.check(s);
  update_angles(s);
  start(s);
  forces_on_coordinates(runtime_elements{c}, s);
}

/// Throws `bad_argument` where a joint or link has a `doForce` of its own, which algorithms that ask for `relative`
/// alone would leave out.
inline void check_plain_loads(const kte_map_chain& c) {
  if (c.wiring().plain_loads) return;
  for (const auto& e : c.wiring().elements)
    if (!e.plain_loads)
      throw bad_argument("kte: this algorithm takes the loads of joints and links from `relative` alone, and " +
                         e.element->record().type +
                         " has a `doForce` of its own: put that force into an element on the coordinate");
}

/// The mass matrix, into the working memory.
inline void mass_of_coordinates(const kte_map_chain& c, runtime_state& s) {
  if (!c.wiring().is_stiff) [[unlikely]]
    for (const auto& e : c.wiring().elements)
      if (e.ports.back().how == access::out && !e.stiff && is_frame(e.ports.back().what))
        throw bad_argument("kte: the mass matrix needs joints and links, not " + e.element->record().type);
  update_angles(s);
  mass_of_coordinates(runtime_elements{c}, s);
}

/// By the factorised mass matrix.
template <class Tau>
void accelerate_by_mass(const kte_map_chain& c, runtime_state& s, const Tau& tau) {
  for_each_listed_freedom(s, [](auto& x, const freedom&) { visit_a(x, [](double& a) { a = 0; }); });
  coordinate_forces(c, s);
  auto& a = s.work.forces;
  read_listed_numbers<vector_of::f>(s, a);
  for (int i = 0; i < s.dofs(); ++i) a[i] += tau(i);
  mass_of_coordinates(c, s);
  solve_in_place(s.work.mass, a);
}
/// At positions that are good. Some accelerations may be given, in the state: those of rows that are `prescribed`, in
/// trees.
template <class Tau>
const Eigen::VectorXd& accelerations_under(const kte_map_chain& c, runtime_state& s, const Tau& tau,
                                           std::span<const char> prescribed = {}) {
  if (s.plan.tree) {
    std::fill(s.work.prescribed.begin(), s.work.prescribed.end(), 0);
    std::copy(prescribed.begin(), prescribed.end(), s.work.prescribed.begin());
    update_angles(s);
    start(s);
    accelerate_articulated(runtime_elements{c}, s, tau);
  } else {
    accelerate_by_mass(c, s, tau);
  }
  check_result(s.work.forces, static_cast<std::size_t>(s.dofs()), [&] {
    Eigen::VectorXd forces(s.dofs());
    for (int i = 0; i < s.dofs(); ++i) forces[i] = tau(i);
    blame("an acceleration", s, forces);
  });
  write_numbers<vector_of::a>(s, s.work.forces, "a");
  return s.work.forces;
}

struct runtime_frame {
  kind what;
  int index;
};
/// Throws `unknown_name`.
inline runtime_frame find_frame(const kte_map_chain& c, std::string_view name) {
  const kind k = c.wiring().kind_of(name) == kind::frame_2D ? kind::frame_2D : kind::frame_3D;
  return {k, c.wiring().find(name, k)};
}
/// doMotion of an element, after that of all that it depends on, each once.
inline void move_element(const topology& t, runtime_state& s, int element) {
  const auto at = [](auto& x, int e) -> auto& { return x[static_cast<std::size_t>(e)]; };
  auto& wanted = s.work.wanted;
  at(wanted, element) = 1;
  int first = element;
  for (int e = element; e >= first; --e) {
    if (!at(wanted, e)) continue;
    const auto& c = at(t.elements, e);
    for (std::size_t p = 0; p < c.ports.size(); ++p) {
      if (c.ports[p].writes() || is_signal(c.ports[p].what)) continue;
      const int writer = at(t.writers[static_cast<std::size_t>(c.ports[p].what)], c.index[p]);
      if (writer >= 0) at(wanted, writer) = 1, first = std::min(first, writer);
    }
  }
  for (int e = first; e <= element; ++e)
    if (std::exchange(at(wanted, e), 0)) at(t.elements, e).element->doMotion(s);
}
/// The same for a frame: what writes it, if an element does.
inline void move(const topology& t, runtime_state& s, const runtime_frame& x) {
  const int writer = t.writers[static_cast<std::size_t>(x.what)][static_cast<std::size_t>(x.index)];
  if (writer >= 0) move_element(t, s, writer);
}

}  // namespace detail

}  // namespace kte
