#pragma once

#include <kte/runtime_chain/runtime_chain.hpp>

#include <memory>
#include <string>
#include <vector>

#include "eval/static_library.hpp"

namespace kte_python {

/// The functions of a chain as a type, in a shared library that stays loaded.
class compiled_functions {
 public:
  compiled_functions(evaluate::library_functions all, std::vector<std::string> frames)
      : all_(all), frames_(std::move(frames)) {}
  /// A function, of a frame or with an empty name of all of the chain; null if the library does not have it.
  const evaluate::library_function* find(std::string_view name, std::string_view frame) const {
    for (const auto* f = all_; f->name; ++f)
      if (name == f->name && frame == (f->frame ? f->frame : "")) return f;
    return nullptr;
  }
  const std::vector<std::string>& frames() const { return frames_; }

 private:
  evaluate::library_functions all_;
  std::vector<std::string> frames_;
};

/// Compiles a chain as a type, or finds it compiled, and loads it. Throws `bad_argument`, `bad_file`, and
/// `unknown_name` for a frame.
std::shared_ptr<const compiled_functions> compile_chain(const kte::runtime_chain& c, std::vector<std::string> frames);

/// Throws the error of a function.
void raise(const evaluate::library_failure& f);

}  // namespace kte_python
