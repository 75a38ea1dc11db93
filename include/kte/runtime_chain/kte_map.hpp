#pragma once

#include <kte/contract/closure.hpp>
#include <kte/contract/element_numbers.hpp>
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
using runtime_state = basic_runtime_state<double>;
namespace detail {
/// In which derivatives go through elements, four directions at a time.
using derivative_number = dual<double, 4>;
template <class D>
class basic_derivative_state;
using derivative_state = basic_derivative_state<derivative_number>;
}  // namespace detail
class topology;

/// A kinetostatic transmission element of a runtime chain: a type-erased element, a static chain, or a chain of such.
class kte_map {
 public:
  virtual ~kte_map() = default;
  kte_map() = default;
  kte_map& operator=(const kte_map&) = delete;

  /// Motion from input frames to output frames.
  virtual void doMotion(runtime_state&) const = 0;
  /// Forces on all its frames and coordinates to zero.
  virtual void clearForce(runtime_state&) const = 0;
  /// Forces from output frames, and its own, to input frames.
  virtual void doForce(runtime_state&) const = 0;

  virtual std::unique_ptr<kte_map> clone() const = 0;
  /// What it was made for, m/s^2: a chain to which it is appended takes it. Zero is none.
  virtual vec3<> gravity() const { return {}; }
  /// Calls `visit` for every single element in it, in order.
  virtual void for_each_element(const std::function<void(const kte_element&)>& visit) const = 0;
  /// The first part of it that no record can hold, being more than the elements it lists: itself, if it is neither an
  /// element nor a chain.
  virtual const kte_map* unrecorded() const { return this; }
  /// Connects all its elements to a chain; when that goes back after a failure, once more. Throws `bad_wiring`.
  virtual void connect(topology&) = 0;

 protected:
  kte_map(const kte_map&) = default;
};

/// A single element, with what the algorithms need of it beyond the passes.
class kte_element : public kte_map {
 public:
  /// Type, names of connections, parameters.
  virtual element_record record() const = 0;
  const kte_map* unrecorded() const final { return nullptr; }

  virtual std::string_view type() const = 0;
  virtual std::span<const port> ports() const = 0;
  /// What the ports are connected to.
  virtual std::span<const std::string> names() const = 0;
  /// Whether it holds functions of its program, which no record can.
  virtual bool holds_code() const = 0;
  /// Its own, after doMotion, J; gravity is the chain's.
  virtual double kinetic_energy(runtime_state&) const = 0;
  virtual double potential_energy(runtime_state&) const = 0;
  /// What goes through zero where its law changes, after doMotion; 1 where it does not change.
  virtual double switching(runtime_state&) const = 0;
  /// Whether it ever does.
  virtual bool switches() const = 0;

  /// What it is to the loops over records (tree/record.hpp).
  virtual detail::element_numbers<double> numbers() const = 0;
  /// Of a mass between several ports: adds its loads for accelerations alone; m c in axes of the base, after doMotion.
  virtual void mass_loads(runtime_state&) const = 0;
  virtual vec3<> first_moment(runtime_state&) const = 0;
  /// Whether it holds its coordinate, and by how large a force it could, N or Nm; what it keeps after its law has
  /// changed.
  virtual bool holds(runtime_state&) const = 0;
  virtual double capacity(runtime_state&) const = 0;
  virtual void switch_over(runtime_state&) const = 0;
  /// Of a joint: its friction, N or Nm, where that depends on the wrench that it carries at its end.
  virtual double friction(runtime_state&, const wrench<vec3<>, vec3<>>& end) const = 0;
  /// Of an element that acts on coordinates alone: subtracts the derivatives of its forces.
  virtual void derive_forces(runtime_state&) const = 0;
  /// doMotion and doForce with derivatives, of an element that is more than a joint, a link or a body.
  virtual void derive_motion(detail::derivative_state&) const = 0;
  virtual void derive_force(detail::derivative_state&) const = 0;
  /// Its friction with derivatives, of a joint that has it by the wrench that it carries at its end.
  virtual detail::derivative_number derive_friction(
      detail::derivative_state&,
      const wrench<vec3<detail::derivative_number>, vec3<detail::derivative_number>>& end) const = 0;

  /// Of a closure (contract/closure.hpp): how many rows it has; none of other elements.
  virtual closure_rows rows() const { return {}; }
  /// Of a closure of frames: its residual (order 0) or a derivative of it, for the motion of its second frame in its
  /// first.
  virtual void close_frames(const detail::closing_motion<double>&, int /*order*/, double* /*rows*/) const {}
  /// The same: whether a closed loop is not on the false solution of a rotation, half a turn off.
  virtual bool is_upright(const detail::closing_motion<double>&) const { return true; }
  /// Of a closure of coordinates at q with rates v: its residual, the derivatives of that by the coordinates, and its
  /// second derivative without accelerations.
  virtual std::array<double, 2> close_coordinates(const double* /*q*/, const double* /*v*/,
                                                  double* /*gradient*/) const {
    return {};
  }
};

/// In a message.
inline std::string describe_element(const kte_element& e) {
  const std::vector<std::string_view> names(e.names().begin(), e.names().end());
  return describe_element(e.type(), e.ports(), names);
}

namespace detail {
/// What an element says is wrong, with its name.
template <class Error>
[[noreturn, gnu::cold]] void raise_named(const kte_element& e, const Error& why) {
  std::string_view text = why.what();
  if (text.starts_with("kte: ")) text.remove_prefix(5);
  throw Error("kte: " + describe_element(e) + ": " + std::string(text));
}
}  // namespace detail

}  // namespace kte
