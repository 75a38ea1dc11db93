#pragma once

#include <kte/contract/closure_parameters.hpp>
#include <kte/contract/force_derivatives.hpp>
#include <kte/contract/parameter_paths.hpp>
#include <kte/contract/varying_joint.hpp>
#include <kte/runtime_chain/derivative_state.hpp>
#include <kte/runtime_chain/kte_map.hpp>
#include <kte/runtime_chain/out_of_line_pass.hpp>
#include <kte/runtime_chain/runtime_state.hpp>

#include <algorithm>

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
class kte_map_adapter final : public kte_element {
 public:
  explicit kte_map_adapter(named_element<Core> e) : core_(e.core), names_(std::move(e.names)) {}

  void doMotion(runtime_state& s) const override {
    named([&] { on(s).motion(inputs{}); });
  }
  void clearForce(runtime_state& s) const override { on(s).clear(std::make_index_sequence<port_count<Core>>{}); }
  void doForce(runtime_state& s) const override {
    named([&] { on(s).force(inputs{}); });
  }

  [[gnu::cold]] std::unique_ptr<kte_map> clone() const override { return std::make_unique<kte_map_adapter>(*this); }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const override { visit(*this); }
  [[gnu::cold]] void connect(topology& t) override {
    t.connect(this, Core::type, Core::ports, names_);
    auto& c = t.elements.back();
    connect_as(c.index);
    c.rigid = detail::is_transmission<Core>, c.distributed_mass = distributed_mass<Core>;
    c.load = is_load<Core>, c.closes = detail::is_closure<Core>;
    c.touches = detail::is_contact<Core>;
    c.starts_in_place = starts_in_place<Core>, c.parameters = detail::parameter_count<Core>;
    const bool on_frames =
        std::any_of(Core::ports.begin(), Core::ports.end(), [](const port& p) { return is_frame(p.what); });
    t.has_derivatives &= on_frames || detail::has_derivatives<Core>;
  }
  void connect_as(std::span<const int> index) override { std::copy(index.begin(), index.end(), index_.begin()); }
  [[gnu::cold]] element_record record() const override { return record_of(core_, names_); }
  [[gnu::cold]] void visit_parameters([[maybe_unused]] const detail::parameter_visitor& visit) override {
    if constexpr (core_in_files<Core>)
      Core::parameters(core_, [&visit](const char* name, auto& x) { detail::visit_numbers(name, x, visit); });
  }
  [[gnu::cold]] void check_parameters() const override {
    const std::array<std::string_view, port_count<Core>> texts = [this]<std::size_t... P>(std::index_sequence<P...>) {
      return std::array<std::string_view, port_count<Core>>{names_[P]...};
    }
    (std::make_index_sequence<port_count<Core>>{});
    parameter_check::breach broken;
    const parameter_check where{Core::type, Core::ports, texts, broken};
    core_.check(where);
    if (broken.rule) detail::raise<bad_parameter>(where());
  }

  std::string_view type() const override { return Core::type; }
  std::span<const port> ports() const override { return Core::ports; }
  std::span<const std::string> names() const override { return names_; }
  bool holds_code() const override { return kte::holds_code<Core>; }

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

  detail::element_numbers<double> numbers() const override { return detail::numbers_of<double>(core_); }
  pose<mat3<vec3<>>, vec3<>> place_joint([[maybe_unused]] const double* q,
                                         [[maybe_unused]] detail::joint_axis<double>* axes,
                                         [[maybe_unused]] bool second) const override {
    if constexpr (detail::is_transmission<Core> && varying_axes<Core>)
      return detail::place_varying_joint(core_, q, axes, second);
    else
      return {};
  }
  void mass_loads(runtime_state& s) const override { on(s).mass_force(inputs{}); }
  bool holds(runtime_state& s) const override { return on(s).holds(inputs{}); }
  double capacity(runtime_state& s) const override { return as<double>(on(s).capacity(inputs{})); }
  void switch_over(runtime_state& s) const override { on(s).switch_over(inputs{}); }
  vec3<> first_moment(runtime_state& s) const override { return as<double>(on(s).first_moment(inputs{})); }
  double friction(runtime_state& s, const wrench<vec3<>, vec3<>>& end) const override {
    return as<double>(on(s).friction(end));
  }
  void derive_forces(runtime_state& s) const override {
    named([&] { detail::subtract_force_derivatives(core_, s, index_.data()); });
  }
  void derive_motion(detail::derivative_state& s) const override {
    if constexpr (detail::acts<Core>)
      named([&] { detail::out_of_line_pass<Core, detail::derivative_state>(core_, s, index_.data()).motion(); });
  }
  void derive_force(detail::derivative_state& s) const override {
    if constexpr (detail::acts<Core>)
      named([&] { detail::out_of_line_pass<Core, detail::derivative_state>(core_, s, index_.data()).force(); });
  }
  detail::derivative_number derive_friction(
      [[maybe_unused]] detail::derivative_state& s,
      [[maybe_unused]] const wrench<vec3<detail::derivative_number>, vec3<detail::derivative_number>>& end)
      const override {
    if constexpr (load_dependent_friction<Core>)
      return detail::out_of_line_pass<Core, detail::derivative_state>(core_, s, index_.data()).friction(end);
    else
      return {};
  }

