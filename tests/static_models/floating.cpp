#include "static_models/model_of.hpp"

namespace kte::test::static_models {
const model& floating() {
  using namespace small_chains;
  static const model x = made<small_chains::floating, small_chains::body, tip, aside>();
  return x;
}
const model& floating_with_springs() {
  static const model x = made<small_chains::floating_with_springs>();
  return x;
}
const model& floating_with_dampers() {
  static const model x = made<small_chains::floating_with_dampers>();
  return x;
}
}  // namespace kte::test::static_models
