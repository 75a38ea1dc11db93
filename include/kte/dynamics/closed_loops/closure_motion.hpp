#pragma once

#include <kte/dynamics/closed_loops/closure_places.hpp>

#include <array>

/// The motion of the frames of a closure relative to each other.
namespace kte::detail {

/// Functions of bodies that have been placed and moved in the working memory of a state.
class closure_motion {
 public:
  /// Calls visit(axis, v, w) for the velocity of frame2 relative to frame1 by each axis, in axes of frame2; bodies are
  /// placed. m: the motion of frame2 in frame1. Returns the poses of frame2 in the body that carries both frames, or in
  /// the bases of frame1 and of frame2.
  template <class State, class S, class Visit>
  static std::array<tree::dense_pose<S>, 2> each_relative_column(const State& s, const closure_place& x,
                                                                 const closing_motion<S>& m, const Visit& visit) {
    const auto& f = s.tree().body_tree;
    const auto &at_a = f.frame(x.frame1.what, x.frame1.index), &at_b = f.frame(x.frame2.what, x.frame2.index);
    const int common = tree::common_slot(f, at_a.slot, at_b.slot);
    const tree::frame_place<S> b_on_a{
        at_a.slot, plain_pose<S>(compose(pose{at_a.at.rotation, at_a.at.position}, pose{m.rotation, m.position}))};
    const auto with_sign = [&visit](double sign) {
      return [&visit, by = S(sign)](int k, const tree::direction<S>& v, const tree::direction<S>& w) {
        visit(k, by * v, by * w);
      };
    };
    std::array<tree::dense_pose<S>, 2> seen;
    (void)tree::jacobian_columns(f, s.work, at_b, seen[1], with_sign(1), common);
    (void)tree::jacobian_columns(f, s.work, b_on_a, seen[0], with_sign(-1), common);
    return seen;
  }
  /// The motion of frame2 in frame1 at rest.
  template <class State>
  static auto motion_between(const State& s, const closure_place& x) {
    ends_of_closure<typename State::scalar> at;
    find_places(s, x, at);
    return between(at);
  }
  /// As `biased_motion`, which is that of the place.
  template <class State>
  static auto biased_motion_between(const State& s, const closure_place& x) {
    ends_of_closure<typename State::scalar> at;
    find_places(s, x, at);
    return accelerated<false>(s, x, at, between(at));
  }
  /// The motion of frame2 in frame1 for moving bodies.
  template <class State>
  static auto moving_between(const State& s, const closure_place& x) {
    ends_of_closure<typename State::scalar> at;
    find_places(s, x, at);
    return accelerated(s, x, at, between(at));
  }

 protected:
  /// The frames of a closure in the body that carries both, or in the world; the slot of this body, or -1.
  template <class S>
  struct ends_of_closure {
    tree::moving_place<S> first, second;
    int common = -1;
  };
  template <class State, class S>
  static void find_places(const State& s, const closure_place& x, ends_of_closure<S>& at) {
    const auto& f = s.tree().body_tree;
    const auto &a = f.frame(x.frame1.what, x.frame1.index), &b = f.frame(x.frame2.what, x.frame2.index);
    at.common = tree::common_slot(f, a.slot, b.slot);
    const int base_a = tree::place_and_velocity(f, s.work, a, at.common, at.first);
    const int base_b = tree::place_and_velocity(f, s.work, b, at.common, at.second);
    if (at.common < 0) into_world(s, base_a, at.first), into_world(s, base_b, at.second);
  }
  template <class S>
  static closing_motion<S> between(const ends_of_closure<S>& at) {
    const auto to_a = transpose(at.first.rotation);
    return {to_a * (at.second.position - at.first.position), to_a * at.second.rotation, {}, {}, {}, {}};
  }
  /// The motion of frame2 in frame1 with all its derivatives; its pose is given. With the position p in the axes of
  /// frame1, and the velocities that frames have in the body or base that carries both,
  ///
  ///   p' = v_2 - v_1 - w_1 x p,   w = w_2 - R^T w_1                                        (1)
  ///   p'' = R a_2 - (a_1 + al_1 x p + w_1 x (w_1 x p) + 2 w_1 x p')                        (2)
  ///   al = al_2 - R^T al_1 + w x R^T w_1                                                   (3)
  ///
  /// where w_1 in (1) is relative to the common body. Without `Bodies` the accelerations of bodies count as zero, and
  /// angular velocities are those of bias motions.
  template <bool Bodies = true, class State, class S>
  static closing_motion<S> accelerated(const State& s, const closure_place& x, const ends_of_closure<S>& ends,
                                       closing_motion<S> m) {
    const auto& f = s.tree().body_tree;
    const auto &at_a = f.frame(x.frame1.what, x.frame1.index), &at_b = f.frame(x.frame2.what, x.frame2.index);
    const auto body_of = [&s](int slot) -> const auto& {
      if constexpr (Bodies)
        return s.work.bodies[static_cast<std::size_t>(slot)];
      else
        return s.work.biases[static_cast<std::size_t>(slot)];
    };
    const auto& [a, b, common] = ends;
    const auto to_a = transpose(a.rotation);
    const auto frame_motion = [&](const auto& at) {
      const auto& body = body_of(at.slot);
      const auto& p = at.at.position;
      const auto& w = body.ang_velocity;
      const auto back = transpose(at.at.rotation);
      if constexpr (Bodies)
        return std::array<vec3<S>, 3>{
            back * w, back * (body.acceleration + cross(body.ang_acceleration, p) + cross(w, cross(w, p))),
            back * body.ang_acceleration};
      else
        return std::array<vec3<S>, 3>{back * w, back * cross(w, cross(w, p)), vec3<S>{}};
    };
    const auto [w1, a1, al1] = frame_motion(at_a);
    const auto [w2, a2, al2] = frame_motion(at_b);
    const vec3<S> turns =
        common < 0 ? w1 : vec3<S>(w1 - to_a * body_of(common).ang_velocity);  // world: different bases
    const auto to_b = transpose(m.rotation);
    const vec3<S> rate = to_a * (b.velocity - a.velocity) - cross(turns, m.position);
    const vec3<S> w1_in_b = to_b * w1;
    m.velocity = to_b * rate, m.ang_velocity = w2 - w1_in_b;
    m.acceleration = a2 - to_b * (a1 + cross(al1, m.position) + cross(w1, cross(w1, m.position)) + 2 * cross(w1, rate));
    m.ang_acceleration = al2 - to_b * al1 + cross(m.ang_velocity, w1_in_b);
    return m;
  }
  /// In the world, for moving bases.
  template <class State, class S>
  static void into_world(const State& s, int base, tree::moving_place<S>& x) {
    for_each_base(s, [&](const auto& m, std::size_t slot) {
      if (static_cast<int>(slot) != base) return;
      const mat3<vec3<S>> r = as<S>(matrix(m.rotation));
      const vec3<S> v = as<S>(m.velocity), w = as<S>(m.ang_velocity);
      x.velocity = r * (v + cross(w, x.position) + x.velocity);
      x.position = as<S>(m.position) + r * x.position, x.rotation = r * x.rotation;
    });
  }
};

}  // namespace kte::detail