  closure_rows rows() const override {
    if constexpr (detail::is_closure<Core> || detail::is_contact<Core>)
      return Core::rows;
    else
      return {};
  }
  void close_frames([[maybe_unused]] const detail::closing_motion<double>& m, [[maybe_unused]] detail::closing what,
                    [[maybe_unused]] double* rows) const override {
    if constexpr (closes_frames) detail::close_frames_by(core_, m, what, rows);
  }
  void close_frames([[maybe_unused]] const detail::closing_motion<detail::derivative_number>& m,
                    [[maybe_unused]] detail::closing what,
                    [[maybe_unused]] detail::derivative_number* rows) const override {
    if constexpr (closes_frames) detail::close_frames_by(core_, m, what, rows);
  }
  void close_frames([[maybe_unused]] std::span<const detail::closing_motion<double>> motions,
                    [[maybe_unused]] double* rows) const override {
    if constexpr (closes_frames)
      for (const auto& m : motions)
        for (const auto what : {detail::closing::residual, detail::closing::residual_ddot, detail::closing::wrenches}) {
          detail::close_frames_by(core_, m, what, rows);
          rows += (what == detail::closing::wrenches ? 6 : 1) * detail::closing_stride;
        }
  }
  detail::touch touch_at([[maybe_unused]] const detail::closing_motion<double>& m) const override {
    if constexpr (detail::is_contact<Core>)
      return core_.touch_at(m);
    else
      return {};
  }
  detail::basic_touch<detail::derivative_number> touch_at(
      [[maybe_unused]] const detail::closing_motion<detail::derivative_number>& m) const override {
    if constexpr (detail::is_contact<Core>)
      return core_.touch_at(m);
    else
      return {};
  }
  bool has_gate() const override { return detail::has_gate<Core>; }
  bool admits(double /*t*/, [[maybe_unused]] const runtime_state& s) const override {
    if constexpr (detail::has_gate<Core>)
      return core_.admits(s);
    else
      return true;
  }
  bool is_upright([[maybe_unused]] const detail::closing_motion<double>& m) const override {
    return detail::is_upright_by(core_, m);
  }
  std::array<double, 2> close_coordinates([[maybe_unused]] const double* q, [[maybe_unused]] const double* v,
                                          [[maybe_unused]] double* gradient) const override {
    if constexpr (closes_coordinates)
      return detail::close_coordinates_by(core_, q, v, gradient);
    else
      return {};
  }
  std::array<detail::derivative_number, 2> close_coordinates(
      [[maybe_unused]] const detail::derivative_number* q, [[maybe_unused]] const detail::derivative_number* v,
      [[maybe_unused]] detail::derivative_number* gradient) const override {
    if constexpr (closes_coordinates)
      return detail::close_coordinates_by(core_, q, v, gradient);
    else
      return {};
  }
  std::span<const std::string_view> closure_parameters() const override {
    if constexpr (detail::derived_by_parameters<Core>)
      return Core::parameter_names;
    else
      return {};
  }
  void frames_by_parameter([[maybe_unused]] int parameter, [[maybe_unused]] const detail::closing_motion<double>& m,
                           [[maybe_unused]] detail::closing what, [[maybe_unused]] double* rows) const override {
    if constexpr (closes_frames && detail::derived_by_parameters<Core>)
      detail::close_frames_by(detail::rows_by_parameter<Core>{core_, parameter}, m, what, rows);
  }
  std::array<double, 2> coordinates_by_parameter([[maybe_unused]] int parameter, [[maybe_unused]] const double* q,
                                                 [[maybe_unused]] const double* v,
                                                 [[maybe_unused]] double* gradient) const override {
    if constexpr (closes_coordinates && detail::derived_by_parameters<Core>)
      return detail::close_coordinates_by(detail::value_by_parameter<Core>{{}, core_, parameter}, q, v, gradient);
    else
      return {};
  }

 private:
  /// Returns f(). Errors of elements that may have no value name the element.
  template <class F>
  decltype(auto) named(const F& f) const {
    if constexpr (may_have_no_value<Core>) {
      try {
        return f();
      } catch (const bad_argument& e) {
        detail::raise_named(*this, e);
      } catch (const dead_point& e) {
        detail::raise_named(*this, e);
      }
    } else {
      return f();
    }
  }
  using inputs = std::make_index_sequence<input_count<Core>>;
  static constexpr bool closes_frames =
      (detail::is_closure<Core> || detail::is_contact<Core>)&&is_frame(Core::ports[0].what);
  static constexpr bool closes_coordinates = detail::is_closure<Core> && !closes_frames;

  template <class State>
  auto on(State& s) const {
    return detail::stored_element<Core, State, detail::by_index>{core_, s, {index_.data()}};
  }

  Core core_;
  std::array<std::string, port_count<Core>> names_;
  std::array<int, port_count<Core>> index_{};
};

}  // namespace kte
