#pragma once

#include <kte/sweep/sweep_options.hpp>

#include <chrono>
#include <mutex>

namespace kte::detail {

/// Counts the cases of a sweep in several threads, and reports progress.
class sweep_clock {
 public:
  /// `missing`: cases to compute, of `total`.
  sweep_clock(const std::function<void(const sweep_progress&)>& report, std::uint64_t total, std::uint64_t missing)
      : report_(report) {
    now_.total = total, now_.found = now_.done = total - missing;
  }
  void add(std::uint64_t cases, std::uint64_t failed) {
    const std::lock_guard lock(guard_);
    now_.done += cases, now_.failed += failed;
    const auto time = clock::now();
    if (report_ && time - last_ >= std::chrono::milliseconds(500) && now_.done < now_.total) tell(time);
  }
  void finish() {
    if (report_) tell(clock::now());
  }

 private:
  using clock = std::chrono::steady_clock;
  void tell(clock::time_point time) {
    last_ = time;
    now_.seconds = std::chrono::duration<double>(time - began_).count();
    report_(now_);
  }

  const std::function<void(const sweep_progress&)>& report_;
  std::mutex guard_;
  sweep_progress now_;
  clock::time_point began_ = clock::now(), last_ = began_;
};

}  // namespace kte::detail
