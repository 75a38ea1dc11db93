#pragma once

#include <kte/io/bytes.hpp>
#include <kte/io/table.hpp>
#include <kte/io/table_number.hpp>

#include <span>

/// A table as a file of MCAP (mcap.dev/spec), which Foxglove and PlotJuggler open: no chunks, no compression, no index,
/// no check sums.
///
///   magic  Header  Schema  Channel  Message ...  DataEnd  Footer  magic
///
/// each of them but the magic an opcode, a length and that many bytes. A row is a message of topic "/kte" in JSON, at
/// the time that its first column says in seconds:
///
///   {"t":0.5,"q":1.25,"tip/position/x":"NaN"}
///
/// JSON has no NaN and infinity; as in the JSON of Protocol Buffers they are the texts "NaN", "Infinity", "-Infinity".
namespace kte::detail {

enum class mcap_op : unsigned char { header = 1, footer, schema, channel, message, chunk, data_end = 15 };

inline constexpr std::string_view mcap_magic = "\x89MCAP0\r\n";
inline constexpr std::string_view mcap_columns = "columns";  ///< the metadata of a channel that lists them, by spaces

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
    out += mcap_magic;
    record(out, mcap_op::header, [&] { text(out, ""), text(out, "kte"); });  // profile, library
    record(out, mcap_op::schema, [&] {
      append_bytes(out, id);
      text(out, "kte.table"), text(out, "jsonschema"), text(out, schema);
    });
    record(out, mcap_op::channel, [&] {
      append_bytes(out, id), append_bytes(out, id);  // of the channel and of its schema
      text(out, "/kte"), text(out, "json");
      append_bytes(out, static_cast<std::uint32_t>(8 + mcap_columns.size() + list.size()));
      text(out, mcap_columns), text(out, list);
    });
  }
  /// Throws `bad_argument` for times that are no unsigned number of nanoseconds.
  void row(std::span<const double> numbers, std::string& out) {
    const double t = numbers[0];
    if (!(t >= 0 && t <= longest)) [[unlikely]]
      raise<bad_argument>("kte: the first column of an MCAP table is time, from 0 to " + number(longest) + " s, got " +
                          number(t));
    const auto time = static_cast<std::uint64_t>(std::llround(1e9 * t));
    record(out, mcap_op::message, [&] {
      append_bytes(out, id), append_bytes(out, sequence_++);
      append_bytes(out, time), append_bytes(out, time);  // logged, published
      for (std::size_t i = 0; i < numbers.size(); ++i) out += keys_[i], value(out, numbers[i]);
      out += '}';
    });
  }
  void tail(std::string& out) const {
    record(out, mcap_op::data_end, [&] { append_bytes(out, std::uint32_t{0}); });  // no check sum
    record(out, mcap_op::footer, [&] { out.append(20, '\0'); });                   // no summary
    out += mcap_magic;
  }

 private:
  static constexpr std::uint16_t id = 1;
  static constexpr double longest = 9e9;  // s, so that nanoseconds fit readers that count them in 63 bits

  /// `write` appends the content; its length is filled in behind it.
  template <class Write>
  static void record(std::string& out, mcap_op op, const Write& write) {
    out.push_back(static_cast<char>(op));
    const std::size_t at = out.size();
    out.append(8, '\0');
    write();
    std::uint64_t n = out.size() - at - 8;
    for (std::size_t i = at; n != 0; n >>= 8) out[i++] = static_cast<char>(static_cast<unsigned char>(n));
  }
  static void text(std::string& out, std::string_view s) {
    append_bytes(out, static_cast<std::uint32_t>(s.size()));
    out += s;
  }
  static void value(std::string& out, double x) {
    if (std::isfinite(x)) return append_table_number(out, x);
    out += std::isnan(x) ? R"("NaN")" : x > 0 ? R"("Infinity")" : R"("-Infinity")";
  }

  std::vector<std::string> keys_;  ///< what stands before each number
  std::uint32_t sequence_ = 0;
};

}  // namespace kte::detail
