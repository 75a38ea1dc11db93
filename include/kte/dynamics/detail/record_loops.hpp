#pragma once

#include <kte/dynamics/state_vectors.hpp>
#include <kte/math/sincos.hpp>
#include <kte/tree/articulated.hpp>
#include <kte/tree/chain_tree.hpp>
#include <kte/tree/composite.hpp>
#include <kte/tree/frame_motion.hpp>
#include <kte/tree/loop_memory.hpp>
#include <kte/tree/newton_euler.hpp>

/// Between the state of a chain and the loops over records: coordinates, bases and the forces of elements. State: as
/// `runtime_state`, of a runtime chain or of a static one that is not unrolled. `Elements` says of element e
///   move(e, s), push(e, s)          its doMotion and doForce
///   ports(e), index(e, p)           what it is connected to; written(e): what its last port is connected to
///   derive(e, s)                    derivatives of its forces (contract/force_derivatives.hpp)
///   mass_loads(e, s)                loads of a mass between several ports, for accelerations alone
///   holds(e, s)                     whether it holds its coordinate
///   friction(e, s, wrench)          of a joint that carries a wrench at its end
///   blame_mass(s, row, finite)      throws: a mass of coordinate `row` that cannot be used
namespace kte::detail {

/// visit(coordinate `slot` of kind k).
template <class State, class Visit>
KTE_INLINE void with_coordinate(State& s, kind k, int slot, const Visit& visit) {
  switch (k) {
    case kind::gen:
      return visit(s.template get<kind::gen>(slot));
    case kind::rotation_3D:
      return visit(s.template get<kind::rotation_3D>(slot));
    case kind::pose_2D:
      return visit(s.template get<kind::pose_2D>(slot));
    default:
      return visit(s.template get<kind::pose_3D>(slot));
  }
}
/// The same of a record.
template <class State, class P, class Visit>
KTE_INLINE void with_coordinate(State& s, const tree::record<P>& r, const Visit& visit) {
  with_coordinate(s, r.what, r.slot, visit);
}
/// The numbers that come with the axes of a record.
template <vector_of Which, class State, class P, class Number>
KTE_INLINE void each_axis(State& s, const tree::record<P>& r, const Number& number) {
  with_coordinate(s, r, [&](auto& c) {
    auto k = static_cast<std::size_t>(r.first);
    visit_numbers<Which>(c, [&](auto& x) { number(x, k++); });
  });
}

/// What is written before bodies can be placed, and sines and matrices of coordinates that elements read beside those
/// of joints.
template <class Elements, class State>
void bring_up_to_date(const Elements& c, State& s) {
  for (const int e : s.tree().followers) {
    c.move(e, s);
    if (c.ports(e).back().what == kind::gen) update_angle(s.template get<kind::gen>(c.written(e)));
  }
  for (const auto& [k, slot] : s.tree().turned) with_coordinate(s, k, slot, [](auto& x) { update_angle(x); });
}

/// Puts a joint of several axes where its coordinate is.
template <class State, class P, class S>
void place_several(State& s, const tree::record<P>& r, tree::spot<S>& at) {
  with_coordinate(s, r, [&](auto& c) {
    if constexpr (!requires { c.q; }) {
      if constexpr (!State::has_sines) update_angle(c);
      at.position = tree::slid(r, as<S>(spatial(c).position));
      at.rotation = as<S>(matrix(spatial(c).rotation));
    }
  });
}
/// The sine and cosine by which a record turns, where angles are not gathered.
template <class State, class P>
auto turn_of(State& s, const tree::record<P>& r) {
  using S = typename State::scalar;
  using std::cos;
  using std::sin;
  const auto& c = s.template get<kind::gen>(r.slot);
  if (r.turns == P(1) && s.has_sine(r.slot)) return tree::turn<S>{c.cos, c.sin};
  const S angle = r.turns * c.q;
  return tree::turn<S>{cos(angle), sin(angle)};
}
/// Puts joints that turn about z, by number of their record, where their coordinates are.
template <class State>
void place_turning(State& s, std::span<const int> joints) {
  using S = typename State::scalar;
  const auto& records = s.tree().forest.records;
  const auto record_of = [&](std::size_t i) -> auto& { return records[static_cast<std::size_t>(joints[i])]; };
  const auto place = [&](std::size_t i, const tree::turn<S>& turn) KTE_INLINE_LAMBDA {
    const auto& r = record_of(i);
    auto& at = s.work.spots[static_cast<std::size_t>(joints[i])];
    if (r.moves == tree::joint::revolute) [[likely]]
      at.angle = r.after * turn;
    else
      tree::place_on_z(r, s.template get<kind::gen>(r.slot).q, turn, at);
  };
  if constexpr (State::has_sines)
    for (std::size_t i = 0; i < joints.size(); ++i) place(i, turn_of(s, record_of(i)));
  else
    sincos_each<S>(
        joints.size(),
        [&](std::size_t i) {
          const auto& r = record_of(i);
          return S(r.turns * s.template get<kind::gen>(r.slot).q);
        },
        [&](std::size_t i, const S& sine, const S& cosine) {
          place(i, tree::turn<S>{cosine, sine});
        });
}
/// The same of one that does not turn, or about several axes.
template <class State, class P, class S>
void place_other(State& s, const tree::record<P>& r, tree::spot<S>& at) {
  if (r.moves == tree::joint::several)
    place_several(s, r, at);
  else
    tree::place_on_z(r, s.template get<kind::gen>(r.slot).q, tree::turn<S>{}, at);
}
template <class P>
bool is_turning(const tree::record<P>& r) {
  return r.moves == tree::joint::revolute || r.moves == tree::joint::screw;
}
/// Bodies to where the coordinates of the state are.
template <class Elements, class State>
void place_bodies(const Elements& c, State& s) {
  bring_up_to_date(c, s);
  const auto& records = s.tree().forest.records;
  place_turning(s, s.tree().angles);
  if (s.tree().angles.size() == records.size()) return;
  for (std::size_t n = 0; n < records.size(); ++n)
    if (!is_turning(records[n])) place_other(s, records[n], s.work.spots[n]);
}

/// The same of a slot and all that it stands on: its way to the base, which is returned. Followers: of all.
template <class Elements, class State>
std::span<const int> place_ancestors(const Elements& c, State& s, int slot) {
  bring_up_to_date(c, s);
  auto& w = s.work;
  const auto& f = s.tree().forest;
  std::size_t length = 0, count = 0;
  while (slot >= f.bases) {
    const int n = slot - f.bases;
    const auto& r = f.records[static_cast<std::size_t>(n)];
    w.way[length++] = n;
    if (is_turning(r)) [[likely]]
      w.turning[count++] = n;
    else
      place_other(s, r, w.spots[static_cast<std::size_t>(n)]);
    slot = r.parent;
  }
  place_turning(s, {w.turning.data(), count});
  return {w.way.data(), length};
}

template <class State>
void take_rates(State& s) {
  for (const auto& r : s.tree().forest.records) {
    const auto k = static_cast<std::size_t>(r.first);
    if (r.what == kind::gen) [[likely]] {
      const auto& c = s.template get<kind::gen>(r.slot);
      s.work.rate[k] = c.q_dot, s.work.acceleration[k] = c.q_ddot;
    } else {
      each_axis<vector_of::v>(s, r, [&s](auto& x, std::size_t i) { s.work.rate[i] = x; });
      each_axis<vector_of::a>(s, r, [&s](auto& x, std::size_t i) { s.work.acceleration[i] = x; });
    }
  }
}

/// visit(motion of a base as kernels see it, its slot).
template <class State, class Visit>
void for_each_base(State& s, const Visit& visit) {
  const auto& t = s.tree();
  for (std::size_t i = 0; i < t.plan.bases.size(); ++i) {
    const auto [k, index] = t.plan.bases[i];
    const auto slot = static_cast<std::size_t>(t.slot_of_base[i]);
    if (k == kind::frame_2D)
      visit(spatial(s.template get<kind::frame_2D>(index)), slot);
    else
      visit(spatial(s.template get<kind::frame_3D>(index)), slot);
  }
}
/// The axes of the base at a slot.
template <class State>
auto axes_of_base(State& s, int base) {
  using S = typename State::scalar;
  mat3<vec3<S>> axes{};
  for_each_base(s, [&](const auto& m, std::size_t slot) {
    if (static_cast<int>(slot) == base) axes = as<S>(matrix(m.rotation));
  });
  return axes;
}
template <class State>
void take_bases(State& s) {
  using S = typename State::scalar;
  for_each_base(s, [&s](const auto& m, std::size_t slot) {
    auto& b = s.work.bodies[slot];
    b.velocity = as<S>(m.velocity), b.ang_velocity = as<S>(m.ang_velocity);
    b.acceleration = as<S>(m.acceleration), b.ang_acceleration = as<S>(m.ang_acceleration);
  });
}
template <class State>
void place_in_world(State& s) {
  using S = typename State::scalar;
  for_each_base(s, [&s](const auto& m, std::size_t slot) {
    auto& b = s.work.world[slot];
    b.rotation = as<S>(matrix(m.rotation)), b.position = as<S>(m.position), b.step = {};
  });
  tree::place_in_world(s.tree().forest, s.work);
}

/// No forces on coordinates.
template <class State>
void clear_coordinates(State& s) {
  for (std::size_t i = 0; i < s.tree().plan.row_of_gen.size(); ++i)
    s.template get<kind::gen>(static_cast<int>(i)).f = typename State::scalar(0);
  for_each_listed_freedom(s, [](auto& c, const freedom&) {
    if constexpr (requires { clear_load(c); }) clear_load(c);
  });
}

/// Frames that elements act on, where their bodies have them.
template <class State>
void place_touched_frames(State& s, bool accelerated) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  for (const auto& [k, index] : t.touched) {
    const auto& at = t.forest.frame(k, index);
    const auto& b = s.work.bodies[static_cast<std::size_t>(at.slot)];
    const auto& place = s.work.world[static_cast<std::size_t>(at.slot)];
    if (at.slot < t.forest.bases) {  // its own motion is in the state, unless it is fixed to the base by links
      if (std::find(t.plan.bases.begin(), t.plan.bases.end(), std::pair{k, index}) != t.plan.bases.end()) {
        if (k == kind::frame_2D)
          clear_load(s.template get<kind::frame_2D>(index));
        else
          clear_load(s.template get<kind::frame_3D>(index));
        continue;
      }
    }
    tree::body_motion<S> moves = b;
    if (!accelerated) moves.acceleration = moves.ang_acceleration = {};
    const auto m = motion_of_frame(place, moves, at.at);
    if (k == kind::frame_2D) {
      auto& x = s.template get<kind::frame_2D>(index);
      const auto flat = [](const vec3<S>& u) { return vec3{u.x, u.y, zero}; };
      const auto normal = [](const vec3<S>& u) { return vec3{zero, zero, u.z}; };
      set_motion(x, motion{flat(m.position), rotation_2D{m.rotation.x.x, m.rotation.y.x}, flat(m.velocity),
                           normal(m.ang_velocity), flat(m.acceleration), normal(m.ang_acceleration)});
      clear_load(x);
    } else {
      auto& x = s.template get<kind::frame_3D>(index);
      set_motion(x, m);
      clear_load(x);
    }
  }
}
/// Frames and signals that elements write when bodies are in place.
template <class Elements, class State>
void move_late(const Elements& c, State& s) {
  for (const int e : s.tree().late) c.move(e, s);
  for (const auto& [k, index] : s.tree().written) {
    if (k == kind::frame_2D)
      clear_load(s.template get<kind::frame_2D>(index));
    else
      clear_load(s.template get<kind::frame_3D>(index));
  }
}
/// f(slot, wrench at the origin of its body) for what elements put on frames.
template <class State, class F>
void for_each_frame_load(State& s, const F& f) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  for (const auto& [k, index] : t.touched) {
    const auto& at = t.forest.frame(k, index);
    if (at.slot < t.forest.bases) continue;
    tree::dense_wrench<S> w;
    if (k == kind::frame_2D) {
      const auto x = load_of(s.template get<kind::frame_2D>(index));
      w = {as<S>(x.force), as<S>(x.torque)};
    } else {
      const auto x = load_of(s.template get<kind::frame_3D>(index));
      w = {x.force, x.torque};
    }
    const auto seen = transmit(at.at, w);
    f(static_cast<std::size_t>(at.slot), tree::dense_wrench<S>{as<S>(seen.force), as<S>(seen.torque)});
  }
}

