#pragma once

#include <kte/contract/port.hpp>
#include <kte/math/quaternion.hpp>
#include <kte/math/rigid_body.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace kte {

/// A parameter of an element core in files and documentation, by its `name`.
struct parameter_info {
  static constexpr signed char any = -128;  ///< a number that is not fixed by the type of the parameter

  std::string_view name;  ///< as in files
  std::string_view what;  ///< "number", "vector", "rotation", "matrix", "symmetric matrix", "list" or "flag"
  bool optional = false;  ///< whether files may omit it
  int count = 0;          ///< number of values in files; -1: a list of any length
  std::array<signed char, 9> numbers{};  ///< numbers fixed by its type, otherwise `any`

  /// Whether its type fixes some of its numbers.
  bool has_fixed() const {
    return std::any_of(numbers.begin(), numbers.begin() + (std::max)(count, 0), [](signed char n) { return n != any; });
  }
  /// Whether its type fixes all of its numbers, such as the axis of a revolute joint in the plane.
  bool is_fixed() const {
    return count > 0 && std::all_of(numbers.begin(), numbers.begin() + count, [](signed char n) { return n != any; });
  }
  /// Whether the numbers of a file agree in count, and with the numbers that the type fixes.
  bool fits(std::span<const double> values) const {
    if (count < 0) return true;
    if (values.size() != static_cast<std::size_t>(count)) return false;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (numbers[i] != any && values[i] != numbers[i]) return false;
    return true;
  }
};

namespace detail {

template <class T>
inline constexpr signed char fixed_number = parameter_info::any;
template <int N>
inline constexpr signed char fixed_number<constant<N>> = N;

/// The description of a parameter by its type.
struct parameter_of_type {
  /// A number, or a list of them.
  template <class T>
  static parameter_info of(const T&) {
    if constexpr (requires(const T& list) { list.size(), list.data(); }) {
      return {{}, "list", false, -1, {}};
    } else {
      return {{}, "number", false, 1, {fixed_number<T>}};
    }
  }
  static parameter_info of(const bool&) { return {{}, "flag", true, 1, {1}}; }
  template <class X, class Y, class Z>
  static parameter_info of(const vec3<X, Y, Z>&) {
    return {{}, "vector", false, 3, {fixed_number<X>, fixed_number<Y>, fixed_number<Z>}};
  }
  template <class... T>
  static parameter_info of(const sym3<T...>&) {
    return {{}, "symmetric matrix", false, 6, {fixed_number<T>...}};
  }
  template <class... R>
  static parameter_info of(const mat3<R...>&) {
    parameter_info p{{}, "matrix", false, 9, {}};
    p.numbers.fill(parameter_info::any);
    return p;
  }
  template <class S>
  static parameter_info of(const unit_quaternion<S>&) {
    return of(mat3<vec3<>>{});
  }
  template <class C, class S>
  static parameter_info of(const rotation_2D<C, S>&) {
    constexpr signed char any = parameter_info::any;
    return {{}, "rotation", false, 9, {any, any, 0, any, any, 0, 0, 0, 1}};
  }
  static parameter_info of(no_rotation) { return {{}, "rotation", false, 9, {1, 0, 0, 0, 1, 0, 0, 0, 1}}; }
};
[[gnu::noinline]] inline void add_info(std::vector<parameter_info>& all, parameter_info p, const char* name,
                                       std::span<const std::string_view> optional) {
  p.name = name;
  p.optional = p.optional || std::find(optional.begin(), optional.end(), p.name) != optional.end();
  if (p.what == "matrix" && p.name.ends_with("rotation")) p.what = "rotation";
  all.push_back(p);
}

}  // namespace detail

/// The parameters of a core, in the order of files. Files may omit those listed in `Core::optional_parameters`, and
/// flags.
template <class Core>
[[nodiscard]] std::vector<parameter_info> parameter_infos() {
  std::vector<parameter_info> all;
  std::span<const std::string_view> optional;
  if constexpr (requires { Core::optional_parameters; }) optional = Core::optional_parameters;
  const Core blank{};
  Core::parameters(blank, [&](const char* name, const auto& value) {
    detail::add_info(all, detail::parameter_of_type::of(value), name, optional);
  });
  return all;
}

}  // namespace kte
