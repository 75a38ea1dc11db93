#pragma once

#include <kte/contract/core_in_scalar.hpp>
#include <kte/contract/nearest_name.hpp>
#include <kte/contract/parameter_check.hpp>

#include <string>
#include <string_view>

/// Parameters of elements by paths: NAME/PARAMETER or NAME/PARAMETER/COMPONENT, such as `tool/mass`, `tool/com/x`,
/// `tool/inertia/zz`, `gravity/z`.
namespace kte::detail {

/// The rest of `path` after a name and a slash; empty if it does not begin with them.
constexpr std::string_view after_name(std::string_view path, std::string_view name) {
  return path.size() > name.size() && path.starts_with(name) && path[name.size()] == '/' ? path.substr(name.size() + 1)
                                                                                         : std::string_view{};
}

/// Calls put(number) for the components of a parameter that `component` names: a number without a component, x, y, z of
/// a vector, xx ... zz of an inertia. Returns whether there is one.
template <class T, class Put>
constexpr bool at_component(T& x, std::string_view component, const Put& put) {
  const auto one = [&](auto& number, std::string_view name) { return component == name && (put(number), true); };
  if constexpr (is_real_number<T> || typed_constant<T>) {
    return one(x, "");
  } else if constexpr (requires { x.xx, x.zz; }) {
    return one(x.xx, "xx") || one(x.xy, "xy") || one(x.xz, "xz") || one(x.yy, "yy") || one(x.yz, "yz") ||
           one(x.zz, "zz");
  } else if constexpr (requires {
                         requires entry<decltype(x.x)>;
                         requires !requires { x.w; };
                         x.z;
                       }) {
    return one(x.x, "x") || one(x.y, "y") || one(x.z, "z");
  } else {
    return false;
  }
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

}  // namespace kte::detail
