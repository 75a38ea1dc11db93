#pragma once

#include <kte/io/npy_table.hpp>

namespace kte::detail {

/// The header of an NPY file as Python and NumPy may write it: blanks between tokens and the order of entries are
/// arbitrary.
class npy_header {
 public:
  std::vector<std::string> names;
  std::uint64_t rows = 0;

  explicit npy_header(byte_reader in) : in_(in) {
    for (const char* token : {"{", "'descr'", ":"}) expect(token);
    skip();
    if (!in_.next("[")) in_.bad("not a table: expected columns with names");
    do column();
    while (!closed());
    for (const char* token : {",", "'fortran_order'", ":", "False", ",", "'shape'", ":", "("}) expect(token);
    rows = count();
    for (const char* token : {",", ")"}) expect(token);
    skip();
    in_.next(",");
    expect("}");
    skip();
    if (in_.size() != 0) in_.bad("more than a header");
  }

 private:
  void skip() {
    while (in_.next(" ") || in_.next("\n")) {
    }
  }
  void expect(std::string_view token) {
    skip();
    in_.expect(token);
  }
  /// Whether the list of columns ends here. A comma is optional before its bracket, and required before another column.
  bool closed() {
    skip();
    const bool comma = in_.next(",");
    skip();
    if (in_.next("]")) return true;
    if (!comma) in_.expect("]");
    return false;
  }
  void column() {
    expect("(");
    expect("'");
    names.emplace_back(in_.until("'"));
    if (names.back().empty()) in_.bad("a column has no name");
    if (!known_.add(names.back())) in_.bad("two columns are named '" + names.back() + "'");
    for (const char* token : {"'", ",", "'<f8'", ")"}) expect(token);
  }
  std::uint64_t count() {
    skip();
    const auto digits = in_.until(",)");
    std::uint64_t n{};
    const auto [stop, code] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (code != std::errc{} || stop != digits.data() + digits.size()) in_.bad("expected a number of rows");
    return n;
  }

  byte_reader in_;
  known_names known_;
};

/// Reads the bytes of an NPY file. Throws `bad_file` with the path and the offset of an error. Bytes after the rows
/// that the header counts were not completely flushed, and are ignored, as in NumPy.
inline table read_npy_table(const std::filesystem::path& path, std::string_view bytes) {
  byte_reader in(path, bytes);
  if (!in.next(npy_table::magic)) in.bad("not a file of NumPy");
  const auto version = in.number<std::uint16_t>("the version");
  if (version != 1 && version != 2 && version != 3) in.bad("expected version 1.0, 2.0 or 3.0");
  const std::uint64_t length =
      version == 1 ? in.number<std::uint16_t>("the header") : in.number<std::uint32_t>("the header");
  npy_header header(in.part(length, "the header"));
  const std::size_t width = 8 * header.names.size();
  if (header.rows > in.size() / width)
    in.bad(std::to_string(header.rows) + " rows of " + std::to_string(width) + " bytes are announced, but only " +
           std::to_string(in.size()) + " bytes follow");
  table t;
  t.names = std::move(header.names);
  t.columns.resize(t.names.size());
  for (auto& c : t.columns) c.reserve(static_cast<std::size_t>(header.rows));
  for (std::uint64_t i = 0; i < header.rows; ++i)
    for (auto& c : t.columns) c.push_back(in.real("a number"));
  return t;
}

}  // namespace kte::detail
