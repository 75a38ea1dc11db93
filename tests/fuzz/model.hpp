#pragma once

#include <kte/io/binary_file.hpp>
#include <kte/io/model_reader.hpp>

#include <cstdint>
#include <cstdlib>

namespace fuzz {

/// Any bytes are an error of kte or an archive, which is the same again through a file.
inline int read(const std::uint8_t* bytes, std::size_t size, kte::model_format format) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  const kte::read_options options{.warn = [](const std::string&) {}};
  kte::archive_record r;
  try {
    r = kte::detail::read_archive(text, "file", format, options);
  } catch (const kte::bad_file&) {
    return 0;
  }
  const std::string once = kte::to_binary(r);
  const auto again = kte::detail::read_archive(once, "again", kte::model_format::binary, {});
  if (kte::to_binary(again) != once) std::abort();
  return 0;
}

}  // namespace fuzz
