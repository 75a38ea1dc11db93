#pragma once

#include <kte/contract/contact.hpp>
#include <kte/contract/element_numbers.hpp>
#include <kte/contract/joint_axis.hpp>
#include <kte/contract/port.hpp>
#include <kte/contract/record.hpp>
#include <kte/math/dual_number.hpp>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kte {

class kte_element;
template <class S>
class basic_runtime_state;
/// The state of a runtime chain in double.
using runtime_state = basic_runtime_state<double>;
namespace detail {
/// Called for a number of an element: the names of its parameter and component, and the number, which it may change;
/// null for a typed constant.
using parameter_visitor = std::function<void(std::string_view, std::string_view, double*)>;
/// The scalar of derivatives through elements, four directions at a time.
using derivative_number = dual<double, 4>;
template <class D>
class basic_derivative_state;
using derivative_state = basic_derivative_state<derivative_number>;
}  // namespace detail
class topology;

/// An element of a runtime chain: a kinetostatic transmission element, a static chain, or a chain.
class kte_map {
 public:
  virtual ~kte_map() = default;
  kte_map() = default;
  kte_map& operator=(const kte_map&) = delete;

  /// Motion from input frames to output frames.
  virtual void doMotion(runtime_state&) const = 0;
  /// Sets the forces on all its frames and coordinates to zero.
  virtual void clearForce(runtime_state&) const = 0;
  /// Transmits forces from output frames, and adds its own, to input frames.
  virtual void doForce(runtime_state&) const = 0;

  /// Returns a copy.
  virtual std::unique_ptr<kte_map> clone() const = 0;
  /// Its gravity, m/s^2, which a chain takes over when the part is appended. Zero means none.
  virtual vec3<> gravity() const { return {}; }
  /// Calls `visit` for every element in it, in order.
  virtual void for_each_element(const std::function<void(const kte_element&)>& visit) const = 0;
  /// The first part that records cannot hold, because it is neither an element nor a chain; null if there is none.
  virtual const kte_map* unrecorded() const { return this; }
  /// Connects all its elements to a chain; called again if the chain is restored after a failure. Throws `bad_wiring`.
  virtual void connect(topology&) = 0;

 protected:
  kte_map(const kte_map&) = default;
};

/// A single element, with the functions that the algorithms need.
class kte_element : public kte_map {
 public:
  /// Its record: type, names of connections, parameters.
  virtual element_record record() const = 0;
  const kte_map* unrecorded() const final { return nullptr; }

  virtual std::string_view type() const = 0;
  virtual std::span<const port> ports() const = 0;
  /// The names at its ports.
  virtual std::span<const std::string> names() const = 0;
  /// Whether it holds functions of the program, which a record cannot hold.
  virtual bool holds_code() const = 0;
  /// Its kinetic energy after doMotion, J.
  virtual double kinetic_energy(runtime_state&) const = 0;
  /// Its potential energy after doMotion, J, without that in gravity.
  virtual double potential_energy(runtime_state&) const = 0;
  /// Calls visit for the numbers of its parameters.
  virtual void visit_parameters(const detail::parameter_visitor& /*visit*/) {}
  /// Throws `bad_parameter` for parameters that the element rejects.
  virtual void check_parameters() const {}
  /// The number of lanes with their own parameters; 1 for an element with the same parameters in all lanes.
  virtual std::size_t lanes() const { return 1; }
  /// The element of a lane.
  virtual const kte_element& lane(std::size_t) const { return *this; }
  /// Takes over the connections of an element of the same type.
  virtual void connect_as(std::span<const int> /*index*/) {}
  /// The function that passes through zero where its law changes, after doMotion; 1 if it never changes.
  virtual double switching(runtime_state&) const = 0;
  /// Whether its law changes at events.
  virtual bool switches() const = 0;

