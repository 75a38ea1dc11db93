#pragma once

#include <exception>
#include <string>
#include <utility>

namespace kte::sundials::detail {

/// Carries exceptions of user functions across the C code of SUNDIALS, which they must not unwind, and stores the last
/// message of SUNDIALS, which would otherwise be printed.
class relay {
 public:
  /// Calls body(), which returns 0, or a positive number for an error that a shorter step may avoid. Stores an
  /// exception, and returns a negative number, which stops SUNDIALS.
  template <class Body>
  int guard(const Body& body) noexcept {
    try {
      return body();
    } catch (...) {
      thrown_ = std::current_exception();
      return -1;
    }
  }
  bool has_exception() const { return thrown_ != nullptr; }
  /// Throws the stored exception, if any.
  void rethrow() {
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

  const std::string& message() const { return message_; }
  void clear_message() { message_.clear(); }
  /// An error handler of CVODE, ARKODE and IDA, with a relay as its data.
  static void keep_message(int, const char*, const char*, char* text, void* self) {
    auto& r = *static_cast<relay*>(self);
    r.guard([&] { return r.message_ = text, 0; });
  }

 private:
  std::exception_ptr thrown_;
  std::string message_;
};

}  // namespace kte::sundials::detail
