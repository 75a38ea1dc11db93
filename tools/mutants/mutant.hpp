#pragma once

#include <cstdio>
#include <cstdlib>
#include <type_traits>

// Switches the faults of mutants.py, which copies this file into the faulty source.

/// The number of the fault that is switched on; 0: none.
inline const int kte_mutant_number = [] {
  const char* const number = std::getenv("KTE_MUTANT");
  return number ? std::atoi(number) : 0;
}();
/// The file that gets the numbers of the faults that are reached, if there is one.
inline const char* const kte_mutants_reached = std::getenv("KTE_MUTANTS_REACHED");

inline bool kte_mutant_is_on(int number) {
  static bool known[1000]{};
  if (kte_mutants_reached && !known[number]) {
    known[number] = true;
    if (std::FILE* const file = std::fopen(kte_mutants_reached, "a")) {
      std::fprintf(file, "%d\n", number);
      std::fclose(file);
    }
  }
  return number == kte_mutant_number;
}
/// Whether a fault is switched on; never at compile time.
constexpr bool kte_mutant(int number) { return !std::is_constant_evaluated() && kte_mutant_is_on(number); }
/// `wrong` if the fault is switched on and both have one type.
template <class M, class R>
constexpr R kte_either(int number, const M& wrong, const R& right) {
  if constexpr (std::is_same_v<M, R>)
    return kte_mutant(number) ? wrong : right;
  else
    return right;
}
