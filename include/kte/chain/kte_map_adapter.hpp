#pragma once

#include <kte/chain/kte_map.hpp>
#include <kte/chain/mass_kernels.hpp>
#include <kte/chain/passes.hpp>

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
    if constexpr (has_coordinate) c.coordinate = index_[0];
    c.stiff = detail::is_transmission<Core>;
    if constexpr (detail::is_transmission<Core>)
      c.below =
          t.writers[static_cast<std::size_t>(Core::ports[base_port].what)][static_cast<std::size_t>(index_[base_port])];
  }
  element_record record() const override { return record_of(core_, names_); }

  std::span<const port> ports() const override { return Core::ports; }
  void update_coordinates(runtime_state& s) const override {
    if constexpr (Core::ports.back().what == kind::gen && Core::ports.back().how == access::out) {
      doMotion(s);
    } else {
      on(s).update_angles(inputs{});
    }
  }

  void carry(runtime_state& s) const override {
    if constexpr (detail::has_mass<Core, double> && Core::ports[0].what != kind::gen) {
      add(carried<0>(s), core_.template mass<double>());
    } else if constexpr (detail::is_transmission<Core>) {
      const auto x = pose(s);
      add(carried<base_port>(s), transported(x.rotation, x.position, carried<base_port + 1>(s)));
    }
  }
  double start_column(const runtime_state& s, wrench_3D& at_end) const override {
    if constexpr (has_coordinate) {
      const auto axis = core_.relative(detail::unit_rate(coordinate(s)));
      at_end = dense(detail::accelerating_wrench(carried<base_port + 1>(s), axis));
      return as<double>(detail::power(axis, at_end));
    } else {
      return 0;
    }
  }
  double carry_wrench(const runtime_state& s, wrench_3D& w) const override {
    double f = 0;
    if constexpr (has_coordinate) f = as<double>(detail::power(core_.relative(detail::unit_rate(coordinate(s))), w));
    if constexpr (detail::is_transmission<Core>) w = dense(transmit(pose(s), w));
    return f;
  }
  void coordinate_mass(runtime_state& s) const override {
    auto& m = s.work.all;
    if constexpr (Core::ports[0].what == kind::gen && detail::has_mass<Core, double>) {
      m(index_[0], index_[0]) += as<double>(core_.template mass<double>());
    } else if constexpr (Core::ports[0].what == kind::gen && Core::ports.back().what == kind::gen &&
                         Core::ports.back().how == access::out) {
      const double ratio = as<double>(core_.doMotion(detail::unit_rate(coordinate(s))).q_dot);
      m.row(index_[0]) += ratio * m.row(index_.back());
      m.col(index_[0]) += ratio * m.col(index_.back());
    }
  }

 private:
  using inputs = std::make_index_sequence<input_count<Core>>;
  static constexpr std::size_t base_port = detail::is_transmission<Core> ? port_count<Core> - 2 : 0;
  static constexpr bool has_coordinate = detail::is_transmission<Core> && base_port == 1;

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
  const gen_coord<>& coordinate(const runtime_state& s) const { return s.get<kind::gen>(index_[0]); }
  auto pose(const runtime_state& s) const {
    if constexpr (has_coordinate) {
      return core_.relative(detail::position_only(coordinate(s)));
    } else {
      return core_.relative();
    }
  }
  template <std::size_t P, class State>
  auto& carried(State& s) const {
    return s.work.carried[Core::ports[P].what == kind::frame_3D][static_cast<std::size_t>(index_[P])];
  }
  template <class C>
  static void add(composite_3D& to, const C& c) {
    to = {as<double>(to.mass + c.mass), as<double>(to.moment + c.moment), as<double>(to.inertia + c.inertia)};
  }
  template <class F, class T>
  static wrench_3D dense(const wrench<F, T>& w) {
    return {as<double>(w.force), as<double>(w.torque)};
  }

  Core core_;
  std::array<std::string, port_count<Core>> names_;
  std::array<int, port_count<Core>> index_{};
};

}  // namespace kte
