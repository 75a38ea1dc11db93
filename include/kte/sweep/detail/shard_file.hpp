#pragma once

#include <kte/io/bytes.hpp>
#include <kte/io/replace_file.hpp>
#include <kte/sweep/detail/sweep_rows.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// A finished shard of a sweep in a file, which appears as a whole or not at all:
///
///   "kte sweep shard 1\n"  sweep  begin  columns  numbers  failures  { number  reason  } ...  checksum
///
/// Whole numbers have 64 bits, least significant byte first; numbers and reasons are preceded by their count.
namespace kte::detail {

inline constexpr std::string_view shard_magic = "kte sweep shard 1\n";

/// FNV-1a with 64 bits.
constexpr std::uint64_t checksum(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325U) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

/// Writes the rows of the sweep whose identity has this checksum. Throws `bad_file`.
inline void write_shard(const std::filesystem::path& path, std::uint64_t sweep, const sweep_rows& rows) {
  std::string out(shard_magic);
  out.reserve(out.size() + 8 * (rows.numbers.size() + 6));
  append_bytes(out, sweep), append_bytes(out, rows.begin);
  append_bytes(out, static_cast<std::uint64_t>(rows.columns));
  append_bytes(out, static_cast<std::uint64_t>(rows.numbers.size()));
  for (const double x : rows.numbers) append_bytes(out, x);
  append_bytes(out, static_cast<std::uint64_t>(rows.failures.size()));
  for (const auto& f : rows.failures) {
    append_bytes(out, f.index), append_bytes(out, static_cast<std::uint64_t>(f.reason.size()));
    out += f.reason;
  }
  append_bytes(out, checksum(out));
  replace_file(path, out);
}

/// Reads a shard; nothing if the file is missing, damaged, or of another sweep.
inline std::optional<sweep_rows> read_shard(const std::filesystem::path& path, std::uint64_t sweep) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) return {};
  const std::string bytes = read_file(path);
  if (bytes.size() < shard_magic.size() + 8) return {};
  const auto body = std::string_view(bytes).substr(0, bytes.size() - 8);
  if (from_bytes<std::uint64_t>(std::string_view(bytes).substr(body.size())) != checksum(body)) return {};
  byte_reader in(path, body);
  const auto next = [&in] { return in.number<std::uint64_t>("a number"); };
  if (!in.next(shard_magic) || next() != sweep) return {};
  sweep_rows rows;
  rows.begin = next(), rows.columns = static_cast<std::size_t>(next());
  rows.numbers.resize(static_cast<std::size_t>(next()));
  for (double& x : rows.numbers) x = in.real("a number");
  rows.failures.resize(static_cast<std::size_t>(next()));
  for (auto& f : rows.failures) f.index = next(), f.reason = in.take(next(), "a reason");
  return rows;
}

}  // namespace kte::detail