  /// The data of the element for the loops over body nodes (tree/body_node.hpp).
  virtual detail::element_numbers<double> numbers() const = 0;
  /// For a joint with varying axes: the pose of its end in its base at coordinates q, and its axes with their
  /// derivatives (contract/varying_joint.hpp).
  virtual pose<mat3<vec3<>>, vec3<>> place_joint(const double* /*q*/, detail::joint_axis<double>* /*axes*/,
                                                 bool /*second*/) const {
    return {};
  }
  /// For a distributed mass: adds its loads due to accelerations alone.
  virtual void mass_loads(runtime_state&) const {}
  /// For a distributed mass: its first moment m c in axes of the base, kg m, after doMotion.
  virtual vec3<> first_moment(runtime_state&) const { return {}; }
  /// Whether it locks its coordinate.
  virtual bool holds(runtime_state&) const { return false; }
  /// The largest holding force, N or Nm.
  virtual double capacity(runtime_state&) const { return 0; }
  /// Updates its mode after its law has changed.
  virtual void switch_over(runtime_state&) const {}
  /// For a joint with load-dependent friction: its friction, N or Nm, under the wrench at its end.
  virtual double friction(runtime_state&, const wrench<vec3<>, vec3<>>& /*end*/) const { return 0; }
  /// For an element that acts on coordinates only: subtracts the derivatives of its forces.
  virtual void derive_forces(runtime_state&) const {}
  /// doMotion with derivatives, for an element other than a joint, a link or a body.
  virtual void derive_motion(detail::derivative_state&) const {}
  /// doForce with derivatives, for an element other than a joint, a link or a body.
  virtual void derive_force(detail::derivative_state&) const {}
  /// For a joint with load-dependent friction: its friction with derivatives.
  virtual detail::derivative_number derive_friction(
      detail::derivative_state&,
      const wrench<vec3<detail::derivative_number>, vec3<detail::derivative_number>>& /*end*/) const {
    return {};
  }

  /// The number of rows of a closure (contract/closure.hpp); none for other elements.
  virtual closure_rows rows() const { return {}; }
  /// For a closure of frames: its rows for the motion of its second frame in its first.
  virtual void close_frames(const detail::closing_motion<double>&, detail::closing, double* /*rows*/) const {}
  /// The residual, its second derivative and the wrenches of rows for several motions: `all_rows_of_closing` numbers a
  /// motion.
  virtual void close_frames(std::span<const detail::closing_motion<double>>, double* /*rows*/) const {}
  /// The place of a contact for the motion of its body in the frame of its surface.
  virtual detail::touch touch_at(const detail::closing_motion<double>&) const { return {}; }
  virtual detail::basic_touch<detail::derivative_number> touch_at(
      const detail::closing_motion<detail::derivative_number>&) const {
    return {};
  }
  /// The distance of the farthest point of a contact's shape from the origin of its frame, m.
  virtual double contact_size() const { return 0; }
  /// Whether it is a contact with `only_if`.
  virtual bool has_gate() const { return false; }
  /// For a contact with `only_if`: whether it acts at the time t, after doMotion.
  virtual bool admits(double /*t*/, const runtime_state&) const { return true; }
  /// Whether a closed loop of rotations is at the true solution, not half a turn away.
  virtual bool is_upright(const detail::closing_motion<double>&) const { return true; }
  /// The residual of a closure of coordinates at q with rates v, its derivatives by the coordinates, and its second
  /// derivative without accelerations.
  virtual std::array<double, 2> close_coordinates(const double* /*q*/, const double* /*v*/,
                                                  double* /*gradient*/) const {
    return {};
  }
  /// The rows of a closure of frames in dual numbers.
  virtual void close_frames(const detail::closing_motion<detail::derivative_number>&, detail::closing,
                            detail::derivative_number* /*rows*/) const {}
  /// The residual and the derivatives of a closure of coordinates in dual numbers.
  virtual std::array<detail::derivative_number, 2> close_coordinates(const detail::derivative_number* /*q*/,
                                                                     const detail::derivative_number* /*v*/,
                                                                     detail::derivative_number* /*gradient*/) const {
    return {};
  }
  /// Parameters of a closure with derivatives (contract/closure_parameters.hpp).
  virtual std::span<const std::string_view> closure_parameters() const { return {}; }
  /// The derivative of `close_frames` by a parameter.
  virtual void frames_by_parameter(int /*parameter*/, const detail::closing_motion<double>&, detail::closing,
                                   double* /*rows*/) const {}
  /// The derivative of `close_coordinates` by a parameter.
  virtual std::array<double, 2> coordinates_by_parameter(int /*parameter*/, const double* /*q*/, const double* /*v*/,
                                                         double* /*gradient*/) const {
    return {};
  }
};

/// An element in messages: "revolute_joint_3D (coordinate 'q', base 'a', end 'b')".
[[nodiscard]] inline std::string describe_element(const kte_element& e) {
  const std::vector<std::string_view> names(e.names().begin(), e.names().end());
  return describe_element(e.type(), e.ports(), names);
}

namespace detail {
/// Throws an error of an element with its name.
template <class Error>
[[noreturn, gnu::cold]] void raise_named(const kte_element& e, const Error& why) {
  std::string_view text = why.what();
  if (text.starts_with("kte: ")) text.remove_prefix(5);
  throw Error("kte: " + describe_element(e) + ": " + std::string(text));
}
}  // namespace detail

}  // namespace kte
