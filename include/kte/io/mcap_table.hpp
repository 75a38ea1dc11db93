#pragma once

#include <kte/io/mcap_records.hpp>
#include <kte/io/table.hpp>
#include <kte/io/table_number.hpp>

#include <span>

/// A table as an MCAP file (mcap.dev/spec), which Foxglove and PlotJuggler open, without chunks, compression, index and
/// checksums.
///
///   magic  Header  Schema  Channel  Message ...  DataEnd  Footer  magic
///
/// Each record except the magic has an opcode, a length, and as many bytes. A row is a message of the topic "/kte" in
/// JSON, at the time of its first column, in seconds:
///
///   {"t":0.5,"q":1.25,"tip/position/x":"NaN"}
///
/// JSON has neither NaN nor infinity; as in the JSON of Protocol Buffers they are the texts "NaN", "Infinity",
/// "-Infinity".
namespace kte::detail {

inline constexpr std::string_view mcap_columns =
    "columns";  ///< the metadata of a channel with its columns, separated by blanks

class mcap_table {
 public:
  void head(const std::vector<std::string>& names, std::string& out) {
    std::string schema = R"({"type":"object","properties":{)", list;
    for (const auto& n : names) {
      schema.append(keys_.empty() ? "\"" : ",\"").append(n).append(R"(":{"type":"number"})");
      list.append(keys_.empty() ? "" : " ").append(n);
      keys_.push_back((keys_.empty() ? "{\"" : ",\"") + n + "\":");
    }
    schema += "}}";
    append_mcap_head(out);
    append_mcap_schema(out, id, "kte.table", schema);
    append_mcap_channel(out, id, id, "/kte", mcap_columns, list);
  }
  /// Throws `bad_argument` for times that are not an unsigned number of nanoseconds.
  void row(std::span<const double> numbers, std::string& out) {
    const auto time = mcap_time(numbers[0]);
    append_mcap_message(out, id, sequence_++, time, [&] {
      for (std::size_t i = 0; i < numbers.size(); ++i) out += keys_[i], value(out, numbers[i]);
      out += '}';
    });
  }
  void tail(std::string& out) const { append_mcap_tail(out); }

 private:
  static constexpr std::uint16_t id = 1;  ///< of the channel and of its schema
  static void value(std::string& out, double x) {
    if (std::isfinite(x)) return append_table_number(out, x);
    out += std::isnan(x) ? R"("NaN")" : x > 0 ? R"("Infinity")" : R"("-Infinity")";
  }

  std::vector<std::string> keys_;  ///< the text before each number
  std::uint32_t sequence_ = 0;
};

}  // namespace kte::detail
