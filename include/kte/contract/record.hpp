#pragma once

#include <kte/contract/element_core.hpp>
#include <kte/contract/file_place.hpp>
#include <kte/detail/raise.hpp>
#include <kte/errors.hpp>
#include <kte/math/quaternion.hpp>
#include <kte/math/rigid_body.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

/// Elements as plain data, for files and comparisons.
namespace kte {

/// A parameter: `name` and `values`; vectors x y z, matrices by rows, symmetric matrices xx xy xz yy yz zz, lists of
/// any length. Records have a `place` in their file, for messages.
struct parameter_record {
  std::string name;
  std::vector<double> values;
  file_place place{};
  friend bool operator==(const parameter_record&, const parameter_record&) = default;
};
/// A connection: the `role` of the port, the `name` it is connected to, and the `place` in the file.
struct connection_record {
  std::string role;
  std::string name;
  file_place place{};
  friend bool operator==(const connection_record&, const connection_record&) = default;
};
/// An element: its type, the version of that type, connections, parameters, and the `place` in the file.
struct element_record {
  std::string type;
  int version = 1;
  std::vector<connection_record> connections;
  std::vector<parameter_record> parameters;
  file_place place{};
  friend bool operator==(const element_record&, const element_record&) = default;
};

/// Limits of a coordinate (models/joint_limits.hpp): `limits` are `lower`, `upper`, `rate` ... as numbers of v; a
/// missing one is infinite. `place`: in the file.
struct limit_record {
  std::string coordinate;
  std::vector<parameter_record> limits;
  file_place place{};
  friend bool operator==(const limit_record&, const limit_record&) = default;
};

/// A chain: gravity in the axes of its bases, m/s^2, and the elements in order. The model of a manipulator also has
/// frames that are its tools, limits of its coordinates and values of its inputs.
struct model_record {
  std::vector<double> gravity{0, 0, 0};
  std::vector<element_record> elements{};
  std::vector<std::string> tools{};
  std::vector<limit_record> limits{};
  std::vector<parameter_record> inputs{};
  friend bool operator==(const model_record&, const model_record&) = default;
};

namespace detail {

// Not inlined, because there is one record_of for each type of element.
[[gnu::noinline]] inline void append_all(std::vector<double>& v, std::initializer_list<double> numbers) {
  v.insert(v.end(), numbers);
}
[[gnu::noinline]] inline void add_connection(element_record& r, std::string_view role, std::string_view name) {
  r.connections.push_back({std::string(role), std::string(name)});
}
/// Adds a parameter without numbers and returns its list.
[[gnu::noinline]] inline std::vector<double>& add_parameter(element_record& r, const char* name) {
  r.parameters.push_back({name, {}});
  return r.parameters.back().values;
}

template <entry T>
void append_numbers(std::vector<double>& v, const T& x) {
  append_all(v, {as<double>(x)});
}
template <class X, class Y, class Z>
void append_numbers(std::vector<double>& v, const vec3<X, Y, Z>& x) {
  const auto d = as<double>(x);
  append_all(v, {d.x, d.y, d.z});
}
template <class... T>
void append_numbers(std::vector<double>& v, const sym3<T...>& x) {
  const auto d = as<double>(x);
  append_all(v, {d.xx, d.xy, d.xz, d.yy, d.yz, d.zz});
}
/// A list.
template <entry List>
requires requires(const List& l) { l.size(), l.data(); }
void append_numbers(std::vector<double>& v, const List& list) { v.insert(v.end(), list.begin(), list.end()); }
template <geometric R>
requires requires(const R& r) { matrix(r); }
void append_numbers(std::vector<double>& v, const R& rotation) {
  const auto m = matrix(rotation);
  append_numbers(v, m.x), append_numbers(v, m.y), append_numbers(v, m.z);
}

}  // namespace detail

/// The record of a core and the names of its connections. A bool parameter is stored only if it is true, as 1. Throws
/// `bad_argument` for a core that declares `holds_code`: functions of the program.
template <class Core, class Names>
[[nodiscard]] element_record record_of(const Core& core, const Names& names) {
  if constexpr (holds_code<Core>) {
    std::array<std::string_view, port_count<Core>> texts;
    for (std::size_t p = 0; p < port_count<Core>; ++p) texts[p] = names[p];
    detail::raise<bad_argument>("kte: " + describe_element(Core::type, Core::ports, texts) +
                                " holds a function of its program, which no record or file can hold");
  }
  element_record r{std::string(std::string_view(Core::type)), 1, {}, {}};
  for (std::size_t p = 0; p < port_count<Core>; ++p) detail::add_connection(r, Core::ports[p].role, names[p]);
  Core::parameters(core, [&r](const char* name, const auto& value) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, bool>) {
      if (value) detail::append_all(detail::add_parameter(r, name), {1});
    } else {
      detail::append_numbers(detail::add_parameter(r, name), value);
    }
  });
  return r;
}

}  // namespace kte
