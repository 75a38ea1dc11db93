#pragma once

#include <kte/io/model_reader.hpp>

#include <optional>

/// Detects the format of files by their content, not their names.
namespace kte::detail {

/// An XML text from its first tag on, without declarations and comments before it.
inline std::string_view from_first_tag(std::string_view text) {
  for (;;) {
    text.remove_prefix((std::min)(text.find_first_not_of(" \t\r\n"), text.size()));
    const std::string_view end = text.starts_with("<?") ? "?>" : text.starts_with("<!--") ? "-->" : "";
    const auto found = end.empty() ? text.npos : text.find(end);
    if (found == text.npos) return text;
    text.remove_prefix(found + end.size());
  }
}

/// The format of a model file by its first bytes: the mark of binary files, the tag <cereal> of XML, the brace of JSON.
/// If these decide nothing, files named .kte or .json are damaged model files. Empty for all others, such as robot
/// descriptions.
inline std::optional<model_format> model_format_in(std::string_view bytes, const std::filesystem::path& path) {
  if (bytes.starts_with(binary_magic)) return model_format::binary;
  const auto text = from_first_tag(without_mark(bytes));
  if (text.starts_with("{")) return model_format::json;
  if (text.starts_with("<cereal>")) return model_format::xml;
  const auto extension = lower_extension(path);
  if (extension == ".kte" || extension == ".json") return model_format_of(path);
  return {};
}

/// The model in the bytes of a file; empty if it is not a model file. Throws `bad_file`.
inline std::optional<model_record> model_in(std::string_view bytes, const std::filesystem::path& path,
                                            const read_options& options = {}) {
  const auto format = model_format_in(bytes, path);
  if (!format) return {};
  return only_model(read_archive(bytes, path.string(), *format, options), path.string());
}

}  // namespace kte::detail
