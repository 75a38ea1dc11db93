#pragma once

#include <kte/io/archive.hpp>
#include <kte/io/model_file.hpp>

namespace kte {

/// Writes an archive to a file in the format of its extension: .xml, .json or .kte. The file is replaced after all is
/// written; its permissions, and symbolic links, are kept. Throws `bad_file` and then leaves the file unchanged.
inline void save_archive(const std::filesystem::path& path, const archive& a, const save_options& options = {}) {
  detail::save_record(path, detail::model_format_of(path), a.record(), options);
}

}  // namespace kte
