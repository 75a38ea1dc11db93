#pragma once

#include <kte/contract/core_in_scalar.hpp>
#include <kte/contract/nearest_name.hpp>
#include <kte/contract/parameter_check.hpp>

#include <string>
#include <string_view>

/// Parameters of elements by paths: NAME/PARAMETER or NAME/PARAMETER/COMPONENT, such as `tool/mass`, `tool/com/x`,
/// `tool/inertia/zz`, `gravity/z`.
namespace kte {

/// A parameter of a chain by its path, and its value: a number, or a pack with a number for each lane.
///
///   kte::parameter{"tool/mass", payload}      NAME/PARAMETER, names of parameters as in files (docs/elements.md)
///   kte::parameter{"tool/com/z", height}      components: x, y, z; of inertias xx, xy, xz, yy, yz, zz
///   kte::parameter{"gravity/z", -g}
///
/// NAME is the last connection of the element, what it acts on or writes: the frame of a body, the end of a link or
/// joint. If no element has this one, it is any other connection: the coordinate of a joint.
template <class S>
struct parameter {
  std::string_view path;
  S value;
};
template <class Path, class S>
parameter(Path, S) -> parameter<S>;

namespace detail {

/// The rest of `path` after a name and a slash; empty if it does not begin with them.
constexpr std::string_view after_name(std::string_view path, std::string_view name) {
  return path.size() > name.size() && path.starts_with(name) && path[name.size()] == '/' ? path.substr(name.size() + 1)
                                                                                         : std::string_view{};
}

/// Calls visit(component, number) for the components of a parameter: a number without a name, x, y, z of a vector, xx
/// ... zz of an inertia. Other parameters have none.
template <class T, class Visit>
constexpr void for_each_component(T& x, const Visit& visit) {
  if constexpr (is_real_number<T> || typed_constant<T>) {
    visit(std::string_view{}, x);
  } else if constexpr (requires { x.xx, x.zz; }) {
    visit(std::string_view("xx"), x.xx), visit(std::string_view("xy"), x.xy), visit(std::string_view("xz"), x.xz);
    visit(std::string_view("yy"), x.yy), visit(std::string_view("yz"), x.yz), visit(std::string_view("zz"), x.zz);
  } else if constexpr (requires {
                         requires entry<decltype(x.x)>;
                         requires !requires { x.w; };
                         x.z;
                       }) {
    visit(std::string_view("x"), x.x), visit(std::string_view("y"), x.y), visit(std::string_view("z"), x.z);
  }
}
/// Calls put(number) for the component of a parameter with this name. Returns whether there is one.
template <class T, class Put>
constexpr bool at_component(T& x, std::string_view component, const Put& put) {
  bool found = false;
  for_each_component(x, [&](std::string_view name, auto& number) {
    if (component == name) put(number), found = true;
  });
  return found;
}
/// Calls put(number) for the number that `path` names in a core with these connections. `all`: for any of its ports,
/// otherwise for the last one, to which the element belongs: the frame of a body, the end of a joint.
template <class Core, class Names, class Put>
constexpr bool at_path(Core& core, const Names& names, std::string_view path, bool all, const Put& put) {
  bool found = false;
  if constexpr (core_in_files<std::remove_const_t<Core>>) {
    const std::size_t last = names.size() - 1;
    for (std::size_t p = all ? 0 : last; p < (all ? last : last + 1); ++p) {
      const std::string_view rest = after_name(path, names[p]);
      if (rest.empty()) continue;
      Core::parameters(core, [&](const char* name, auto& x) {
        const std::string_view component = rest == name ? std::string_view{} : after_name(rest, name);
        if (rest == name || !component.empty()) found |= at_component(x, component, put);
      });
    }
  }
  return found;
}

/// Throws for a path that no element has, or several.
[[noreturn, gnu::cold]] inline void raise_no_parameter(std::string_view path) {
  raise<unknown_name>("kte: the chain has no parameter '" + std::string(path) +
                      "'; paths are NAME/PARAMETER or NAME/PARAMETER/COMPONENT, as tool/mass or tool/com/x");
}
[[noreturn, gnu::cold]] inline void raise_ambiguous_parameter(std::string_view path, int elements) {
  raise<bad_argument>("kte: the path '" + std::string(path) + "' names parameters of " + std::to_string(elements) +
                      " elements");
}
/// Throws for a path of a typed constant.
[[noreturn, gnu::cold]] inline void raise_fixed(std::string_view path) {
  raise<bad_argument>("kte: the parameter '" + std::string(path) +
                      "' is a typed constant, which is fixed by the type of the chain; build the chain with a number "
                      "there");
}
/// Throws for a path of an element whose core has parameters in double only.
[[noreturn, gnu::cold]] inline void raise_one_number(std::string_view path) {
  raise<bad_argument>("kte: the parameter '" + std::string(path) +
                      "' is a double by the type of its element, equal in all lanes");
}

}  // namespace detail
}  // namespace kte
