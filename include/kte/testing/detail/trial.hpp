#pragma once

#include <kte/chain/element.hpp>
#include <kte/chain/passes.hpp>
#include <kte/math/axis_angle.hpp>

/// An element alone, to try laws on.
namespace kte::testing::detail {

/// Where a thing is at time t if its rates and accelerations are those at time 0.
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
void move(S&, const S&) {}  // an input

/// An element alone, with a coordinate, frame or input of its own at every port.
template <class S, class Core>
class trial {
 public:
  static constexpr std::size_t ports = port_count<Core>;

  template <class Draw>
  trial(const Core& core, Draw& draw) : core_(core) {
    const auto number = [&draw] { return S(draw()); };
    const auto vector = [&]() -> vec3<S> { return {number(), number(), number()}; };
    for (auto& c : coordinates_) c = {number(), number(), number(), S(0), S(1), S(0)};
    for (auto& x : in_plane_)
      x = {{number(), number()},
           rotation_by(S(3 * number())),
           {number(), number()},
           number(),
           {number(), number()},
           number(),
           {},
           S(0)};
    for (auto& x : in_space_) x = {vector(), matrix(S(2) * vector()), vector(), vector(), vector(), vector(), {}, {}};
    for (auto& u : inputs_) u = number();
  }

  template <kind K>
  auto& get(int port) {
    return get<K>(*this, static_cast<std::size_t>(port));
  }
  template <std::size_t P>
  auto& at() {
    return get<Core::ports[P].what>(static_cast<int>(P));
  }
  auto& output() { return at<ports - 1>(); }

  void doMotion() { pass().motion(read{}); }
  void doForce() { pass().force(read{}); }
  /// Everything that the element reads, after time t.
  void move(const S& t) {
    for_each([&](const port& p, auto& x) {
      if (!p.writes()) detail::move(x, t);
    });
    doMotion();
  }
  /// f(port, thing) for all ports.
  template <class F>
  void for_each(const F& f) {
    each(f, std::make_index_sequence<ports>{});
  }
  /// f(things that it reads...).
  template <class F>
  auto apply(const F& f) {
    return apply(f, read{});
  }

 private:
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
  template <kind K, class Self>
  static auto& get(Self& s, std::size_t i) {
    if constexpr (K == kind::gen) {
      return s.coordinates_[i];
    } else if constexpr (K == kind::frame_2D) {
      return s.in_plane_[i];
    } else if constexpr (K == kind::frame_3D) {
      return s.in_space_[i];
    } else {
      return s.inputs_[i];
    }
  }

  Core core_;
  std::array<gen_coord<S>, ports> coordinates_;
  std::array<frame_2D<S>, ports> in_plane_;
  std::array<frame_3D<S>, ports> in_space_;
  std::array<S, ports> inputs_;
};

}  // namespace kte::testing::detail
