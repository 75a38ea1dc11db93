#pragma once

#include <kte/errors.hpp>

#include <bit>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

/// Numbers and texts in binary files, least significant byte first.
namespace kte::detail {

template <std::unsigned_integral U>
void append_bytes(std::string& out, U x) {
  char bytes[sizeof(U)];
  for (std::size_t i = 0; i < sizeof(U); ++i) bytes[i] = static_cast<char>(static_cast<unsigned char>(x >> (8 * i)));
  out.append(bytes, sizeof(U));
}
inline void append_bytes(std::string& out, double x) { append_bytes(out, std::bit_cast<std::uint64_t>(x)); }

template <std::unsigned_integral U>
U from_bytes(std::string_view bytes) {
  std::uint64_t x = 0;
  for (std::size_t i = 0; i < sizeof(U); ++i) x |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return static_cast<U>(x);
}
inline double real_from_bytes(std::string_view bytes) {
  return std::bit_cast<double>(from_bytes<std::uint64_t>(bytes));
}

/// Reads bytes from the front of a file or of a part of it. Lengths are checked against the remaining bytes before use.
/// Errors are `bad_file` with the path and the offset in the file.
class byte_reader {
 public:
  byte_reader(const std::filesystem::path& path, std::string_view bytes, std::size_t offset = 0)
      : path_(path), rest_(bytes), offset_(offset) {}

  std::size_t size() const { return rest_.size(); }
  std::size_t offset() const { return offset_; }
  std::string_view rest() const { return rest_; }

  [[noreturn]] void bad(const std::string& what) const {
    raise<bad_file>("kte: '" + path_.string() + "', byte " + std::to_string(offset_) + ": " + what);
  }
  /// The next n bytes; `what` names them in the message if there are fewer.
  std::string_view take(std::uint64_t n, const char* what) {
    if (n > rest_.size()) bad(std::string(what).append(" is cut off"));
    const auto bytes = rest_.substr(0, static_cast<std::size_t>(n));
    rest_.remove_prefix(bytes.size());
    offset_ += bytes.size();
    return bytes;
  }
  /// The bytes as a separate source.
  byte_reader part(std::uint64_t n, const char* what) {
    const std::size_t begin = offset_;
    return {path_, take(n, what), begin};
  }
  template <std::unsigned_integral U>
  U number(const char* what) {
    return from_bytes<U>(take(sizeof(U), what));
  }
  double real(const char* what) { return real_from_bytes(take(8, what)); }

  /// Skips these bytes if they come next; returns whether they did.
  bool next(std::string_view literal) {
    if (!rest_.starts_with(literal)) return false;
    take(literal.size(), "");
    return true;
  }
  void expect(std::string_view literal) {
    if (!next(literal)) bad("expected " + std::string(literal));
  }
  /// The text up to one of these characters.
  std::string_view until(std::string_view ends) {
    const auto n = rest_.find_first_of(ends);
    if (n == rest_.npos) bad("cut off");
    return take(n, "");
  }

 private:
  const std::filesystem::path& path_;
  std::string_view rest_;
  std::size_t offset_;
};

}  // namespace kte::detail
