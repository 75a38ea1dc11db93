#pragma once

#include <kte/contract/closure_parameters.hpp>
#include <kte/contract/varying_joint.hpp>
#include <kte/runtime_chain/connected_element.hpp>
#include <kte/runtime_chain/derivative_state.hpp>
#include <kte/runtime_chain/out_of_line_pass.hpp>
#include <kte/runtime_chain/runtime_state.hpp>

#include <type_traits>
#include <utility>

/// The functions of an element in a runtime chain that only some cores need, each group in a class: other cores compile
/// nothing for them.
namespace kte::detail {

/// A core and the indices of its items in a state.
template <class Core>
class element_of : public connected_element {
 public:
  using core_type = Core;
  void connect_as(std::span<const int> index) final { std::copy(index.begin(), index.end(), index_.begin()); }

 protected:
  using inputs = std::make_index_sequence<input_count<Core>>;

  explicit element_of(named_element<Core>& e) : connected_element(facts_of<Core>, e.names.data()), core_(e.core) {}

  template <class State>
  auto on(State& s) const {
    return stored_element<Core, State, by_index>{core_, s, {index_.data()}};
  }
  auto in_duals(derivative_state& s) const { return out_of_line_pass<Core, derivative_state>(core_, s, index_.data()); }
  /// Returns f(). Errors of elements that may have no value name the element.
  template <class F>
  decltype(auto) named(const F& f) const {
    if constexpr (may_have_no_value<Core>) {
      try {
        return f();
      } catch (const bad_argument& e) {
        raise_named(*this, e);
      } catch (const dead_point& e) {
        raise_named(*this, e);
      }
    } else {
      return f();
    }
  }

  Core core_;
  std::array<int, port_count<Core>> index_{};
};

/// For elements on coordinates only.
template <class Base>
class with_force_derivatives : public Base {
 public:
  void derive_forces(runtime_state& s) const final {
    this->named([&] { subtract_force_derivatives(this->core_, s, this->index_.data()); });
  }

 protected:
  using Base::Base;
};

/// For elements other than joints, links, bodies, closures and contacts.
template <class Base>
class with_action : public Base {
 public:
  void derive_motion(derivative_state& s) const final {
    this->named([&] { this->in_duals(s).motion(); });
  }
  void derive_force(derivative_state& s) const final {
    this->named([&] { this->in_duals(s).force(); });
  }

 protected:
  using Base::Base;
};

/// For joints whose axes depend on their coordinates.
template <class Base>
class with_varying_axes : public Base {
 public:
  pose<mat3<vec3<>>, vec3<>> place_joint(const double* q, joint_axis<double>* axes, bool second) const final {
    return place_varying_joint(this->core_, q, axes, second);
  }

 protected:
  using Base::Base;
};

/// For joints with load-dependent friction.
template <class Base>
class with_friction : public Base {
 public:
  double friction(runtime_state& s, const wrench<vec3<>, vec3<>>& end) const final {
    return as<double>(this->on(s).friction(end));
  }
  derivative_number derive_friction(derivative_state& s,
                                    const wrench<vec3<derivative_number>, vec3<derivative_number>>& end) const final {
    return this->in_duals(s).friction(end);
  }

 protected:
  using Base::Base;
};

/// For masses between several ports.
template <class Base>
class with_distributed_mass : public Base {
 public:
  void mass_loads(runtime_state& s) const final { this->on(s).mass_force(typename Base::inputs{}); }
  vec3<> first_moment(runtime_state& s) const final {
    return as<double>(this->on(s).first_moment(typename Base::inputs{}));
  }

 protected:
  using Base::Base;
};

/// For elements with internal states, such as those that may lock a coordinate.
template <class Base>
class with_internal_states : public Base {
 protected:
  using Base::Base;
  using typename Base::inputs;

 public:
  bool holds(runtime_state& s) const final { return this->on(s).holds(inputs{}); }
  double capacity(runtime_state& s) const final { return as<double>(this->on(s).capacity(inputs{})); }
  void switch_over(runtime_state& s) const final { this->on(s).switch_over(inputs{}); }
};

/// For contacts.
template <class Base>
class with_touch : public Base {
  using core = typename Base::core_type;

 public:
  touch touch_at(const closing_motion<double>& m) const final { return this->core_.touch_at(m); }
  basic_touch<derivative_number> touch_at(const closing_motion<derivative_number>& m) const final {
    return this->core_.touch_at(m);
  }
  double contact_size() const final { return this->core_.size(); }
  bool has_gate() const final { return detail::has_gate<core>; }
  bool admits(double t, const runtime_state& s) const final {
    if constexpr (detail::has_gate<core>)
      return this->core_.admits(s);
    else
      return Base::admits(t, s);
  }

