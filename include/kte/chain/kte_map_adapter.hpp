#pragma once

#include <kte/chain/kte_map.hpp>
#include <kte/chain/runtime_state.hpp>

namespace kte {

/// An element of a runtime chain: the same core as in a static chain, connected by texts.
template <class Core>
class kte_map_adapter final : public kte_element {
 public:
  explicit kte_map_adapter(named_element<Core> e) : core_(e.core), names_(std::move(e.names)) {}

  void doMotion(runtime_state& s) const override { on(s).motion(inputs{}); }
  void clearForce(runtime_state& s) const override { on(s).clear(std::make_index_sequence<port_count<Core>>{}); }
  void doForce(runtime_state& s) const override { on(s).force(inputs{}); }

  std::unique_ptr<kte_map> clone() const override { return std::make_unique<kte_map_adapter>(*this); }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const override { visit(*this); }
  void connect(topology& t) override {
    t.connect(this, Core::type, Core::ports, names_);
    auto& c = t.elements.back();
    std::copy(c.index.begin(), c.index.end(), index_.begin());
    c.stiff = detail::is_transmission<Core>;
    c.reads_positions = detail::reads_positions<Core>;
    c.has_derivatives = detail::has_derivatives<Core>;
    c.plain_loads = detail::loads_by_relative<Core>;
    t.reads_positions |= c.reads_positions;
    t.has_derivatives &= c.has_derivatives;
    t.plain_loads &= c.plain_loads;
    t.is_stiff &= c.stiff || Core::ports.back().how != access::out || !is_frame(Core::ports.back().what);
    number_ = t.elements.size() - 1;
  }
  element_record record() const override { return record_of(core_, names_); }

  std::span<const port> ports() const override { return Core::ports; }

  double kinetic_energy(runtime_state& s) const override { return as<double>(on(s).kinetic_energy(inputs{})); }
  double potential_energy(runtime_state& s) const override { return as<double>(on(s).potential_energy(inputs{})); }
  double switching(runtime_state& s) const override { return as<double>(on(s).switching(inputs{})); }
  bool switches() const override {
    using number = decltype(on(std::declval<runtime_state&>()).switching(inputs{}));
    return !typed_constant<number>;
  }

  void perform(detail::steps::move step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::push step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::move_fully step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::push_fully step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::follow step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::carry step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::carry_coordinate step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::move_by_rates step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::articulate step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::accelerate step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::rest step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::load_down step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::vary step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::vary_coordinates step, runtime_state& s) const override { take(step, s); }
  void perform(detail::steps::inward step, runtime_state& s) const override { take(step, s); }

 private:
  using inputs = std::make_index_sequence<input_count<Core>>;

  auto on(runtime_state& s) const {
    return detail::stored_element<Core, runtime_state, detail::by_index>{core_, s, {index_.data()}};
  }
  template <class Step>
  void take(Step, runtime_state& s) const {
    detail::perform<Step>(core_, s, index_.data(), s.plan.places[number_]);
  }

  Core core_;
  std::array<std::string, port_count<Core>> names_;
  std::array<int, port_count<Core>> index_{};
  std::size_t number_ = 0;  ///< among the elements of the chain
};

}  // namespace kte
