#pragma once

#include <random>

/// Random numbers with a fixed seed, the same on every machine (the distributions of the standard library are not).
class random_numbers {
 public:
  explicit random_numbers(unsigned seed) : engine_(seed) {}
  /// Uniform in [-1, 1).
  double operator()() { return static_cast<double>(engine_()) * 0x1p-31 - 1; }
  double operator()(double size) { return size * (*this)(); }

 private:
  std::mt19937 engine_;
};
