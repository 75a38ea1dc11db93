#pragma once

#include <kte/contract/checks.hpp>
#include <kte/contract/thing.hpp>
#include <kte/errors.hpp>
#include <kte/static_chain/wiring.hpp>

#include <array>

namespace kte {

namespace detail {
constexpr void check_coordinate(int i, int count) {
  if (i < 0 || i >= count) [[unlikely]]
    raise<bad_argument>("kte: there is no generalized coordinate " + std::to_string(i) + " in a state that has " +
                        std::to_string(count));
}
}  // namespace detail

/// The state of a static chain: every coordinate, frame, input and internal state, by key. It is a value that passes
/// change, while the chain is constant. `dofs`: the number of degrees of freedom; `nq`: the size of q.
///
///   s[joint].position,  s[q].q_ddot,  s[motor] = 2.0
template <class Scalar, class Wiring>
class chain_state {
 public:
  using scalar = Scalar;
  using wiring = Wiring;
  static constexpr int dofs = Wiring::dofs;
  static constexpr int nq = Wiring::nq;

  template <key_type Key>
  constexpr auto& operator[](const Key&) {
    return at(*this, Key{});
  }
  template <key_type Key>
  constexpr const auto& operator[](const Key&) const {
    return at(*this, Key{});
  }

  /// A compile error with an explanation. The return value only avoids follow-up errors.
  template <text_type Text>
  constexpr auto& operator[](const Text&) const {
    static_assert(detail::fit<Text>,
                  "kte: items of the state of a static chain are named by keys, s[hand]; texts are for runtime chains");
    return no_thing();
  }

  /// Generalized coordinate number i; the degrees of freedom come first. Throws `bad_argument` for an i out of range.
  constexpr auto& coordinate(int i) { return get<kind::gen>(checked(i)); }
  constexpr const auto& coordinate(int i) const { return get<kind::gen>(checked(i)); }
  /// Item i of a kind, for the passes.
  template <kind K>
  constexpr auto& get(int i) {
    return detail::of_kind<K>(things_)[static_cast<std::size_t>(i)];
  }
  template <kind K>
  constexpr const auto& get(int i) const {
    return detail::of_kind<K>(things_)[static_cast<std::size_t>(i)];
  }

 private:
  static constexpr int checked(int i) {
    detail::check_coordinate(i, Wiring::count(kind::gen));
    return i;
  }
  template <class Self, class Key>
  static constexpr auto& at(Self& s, Key) {
    constexpr int i = Wiring::template find<Key>();
    if constexpr (i < 0 && Wiring::elements == 0) {
      return no_thing();  // the element was rejected with its own message
    } else {
      static_assert(i >= 0, "kte: this chain has nothing of this name");
      return s.template get<Key::what>(i < 0 ? 0 : i);
    }
  }
  struct any_thing : gen_coord<Scalar>, frame_3D<Scalar> {};
  static any_thing& no_thing();

  template <class Kinds>
  struct lists;
  template <std::size_t... K>
  struct lists<std::index_sequence<K...>> {
    using type = std::tuple<std::array<detail::thing_of<static_cast<kind>(K), Scalar>,
                                       static_cast<std::size_t>(Wiring::count(static_cast<kind>(K)))>...>;
  };
  typename lists<std::make_index_sequence<kinds>>::type things_{};
};

/// Whether T is the state of a static chain.
template <class T>
inline constexpr bool is_chain_state = false;
template <class Scalar, class Wiring>
inline constexpr bool is_chain_state<chain_state<Scalar, Wiring>> = true;

}  // namespace kte
