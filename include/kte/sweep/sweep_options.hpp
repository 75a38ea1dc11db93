#pragma once

#include <kte/dynamics/executors.hpp>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace kte {

/// How far a sweep is.
struct sweep_progress {
  std::uint64_t total = 0;   ///< cases
  std::uint64_t found = 0;   ///< cases that an earlier run had computed
  std::uint64_t done = 0;    ///< cases, including those found
  std::uint64_t failed = 0;  ///< of the cases computed in this run
  double seconds = 0;        ///< since the start of this run

  /// Cases per second.
  [[nodiscard]] double rate() const { return seconds > 0 ? static_cast<double>(done - found) / seconds : 0; }
  /// The time left at this rate, s; 0 if it is unknown.
  [[nodiscard]] double left() const { return rate() > 0 ? static_cast<double>(total - done) / rate() : 0; }
};

/// Prints progress as a line on stderr, over the previous one: `512000 of 1000000 cases, 3 failed, 61000 per s, 8 s
/// left`.
inline void print_progress(const sweep_progress& p) {
  std::fprintf(stderr, "\r%llu of %llu cases, %llu failed, %.4g per s, %.0f s left   %s",
               static_cast<unsigned long long>(p.done), static_cast<unsigned long long>(p.total),
               static_cast<unsigned long long>(p.failed), p.rate(), p.left(), p.done == p.total ? "\n" : "");
}

/// Settings of a sweep. Of these only `shard_size` can influence results: those of adaptive integrators in packs.
struct sweep_options {
  /// Cases computed and saved together. A killed run loses the unfinished shards.
  std::uint64_t shard_size = 1024;
  /// Runs shards: `kte::batch::in_this_thread()`, `kte::batch::threads(n)`, or a custom one
  /// (kte/dynamics/executors.hpp).
  std::function<void(std::size_t, const std::function<void(std::size_t)>&)> executor = batch::in_this_thread();
  /// Called after a shard, at most twice a second, and at the end: `kte::print_progress`.
  std::function<void(const sweep_progress&)> progress{};
  /// What tells this sweep from others with the same cases and columns, such as the version of its function. A run
  /// continues shards of the same note only.
  std::string note{};
  /// What else the results depend on, by names: `{{"chain", kte::to_json(kte::record_of(chain))}, {"time", "10"}}`. A
  /// run continues shards only if all are equal; an error names those that differ.
  std::vector<std::pair<std::string, std::string>> depends_on{};
};

}  // namespace kte
