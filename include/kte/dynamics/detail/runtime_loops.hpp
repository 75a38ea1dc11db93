#pragma once

#include <kte/chain/kte_map_chain.hpp>
#include <kte/dynamics/detail/runtime_arguments.hpp>
#include <kte/math/sincos.hpp>
#include <kte/tree/articulated.hpp>
#include <kte/tree/composite.hpp>
#include <kte/tree/jacobian.hpp>
#include <kte/tree/newton_euler.hpp>

/// Between the state of a runtime chain and the loops over records: coordinates, bases and the forces of elements.
namespace kte::detail {

/// Elements are those of the chain at hand: a state may have been made for one of which this is a copy.
inline const topology::connection& connection_of(const kte_map_chain& c, int number) {
  return c.wiring().elements[static_cast<std::size_t>(number)];
}
inline const kte_element& element_of(const kte_map_chain& c, int number) { return *connection_of(c, number).element; }
/// Throws `bad_argument` unless the state is of this chain, which is no part of another.
inline void check_whole(const kte_map_chain& c, const runtime_state& s) {
  (void)c.wiring();
  c.check(s);
}
/// The same where passes alone know the chain.
inline void check_regular(const kte_map_chain& c, const runtime_state& s) {
  check_whole(c, s);
  const auto& t = s.tree();
  if (t.irregular >= 0) [[unlikely]]
    throw bad_argument("kte: this algorithm takes joints and links by their `relative` alone, and " +
                       element_of(c, t.irregular).record().type + t.why);
}

/// visit(coordinate of a record).
template <class Visit>
KTE_INLINE void with_coordinate(runtime_state& s, const tree::record<double>& r, const Visit& visit) {
  switch (r.what) {
    case kind::gen:
      return visit(s.get<kind::gen>(r.slot));
    case kind::rotation_3D:
      return visit(s.get<kind::rotation_3D>(r.slot));
    case kind::pose_2D:
      return visit(s.get<kind::pose_2D>(r.slot));
    default:
      return visit(s.get<kind::pose_3D>(r.slot));
  }
}
/// The numbers that come with the axes of a record.
template <vector_of Which, class Number>
KTE_INLINE void each_axis(runtime_state& s, const tree::record<double>& r, const Number& number) {
  with_coordinate(s, r, [&](auto& c) {
    auto k = static_cast<std::size_t>(r.first);
    visit_numbers<Which>(c, [&](double& x) { number(x, k++); });
  });
}

/// Coordinates that follow others.
inline void follow(const kte_map_chain& c, runtime_state& s) {
  for (const int e : s.tree().followers) {
    element_of(c, e).doMotion(s);
    update_angle(s.get<kind::gen>(connection_of(c, e).index.back()));
  }
}

/// Puts a joint of several axes where its coordinate is.
inline void place_several(runtime_state& s, const tree::record<double>& r, tree::spot<double>& at) {
  with_coordinate(s, r, [&](auto& c) {
    if constexpr (!requires { c.q; }) {
      update_angle(c);
      const auto m = spatial(c);
      at.rotation = as<double>(matrix(m.rotation));
      at.position = tree::slid(r, as<double>(m.position));
    }
  });
}
/// Bodies to where the coordinates of the state are.
inline void place_bodies(const kte_map_chain& c, runtime_state& s) {
  if (!s.tree().followers.empty()) follow(c, s);
  auto& w = s.work;
  const auto& records = s.tree().forest.records;
  const auto& angles = s.tree().angles;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto& r = records[static_cast<std::size_t>(angles[i])];
    w.angle[i] = r.turns * s.get<kind::gen>(r.slot).q;
  }
  sincos_each(w.angle.data(), w.sine.data(), w.cosine.data(), w.angle.size());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto n = static_cast<std::size_t>(angles[i]);
    const auto& r = records[n];
    const tree::turn<double> turn{w.cosine[i], w.sine[i]};
    if (r.moves == tree::joint::revolute) [[likely]]
      w.spots[n].angle = r.after * turn;
    else
      tree::place_on_z(r, s.get<kind::gen>(r.slot).q, turn, w.spots[n]);
  }
  if (angles.size() == records.size()) return;
  for (std::size_t n = 0; n < records.size(); ++n) {
    const auto& r = records[n];
    if (r.moves == tree::joint::prismatic) tree::place_on_z(r, s.get<kind::gen>(r.slot).q, {}, w.spots[n]);
    if (r.moves == tree::joint::several) place_several(s, r, w.spots[n]);
  }
}

