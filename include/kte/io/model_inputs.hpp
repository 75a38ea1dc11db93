#pragma once

#include <kte/io/limit_records.hpp>
#include <kte/io/state_records.hpp>
#include <kte/runtime_chain/static_chain_map.hpp>

/// Models of manipulators as plain data and back: tools and limits; for dynamics models also inputs by name.
namespace kte::detail {

/// Calls visit(name, first index in u, count) for all external inputs of a model.
template <class Model, class Visit>
void for_each_input(const Model& m, const Visit& visit) {
  if constexpr (requires { m.wiring(); }) {
    for (const auto& s : m.wiring().signals)
      if (s.u >= 0)
        visit(m.wiring().names[static_cast<std::size_t>(s.what)][static_cast<std::size_t>(s.slot)], s.u, nu_of(s.what));
  } else {
    using all = typename Model::wiring;
    for (int i = 0; i < all::table.signals; ++i)
      if (const auto& s = all::table.signal[static_cast<std::size_t>(i)]; s.u >= 0)
        visit(name_of_thing(static_cast<const all*>(nullptr), s.what, s.slot), s.u, nu_of(s.what));
  }
}
template <class Model>
std::vector<parameter_record> input_records(const Model& m) {
  std::vector<parameter_record> all;
  for_each_input(m, [&](std::string_view name, int u, int n) {
    auto& values = all.emplace_back(parameter_record{std::string(name), {}}).values;
    for (int i = u; i < u + n; ++i) values.push_back(static_cast<double>(m.input()[i]));
  });
  return all;
}
/// The record of a chain or a model, with tools, limits and inputs. Throws `bad_argument` for functions of the program.
template <class T>
model_record record_of_model(const T& x) {
  model_record m = record_of(x);
  if constexpr (requires { x.tools(); })
    for (const auto& t : x.tools()) m.tools.emplace_back(t);
  if constexpr (requires { x.limits(); }) m.limits = limit_records(x, x.limits());
  if constexpr (requires { x.has_output(); }) {
    if (x.has_output())
      throw bad_argument("kte: the output of this model is a function of its program, which no file can hold");
    m.inputs = input_records(x);
  }
  return m;
}
/// Throws `unknown_name`, `bad_file`; the model is then unchanged.
template <class Model>
void restore_inputs(const model_record& r, Model& m) {
  auto u = m.input();
  for (const auto& x : r.inputs) {
    bool found = false;
    for_each_input(m, [&](std::string_view name, int begin, int n) {
      if (x.name != name) return;
      found = true;
      if (x.values.size() != static_cast<std::size_t>(n))
        raise<bad_file>("kte: " + to_string(x.place) + "input '" + x.name + "' has " + std::to_string(x.values.size()) +
                        " numbers, not " + std::to_string(n));
      for (int i = 0; i < n; ++i)
        u[begin + i] = static_cast<std::remove_reference_t<decltype(u[0])>>(x.values[static_cast<std::size_t>(i)]);
    });
    if (!found) raise<unknown_name>("kte: " + to_string(x.place) + "the model has no input '" + x.name + "'");
  }
  m.setInput(u);
}

}  // namespace kte::detail
