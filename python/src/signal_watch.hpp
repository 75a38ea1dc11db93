#pragma once

#include <kte/dynamics/executors.hpp>

#include <chrono>
#include <pybind11/pybind11.h>

namespace kte_python {

/// Looks for Ctrl-C every 50 ms, called without the GIL. Throws the exception of the handler of a signal, in the main
/// thread of Python.
class signal_watch {
 public:
  static constexpr std::chrono::milliseconds interval{50};

  void operator()() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + interval;
    const pybind11::gil_scoped_acquire with;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }

 private:
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + interval;
};

/// An executor of batches, called without the GIL: threads; this one looks for Ctrl-C between its tasks. After
/// Ctrl-C the tasks that have not begun are left out, and KeyboardInterrupt is thrown.
class interruptible_threads {
 public:
  explicit interruptible_threads(std::size_t n) : team_(n) {}
  template <class Task>
  void operator()(std::size_t tasks, Task&& task) const {
    const auto caller = std::this_thread::get_id();
    std::atomic<bool> stop{false};
    signal_watch watch;
    team_(tasks, [&](std::size_t i) {
      if (stop) return;
      if (std::this_thread::get_id() == caller) {
        try {
          watch();
        } catch (...) {
          stop = true;
          throw;
        }
      }
      task(i);
    });
  }

 private:
  kte::batch::threads team_;
};

}  // namespace kte_python
