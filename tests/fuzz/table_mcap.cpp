#include <kte/io/mcap_table_reader.hpp>

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  try {
    (void)kte::detail::mcap_table_reader("file", {reinterpret_cast<const char*>(bytes), size}).result();
  } catch (const kte::bad_file&) {
  }
  return 0;
}
