#pragma once

#include <kte/contract/gravity.hpp>
#include <kte/contract/passes.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/static_chain/connections.hpp>
#include <kte/static_chain/kept_states.hpp>
#include <kte/static_chain/state.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/flatten.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

/// The largest number of elements for which algorithms with superlinear code size are unrolled: mass matrix,
/// articulated bodies, derivatives. Passes and inverse dynamics are unrolled up to three times this number. Beyond it,
/// passes have one function per type of element core, and algorithms are loops (dynamics/looped/static_chains.hpp).
/// Like other options it must be equal in all units of a program.
#if !defined(KTE_UNROLLED_ELEMENTS)
#  define KTE_UNROLLED_ELEMENTS 48
#endif

namespace kte {

namespace detail {
template <std::size_t Elements>
inline constexpr bool unrolls_passes = Elements <= 3 * KTE_UNROLLED_ELEMENTS;
template <std::size_t Elements>
inline constexpr bool unrolls_all = Elements <= KTE_UNROLLED_ELEMENTS;
}  // namespace detail

/// A mechanism as a type: elements in order, connected by their keys, with a gravity. Build it with `kte::chain`.
/// Immutable; constexpr if its numbers are; can be copied, and shared between threads.
///
/// Passes on a state (made by `make_state`):
///   doMotion    motion of all frames, front to back
///   clearForce  all forces to zero
///   doForce     forces, back to front; then s[q].f is the force of virtual power on q
template <class Gravity, class... E>
class static_chain {
  using shapes = detail::shapes_of<detail::wiring<E...>, typename E::core_type...>;

 public:
  using wiring = detail::wiring<E...>;
  /// The number of elements.
  static constexpr std::size_t size = sizeof...(E);
  /// The number of degrees of freedom: the size of v, a, tau (order: static_chain/layout.hpp).
  static constexpr int dofs = wiring::dofs;
  /// The size of a configuration q; larger than `dofs` if a coordinate is a rotation in space.
  static constexpr int nq = wiring::nq;
  /// Whether forces of an element depend on positions, rotations or linear velocities of frames. The element core
  /// declares this by `static constexpr bool reads_positions = true`. The fused algorithms compute them only then.
  static constexpr bool reads_positions = shapes::reads_positions;
  /// Whether those of an element that is not a contact do.
  static constexpr bool reads_positions_but_contacts = shapes::reads_positions_but_contacts;
  /// Whether all algorithms can be unrolled for it; otherwise some need the loops over body nodes.
  static constexpr bool common = shapes::common;
  /// Whether this holds without its contacts.
  static constexpr bool common_but_contacts = shapes::common_but_contacts;
  /// Whether algorithms are unrolled for this chain.
  static constexpr bool unrolled = detail::unrolls_all<size> && common;

  constexpr static_chain(const boost::hana::tuple<E...>& elements, const Gravity& g)
      : elements_(elements), gravity_(g) {}