/// The same of a slot and all that it stands on. Followers: of all.
inline void place_ancestors(const kte_map_chain& c, runtime_state& s, int slot) {
  if (!s.tree().followers.empty()) follow(c, s);
  auto& w = s.work;
  const auto& f = s.tree().forest;
  // Angles are gathered in order of the way.
  std::size_t count = 0;
  for (int at = slot; at >= f.bases;) {
    const auto& r = f.records[static_cast<std::size_t>(at - f.bases)];
    if (r.moves == tree::joint::revolute || r.moves == tree::joint::screw)
      w.angle[count++] = r.turns * s.get<kind::gen>(r.slot).q;
    at = r.parent;
  }
  std::fill(w.angle.begin() + static_cast<std::ptrdiff_t>(count), w.angle.end(), 0.0);
  sincos_each(w.angle.data(), w.sine.data(), w.cosine.data(), std::min((count + 3) / 4 * 4, w.angle.size()));
  count = 0;
  for (int at = slot; at >= f.bases;) {
    const auto n = static_cast<std::size_t>(at - f.bases);
    const auto& r = f.records[n];
    if (r.moves == tree::joint::several) {
      place_several(s, r, w.spots[n]);
    } else {
      tree::turn<double> turn;
      if (r.moves != tree::joint::prismatic) turn = {w.cosine[count], w.sine[count]}, ++count;
      tree::place_on_z(r, s.get<kind::gen>(r.slot).q, turn, w.spots[n]);
    }
    at = r.parent;
  }
}

inline void take_rates(runtime_state& s) {
  for (const auto& r : s.tree().forest.records) {
    const auto k = static_cast<std::size_t>(r.first);
    if (r.what == kind::gen) [[likely]] {
      const auto& c = s.get<kind::gen>(r.slot);
      s.work.rate[k] = c.q_dot, s.work.acceleration[k] = c.q_ddot;
    } else {
      each_axis<vector_of::v>(s, r, [&s](double& x, std::size_t i) { s.work.rate[i] = x; });
      each_axis<vector_of::a>(s, r, [&s](double& x, std::size_t i) { s.work.acceleration[i] = x; });
    }
  }
}

/// visit(motion of a base as kernels see it, its slot).
template <class Visit>
void for_each_base(runtime_state& s, const Visit& visit) {
  const auto& t = s.tree();
  for (std::size_t i = 0; i < t.plan.bases.size(); ++i) {
    const auto [k, index] = t.plan.bases[i];
    const auto slot = static_cast<std::size_t>(t.slot_of_base[i]);
    if (k == kind::frame_2D)
      visit(spatial(s.get<kind::frame_2D>(index)), slot);
    else
      visit(spatial(s.get<kind::frame_3D>(index)), slot);
  }
}
inline void take_bases(runtime_state& s) {
  for_each_base(s, [&s](const auto& m, std::size_t slot) {
    auto& b = s.work.bodies[slot];
    b.velocity = as<double>(m.velocity), b.ang_velocity = as<double>(m.ang_velocity);
    b.acceleration = as<double>(m.acceleration), b.ang_acceleration = as<double>(m.ang_acceleration);
  });
}
inline void place_in_world(runtime_state& s) {
  for_each_base(s, [&s](const auto& m, std::size_t slot) {
    auto& b = s.work.world[slot];
    b.rotation = as<double>(matrix(m.rotation)), b.position = as<double>(m.position), b.step = {};
  });
  tree::place_in_world(s.tree().forest, s.work);
}

/// No forces on coordinates.
inline void clear_coordinates(runtime_state& s) {
  for (std::size_t i = 0; i < s.tree().plan.row_of_gen.size(); ++i) s.get<kind::gen>(static_cast<int>(i)).f = 0;
  for_each_listed_freedom(s, [](auto& c, const freedom&) {
    if constexpr (requires { clear_load(c); }) clear_load(c);
  });
}

