#pragma once

#include <kte/detail/interruption.hpp>
#include <kte/dynamics/executors.hpp>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <pybind11/pybind11.h>
#include <thread>

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

/// f() without the GIL, which looks for Ctrl-C between the iterations of algorithms of the library.
template <class F>
auto run_interruptibly(const F& f) {
  const pybind11::gil_scoped_release without;
  const kte::detail::interruptible heard{signal_watch()};
  return f();
}

/// f() without the GIL, of computations with parts that nothing can end: in a separate thread, while this one looks for
/// Ctrl-C. After Ctrl-C that thread ends where it next looks for an interruption, or at its end, without a use: f holds
/// all that it needs, and nothing of Python, and changes nothing outside.
template <class F>
auto run_aside(F f) {
  struct nobody_waits {};
  const pybind11::gil_scoped_release without;
  const auto stop = std::make_shared<std::atomic<bool>>(false);
  std::packaged_task<decltype(f())()> task([f = std::move(f), stop] {
    const kte::detail::interruptible heard{[&stop] {
      if (*stop) throw nobody_waits();
    }};
    return f();
  });
  auto ended = task.get_future();
  std::thread(std::move(task)).detach();
  try {
    signal_watch watch;
    while (ended.wait_for(signal_watch::interval) != std::future_status::ready) watch();
  } catch (...) {
    *stop = true;
    throw;
  }
  return ended.get();
}

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
