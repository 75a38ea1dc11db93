#pragma once

#include <kte/io/archive.hpp>
#include <kte/io/model_file.hpp>

namespace kte {

/// Writes an archive to a file, by its ending: .xml, .json or .kte. The file is replaced only when all is written; a
/// link stays one. Throws `bad_file`.
inline void save_archive(const std::filesystem::path& path, const archive& a) {
  detail::save_record(path, detail::model_format_of(path), a.record());
}

}  // namespace kte
