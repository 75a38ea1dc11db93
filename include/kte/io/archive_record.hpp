#pragma once

#include <kte/contract/key.hpp>
#include <kte/contract/record.hpp>

#include <variant>

/// The content of an archive as plain data. Roots share coordinates, frames and chains by name.
namespace kte {

/// Versions of the format: 1 has a single chain; 2 has archives with several roots, and manipulator models.
inline constexpr int model_file_version = 1;
inline constexpr int archive_file_version = 2;

/// The `values` of a quantity `name`, with the precision of long double, and the `place` in the file.
struct quantity_record {
  std::string name;
  std::vector<long double> values;
  file_place place{};
  friend bool operator==(const quantity_record&, const quantity_record&) = default;
};
/// A coordinate, frame, input or internal state: its kind `what`, its name in chains, its values, and the `place` in
/// the file. Missing values are zero.
struct thing_record {
  kind what{};
  std::string name;
  std::vector<quantity_record> values;
  file_place place{};
  friend bool operator==(const thing_record&, const thing_record&) = default;
};
/// The state of a chain: `things`, items with their values.
struct state_record {
  std::vector<thing_record> things;
  friend bool operator==(const state_record&, const state_record&) = default;
};
/// A `mass_matrix_calc`: the root that is its chain, and the names of its `inertias` and `coordinates`; none if it is
/// `of_all`.
struct calculator_record {
  std::string chain;
  bool of_all = true;
  std::vector<std::string> inertias{}, coordinates{};
  friend bool operator==(const calculator_record&, const calculator_record&) = default;
};
/// A list of numbers, such as q or v.
using numbers_record = std::vector<long double>;

/// A root of an archive: its `name`, its `content`, and the `place` in the file.
struct root_record {
  using content_type = std::variant<model_record, thing_record, state_record, calculator_record, numbers_record>;
  std::string name;
  content_type content;
  file_place place{};
  friend bool operator==(const root_record&, const root_record&) = default;
};
/// An archive as plain data: its `roots`, in order.
struct archive_record {
  std::vector<root_record> roots;
  friend bool operator==(const archive_record&, const archive_record&) = default;
};

namespace detail {
/// The fields with the content of a root, in the order of `content_type`.
inline constexpr std::string_view content_fields[]{"chain", "thing", "state", "mass_matrix_calc", "numbers"};
/// The names of limits, in the order of `joint_limits`.
inline constexpr std::string_view limit_fields[]{"lower", "upper", "rate", "acceleration", "jerk", "effort"};
/// The names of kinds in files, in the order of `kind`.
inline constexpr std::string_view kind_names[]{"coordinate", "frame_2D", "frame_3D", "input", "rotation_3D", "pose_2D",
                                               "pose_3D",    "internal", "vector",   "loop",  "contact"};
static_assert(std::size(kind_names) == kinds);
}  // namespace detail

}  // namespace kte
