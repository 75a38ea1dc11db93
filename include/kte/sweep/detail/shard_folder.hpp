#pragma once

#include <kte/io/table_writer.hpp>
#include <kte/sweep/detail/shard_file.hpp>
#include <kte/sweep/sweep_cases.hpp>
#include <kte/sweep/sweep_options.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace kte::detail {

/// What the shards of a sweep depend on, a line each: a name, a tab, and a value, or the checksum of a long one. Cases
/// have their names, their count, and the values of up to 65536 cases.
inline std::string sweep_identity(const sweep_cases& cases, const std::vector<std::string>& kept,
                                  const sweep_options& options) {
  std::string text;
  const auto add = [&text](const std::string& name, const std::string& value) {
    const bool is_short = value.size() <= 60 && std::all_of(value.begin(), value.end(),
                                                            [](unsigned char c) { return c >= ' ' && c != 0x7f; });
    char digest[32];
    std::snprintf(digest, sizeof digest, "#%016llx", static_cast<unsigned long long>(checksum(value)));
    text.append(name).append("\t").append(is_short ? value : digest).append("\n");
  };
  const auto list = [](const std::vector<std::string>& names) {
    std::string all;
    for (const auto& name : names) all.append(all.empty() ? "" : ", ").append(name);
    return all;
  };
  add("columns of cases", list(cases.names())), add("kept columns", list(kept));
  add("number of cases", std::to_string(cases.count())), add("shard size", std::to_string(options.shard_size));
  std::string values;
  const std::uint64_t samples = (std::min)(cases.count(), std::uint64_t{65536});
  for (std::uint64_t k = 0; k < samples; ++k)
    for (std::size_t j = 0; j < cases.names().size(); ++j)
      append_bytes(values, cases(samples == 1 ? 0 : k * ((cases.count() - 1) / (samples - 1)), j));
  add("values of cases", values + '\n');  // with the end of a line: its checksum
  add("note", options.note);
  for (const auto& [name, value] : options.depends_on) add(name, value);
  return text;
}

/// How the identity of a sweep differs from that of shards: "time is 12, not 10; another chain".
inline std::string difference_of_sweeps(const std::string& now, const std::string& before) {
  const auto lines_of = [](const std::string& text) {
    std::map<std::string, std::string> all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (const auto tab = line.find('\t'); tab != line.npos) all[line.substr(0, tab)] = line.substr(tab + 1);
    return all;
  };
  const auto a = lines_of(now), b = lines_of(before);
  std::string text;
  const auto add = [&text](const std::string& what) { text.append(text.empty() ? "" : "; ").append(what); };
  for (const auto& [name, value] : a) {
    const auto other = b.find(name);
    if (other == b.end())
      add("they have no " + name);
    else if (other->second != value)
      add(value.starts_with('#') || other->second.starts_with('#')
              ? "another value of " + name
              : name + " is '" + value + "', not '" + other->second + "'");
  }
  for (const auto& [name, value] : b)
    if (!a.contains(name)) add("they have " + name);
  return b.empty() ? "they are of another version of kte" : text;
}

/// The shards of the sweep whose results go to a file: those of FILE.parts.
class shard_folder {
 public:
  /// The identity is that of `sweep_identity`.
  shard_folder(const std::filesystem::path& file, const std::string& identity)
      : file_(file), folder_(file), identity_(identity), sweep_(checksum(identity)) {
    folder_ += ".parts";
  }
  /// Creates the folder. Returns the missing ones of n shards. Throws `bad_argument` if the folder belongs to another
  /// sweep.
  std::vector<std::uint64_t> prepare(std::uint64_t n) const {
    static_cast<void>(format_of(file_));  // rejects an unknown extension before the work
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) raise_file("create", folder_, error.value());
    const auto mark = folder_ / "sweep";
    if (const auto before = std::filesystem::exists(mark) ? read_file(mark) : identity_; before != identity_)
      raise<bad_argument>("kte: '" + folder_.string() + "' has shards of another sweep (" +
                          difference_of_sweeps(identity_, before) +
                          "): remove this folder to start again, or write to another file");
    replace_file(mark, identity_);
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
  std::string identity_;
  std::uint64_t sweep_;  ///< the checksum of the identity
};

}  // namespace kte::detail