/// Which elements count: all; all, but with friction that depends on what joints carry as it is in the working memory;
/// bodies.
enum class acting { all, with_given_friction, bodies };

/// What acts on coordinates, and followers, which hand on what is on them: from the last.
template <class Elements, class State>
void push_on_coordinates(const Elements& c, State& s, acting who) {
  const auto& t = s.tree();
  auto f = t.followers.rbegin();
  const auto pass_on = [&](int until) {
    for (; f != t.followers.rend() && *f > until; ++f) c.push(*f, s);
  };
  if (who != acting::bodies)
    for (auto e = t.on_coordinates.rbegin(); e != t.on_coordinates.rend(); ++e) {
      pass_on(*e);
      c.push(*e, s);
    }
  pass_on(-1);
}

/// friction(element, row of its coordinate, force on it) of the joints whose friction depends on what they carry, after
/// `take_needs`.
template <class Elements, class State, class F>
void for_each_friction(const Elements& c, State& s, const F& f) {
  using S = typename State::scalar;
  const auto& forest = s.tree().forest;
  for (const int e : s.tree().readers) {
    const auto& place = forest.frame(c.ports(e).back().what, c.written(e));
    const auto& needs = s.work.bodies[static_cast<std::size_t>(place.slot)].needs;
    const auto carried = transmit(inverse(place.at), tree::dense_wrench<S>{-needs.force, -needs.torque});
    const auto& r = forest.records[static_cast<std::size_t>(place.slot - forest.bases)];
    f(r, c.friction(e, s, tree::dense_wrench<S>{as<S>(carried.force), as<S>(carried.torque)}));
  }
}