  template <class State>
  constexpr void doMotion(State& s) const {
    check<State>();
    forward([](const auto& x) { x.motion(inputs_of(x)); }, s);
  }
  template <class State>
  constexpr void clearForce(State& s) const {
    check<State>();
    forward([](const auto& x) { x.clear(ports_of(x)); }, s);
  }
  template <class State>
  constexpr void doForce(State& s) const {
    check<State>();
    detail::unroll<size>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
      this->template one<size - 1 - I>([](const auto& x) { x.force(inputs_of(x)); }, s);
    });
  }

  /// The signals that elements write (measures, controls), in order, computed by the last doMotion. A vector signal
  /// contributes three numbers.
  template <class State>
  [[nodiscard]] constexpr auto outputs(const State& s) const {
    check<State>();
    constexpr std::size_t n = (output_numbers<typename E::core_type> + ... + 0);
    std::array<typename State::scalar, n> y{};
    std::size_t i = 0;
    detail::unroll<size>([&]<std::size_t I>() {
      using Core = core_type<I>;
      if constexpr (output_numbers < Core >> 0) {
        const auto& x = s.template get<Core::ports.back().what>(wiring::slot(I, port_count<Core> - 1));
        if constexpr (output_numbers<Core> == 3)
          y[i++] = x.x, y[i++] = x.y, y[i++] = x.z;
        else
          y[i++] = x;
      }
    });
    return y;
  }

  /// A copy of the chain with gravity, m/s^2, in the axes of the base: `.gravity(along_z(-9.81))`. Gravity acts as the
  /// opposite acceleration of the base. Throws `bad_parameter` if it is not finite.
  template <class X, class Y, class Z>
  [[nodiscard]] constexpr auto gravity(const vec3<X, Y, Z>& g) const {
    detail::check_gravity(g);
    return static_chain<vec3<X, Y, Z>, E...>(elements_, g);
  }
  /// A copy of the chain with gravity, m/s^2: `.gravity({0, 0, -9.81})`.
  [[nodiscard]] constexpr auto gravity(const vec3<>& g) const { return gravity<double, double, double>(g); }
  template <class Number>
  [[nodiscard]] constexpr const static_chain& gravity(const Number&) const {
    static_assert(detail::fit<Number>,
                  "kte: gravity is a vector in the axes of the base, m/s^2: .gravity(kte::along_z(-9.81))");
    return *this;
  }
  [[nodiscard]] constexpr const Gravity& gravity() const { return gravity_; }

  /// All elements, in order.
  constexpr const boost::hana::tuple<E...>& elements() const { return elements_; }
  template <std::size_t I>
  using core_type = typename std::remove_cvref_t<decltype(boost::hana::at_c<I>(
      std::declval<const boost::hana::tuple<E...>&>()))>::core_type;
  /// The core of element I.
  template <std::size_t I>
  KTE_INLINE constexpr const auto& core() const {
    return boost::hana::at_c<I>(elements_).core;
  }

 private:
  template <class Core>
  static constexpr std::size_t output_numbers = detail::writes_signal<Core>
                                                    ? static_cast<std::size_t>(nu_of(Core::ports.back().what))
                                                    : 0;
  template <class State>
  static constexpr void check() {
    if constexpr (is_chain_state<State>)
      static_assert(std::is_same_v<typename State::wiring, wiring>, "kte: this state was made for another chain");
  }
  template <std::size_t I>
  struct where {
    template <std::size_t P>
    static constexpr int at() {
      constexpr int slot = wiring::slot(I, P);
      return slot;
    }
  };
  template <class X>
  static constexpr auto inputs_of(const X&) {
    return std::make_index_sequence<X::inputs>{};
  }
  template <class X>
  static constexpr auto ports_of(const X&) {
    return std::make_index_sequence<X::ports>{};
  }
  template <std::size_t I, class F, class S>
  KTE_INLINE constexpr void one(const F& f, S& s) const {
    if constexpr (detail::unrolls_passes<size>) {
      f(detail::stored_element<core_type<I>, S, where<I>>{core<I>(), s, {}});
    } else {
      apart(f, core<I>(), s, wiring::table.slot.data() + wiring::first[I]);
    }
  }
  template <class F, class Core, class S>
  [[gnu::noinline]] static constexpr void apart(const F& f, const Core& core, S& s, const int* index) {
    f(detail::stored_element<Core, S, detail::by_index>{core, s, {index}});
  }
  template <class F, class S>
  KTE_INLINE constexpr void forward(const F& f, S& s) const {
    detail::unroll<size>([&]<std::size_t I>() KTE_INLINE_LAMBDA { this->template one<I>(f, s); });
  }

  boost::hana::tuple<E...> elements_;
  Gravity gravity_;

 public:
  /// Memory for calculations that are not unrolled.
  [[no_unique_address]] detail::kept_states<!unrolled> kept;
};

