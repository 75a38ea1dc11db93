#pragma once

namespace kte::detail {

/// A reference to a callable, for arguments of functions that are not templates. The callable must outlive the call.
template <class... Args>
class function_ref {
 public:
  template <class F>
  function_ref(const F& f)  // NOLINT(google-explicit-constructor)
      : object_(&f), call_([](const void* object, Args... args) { (*static_cast<const F*>(object))(args...); }) {}
  void operator()(Args... args) const { call_(object_, args...); }

 private:
  const void* object_;
  void (*call_)(const void*, Args...);
};

}  // namespace kte::detail
