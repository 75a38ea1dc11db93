#pragma once

#include <kte/elements/registry.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/io/model_writer.hpp>
#include <kte/runtime_chain/from_record.hpp>

/// Models as JSON, XML and binary files. A file is a flat list of elements in their order:
///
///   {"kte_model": {"version": 1, "gravity": "0 0 -9.81", "elements": [
///       {"type": "rigid_link_3D", "version": 1,
///        "ports": {"base": "ground", "end": "elbow"},
///        "parameters": {"position": "0 0 0.36", "rotation": "1 0 0 0 1 0 0 0 1"}}]}}
///
/// Numbers are written as texts of the shortest digits that read back to the same double (docs/file_format.md).
namespace kte {

/// Writes a chain of either kind to a file, by its ending: .xml, .json or .kte. The file is replaced only when all is
/// written; a link stays one. Throws `bad_file`, or `bad_argument` for a chain that no file can hold.
template <class Chain>
void save_model(const std::filesystem::path& path, const Chain& chain) {
  const auto format = detail::model_format_of(path);
  detail::save_record(path, format, record_of(chain));
}

}  // namespace kte
