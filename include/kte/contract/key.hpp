#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

/// Names of coordinates, frames, inputs and internal states. A name is a type, declared once:
///
///   inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow"> {} elbow;
///
/// A misspelt name is a compile error with the compiler's "did you mean", because it names a type. The text is for
/// messages, files and runtime chains.
namespace kte {

/// The kinds of items at ports.
enum class kind : unsigned char {
  gen,          ///< a generalized coordinate: q and its rates, and a generalized force
  frame_2D,     ///< a frame in the plane
  frame_3D,     ///< a frame in space
  input,        ///< a signal: a number set by the user, for instance the force of a motor, or written by an element
  rotation_3D,  ///< a coordinate that is a rotation in space: a unit quaternion and an angular velocity
  pose_2D,      ///< a coordinate that is a pose in the plane
  pose_3D,      ///< a coordinate that is a pose in space
  internal,     ///< an internal state of one element, a number with a rate: the deflection of bristles in friction
  vector,       ///< a signal of three numbers
  loop,         ///< the forces and residuals of one closure of a kinematic loop
  contact       ///< the force, gap and mode of one contact
};
/// The number of kinds.
inline constexpr std::size_t kinds = 11;

/// Whether it is a frame, in the plane or in space.
[[nodiscard]] constexpr bool is_frame(kind k) { return k == kind::frame_2D || k == kind::frame_3D; }
/// Whether it is a signal: numbers without a force.
[[nodiscard]] constexpr bool is_signal(kind k) {
  return k == kind::input || k == kind::internal || k == kind::vector || k == kind::loop || k == kind::contact;
}
/// The size of a signal in the inputs u of a chain, if no element writes it.
[[nodiscard]] constexpr int nu_of(kind k) { return k == kind::input ? 1 : k == kind::vector ? 3 : 0; }
/// Whether it is a coordinate: a number, a rotation or a pose.
[[nodiscard]] constexpr bool is_coordinate(kind k) { return !is_frame(k) && !is_signal(k); }
/// The size of an item in a configuration q: x, y, z before w, x, y, z of the quaternion; x, y, angle in the plane.
[[nodiscard]] constexpr int nq_of(kind k) {
  return k == kind::gen ? 1 : k == kind::rotation_3D ? 4 : k == kind::pose_2D ? 3 : k == kind::pose_3D ? 7 : 0;
}
/// The number of degrees of freedom of an item: its size in v, a and tau, linear before angular.
[[nodiscard]] constexpr int nv_of(kind k) {
  return k == kind::gen ? 1 : k == kind::rotation_3D || k == kind::pose_2D ? 3 : k == kind::pose_3D ? 6 : 0;
}

/// Its name in messages and files: "coordinate".
[[nodiscard]] constexpr std::string_view to_string(kind k) {
  switch (k) {
    case kind::gen:
      return "coordinate";
    case kind::frame_2D:
      return "2D frame";
    case kind::frame_3D:
      return "3D frame";
    case kind::input:
      return "input";
    case kind::rotation_3D:
      return "rotation";
    case kind::pose_2D:
      return "2D pose";
    case kind::pose_3D:
      return "3D pose";
    case kind::internal:
      return "internal state";
    case kind::vector:
      return "vector";
    case kind::loop:
      return "closure";
    case kind::contact:
      return "contact";
  }
  return "";
}

/// Its name with an article, for messages: "an input", "a coordinate".
[[nodiscard]] constexpr std::string_view article(kind k) {
  return k == kind::input || k == kind::internal ? "an " : "a ";
}

/// A text as a template argument.
template <std::size_t N>
struct fixed_string {
  char text[N]{};
  constexpr fixed_string(const char (&s)[N]) { std::copy_n(s, N, text); }  // NOLINT(google-explicit-constructor)
  /// The text.
  constexpr std::string_view view() const { return {text, N - 1}; }
};

/// A key: the name of an item of a static chain as a type. `what` is its kind, `name` its text.
///
///   inline constexpr struct elbow_ final : kte::coord_key<"elbow"> {} elbow;
template <kind K, fixed_string Text>
struct key {
  static_assert(sizeof(Text.text) > 1, "kte: a key needs a text, for messages and files");
  static constexpr kind what = K;
  static constexpr std::string_view name = Text.view();
};

/// The key of a coordinate.
template <fixed_string Text>
struct coord_key : key<kind::gen, Text> {};
/// The key of a frame in the plane.
template <fixed_string Text>
struct frame_2D_key : key<kind::frame_2D, Text> {};
/// The key of a frame in space.
template <fixed_string Text>
struct frame_3D_key : key<kind::frame_3D, Text> {};
/// The key of an input or another signal.
template <fixed_string Text>
struct input_key : key<kind::input, Text> {};
/// The key of a signal of three numbers.
template <fixed_string Text>
struct vector_key : key<kind::vector, Text> {};
/// The key of a coordinate that is a rotation in space.
template <fixed_string Text>
struct rotation_3D_key : key<kind::rotation_3D, Text> {};
/// The key of a coordinate that is a pose in the plane.
template <fixed_string Text>
struct pose_2D_key : key<kind::pose_2D, Text> {};
/// The key of a coordinate that is a pose in space.
template <fixed_string Text>
struct pose_3D_key : key<kind::pose_3D, Text> {};
/// The key of an internal state.
template <fixed_string Text>
struct internal_key : key<kind::internal, Text> {};
/// The key of a loop that a closure closes.
template <fixed_string Text>
struct loop_key : key<kind::loop, Text> {};
/// The key of a contact.
template <fixed_string Text>
struct contact_key : key<kind::contact, Text> {};

/// The time, s: in models of systems (models/) an input of this name is the time, and not part of u.
inline constexpr struct chain_time_ final : input_key<"time"> {
} chain_time;

/// A key: a type with a kind `what` and a text `name`.
template <class T>
concept key_type = requires {
  { T::what } -> std::convertible_to<kind>;
  { T::name } -> std::convertible_to<std::string_view>;
};
/// A text: a name in runtime chains.
template <class T>
concept text_type = std::is_convertible_v<const T&, std::string_view>;

namespace detail {

constexpr std::uint64_t hash(std::string_view s) {  // FNV-1a
  std::uint64_t h = 14695981039346656037ull;
  for (char c : s) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return h;
}
template <class T>
constexpr std::uint64_t hash_of_type() {
#if defined(_MSC_VER)
  return hash(__FUNCSIG__);
#else
  return hash(__PRETTY_FUNCTION__);
#endif
}
/// Two keys are one name if their types are equal; equal texts are permitted only then. Frames have their own
/// namespace, so a frame and a coordinate or signal may share a text.
template <class Key>
inline constexpr std::uint64_t id_of_key = hash_of_type<Key>();
template <class Key>
inline constexpr std::uint64_t id_of_text = hash(Key::name) + (is_frame(Key::what) ? 1 : 0);

}  // namespace detail
}  // namespace kte
