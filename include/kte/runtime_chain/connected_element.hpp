#pragma once

#include <kte/contract/element_numbers.hpp>
#include <kte/contract/force_derivatives.hpp>
#include <kte/contract/parameter_check.hpp>
#include <kte/contract/parameter_paths.hpp>
#include <kte/runtime_chain/kte_map.hpp>
#include <kte/runtime_chain/topology.hpp>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

/// What elements of a runtime chain do without their cores: they have names, and are connected.
namespace kte::detail {

/// What chains ask of a core type.
struct core_facts {
  std::string_view type;
  std::span<const port> ports;
  bool rigid, distributed_mass, load, closes, touches, starts_in_place, holds_code;
  bool has_derivatives;  ///< whether its forces on coordinates alone have derivatives
  int parameters;        ///< number of its inertial parameters
};
template <class Core>
inline constexpr core_facts facts_of{
    Core::type,
    Core::ports,
    is_transmission<Core>,
    distributed_mass<Core>,
    is_load<Core>,
    is_closure<Core>,
    is_contact<Core>,
    starts_in_place<Core>,
    holds_code<Core>,
    has_derivatives<Core> ||
        std::any_of(Core::ports.begin(), Core::ports.end(), [](const port& p) { return is_frame(p.what); }),
    parameter_count<Core>};

/// An element with the names at its ports. Functions that are called only while a chain is built are cold, so that
/// compilers keep them small.
class connected_element : public kte_element {
 public:
  std::string_view type() const final { return facts_.type; }
  std::span<const port> ports() const final { return facts_.ports; }
  std::span<const std::string> names() const final { return {names_.data(), names_.size()}; }
  bool holds_code() const final { return facts_.holds_code; }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const final { visit(*this); }
  void connect(topology& t) final { connect_to(t); }
  void check_parameters() const final { refuse_bad_parameters(); }

 protected:
  /// Takes the names. (A span of them, or of a list, would instantiate 900 classes of std in each unit.)
  connected_element(const core_facts& facts, std::string* names);
  connected_element(const connected_element&);

 private:
  // Not virtual: units compile the virtual functions of a class if one of them is not defined in it.
  void connect_to(topology& t);
  void refuse_bad_parameters() const;
  /// Checks the parameters of the core.
  virtual void check_core(const parameter_check& where) const = 0;

  const core_facts& facts_;
  std::vector<std::string> names_;
};

#ifdef KTE_FUNCTION
[[gnu::cold]] KTE_FUNCTION connected_element::connected_element(const core_facts& facts, std::string* names)
    : facts_(facts) {
  names_.reserve(facts.ports.size());
  for (std::size_t p = 0; p < facts.ports.size(); ++p) names_.push_back(std::move(names[p]));
}
[[gnu::cold]] KTE_FUNCTION connected_element::connected_element(const connected_element& o)
    : kte_element(o), facts_(o.facts_), names_(o.names_) {}
[[gnu::cold]] KTE_FUNCTION void connected_element::connect_to(topology& t) {
  t.connect(this, facts_.type, facts_.ports, names());
  auto& c = t.elements.back();
  connect_as({c.index.data(), c.index.size()});
  c.rigid = facts_.rigid, c.distributed_mass = facts_.distributed_mass, c.load = facts_.load;
  c.closes = facts_.closes, c.touches = facts_.touches;
  c.starts_in_place = facts_.starts_in_place, c.parameters = facts_.parameters;
  t.has_derivatives &= facts_.has_derivatives;
}
[[gnu::cold]] KTE_FUNCTION void connected_element::refuse_bad_parameters() const {
  const std::vector<std::string_view> texts(names_.begin(), names_.end());
  parameter_check::breach broken;
  const parameter_check where{facts_.type, facts_.ports, {texts.data(), texts.size()}, broken};
  check_core(where);
  if (broken.rule) raise<bad_parameter>(where());
}
#endif

}  // namespace kte::detail