namespace detail {
template <class Gravity, class... E>
constexpr auto as_elements(const static_chain<Gravity, E...>& c) {
  return c.elements();
}
template <class Core, class... Keys>
constexpr auto as_elements(const element<Core, Keys...>& e) {
  return boost::hana::tuple<element<Core, Keys...>>(e);
}
/// Checks that an argument can be part of a static chain.
template <class E>
struct check_part {
  static constexpr bool passed = requires(const E& e) { as_elements(e); };
  static_assert(passed, "kte: a static chain consists of elements and static chains; this argument is neither");
};
template <>
struct check_part<refused> {
  static constexpr bool passed = false;
};
template <class Core>
struct check_part<named_element<Core>> {
  static_assert(fit<Core>,
                "kte: a static chain is connected by keys; texts are for runtime chains: kte::runtime_chain");
  static constexpr bool passed = false;
};
/// The gravity of a part, as a tuple with it or an empty tuple.
template <class Core, class... Keys>
constexpr boost::hana::tuple<> gravities_of(const element<Core, Keys...>&) {
  return {};
}
template <class Gravity, class... E>
constexpr auto gravities_of(const static_chain<Gravity, E...>& c) {
  return boost::hana::make_tuple(c.gravity());
}
template <class T>
inline constexpr bool is_element = false;
template <class Core, class... Keys>
inline constexpr bool is_element<element<Core, Keys...>> = true;

template <class Chain>
struct problem_in;
template <class Gravity, class... E>
struct problem_in<const static_chain<Gravity, E...>> {
  using type = first_problem<E...>;
};

inline constexpr auto make_chain = [](const auto&... e) {
  using chain_type = static_chain<zero3, std::remove_cvref_t<decltype(e)>...>;
  return chain_type(boost::hana::tuple<std::remove_cvref_t<decltype(e)>...>(e...), zero3{});
};
}  // namespace detail

/// A static chain of elements and of other static chains, in order.
///
/// A name is written by one element, before it is read; several elements may read it: that is a branch. The first frame
/// read is the base of the chain; a coordinate that no element writes is a degree of freedom. A mistake is a compile
/// error that names the element (docs/errors.md).
///
/// The chain has the gravity of the first part with a gravity other than zero; parts with different gravities are
template <class... E>
[[nodiscard]] constexpr auto chain(const E&... e) {
  constexpr bool flat = [] {
    for (const bool single : {detail::is_element<E>..., true})  // not a fold, because clang limits those to 256
      if (!single) return false;
    return true;
  }();
  if constexpr (flat) {
    static_assert(sizeof(detail::first_problem<E...>) > 0);
    return detail::make_chain(e...);
  } else {
    constexpr bool usable = (detail::check_part<E>::passed && ...);
    if constexpr (usable) {
      const auto whole = boost::hana::unpack(boost::hana::flatten(boost::hana::make_tuple(detail::as_elements(e)...)),
                                             detail::make_chain);
      static_assert(sizeof(typename detail::problem_in<decltype(whole)>::type) > 0);
      const auto gravities = boost::hana::flatten(boost::hana::make_tuple(detail::gravities_of(e)...));
      detail::check_one_gravity(gravities);
      return whole.gravity(detail::gravity_of_all(gravities));
    } else {
      return detail::make_chain();
    }
  }
}

/// A state for a chain: all coordinates and rates are zero, and the base accelerates against gravity.
template <class Scalar = double, class Gravity, class... E>
[[nodiscard]] constexpr auto make_state(const static_chain<Gravity, E...>& c) {
  using wiring = detail::wiring<E...>;
  chain_state<Scalar, wiring> s;
  const vec3<Scalar> up = vec3<Scalar>{} - as<Scalar>(c.gravity());
  for (int i = 0; i < wiring::count(kind::frame_2D); ++i)
    if (wiring::writer(kind::frame_2D, i) < 0) s.template get<kind::frame_2D>(i).acceleration = {up.x, up.y};
  for (int i = 0; i < wiring::count(kind::frame_3D); ++i)
    if (wiring::writer(kind::frame_3D, i) < 0) s.template get<kind::frame_3D>(i).acceleration = up;
  return s;
}
/// The number of degrees of freedom of a chain: the size of v, a, tau.
template <class Gravity, class... E>
[[nodiscard]] constexpr int dofs(const static_chain<Gravity, E...>&) {
  return static_chain<Gravity, E...>::dofs;
}

}  // namespace kte
