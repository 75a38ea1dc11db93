#pragma once

#include <kte/chain/kte_map.hpp>
#include <kte/chain/working_articulated.hpp>
#include <kte/chain/working_mass.hpp>

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
    number_ = t.elements.size() - 1;
  }
  element_record record() const override { return record_of(core_, names_); }

  std::span<const port> ports() const override { return Core::ports; }
  bool reads_positions() const override { return detail::reads_positions<Core>; }

  double kinetic_energy(runtime_state& s) const override { return as<double>(on(s).kinetic_energy(inputs{})); }
  double potential_energy(runtime_state& s) const override { return as<double>(on(s).potential_energy(inputs{})); }

  void update_coordinates(runtime_state& s) const override { plain(s).follow(); }
  void move(runtime_state& s) const override { plain(s).move(); }
  void push(runtime_state& s) const override { plain(s).template push<false>(); }
  void carry(runtime_state& s) const override { working<detail::working_mass>(s).carry(); }
  void carry_coordinate(runtime_state& s) const override { working<detail::working_mass>(s).carry_coordinate(); }
  void move_by_rates(runtime_state& s) const override { working<detail::working_articulated>(s).move_by_rates(); }
  void articulate(runtime_state& s) const override { working<detail::working_articulated>(s).articulate(); }
  void accelerate(runtime_state& s) const override { working<detail::working_articulated>(s).accelerate(); }

 private:
  using inputs = std::make_index_sequence<input_count<Core>>;

  /// Where a port leads.
  struct where {
    const int* index;
    template <std::size_t P>
    int at() const {
      return index[P];
    }
  };
  auto on(runtime_state& s) const {
    return detail::stored_element<Core, runtime_state, where>{core_, s, {index_.data()}};
  }
  auto plain(runtime_state& s) const {
    return detail::working_element<Core>{core_, s, index_.data(), s.work.places[number_]};
  }
  template <template <class> class Working>
  auto working(runtime_state& s) const {
    return Working<Core>{plain(s)};
  }

  Core core_;
  std::array<std::string, port_count<Core>> names_;
  std::array<int, port_count<Core>> index_{};
  std::size_t number_ = 0;  ///< among the elements of the chain
};

}  // namespace kte
