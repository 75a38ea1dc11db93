#pragma once

#include <kte/contract/element.hpp>
#include <kte/contract/passes.hpp>
#include <kte/contract/thing.hpp>
#include <kte/math/axis_angle.hpp>

/// A single element, for testing laws.
namespace kte::testing::detail {

/// Moves an item to time t, with its rates and accelerations at time 0.
template <class S>
void move(gen_coord<S>& c, const S& t) {
  c.q = c.q + t * (c.q_dot + t / 2 * c.q_ddot);
}
template <class S>
void move(frame_2D<S>& x, const S& t) {
  const S half = t / 2;
  x.position = x.position + x.rotation * (t * (x.velocity + half * x.acceleration));
  x.rotation = x.rotation * rotation_by(S(t * (x.ang_velocity + half * x.ang_acceleration)));
}
template <class S>
void move(frame_3D<S>& x, const S& t) {
  const S half = t / 2;
  x.position = x.position + x.rotation * (t * (x.velocity + half * x.acceleration));
  x.rotation = x.rotation * matrix(t * (x.ang_velocity + half * x.ang_acceleration));
}
template <class S>
void move(rotation_coord_3D<S>& c, const S& t) {
  c.rotation = c.rotation * to_quaternion(t * (c.ang_velocity + t / 2 * c.ang_acceleration));
}
/// For poses, whose accelerations are rates of the components of v: p'' = R (a + w x v).
template <class S>
void move(pose_coord_2D<S>& c, const S& t) {
  const S& w = c.ang_velocity;
  const vec2<S> a{c.acceleration.x - w * c.velocity.y, c.acceleration.y + w * c.velocity.x};
  c.position = c.position + rotation_by(c.angle) * (t * (c.velocity + t / 2 * a));
  c.angle = c.angle + t * (w + t / 2 * c.ang_acceleration);
}
template <class S>
void move(pose_coord_3D<S>& c, const S& t) {
  const auto a = c.acceleration + cross(c.ang_velocity, c.velocity);
  c.position = c.position + c.rotation * (t * (c.velocity + t / 2 * a));
  c.rotation = c.rotation * to_quaternion(t * (c.ang_velocity + t / 2 * c.ang_acceleration));
}
template <class S>
void move(internal_state<S>& x, const S& t) {
  x.z = x.z + t * x.z_dot;
}
template <class S>
void move(loop_state<S>&, const S&) {}
template <class S>
void move(contact_state<S>&, const S&) {}
template <class S>
void move(S&, const S&) {}  // a signal
template <class S>
void move(vec3<S>&, const S&) {}

/// A random item of kind K, with numbers in [-1, 1); rotations of up to about 3 rad.
template <kind K, class S, class Draw>
kte::detail::thing_of<K, S> random_thing(Draw& draw) {
  const auto number = [&draw] { return S(draw()); };
  const auto in_plane = [&]() -> vec2<S> { return {number(), number()}; };
  const auto vector = [&]() -> vec3<S> { return {number(), number(), number()}; };
  const auto turn = [&] { return to_quaternion(S(2) * vector()); };
  if constexpr (K == kind::gen) {
    return {number(), number(), number(), S(0), S(1), S(0)};
  } else if constexpr (K == kind::frame_2D) {
    return {in_plane(), rotation_by(S(3 * number())), in_plane(), number(), in_plane(), number(), {}, S(0)};
  } else if constexpr (K == kind::frame_3D) {
    return {vector(), matrix(S(2) * vector()), vector(), vector(), vector(), vector(), {}, {}};
  } else if constexpr (K == kind::rotation_3D) {
    return {.rotation = turn(), .ang_velocity = vector(), .ang_acceleration = vector()};
  } else if constexpr (K == kind::pose_2D) {
    return {.position = in_plane(),
            .angle = 3 * number(),
            .velocity = in_plane(),
            .ang_velocity = number(),
            .acceleration = in_plane(),
            .ang_acceleration = number()};
  } else if constexpr (K == kind::pose_3D) {
    return {.position = vector(),
            .rotation = turn(),
            .velocity = vector(),
            .ang_velocity = vector(),
            .acceleration = vector(),
            .ang_acceleration = vector()};
  } else if constexpr (K == kind::internal) {
    return {number(), S(0)};
  } else if constexpr (K == kind::loop) {
    return {.force = vector(), .torque = vector()};
  } else if constexpr (K == kind::contact) {
    return {.force = vector()};
  } else if constexpr (K == kind::vector) {
    return vector();
  } else {
    return number();
  }
}

/// A single element with a separate item at every port.
template <class S, class Core>
class trial {
 public:
  using scalar = S;
  static constexpr std::size_t ports = port_count<Core>;

