#pragma once

#include <kte/io/print_numbers.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/runtime_chain/static_chain_map.hpp>

/// `std::cout << chain`: a line for the chain and one for each element, with the connections of its ports and its
/// parameters.
///
///   static chain of 2 elements, 1 degree of freedom, gravity (0_c, -9.81, 0_c)
///     revolute_joint_2D (coordinate 'q', base 'base', end 'joint'): axis (0_c, 0_c, 1_c)
///     inertia_2D (frame 'joint'): mass 1, com (0_c, 0_c, 0_c), inertia (0_c, 0_c, 0_c, 0_c, 0_c, 0_c)
namespace kte {

namespace detail {
/// "1", "(0.5, 0, 0)": values in the order of files.
inline std::ostream& print_values(std::ostream& out, const std::vector<double>& values) {
  if (values.size() == 1) return out << values[0];
  const char* before = "(";
  for (const double x : values) out << before << x, before = ", ";
  return out << (values.empty() ? "()" : ")");
}
inline std::ostream& print_element(std::ostream& out, std::string_view type, std::span<const connection_record> to,
                                   std::span<const parameter_record> parameters) {
  out << type;
  const char* before = " (";
  for (const auto& c : to) out << before << c.role << " '" << c.name << "'", before = ", ";
  if (!to.empty()) out << ')';
  before = ": ";
  for (const auto& p : parameters) print_values(out << before << p.name << ' ', p.values), before = ", ";
  return out;
}
/// The line of the chain, up to its gravity.
inline std::ostream& print_title(std::ostream& out, const char* what, std::size_t elements) {
  return out << what << " of " << elements << (elements == 1 ? " element" : " elements") << ", gravity ";
}
}  // namespace detail

inline std::ostream& operator<<(std::ostream& out, const element_record& e) {
  return detail::print_element(out, e.type, e.connections, e.parameters);
}
inline std::ostream& operator<<(std::ostream& out, const model_record& m) {
  detail::print_values(detail::print_title(out, "model", m.elements.size()), m.gravity) << '\n';
  for (const auto& e : m.elements) out << "  " << e << '\n';
  return out;
}

/// An element of a static chain.
template <class Core, class... Keys>
std::ostream& operator<<(std::ostream& out, const element<Core, Keys...>& e) {
  const std::string_view names[]{Keys::name...};
  out << describe_element(Core::type, Core::ports, names);
  if constexpr (holds_code<Core>) return out << ": a function of the program";
  const char* before = ": ";
  Core::parameters(e.core, [&](const char* name, const auto& value) {
    using type = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<type, bool>) {
      if (!value) return;
    }
    out << before << name << ' ', before = ", ";
    if constexpr (requires { value.size(), value.data(); })
      detail::print_list(out, value);
    else
      out << value;
  });
  return out;
}

template <class Gravity, class... E>
std::ostream& operator<<(std::ostream& out, const static_chain<Gravity, E...>& c) {
  detail::print_title(out, "static chain", sizeof...(E)) << c.gravity() << '\n';
  boost::hana::for_each(c.elements(), [&out](const auto& e) { out << "  " << e << '\n'; });
  return out;
}

/// An element of a runtime chain, with the numbers that a file would have.
inline std::ostream& operator<<(std::ostream& out, const kte_element& e) {
  if (!e.holds_code()) return out << e.record();
  const std::vector<std::string_view> names(e.names().begin(), e.names().end());
  return out << describe_element(e.type(), e.ports(), names) << ": a function of the program";
}
inline std::ostream& operator<<(std::ostream& out, const runtime_chain& c) {
  std::size_t count = 0;
  c.for_each_element([&count](const kte_element&) { ++count; });
  detail::print_title(out, "runtime chain", count) << c.gravity() << '\n';
  c.for_each_element([&out](const kte_element& e) { out << "  " << e << '\n'; });
  return out;
}

}  // namespace kte
