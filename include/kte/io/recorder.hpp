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
/// The first column is t. What there is:
///
///   coordinate          q                 q/v   q/a   q/f
///   rotation            ball/rotation     ball/ang_velocity   ball/ang_acceleration   ball/torque
///   poses and frames    x/position  x/rotation (2D: x/angle)  x/velocity  x/ang_velocity  x/acceleration
///                       x/ang_acceleration  x/force  x/torque
///   signal              motor   (of three numbers: pull/x  pull/y  pull/z)
///   internal state      bristle           bristle/v
///
/// A vector is a column a component, `tip/position/x`, which may be asked for alone; a rotation has w, x, y, z. The
/// name of a thing alone is where it is: all of its q, or position and rotation; with /v, /a, /f it is all of these.
/// A frame may have the name of a coordinate or signal: "elbow/position" is then that of the frame, which alone has
/// one; what both have is asked for as "frame:elbow" and "coordinate:elbow" ("signal:"), and columns have these names.
/// Units and axes are those of the state, see `gen_coord`, `frame_3D`, `pose_coord_3D`. The quaternion of a frame is
/// the one with w >= 0, so x, y, z jump where the frame passes half a turn; that of a coordinate is as in the state.
///
/// Without names everything of coordinates, inputs and internal states is recorded, and where all frames are. Static
/// and runtime chains with the same elements give the same columns. No row allocates; names are looked up once.
template <class Chain, class Table = table_writer>
class recorder {
 public:
  /// Throws `unknown_name` for what the chain does not have, and what `table_writer` throws.
  recorder(const std::filesystem::path& file, const Chain& chain, const std::vector<std::string>& names = {})
      : recorder(file, chain, names, format_of(file)) {}
  recorder(const std::filesystem::path& file, const Chain& chain, const std::vector<std::string>& names,
           table_format format)
      : recorder(chain, detail::recording(detail::slots_of(chain), names), file, format) {}
  /// In memory.
  explicit recorder(const Chain& chain, const std::vector<std::string>& names = {})
      : recorder(chain, detail::recording(detail::slots_of(chain), names)) {}

  /// The quantities as they are in the state at time t. Frames are as of the last `doMotion`, forces as of the last
  /// `doForce`. Throws `bad_argument` for a state of another runtime chain (for static chains that does not compile),
  /// and where the matrix of a frame is no rotation.
  template <class T, class State>
  void row(const T& t, const State& s) {
    check(s);
    detail::read_recorded(cells_, s, numbers_.data());
    out_.row(t, numbers_);
  }

  // As of the table.
  void flush() { out_.flush(); }
  void flush_every(std::size_t rows) { out_.flush_every(rows); }
  void close() { out_.close(); }
  /// In memory: what was recorded.
  const table& contents() const { return out_.contents(); }

 private:
  static constexpr bool is_static = requires { typename Chain::wiring; };

  recorder(const Chain& chain, const detail::recording& r, const std::filesystem::path& file, table_format format)
      : layout_(layout_of(chain)), cells_(r.cells), numbers_(r.columns.size() - 1), out_(file, r.columns, format) {}
  recorder(const Chain& chain, const detail::recording& r)
      : layout_(layout_of(chain)), cells_(r.cells), numbers_(r.columns.size() - 1), out_(r.columns) {}

  /// Tells runtime chains apart.
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