/// Inverse dynamics (RNEA): the forces of virtual power on the coordinates, into the state. At rates and accelerations
/// of the state; of bodies alone, with bases that are accelerated or not. `placed`: all bodies are where the positions
/// of the state have them.
template <class Elements, class State>
void forces_on_coordinates(const Elements& c, State& s, acting who, bool accelerated_bases = true,
                           bool placed = false) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  if (!placed || !t.only_bodies) place_bodies(c, s);  // followers have accelerations too
  take_rates(s), take_bases(s);
  if (!accelerated_bases)
    for (std::size_t b = 0; b < static_cast<std::size_t>(t.forest.bases); ++b)
      w.bodies[b].acceleration = w.bodies[b].ang_acceleration = vec3<S>{};
  if (t.only_bodies) {
    tree::move_bodies<false>(t.forest, w);
    tree::take_needs(t.forest, w);
    if (t.has_own_mass)
      for (std::size_t k = 0; k < w.force.size(); ++k) w.force[k] += w.own_mass[k] * w.acceleration[k];
    for (const auto& r : t.forest.records) {
      const auto k = static_cast<std::size_t>(r.first);
      if (r.what == kind::gen) [[likely]]
        s.template get<kind::gen>(r.slot).f = -w.force[k];
      else
        each_axis<vector_of::f>(s, r, [&w](auto& f, std::size_t i) { f = -w.force[i]; });
    }
    return;
  }
  clear_coordinates(s);
  for (const auto& [coordinate, mass] : t.rotors) {
    auto& x = s.template get<kind::gen>(coordinate);
    x.f -= mass * x.q_ddot;
  }
  const auto& others = who != acting::bodies ? t.on_frames : t.weights;
  if (others.empty() && (who == acting::bodies || t.late.empty())) {
    tree::move_bodies<false>(t.forest, w);
  } else {
    tree::move_bodies<true>(t.forest, w);
    place_in_world(s);
    place_touched_frames(s, true);
    if (who != acting::bodies) move_late(c, s);
    for (auto e = others.rbegin(); e != others.rend(); ++e) c.push(*e, s);
    for_each_frame_load(s, [&w](std::size_t slot, const tree::dense_wrench<S>& x) {
      auto& needs = w.bodies[slot].needs;
      needs = {needs.force - x.force, needs.torque - x.torque};
    });
  }
  tree::take_needs(t.forest, w);
  for (const auto& r : t.forest.records)
    each_axis<vector_of::f>(s, r, [&w](auto& f, std::size_t k) { f -= w.force[k]; });
  if (who != acting::bodies) {
    auto given = w.friction.begin();
    for_each_friction(c, s, [&](const auto& r, const S& friction) {
      s.template get<kind::gen>(r.slot).f += who == acting::all ? friction : *given++;
    });
  }
  push_on_coordinates(c, s, who);
}

/// After that, what must be applied for the motion to happen, into `forces` of the working memory.
template <class State>
void take_needed_forces(State& s) {
  const auto& t = s.tree();
  auto& f = s.work.forces;
  if (t.only_bodies) {
    for (std::size_t k = 0; k < t.forest.row.size(); ++k) f[t.forest.row[k]] = s.work.force[k];
  } else {
    read_listed_numbers<vector_of::f>(s, f);
    f = -f;
  }
}
}  // namespace kte::detail
