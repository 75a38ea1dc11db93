#pragma once

#include <kte/io/table.hpp>
#include <kte/view/detail/chain_parts.hpp>
#include <kte/view/options.hpp>
#include <kte/view/scene.hpp>
#include <kte/view/scene_row.hpp>

namespace kte {

namespace detail {
/// A frame or coordinate of a state.
struct thing_place {
  kind what;
  int slot;
};
/// The columns of a table that determine a frame or coordinate of a state.
struct thing_source {
  kind what;
  int slot;
  std::vector<const std::vector<double>*> columns;  ///< empty: the time
  bool rates = false;                               ///< whether they are rates of a coordinate
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
  /// Adds a quantity to plot after the rows, with a number for each of them. Throws `bad_argument` for another count.
  void add_column(const std::string& name, const std::string& unit, const std::vector<double>& numbers);

 protected:
  recorded_scene(const detail::chain_parts& chain, const recording_options& options);

  /// The frames and coordinates from which a row is read.
  const std::vector<detail::thing_place>& tracked() const { return tracked_; }
  const std::vector<detail::thing_place>& freedoms() const { return freedoms_; }
  const std::vector<detail::thing_place>& signals() const { return signals_; }
  const std::vector<detail::recorded>& cells() const { return cells_; }
  /// The columns of a table that a row uses; other columns are added unchanged. Throws `unknown_name` for coordinates
  /// without columns, `bad_argument` for invalid numbers and times.
  detail::replay_plan replay(const detail::chain_parts& chain, const table& numbers);

  /// The row to fill.
  scene_row& blank() { return row_; }
  /// Adds the row at time t.
  void add(double t);

 private:
  scene scene_;
  std::vector<detail::thing_place> tracked_, freedoms_, signals_;
  std::vector<detail::recorded> cells_;
  scene_row row_;
  bool broken_ = false;                ///< whether a number was not finite
  bool knows_v_ = true;                ///< whether velocities are known
  std::vector<bool> unknown_signals_;  ///< for tables
};

}  // namespace kte
