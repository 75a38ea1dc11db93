#pragma once

#include <kte/io/mcap_table.hpp>

namespace kte::detail {

/// Reads the bytes of an MCAP file with a table as `mcap_table` writes it. The file may end after any record, as if it
/// was never closed. Throws `bad_file` with the path, the offset and the column of an error.
class mcap_table_reader {
 public:
  mcap_table_reader(const std::filesystem::path& path, std::string_view bytes) : in_(path, bytes) {
    in_.expect(mcap_magic);
    while (in_.size() != 0 && !(ended_ && in_.rest() == mcap_magic)) record();
    if (result_.names.empty()) in_.bad("no channel of MCAP that holds a table");
  }

  table result() && { return std::move(result_); }

 private:
  void record() {
    const auto op = mcap_op{in_.number<unsigned char>("a record")};
    const auto length = in_.number<std::uint64_t>("the length of a record");
    auto content = in_.part(length, "a record");
    if (op == mcap_op::channel) channel(content);
    if (op == mcap_op::message) message(content);
    if (op == mcap_op::chunk) content.bad("a chunk of MCAP: only files without chunks are read");
    ended_ |= op == mcap_op::footer;
  }
  static std::string_view text(byte_reader& in, const char* what) {
    return in.take(in.number<std::uint32_t>(what), what);
  }

  /// The first channel with a list of columns is the table.
  void channel(byte_reader& in) {
    const auto id = in.number<std::uint16_t>("a channel");
    in.number<std::uint16_t>("a channel");
    text(in, "a topic"), text(in, "an encoding");
    const auto length = in.number<std::uint32_t>("metadata");
    auto metadata = in.part(length, "metadata");
    while (metadata.size() != 0) {
      const auto key = text(metadata, "metadata");
      const auto names = text(metadata, "metadata");
      if (key == mcap_columns && result_.names.empty()) columns(metadata, names), channel_ = id;
    }
  }
  void columns(const byte_reader& in, std::string_view names) {
    known_names known;
    while (!names.empty()) {
      const auto name = names.substr(0, names.find(' '));
      names.remove_prefix((std::min)(name.size() + 1, names.size()));
      if (name.empty()) in.bad("the list of columns has an empty name");
      if (!known.add(name)) in.bad("the list of columns has '" + std::string(name) + "' twice");
      result_.names.emplace_back(name);
    }
    result_.columns.resize(result_.names.size());
  }
  void message(byte_reader& in) {
    const bool mine = in.number<std::uint16_t>("a message") == channel_ && !result_.names.empty();
    in.take(20, "a message");  // sequence number and times
    if (!mine) return;
    for (std::size_t j = 0; j < result_.names.size(); ++j) {
      in.expect(j == 0 ? "{\"" : ",\"");
      in.expect(result_.names[j]);
      in.expect("\":");
      result_.columns[j].push_back(value(in, j));
    }
    in.expect("}");
    if (in.size() != 0) in.bad("more than a row");
  }
  static double value(byte_reader& in, std::size_t column) {
    const byte_reader start = in;
    const bool quoted = in.next("\"");
    const auto word = in.until(quoted ? "\"" : ",}");
    double x{};
    const bool known = quoted ? word == "NaN" || word == "Infinity" || word == "-Infinity" : !word.empty();
    if (!known || !read_number(word, x))
      start.bad("column " + std::to_string(column + 1) + ": '" + std::string(word.substr(0, 80)) + "' is not a number");
    if (quoted) in.expect("\"");
    return x;
  }

  byte_reader in_;
  table result_;
  std::uint16_t channel_ = 0;
  bool ended_ = false;
};

}  // namespace kte::detail