  template <class Draw>
  trial(const Core& core, Draw& draw) : core_(core) {
    draw_all(draw, std::make_index_sequence<kinds>{});
  }

  template <kind K>
  auto& get(int port) {
    return kte::detail::of_kind<K>(things_)[static_cast<std::size_t>(port)];
  }
  template <std::size_t P>
  auto& at() {
    return get<Core::ports[P].what>(static_cast<int>(P));
  }
  auto& output() { return at<ports - 1>(); }

  void doMotion() { pass().motion(read{}); }
  void doForce() { pass().force(read{}); }
  void mass_force() { pass().mass_force(read{}); }
  void clear() { pass().clear(std::make_index_sequence<ports>{}); }
  /// Another element with the same items.
  template <class Other>
  trial<S, Other> with(const Other& other) const {
    return {other, things_};
  }
  /// Moves everything that the element reads to time t.
  void move(const S& t) {
    for_each([&](const port& p, auto& x) {
      if (!p.writes()) detail::move(x, t);
    });
    doMotion();
  }
  /// Calls f(port, item) for all ports.
  template <class F>
  void for_each(const F& f) {
    each(f, std::make_index_sequence<ports>{});
  }
  /// Calls f with the items that the element reads.
  template <class F>
  auto apply(const F& f) {
    return apply(f, read{});
  }

 private:
  template <class, class>
  friend class trial;
  template <class Things>
  trial(const Core& core, const Things& things) requires(!std::is_invocable_v<Things&>)
      : core_(core), things_(things) {}

  using read = std::make_index_sequence<input_count<Core>>;
  struct itself {
    template <std::size_t P>
    static constexpr int at() {
      return static_cast<int>(P);
    }
  };
  auto pass() { return kte::detail::stored_element<Core, trial, itself>{core_, *this, {}}; }
  template <class F, std::size_t... P>
  void each(const F& f, std::index_sequence<P...>) {
    (f(Core::ports[P], at<P>()), ...);
  }
  template <class F, std::size_t... P>
  auto apply(const F& f, std::index_sequence<P...>) {
    return f(at<P>()...);
  }
  static constexpr bool has_port(kind k) {
    for (const auto& p : Core::ports)
      if (p.what == k) return true;
    return false;
  }
  template <class Draw, std::size_t... K>
  void draw_all(Draw& draw, std::index_sequence<K...>) {
    const auto draw_kind = [&draw]<kind Kind>(auto& things) {
      if ((Kind == kind::vector || Kind == kind::loop || Kind == kind::contact) && !has_port(Kind))
        return;  // other numbers are unchanged
      for (auto& x : things) x = random_thing<Kind, S>(draw);
    };
    (draw_kind.template operator()<static_cast<kind>(K)>(std::get<K>(things_)), ...);
  }
  template <class Kinds>
  struct lists;
  template <std::size_t... K>
  struct lists<std::index_sequence<K...>> {
    using type = std::tuple<std::array<kte::detail::thing_of<static_cast<kind>(K), S>, ports>...>;
  };

  Core core_;
  typename lists<std::make_index_sequence<kinds>>::type things_;
};

}  // namespace kte::testing::detail
