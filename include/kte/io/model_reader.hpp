#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/io/archive_reader.hpp>
#include <kte/io/binary_scanner.hpp>
#include <kte/io/file.hpp>
#include <kte/io/json_scanner.hpp>
#include <kte/io/xml_scanner.hpp>

/// Reads files into records. Does not need cereal.
namespace kte {

/// The formats of model files and archives: `json`, `xml` and binary.
enum class model_format {
  json,
  xml,
  binary  ///< .kte: io/binary_layout.hpp
};

namespace detail {

/// The format of a file by its extension. Throws `bad_file` for unknown extensions.
inline model_format model_format_of(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".json") return model_format::json;
  if (extension == ".xml") return model_format::xml;
  if (extension != ".kte") raise<bad_file>("kte: '" + path.string() + "': a model file ends in .xml, .json or .kte");
  return model_format::binary;
}

/// `name` is the name of the file in messages.
archive_record read_archive(std::string_view bytes, const std::string& name, model_format format,
                            const read_options& options);
#ifdef KTE_FUNCTION
KTE_FUNCTION archive_record read_archive(std::string_view bytes, const std::string& name, model_format format,
                                         const read_options& options) {
  if (format == model_format::binary) {
    binary_scanner in(bytes, name);
    if (bytes.size() > options.max_bytes) in.fail_at(0, file_too_large(options.max_bytes));
    return archive_reader(in, options).read();
  }
  source_text source(bytes, name, options.max_bytes);
  if (format == model_format::json) {
    json_scanner in(source);
    return archive_reader(in, options).read();
  }
  xml_scanner in(source);
  return archive_reader(in, options).read();
}
#endif

inline archive_record read_archive(const std::filesystem::path& path, const read_options& options) {
  const auto format = model_format_of(path);
  return read_archive(read_file(path, options.max_bytes), path.string(), format, options);
}

/// The only chain of an archive.
inline model_record only_model(archive_record&& all, const std::string& name) {
  model_record* found = nullptr;
  std::string chains;
  for (auto& r : all.roots)
    if (auto* m = std::get_if<model_record>(&r.content)) {
      found = chains.empty() ? m : nullptr;
      chains += " '" + r.name + "'";
    }
  if (!found)
    raise<bad_file>("kte: " + name +
                    (chains.empty() ? ": an archive without a chain"
                                    : ": an archive of several chains, for load_archive:" + chains));
  return std::move(*found);
}

}  // namespace detail

/// A model from a JSON text; `file` is its name in messages. Throws `bad_file` with line, column and field.
[[nodiscard]] inline model_record from_json(std::string_view text, const std::string& file = "JSON text",
                                            const read_options& options = {}) {
  return detail::only_model(detail::read_archive(text, file, model_format::json, options), file);
}
/// A model from an XML text; `file` is its name in messages. Throws `bad_file` with line, column and field.
[[nodiscard]] inline model_record from_xml(std::string_view text, const std::string& file = "XML text",
                                           const read_options& options = {}) {
  return detail::only_model(detail::read_archive(text, file, model_format::xml, options), file);
}
/// A model from the bytes of a .kte file; `file` is its name in messages. Throws `bad_file` with the offset of the byte
/// and the field.
[[nodiscard]] inline model_record from_binary(std::string_view bytes, const std::string& file = "binary model",
                                              const read_options& options = {}) {
  return detail::only_model(detail::read_archive(bytes, file, model_format::binary, options), file);
}

/// Reads the model of a file: `to_chain(load_model(path))` is a runtime chain, `from_record(like, load_model(path))` a
/// static chain. An archive must have one chain. Throws `bad_file`.
[[nodiscard]] inline model_record load_model(const std::filesystem::path& path, const read_options& options = {}) {
  return detail::only_model(detail::read_archive(path, options), path.string());
}

}  // namespace kte
