#pragma once

#include <kte/io/archive.hpp>
#include <kte/io/model_file.hpp>

namespace kte {

/// Writes an archive to a file, by its ending: .xml, .json or .kte. The file is replaced only when all is written, and
/// keeps its permissions; a link stays one. Throws `bad_file`; the file is then as before.
inline void save_archive(const std::filesystem::path& path, const archive& a, const save_options& options = {}) {
  detail::save_record(path, detail::model_format_of(path), a.record(), options);
}

}  // namespace kte
