#pragma once

#include <utility>

namespace kte::detail {

template <class Signature>
class function_ref;
/// A reference to a callable, for arguments of functions that are not templates. The callable must outlive the call.
template <class R, class... Args>
class function_ref<R(Args...)> {
 public:
  template <class F>
  function_ref(const F& f)  // NOLINT(google-explicit-constructor)
      : object_(&f), call_([](const void* object, Args... args) -> R {
          return (*static_cast<const F*>(object))(std::forward<Args>(args)...);
        }) {}
  R operator()(Args... args) const { return call_(object_, std::forward<Args>(args)...); }

 private:
  const void* object_;
  R (*call_)(const void*, Args...);
};

}  // namespace kte::detail
