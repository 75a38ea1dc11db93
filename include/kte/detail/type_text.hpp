#pragma once

#include <cstdlib>
#include <cxxabi.h>
#include <memory>
#include <string>
#include <typeinfo>

namespace kte::detail {

/// The type of an object as it is written in C++, for messages.
template <class T>
std::string type_text(const T& x) {
  const char* const mangled = typeid(x).name();
  const std::unique_ptr<char, void (*)(void*)> text(abi::__cxa_demangle(mangled, nullptr, nullptr, nullptr), std::free);
  return text ? text.get() : mangled;
}

}  // namespace kte::detail
