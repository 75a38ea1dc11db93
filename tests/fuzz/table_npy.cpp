#include <kte/io/npy_table_reader.hpp>

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  try {
    (void)kte::detail::read_npy_table("file", {reinterpret_cast<const char*>(bytes), size});
  } catch (const kte::bad_file&) {
  }
  return 0;
}