 protected:
  using Base::Base;
};

/// For closures of frames, and contacts.
template <class Base>
class with_closed_frames : public Base {
  using core = typename Base::core_type;

 public:
  using Base::close_frames;
  closure_rows rows() const final { return core::rows; }
  void close_frames(const closing_motion<double>& m, closing what, double* rows) const final {
    close_frames_by(this->core_, m, what, rows);
  }
  void close_frames(std::span<const closing_motion<double>> motions, double* rows) const final {
    for (const auto& m : motions)
      for (const auto what : {closing::residual, closing::residual_ddot, closing::wrenches}) {
        close_frames_by(this->core_, m, what, rows);
        rows += (what == closing::wrenches ? 6 : 1) * closing_stride;
      }
  }

 protected:
  using Base::Base;
};

/// For closures of frames; of contacts `touch_at` is derived.
template <class Base>
class with_derived_frames : public Base {
 public:
  using Base::close_frames;
  void close_frames(const closing_motion<derivative_number>& m, closing what, derivative_number* rows) const final {
    close_frames_by(this->core_, m, what, rows);
  }
  bool is_upright(const closing_motion<double>& m) const final { return is_upright_by(this->core_, m); }

 protected:
  using Base::Base;
};

/// For closures of coordinates.
template <class Base>
class with_closed_coordinates : public Base {
  using core = typename Base::core_type;

 public:
  closure_rows rows() const final { return core::rows; }
  std::array<double, 2> close_coordinates(const double* q, const double* v, double* gradient) const final {
    return close_coordinates_by(this->core_, q, v, gradient);
  }
  std::array<derivative_number, 2> close_coordinates(const derivative_number* q, const derivative_number* v,
                                                     derivative_number* gradient) const final {
    return close_coordinates_by(this->core_, q, v, gradient);
  }

 protected:
  using Base::Base;
};

/// For closures with derivatives by parameters.
template <class Base>
class with_closure_parameters : public Base {
  using core = typename Base::core_type;

 public:
  std::span<const std::string_view> closure_parameters() const final { return core::parameter_names; }
  void frames_by_parameter(int parameter, const closing_motion<double>& m, closing what, double* rows) const final {
    if constexpr (is_frame(core::ports[0].what))
      close_frames_by(rows_by_parameter<core>{this->core_, parameter}, m, what, rows);
    else
      Base::frames_by_parameter(parameter, m, what, rows);
  }
  std::array<double, 2> coordinates_by_parameter(int parameter, const double* q, const double* v,
                                                 double* gradient) const final {
    if constexpr (is_frame(core::ports[0].what))
      return Base::coordinates_by_parameter(parameter, q, v, gradient);
    else
      return close_coordinates_by(value_by_parameter<core>{{}, this->core_, parameter}, q, v, gradient);
  }

 protected:
  using Base::Base;
};

/// A base with a part, or without.
template <bool has, template <class> class Part, class Base>
struct with_part : std::type_identity<Base> {};
template <template <class> class Part, class Base>
struct with_part<true, Part, Base> : std::type_identity<Part<Base>> {};

/// Adds the parts that a core needs to `element_of` it.
template <class Core>
class parts_of_element {
  template <bool has, template <class> class Part, class Base>
  using add = typename with_part<has, Part, Base>::type;
  static constexpr bool on_frames = is_frame(Core::ports[0].what);

  using derived = add<is_on_coordinates<Core>, with_force_derivatives, element_of<Core>>;
  using moving = add<acts<Core>, with_action, derived>;
  using jointed = add<is_transmission<Core> && varying_axes<Core>, with_varying_axes, moving>;
  using loaded = add<load_dependent_friction<Core>, with_friction, jointed>;
  using massive = add<distributed_mass<Core>, with_distributed_mass, loaded>;
  using keeping = add<(kept_count<Core> > 0), with_internal_states, massive>;
  using touching = add<is_contact<Core>, with_touch, keeping>;
  using closing_frames = add<is_contact<Core> || (is_closure<Core> && on_frames), with_closed_frames, touching>;
  using derived_frames = add<is_closure<Core> && on_frames, with_derived_frames, closing_frames>;
  using closing_coordinates = add<is_closure<Core> && !on_frames, with_closed_coordinates, derived_frames>;

 public:
  using type = add<derived_by_parameters<Core>, with_closure_parameters, closing_coordinates>;
};

}  // namespace kte::detail
