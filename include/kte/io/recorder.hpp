#pragma once

#include <kte/io/memory_table.hpp>
#include <kte/io/recording.hpp>
#include <kte/io/table_writer.hpp>

namespace kte {

/// Records quantities of a chain's state by name, in a file of any `table_format` or in memory:
///
///   kte::recorder rec("run.csv", pendulum, {"q", "q/v", "tip/position"});
///   solver.integrate(10.0, kte::every(0.01), [&](double t, const auto& x) { ...; rec.row(t, s); });
///   rec.close();
///
/// The first column is t. Names are:
///
///   coordinate          q                 q/v   q/a   q/f
///   rotation            ball/rotation     ball/ang_velocity   ball/ang_acceleration   ball/torque
///   poses and frames    x/position  x/rotation (2D: x/angle)  x/velocity  x/ang_velocity  x/acceleration
///                       x/ang_acceleration  x/force  x/torque
///   signal              motor   (three numbers: pull/x  pull/y  pull/z)
///   internal state      bristle           bristle/v
///
/// A vector has a column per component, `tip/position/x`, which may be recorded alone; a rotation has w, x, y, z. The
/// name of an item alone means all of its q, or position and rotation; with /v, /a, /f all of these. A frame may have
/// the name of a coordinate or signal: "elbow/position" is then that of the frame, as only frames have a position.
/// Quantities that both have are named "frame:elbow" and "coordinate:elbow" ("signal:"), also in the columns; so are
/// those of an item called "t", as that is the time. "energy/total" is refused, as a state does not have it. Units and
/// axes are those of the state, see `gen_coord`, `frame_3D`, `pose_coord_3D`. The quaternion of a frame has w >= 0, so
/// that x, y, z jump where the frame passes half a turn; that of a coordinate is as in the state.
///
/// Without names all coordinates, inputs and internal states are recorded, and the poses of all frames. Static and
/// runtime chains of equal elements have equal columns. A row does not allocate; names are looked up once.
template <class Chain, class Table = table_writer>
class recorder {
 public:
  /// A recorder into a file. Throws `unknown_name` for names that the chain does not have, and what `table_writer`
  /// throws.
  recorder(const std::filesystem::path& file, const Chain& chain, const std::vector<std::string>& names = {})
      : recorder(file, chain, names, format_of(file)) {}
  recorder(const std::filesystem::path& file, const Chain& chain, const std::vector<std::string>& names,
           table_format format)
      : recorder(chain, detail::recording(detail::slots_of(chain), names), file, format) {}
  /// A recorder in memory.
  explicit recorder(const Chain& chain, const std::vector<std::string>& names = {})
      : recorder(chain, detail::recording(detail::slots_of(chain), names)) {}

  /// Records a row: the quantities of the state at time t, s. Frames are those of the last `doMotion`, forces those of
  /// the last `doForce`. Throws `bad_argument` for a state of another runtime chain (for static chains it does not
  /// compile), and if the matrix of a frame is not a rotation.
  template <class T, class State>
  void row(const T& t, const State& s) {
    check(s);
    detail::read_recorded(cells_, s, numbers_.data());
    out_.row(t, numbers_);
  }

  /// Passes all rows to the operating system, see `table_writer`.
  void flush() { out_.flush(); }
  /// Flushes after this number of rows.
  void flush_every(std::size_t rows) { out_.flush_every(rows); }
  /// Writes the remaining rows and closes the file.
  void close() { out_.close(); }
  /// The recorded table, for a recorder in memory.
  [[nodiscard]] const table& contents() const { return out_.contents(); }

 private:
  static constexpr bool is_static = requires { typename Chain::wiring; };

  recorder(const Chain& chain, const detail::recording& r, const std::filesystem::path& file, table_format format)
      : layout_(layout_of(chain)), cells_(r.cells), numbers_(r.columns.size() - 1), out_(file, r.columns, format) {}
  recorder(const Chain& chain, const detail::recording& r)
      : layout_(layout_of(chain)), cells_(r.cells), numbers_(r.columns.size() - 1), out_(r.columns) {}

  /// Identifies a runtime chain.
  static std::shared_ptr<const char> layout_of(const Chain& chain) {
    if constexpr (is_static) {
      return nullptr;
    } else {
      return chain.wiring().layout;
    }
  }
  template <class State>
  void check(const State& s) const {
    if constexpr (is_static) {
      static_assert(std::is_same_v<typename State::wiring, typename Chain::wiring>,
                    "kte: this state was made for another chain");
    } else if (s.made_for()->layout != layout_) {
      detail::raise<bad_argument>("kte: this state was made for another chain than the recorder");
    }
  }

  std::shared_ptr<const char> layout_;
  std::vector<detail::recorded> cells_;
  std::vector<double> numbers_;
  Table out_;
};
template <class Chain>
recorder(const Chain&) -> recorder<Chain, memory_table>;
template <class Chain>
recorder(const Chain&, const std::vector<std::string>&) -> recorder<Chain, memory_table>;

}  // namespace kte