/// Frames that elements act on, where their bodies have them.
inline void place_touched_frames(runtime_state& s, bool accelerated) {
  const auto& t = s.tree();
  for (const auto& [k, index] : t.touched) {
    const auto& at = t.forest.frame(k, index);
    const auto& b = s.work.bodies[static_cast<std::size_t>(at.slot)];
    const auto& place = s.work.world[static_cast<std::size_t>(at.slot)];
    if (at.slot < t.forest.bases) {  // its own motion is in the state, unless it is fixed to the base by links
      if (std::find(t.plan.bases.begin(), t.plan.bases.end(), std::pair{k, index}) != t.plan.bases.end()) {
        if (k == kind::frame_2D)
          clear_load(s.get<kind::frame_2D>(index));
        else
          clear_load(s.get<kind::frame_3D>(index));
        continue;
      }
    }
    const auto m = compose(motion{place.position, place.rotation, b.velocity, b.ang_velocity,
                                  accelerated ? b.acceleration : vec3<>{}, accelerated ? b.ang_acceleration : vec3<>{}},
                           at_rest(at.at.rotation, at.at.position));
    if (k == kind::frame_2D) {
      auto& x = s.get<kind::frame_2D>(index);
      const auto flat = [](const vec3<>& u) { return vec3{u.x, u.y, zero}; };
      const auto normal = [](const vec3<>& u) { return vec3{zero, zero, u.z}; };
      set_motion(x, motion{flat(m.position), rotation_2D{m.rotation.x.x, m.rotation.y.x}, flat(m.velocity),
                           normal(m.ang_velocity), flat(m.acceleration), normal(m.ang_acceleration)});
      clear_load(x);
    } else {
      auto& x = s.get<kind::frame_3D>(index);
      set_motion(x, m);
      clear_load(x);
    }
  }
}
/// f(slot, wrench at the origin of its body) for what elements put on frames.
template <class F>
void for_each_frame_load(runtime_state& s, const F& f) {
  const auto& t = s.tree();
  for (const auto& [k, index] : t.touched) {
    const auto& at = t.forest.frame(k, index);
    if (at.slot < t.forest.bases) continue;
    tree::dense_wrench<double> w;
    if (k == kind::frame_2D) {
      const auto x = load_of(s.get<kind::frame_2D>(index));
      w = {as<double>(x.force), as<double>(x.torque)};
    } else {
      const auto x = load_of(s.get<kind::frame_3D>(index));
      w = {x.force, x.torque};
    }
    const auto seen = transmit(at.at, w);
    f(static_cast<std::size_t>(at.slot), tree::dense_wrench<double>{seen.force, seen.torque});
  }
}

/// Which elements count.
enum class acting { all, bodies };

/// Inverse dynamics (RNEA): the forces of virtual power on the coordinates, into the state. At rates and accelerations
/// of the state; of bodies alone, with bases that are accelerated or not.
inline void forces_on_coordinates(const kte_map_chain& c, runtime_state& s, acting who, bool accelerated_bases = true) {
  const auto& t = s.tree();
  auto& w = s.work;
  place_bodies(c, s);
  take_rates(s), take_bases(s);
  if (!accelerated_bases)
    for (std::size_t b = 0; b < static_cast<std::size_t>(t.forest.bases); ++b)
      w.bodies[b].acceleration = w.bodies[b].ang_acceleration = {};
  if (t.only_bodies) {
    tree::move_bodies<false>(t.forest, w);
    tree::take_needs(t.forest, w);
    for (const auto& r : t.forest.records) {
      const auto k = static_cast<std::size_t>(r.first);
      if (r.what == kind::gen) [[likely]]
        s.get<kind::gen>(r.slot).f = -w.force[k];
      else
        each_axis<vector_of::f>(s, r, [&w](double& f, std::size_t i) { f = -w.force[i]; });
    }
    return;
  }
  clear_coordinates(s);
  const auto& others = who == acting::all ? t.on_frames : t.weights;
  if (others.empty()) {
    tree::move_bodies<false>(t.forest, w);
  } else {
    tree::move_bodies<true>(t.forest, w);
    place_in_world(s);
    place_touched_frames(s, true);
    for (const int e : others) element_of(c, e).doForce(s);
    for_each_frame_load(s, [&w](std::size_t slot, const tree::dense_wrench<double>& x) {
      auto& needs = w.bodies[slot].needs;
      needs = {needs.force - x.force, needs.torque - x.torque};
    });
  }
  tree::take_needs(t.forest, w);
  for (const auto& r : t.forest.records)
    each_axis<vector_of::f>(s, r, [&w](double& f, std::size_t k) { f -= w.force[k]; });
  // What acts on coordinates, and followers, which hand on what is on them: from the last.
  auto f = t.followers.rbegin();
  const auto pass_on = [&](int until) {
    for (; f != t.followers.rend() && *f > until; ++f) element_of(c, *f).doForce(s);
  };
  if (who == acting::all)
    for (auto e = t.on_coordinates.rbegin(); e != t.on_coordinates.rend(); ++e) {
      pass_on(*e);
      element_of(c, *e).doForce(s);
    }
  pass_on(-1);
}

/// After that, what must be applied for the motion to happen, into `forces` of the working memory.
inline void take_needed_forces(runtime_state& s) {
  const auto& t = s.tree();
  auto& f = s.work.forces;
  if (t.only_bodies) {
    for (std::size_t k = 0; k < t.forest.row.size(); ++k) f[t.forest.row[k]] = s.work.force[k];
  } else {
    read_listed_numbers<vector_of::f>(s, f);
    f = -f;
  }
}
/// Inverse dynamics, into the state.
inline void coordinate_forces(const kte_map_chain& c, runtime_state& s) {
  check_whole(c, s);
  if (s.tree().irregular < 0) [[likely]] {
    forces_on_coordinates(c, s, acting::all);
  } else {
    c.doMotion(s), c.clearForce(s), c.doForce(s);
  }
}

}  // namespace kte::detail
