#pragma once

#include <kte/io/bytes.hpp>

#include <cmath>

/// Records of MCAP files (mcap.dev/spec): an opcode, a length and as many bytes.
namespace kte::detail {

enum class mcap_op : unsigned char { header = 1, footer, schema, channel, message, chunk, data_end = 15 };

inline constexpr std::string_view mcap_magic = "\x89MCAP0\r\n";
inline constexpr double longest_mcap_time = 9e9;  ///< s, so that nanoseconds fit into 63 bits

/// `write` appends the content; its length is filled in afterwards.
template <class Write>
void append_mcap_record(std::string& out, mcap_op op, const Write& write) {
  out.push_back(static_cast<char>(op));
  const std::size_t at = out.size();
  out.append(8, '\0');
  write();
  std::uint64_t n = out.size() - at - 8;
  for (std::size_t i = at; n != 0; n >>= 8) out[i++] = static_cast<char>(static_cast<unsigned char>(n));
}
inline void append_mcap_text(std::string& out, std::string_view s) {
  append_bytes(out, static_cast<std::uint32_t>(s.size()));
  out += s;
}
inline void append_mcap_schema(std::string& out, std::uint16_t id, std::string_view name, std::string_view schema) {
  append_mcap_record(out, mcap_op::schema, [&] {
    append_bytes(out, id);
    append_mcap_text(out, name), append_mcap_text(out, "jsonschema"), append_mcap_text(out, schema);
  });
}
/// A channel of JSON, with one metadata entry or none.
inline void append_mcap_channel(std::string& out, std::uint16_t id, std::uint16_t schema, std::string_view topic,
                                std::string_view key = {}, std::string_view value = {}) {
  append_mcap_record(out, mcap_op::channel, [&] {
    append_bytes(out, id), append_bytes(out, schema);
    append_mcap_text(out, topic), append_mcap_text(out, "json");
    append_bytes(out, static_cast<std::uint32_t>(key.empty() ? 0 : 8 + key.size() + value.size()));
    if (!key.empty()) append_mcap_text(out, key), append_mcap_text(out, value);
  });
}
/// A message whose text `write` appends, with the time in ns.
template <class Write>
void append_mcap_message(std::string& out, std::uint16_t channel, std::uint32_t sequence, std::uint64_t time,
                         const Write& write) {
  append_mcap_record(out, mcap_op::message, [&] {
    append_bytes(out, channel), append_bytes(out, sequence);
    append_bytes(out, time), append_bytes(out, time);  // logged, published
    write();
  });
}
/// Throws `bad_argument` for times that are not an unsigned number of nanoseconds.
inline std::uint64_t mcap_time(double t) {
  if (!(t >= 0 && t <= longest_mcap_time)) [[unlikely]]
    raise<bad_argument>("kte: the first column of an MCAP table is time, from 0 to " + number(longest_mcap_time) +
                        " s, got " + number(t));
  return static_cast<std::uint64_t>(std::llround(1e9 * t));
}
inline void append_mcap_head(std::string& out) {
  out += mcap_magic;
  append_mcap_record(out, mcap_op::header, [&] { append_mcap_text(out, ""), append_mcap_text(out, "kte"); });
}
inline void append_mcap_tail(std::string& out) {
  append_mcap_record(out, mcap_op::data_end, [&] { append_bytes(out, std::uint32_t{0}); });  // no checksum
  append_mcap_record(out, mcap_op::footer, [&] { out.append(20, '\0'); });                   // no summary
  out += mcap_magic;
}

}  // namespace kte::detail
