#include <kte/io/text_table.hpp>

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  for (const char separator : {' ', ',', '\t'}) try {
      (void)kte::detail::read_text_table("file", text, separator);
    } catch (const kte::bad_file&) {
    }
  return 0;
}
