#pragma once

#include <kte/errors.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

/// An executor of a batch is called as executor(tasks, task), calls task(0) ... task(tasks - 1) in any order and in any
/// threads, and returns when all are done. A custom thread pool needs three lines.
namespace kte::batch {

/// Runs all tasks one after the other in this thread.
struct in_this_thread {
  template <class Task>
  void operator()(std::size_t tasks, Task&& task) const {
    for (std::size_t i = 0; i < tasks; ++i) task(i);
  }
};

/// Runs tasks on up to n threads, including this one; the others are started for each call. All tasks run even if some
/// throw; then the exception of the first of these is thrown.
class threads {
 public:
  explicit threads(std::size_t n) : n_(n) {
    if (n == 0) kte::detail::raise<bad_argument>("kte: a batch needs at least one thread");
  }
  template <class Task>
  void operator()(std::size_t tasks, Task&& task) const {
    std::atomic<std::size_t> next{0};
    std::mutex guard;
    std::size_t failed = tasks;
    std::exception_ptr failure;
    const auto work = [&] {
      for (std::size_t i; (i = next.fetch_add(1)) < tasks;) {
        try {
          task(i);
        } catch (...) {
          const std::lock_guard lock(guard);
          if (i < failed) failed = i, failure = std::current_exception();
        }
      }
    };
    const std::size_t helpers = (std::max<std::size_t>)((std::min)(n_, tasks), 1) - 1;
    std::vector<std::thread> team;
    team.reserve(helpers);
    try {
      while (team.size() < helpers) team.emplace_back(work);
    } catch (...) {  // no more threads can be started: continue with fewer
    }
    work();
    for (auto& t : team) t.join();
    if (failure) std::rethrow_exception(failure);
  }

 private:
  std::size_t n_;
};

}  // namespace kte::batch
