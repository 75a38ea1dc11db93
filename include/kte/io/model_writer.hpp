#pragma once

#include <kte/io/binary_file.hpp>
#include <kte/io/cereal_writer.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/io/replace_file.hpp>

/// Writes records of models and archives to files: JSON and XML by cereal.
namespace kte {

/// A model or an archive as JSON text. Throws `bad_file` for records that `from_json` or `from_xml` would reject:
/// gravity that is not finite, names with control characters, and for XML parameters whose names cannot be tags.
template <class Record = model_record>
[[nodiscard]] std::string to_json(const Record& r) {
  detail::cereal_writer<cereal::JSONOutputArchive> out;
  return detail::write_file(out, r);
}
/// A model or an archive as XML text; see `to_json`.
template <class Record = model_record>
[[nodiscard]] std::string to_xml(const Record& r) {
  detail::cereal_writer<cereal::XMLOutputArchive> out;
  return detail::write_file(out, r);
}

namespace detail {
/// Writes a file in the format of its extension. The file is replaced after everything is written.
template <class Record>
void save_record(const std::filesystem::path& path, model_format format, const Record& r,
                 const save_options& options = {}) {
  replace_file(path,
               format == model_format::xml    ? to_xml(r)
               : format == model_format::json ? to_json(r)
                                              : to_binary(r),
               options);
}
}  // namespace detail

}  // namespace kte
