#pragma once

#include <kte/elements/registry.hpp>
#include <kte/io/limit_records.hpp>
#include <kte/io/model_inputs.hpp>
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

/// Writes a chain of either kind, or a model with its tools, limits and inputs, to a file in the format of its
/// extension: .xml, .json or .kte. The file is replaced after all is written; its permissions, and symbolic links, are
/// kept. Throws `bad_file`, or `bad_argument` for a chain that files cannot hold; the file is then unchanged.
template <class Chain>
void save_model(const std::filesystem::path& path, const Chain& chain, const save_options& options = {}) {
  const auto format = detail::model_format_of(path);
  detail::save_record(path, format, detail::record_of_model(chain), options);
}
/// Writes a chain or model with the limits of its coordinates.
template <class Chain, class Numbers>
void save_model(const std::filesystem::path& path, const Chain& chain, const joint_limits<Numbers>& limits,
                const save_options& options = {}) {
  const auto format = detail::model_format_of(path);
  auto record = detail::record_of_model(chain);
  record.limits = limit_records(chain, limits);
  detail::save_record(path, format, record, options);
}

}  // namespace kte
