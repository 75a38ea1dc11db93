#pragma once

#include <functional>
#include <utility>

/// Long calls that a program can end.
namespace kte::detail {

/// What this thread calls between the iterations of algorithms that may take long, or nothing. It may throw, which
/// ends the call: the package for Python looks for Ctrl-C.
inline thread_local const std::function<void()>* interruption = nullptr;

inline void look_for_interruption() {
  if (interruption != nullptr) [[unlikely]]
    (*interruption)();
}

/// Sets `interruption` for its lifetime.
class interruptible {
 public:
  explicit interruptible(std::function<void()> look) : look_(std::move(look)), before_(interruption) {
    interruption = &look_;
  }
  ~interruptible() { interruption = before_; }
  interruptible(const interruptible&) = delete;
  interruptible& operator=(const interruptible&) = delete;

 private:
  std::function<void()> look_;
  const std::function<void()>* before_;
};

}  // namespace kte::detail
