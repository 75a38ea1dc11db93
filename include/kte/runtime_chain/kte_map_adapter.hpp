#pragma once

#include <kte/runtime_chain/element_parts.hpp>
#include <kte/runtime_chain/general_dynamics.hpp>

namespace kte {

namespace detail {
/// Calls visit for the numbers of a parameter.
template <class T>
[[gnu::noinline]] void visit_numbers(std::string_view name, T& x, const parameter_visitor& visit) {
  for_each_component(x, [&](std::string_view component, auto& number) {
    using number_type = std::remove_cvref_t<decltype(number)>;
    if constexpr (typed_constant<number_type>) {
      visit(name, component, nullptr);
    } else if constexpr (std::is_same_v<number_type, double>) {
      visit(name, component, &number);
    } else {
      double value = as_double(number);
      visit(name, component, &value);
      number = static_cast<number_type>(value);
    }
  });
}
}  // namespace detail

/// An element of a runtime chain: an element core, connected by texts. Functions that are only called while a chain is
/// built are cold, so that compilers keep them small.
template <class Core>
class kte_map_adapter final : public detail::parts_of_element<Core>::type {
  using base = typename detail::parts_of_element<Core>::type;
  using base::core_, base::named, base::on;
  using typename base::inputs;

 public:
  explicit kte_map_adapter(named_element<Core> e) : base(e) {}

  void doMotion(runtime_state& s) const override {
    named([&] { on(s).motion(inputs{}); });
  }
  void clearForce(runtime_state& s) const override { on(s).clear(std::make_index_sequence<port_count<Core>>{}); }
  void doForce(runtime_state& s) const override {
    named([&] { on(s).force(inputs{}); });
  }

  [[gnu::cold]] std::unique_ptr<kte_map> clone() const override { return std::make_unique<kte_map_adapter>(*this); }
  [[gnu::cold]] element_record record() const override { return record_of(core_, this->names()); }
  [[gnu::cold]] void visit_parameters([[maybe_unused]] const detail::parameter_visitor& visit) override {
    if constexpr (core_in_files<Core>)
      Core::parameters(core_, [&visit](const char* name, auto& x) { detail::visit_numbers(name, x, visit); });
  }

  double kinetic_energy(runtime_state& s) const override { return as<double>(on(s).kinetic_energy(inputs{})); }
  double potential_energy(runtime_state& s) const override {
    return named([&] { return as<double>(on(s).potential_energy(inputs{})); });
  }
  double switching(runtime_state& s) const override {
    return named([&] { return as<double>(on(s).switching(inputs{})); });
  }
  bool switches() const override {
    using number = decltype(on(std::declval<runtime_state&>()).switching(inputs{}));
    return !typed_constant<number> || locks_coordinate<Core>;
  }
  detail::element_numbers<double> numbers() const override {
    using kinetic = decltype(on(std::declval<runtime_state&>()).kinetic_energy(inputs{}));
    using potential = decltype(on(std::declval<runtime_state&>()).potential_energy(inputs{}));
    auto n = detail::numbers_of<double>(core_);
    n.has_energy = !std::is_same_v<kinetic, zero_t> || !std::is_same_v<potential, zero_t>;
    return n;
  }

 private:
  [[gnu::cold]] void check_core(const parameter_check& where) const override { core_.check(where); }
};

namespace detail {
/// The element of a runtime chain with a core. Programs that link kte::compiled instantiate no adapters of its cores.
template <class Core>
[[gnu::cold]] std::unique_ptr<kte_element> adapted(named_element<Core> e) {
  if constexpr (needs_general_dynamics<Core>) general_dynamics<runtime_state>::bring();
  return std::make_unique<kte_map_adapter<Core>>(std::move(e));
}
}  // namespace detail

}  // namespace kte
