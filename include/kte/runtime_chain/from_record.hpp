#pragma once

#include <kte/contract/number_reader.hpp>
#include <kte/runtime_chain/static_chain_map.hpp>

/// Converts plain data to a static chain type.
namespace kte {

namespace detail {

template <class Core, class... Keys>
void assign(element<Core, Keys...>& e, const element_record& r, std::size_t number) {
  const std::string which = "element " + std::to_string(number) + " (" + r.type + ")";
  const record_place at{to_string(r.place) + which};
  const auto own = record_of(e.core, std::array<std::string_view, sizeof...(Keys)>{Keys::name...});
  if (r.type != own.type) at.fail("the static chain has a " + own.type + " here");
  if (r.version != own.version)
    at.fail("has version " + std::to_string(r.version) + ", not " + std::to_string(own.version));
  if (r.connections != own.connections) {
    std::string names;
    for (const auto& c : own.connections) names += " " + c.role + " '" + c.name + "'";
    at.fail("is not connected as in the static chain:" + names);
  }
  std::size_t n = 0;
  Core::parameters(e.core, [&](const char* name, auto& value) {
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(value)>, bool>) {
      value = n < r.parameters.size() && r.parameters[n].name == name;
      if (!value) return;
    }
    if (n == r.parameters.size()) at.fail("does not have the parameters of its type");
    const auto& p = r.parameters[n++];
    if (p.name != name) at.fail("has a parameter '" + p.name + "' instead of '" + name + "'");
    const record_place here{to_string(p.place) + which + ", " + name};
    number_reader reader(p.values, here);
    reader(value);
    reader.finish();
  });
  if (n != r.parameters.size()) at.fail("does not have the parameters of its type");
  const std::array<std::string_view, sizeof...(Keys)> names{Keys::name...};
  parameter_check::breach broken;
  const parameter_check where{Core::type, Core::ports, names, broken};
  e.core.check(where);
  const auto text = [&] { return "kte: " + at.text + ": " + where().substr(5); };
  require<bad_parameter>(!broken.rule, text, broken.rule, broken.value);
}

}  // namespace detail

/// A static chain of the type of `like` with the numbers of a record. Elements, connections and typed constants must be
/// those of the type; throws `bad_file` that says which is not, or `bad_parameter`.
template <class Gravity, class... E>
[[nodiscard]] static_chain<Gravity, E...> from_record(const static_chain<Gravity, E...>& like, const model_record& r) {
  auto elements = like.elements();
  if (r.elements.size() != sizeof...(E))
    throw bad_file("kte: the model has " + std::to_string(r.elements.size()) + " elements, the static chain " +
                   std::to_string(sizeof...(E)));
  std::size_t i = 0;
  boost::hana::for_each(elements, [&](auto& e) {
    detail::assign(e, r.elements[i], i + 1);
    ++i;
  });
  Gravity g = like.gravity();
  const detail::record_place place{"gravity"};
  detail::number_reader reader(r.gravity, place);
  reader(g);
  reader.finish();
  detail::check_gravity(g);
  return {elements, g};
}

}  // namespace kte
