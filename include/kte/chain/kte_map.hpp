#pragma once

#include <kte/chain/record.hpp>
#include <kte/chain/runtime_state.hpp>

#include <functional>
#include <memory>

namespace kte {

class kte_element;

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
  /// Calls `visit` for every single element in it, in order.
  virtual void for_each_element(const std::function<void(const kte_element&)>& visit) const = 0;
  /// Connects all its elements to a chain. Throws `bad_wiring`.
  virtual void connect(topology&) = 0;

 protected:
  kte_map(const kte_map&) = default;
};

/// A single element, with what the algorithms need of it beyond the passes.
class kte_element : public kte_map {
 public:
  /// Type, names of connections, parameters.
  virtual element_record record() const = 0;

  virtual std::span<const port> ports() const = 0;
  /// Brings sines, cosines and followers up to date with the coordinates.
  virtual void update_coordinates(runtime_state&) const = 0;

  /// For the composite-rigid-body algorithm: adds its mass, and what its end carries, to what its base carries.
  virtual void carry(runtime_state&) const = 0;
  /// Joint: the wrench at its end that accelerates what the end carries by a unit rate of its coordinate each second;
  /// returns its projection on the coordinate.
  virtual double start_column(const runtime_state&, wrench_3D& at_end) const = 0;
  /// Replaces a wrench at its end by that at its base; returns its projection on the coordinate, 0 for a link.
  virtual double carry_wrench(const runtime_state&, wrench_3D&) const = 0;
  /// Coordinates: adds a mass, and for followers their rows and columns to those of what they follow.
  virtual void coordinate_mass(runtime_state&) const = 0;
};

}  // namespace kte
