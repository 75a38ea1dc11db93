#include "static_models/model_of.hpp"

const kte::test::model& kte::test::static_models::geared() {
  static const model x = made<small_chains::geared, small_chains::palm, small_chains::tip>();
  return x;
}
