#pragma once

#include <cstdlib>
#include <cxxabi.h>
#include <string>
#include <typeinfo>

namespace kte::detail {

/// The type of an object in C++ notation, for messages.
template <class T>
std::string type_text(const T& x) {
  const char* const mangled = typeid(x).name();
  const struct freed {
    char* text;
    ~freed() { std::free(text); }
  } plain{abi::__cxa_demangle(mangled, nullptr, nullptr, nullptr)};
  return plain.text != nullptr ? plain.text : mangled;
}

}  // namespace kte::detail
