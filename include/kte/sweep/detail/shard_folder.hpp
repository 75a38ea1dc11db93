#pragma once

#include <kte/io/table_writer.hpp>
#include <kte/sweep/detail/shard_file.hpp>
#include <kte/sweep/sweep_cases.hpp>
#include <kte/sweep/sweep_options.hpp>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace kte::detail {

/// A number that differs between sweeps: a checksum of names, counts, note, and the values of up to 64 cases.
inline std::uint64_t sweep_fingerprint(const sweep_cases& cases, const std::vector<std::string>& kept,
                                       const sweep_options& options) {
  std::string text = options.note + '\n';
  for (const auto* names : {&cases.names(), &kept})
    for (const auto& name : *names) text += name + '\n';
  append_bytes(text, cases.count()), append_bytes(text, options.shard_size);
  append_bytes(text, static_cast<std::uint64_t>(kept.size()));
  const std::uint64_t samples = (std::min)(cases.count(), std::uint64_t{64});
  for (std::uint64_t k = 0; k < samples; ++k)
    for (std::size_t j = 0; j < cases.names().size(); ++j)
      append_bytes(text, cases(samples == 1 ? 0 : k * ((cases.count() - 1) / (samples - 1)), j));
  return checksum(text);
}

/// The shards of the sweep whose results go to a file: those of FILE.parts.
class shard_folder {
 public:
  shard_folder(const std::filesystem::path& file, std::uint64_t sweep) : file_(file), folder_(file), sweep_(sweep) {
    folder_ += ".parts";
  }
  /// Creates the folder. Returns the missing ones of n shards. Throws `bad_argument` if the folder belongs to another
  /// sweep.
  std::vector<std::uint64_t> prepare(std::uint64_t n) const {
    static_cast<void>(format_of(file_));  // rejects an unknown extension before the work
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) raise_file("create", folder_, error.value());
    char name[32];
    std::snprintf(name, sizeof name, "%016llx\n", static_cast<unsigned long long>(sweep_));
    const auto mark = folder_ / "sweep";
    if (std::filesystem::exists(mark) && read_file(mark) != name)
      raise<bad_argument>("kte: '" + folder_.string() + "' has shards of another sweep: of other cases, columns, " +
                          "shards or another note; remove it, or write to another file");
    replace_file(mark, name);
    std::vector<std::uint64_t> missing;
    for (std::uint64_t k = 0; k < n; ++k)
      if (!read_shard(shard(k), sweep_)) missing.push_back(k);
    return missing;
  }
  void save(std::uint64_t k, const sweep_rows& rows) const { write_shard(shard(k), sweep_, rows); }

  /// Merges n shards into the file, by an object with `add` and `summary` that merger(table_writer) makes, and removes
  /// the folder.
  template <class Merger>
  auto merge(std::uint64_t n, const std::vector<std::string>& columns, const Merger& merger) const {
    const auto table = folder_ / ("merged" + file_.extension().string());
    table_writer out(table, columns, format_of(file_));
    auto rows = merger(out);
    std::string reasons = "case,reason\n";
    for (std::uint64_t k = 0; k < n; ++k) {
      const auto part = read_shard(shard(k), sweep_);
      if (!part)
        raise<bad_file>("kte: cannot merge '" + folder_.string() + "': shard " + std::to_string(k) + " of " +
                        std::to_string(n) + " is missing");
      rows.add(*part);
      for (const auto& f : part->failures) append_reason(reasons, f);
    }
    out.close();
    auto failures = file_;
    failures += ".failures.csv";
    std::error_code error;
    if (rows.summary().failed > 0)
      replace_file(failures, reasons);
    else
      std::filesystem::remove(failures, error);
    std::filesystem::rename(table, file_, error);
    if (error) raise_file("write", file_, error.value());
    std::filesystem::remove_all(folder_, error);
    return rows.summary();
  }

 private:
  std::filesystem::path shard(std::uint64_t k) const { return folder_ / (std::to_string(k) + ".shard"); }
  static void append_reason(std::string& out, const sweep_failure& f) {
    out.append(std::to_string(f.index)).append(",\"");
    for (const char c : f.reason) out.append(c == '"' ? 2 : 1, c == '\n' || c == '\r' ? ' ' : c);
    out.append("\"\n");
  }

  std::filesystem::path file_, folder_;
  std::uint64_t sweep_;
};

}  // namespace kte::detail
