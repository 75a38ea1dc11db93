#pragma once

#include <kte/io/memory_table.hpp>
#include <kte/io/table_writer.hpp>
#include <kte/sweep/detail/row_merger.hpp>
#include <kte/sweep/detail/shard_folder.hpp>
#include <kte/sweep/detail/sweep_clock.hpp>
#include <kte/sweep/sweep_function.hpp>
#include <kte/sweep/sweep_options.hpp>
#include <kte/sweep/sweep_results.hpp>

namespace kte {

/// Evaluates a function on many cases, and keeps numbers of each:
///
///   kte::sweep swings(kte::evenly("length", 0.5, 1.5, 1000), {"period"},
///                     [](const auto& c) { return std::array{period(c["length"])}; },
///                     {.executor = kte::batch::threads(2), .progress = kte::print_progress});
///   swings.to("periods.npy");
///
/// f(c) gets a `sweep_case` and returns the kept numbers as an array, vector or Eigen vector; it may also be made by
/// `in_packs`. Each shard has a copy of f, so that f may hold states. A case whose f throws, or gives NaN, fails: its
/// row remains, with `failed` 1 and the reason in the list of failures. Results do not depend on the number of threads.
///
/// Large sweeps go through shards in the folder `FILE.parts`. A run that is killed continues where it was: the next one
/// computes missing shards only. Several processes may compute shards of one sweep: `missing`, `compute` and `merge`
/// are its parts.
class sweep {
 public:
  /// Throws `bad_argument` for names of columns that `table_writer` rejects, a shard size of 0, and names of
  /// `depends_on` with a tab or the end of a line.
  template <class F>
  sweep(sweep_cases cases, std::vector<std::string> kept, F f, sweep_options options = {})
      : cases_(std::move(cases)),
        kept_(std::move(kept)),
        function_(detail::range_function_of(std::move(f))),
        options_(std::move(options)) {
    detail::check_column_names(columns());
    if (options_.shard_size == 0) detail::raise<bad_argument>("kte: the shards of a sweep need at least one case");
    for (const auto& [name, value] : options_.depends_on)
      if (name.find_first_of("\t\n") != name.npos)
        detail::raise<bad_argument>("kte: a name of `depends_on` of a sweep has a tab or the end of a line");
    identity_ = detail::sweep_identity(cases_, kept_, options_);
  }

  /// The names of the columns of results: `case`, those of the cases, the kept ones, `failed`.
  [[nodiscard]] std::vector<std::string> columns() const {
    std::vector<std::string> names{"case"};
    names.insert(names.end(), cases_.names().begin(), cases_.names().end());
    names.insert(names.end(), kept_.begin(), kept_.end());
    names.emplace_back("failed");
    return names;
  }
  /// The number of shards.
  [[nodiscard]] std::uint64_t shards() const {
    return cases_.count() / options_.shard_size + (cases_.count() % options_.shard_size != 0 ? 1 : 0);
  }

  /// Computes all cases in memory.
  [[nodiscard]] sweep_table table() const {
    std::vector<detail::sweep_rows> all(static_cast<std::size_t>(shards()));
    run(numbers_to(shards()),
        [&](std::uint64_t shard) { return all[static_cast<std::size_t>(shard)] = rows_of(shard); });
    memory_table out(columns());
    out.reserve(static_cast<std::size_t>(cases_.count()));
    detail::row_merger<memory_table> merger(cases_, kept_, out);
    sweep_table result;
    for (auto& rows : all) {
      merger.add(rows);
      result.failures.insert(result.failures.end(), rows.failures.begin(), rows.failures.end());
      rows = {};
    }
    result.rows = out.contents(), result.summary = merger.summary();
    return result;
  }
  /// Computes the missing shards, and merges all into a table in the format of the extension: CSV, NPY, MCAP
  /// (`table_format`). Reasons of failures, if any, are written to FILE.failures.csv. Throws `bad_file` if a file
  /// cannot be written, and `bad_argument` if FILE.parts belongs to another sweep, with what differs.
  sweep_summary to(const std::filesystem::path& file) const {
    run(missing(file), [&](std::uint64_t shard) { return saved(file, shard); });
    return merge(file);
  }

  /// The shards that the folder FILE.parts does not have; creates the folder.
  [[nodiscard]] std::vector<std::uint64_t> missing(const std::filesystem::path& file) const {
    return detail::shard_folder(file, identity_).prepare(shards());
  }
  /// Computes one shard and saves it in FILE.parts.
  void compute(const std::filesystem::path& file, std::uint64_t shard) const { saved(file, shard); }
  /// Merges all shards into FILE and removes FILE.parts. Throws `bad_file` if a shard is missing.
  sweep_summary merge(const std::filesystem::path& file) const {
    const detail::shard_folder folder(file, identity_);
    return folder.merge(shards(), columns(), [&](auto& out) { return detail::row_merger(cases_, kept_, out); });
  }

 private:
  static std::vector<std::uint64_t> numbers_to(std::uint64_t n) {
    std::vector<std::uint64_t> all(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
  }
  detail::sweep_rows rows_of(std::uint64_t shard) const {
    if (shard >= shards())
      detail::raise<bad_argument>("kte: the sweep has " + std::to_string(shards()) + " shards, not a shard " +
                                  std::to_string(shard));
    const std::uint64_t begin = shard * options_.shard_size;
    const std::uint64_t end = begin + (std::min)(options_.shard_size, cases_.count() - begin);
    detail::sweep_rows rows;
    rows.begin = begin, rows.columns = kept_.size();
    rows.numbers.reserve(static_cast<std::size_t>(end - begin) * kept_.size());
    auto f = function_;
    f(cases_, kept_, begin, end, rows);
    return rows;
  }
  detail::sweep_rows saved(const std::filesystem::path& file, std::uint64_t shard) const {
    auto rows = rows_of(shard);
    detail::shard_folder(file, identity_).save(shard, rows);
    return rows;
  }
  /// Calls compute(shard), which returns its rows, for all these shards.
  template <class Compute>
  void run(const std::vector<std::uint64_t>& shards, const Compute& compute) const {
    detail::sweep_clock clock(options_.progress, cases_.count(), cases_in(shards));
    options_.executor(shards.size(), [&](std::size_t i) {
      const detail::sweep_rows& rows = compute(shards[i]);
      clock.add(rows.count(), rows.failures.size());
    });
    clock.finish();
  }
  std::uint64_t cases_in(const std::vector<std::uint64_t>& shards) const {
    std::uint64_t n = 0;
    for (const auto s : shards) n += (std::min)(options_.shard_size, cases_.count() - s * options_.shard_size);
    return n;
  }

  sweep_cases cases_;
  std::vector<std::string> kept_;
  detail::range_function function_;
  sweep_options options_;
  std::string identity_;
};

}  // namespace kte
