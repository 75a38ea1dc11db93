#pragma once

#include <kte/io/table.hpp>
#include <kte/view/detail/chain_parts.hpp>
#include <kte/view/options.hpp>
#include <kte/view/scene.hpp>
#include <kte/view/scene_row.hpp>

namespace kte {

namespace detail {
/// A thing in a state: a frame or a coordinate.
struct thing_place {
  kind what;
  int slot;
};
/// What of a row of a table goes into a thing of a state before it is drawn.
struct thing_source {
  kind what;
  int slot;
  std::vector<const std::vector<double>*> columns;  ///< none: the time
  bool rates = false;                               ///< of a coordinate
};
struct replay_plan {
  std::vector<thing_source> sources;
  const std::vector<double>* time;
};
}  // namespace detail

/// A scene with one recording that grows row by row: the part of `scene_recording` that does not depend on the chain.
class recorded_scene {
 public:
  /// The scene with the recording so far.
  const scene& contents() const { return scene_; }

 protected:
  recorded_scene(const detail::chain_parts& chain, const recording_options& options);

  /// Where to read a row from.
  const std::vector<detail::thing_place>& tracked() const { return tracked_; }
  const std::vector<detail::thing_place>& freedoms() const { return freedoms_; }
  const std::vector<detail::thing_place>& signals() const { return signals_; }
  const std::vector<detail::recorded>& cells() const { return cells_; }
  /// What a row takes from a table; the columns that nothing takes are added as they are. Throws `unknown_name` for
  /// coordinates that have no columns, `bad_argument` for numbers and times that cannot be.
  detail::replay_plan replay(const detail::chain_parts& chain, const table& numbers);

  /// A row to be filled.
  scene_row& blank() { return row_; }
  /// Takes the row.
  void add(double t);

 private:
  scene scene_;
  std::vector<detail::thing_place> tracked_, freedoms_, signals_;
  std::vector<detail::recorded> cells_;
  scene_row row_;
  bool broken_ = false;                ///< whether there were numbers that are not finite
  bool knows_v_ = true;                ///< whether there are velocities
  std::vector<bool> unknown_signals_;  ///< of a table
};

}  // namespace kte
