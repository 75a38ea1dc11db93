#include "static_models/model_of.hpp"

const kte::test::model& kte::test::static_models::planar() {
  static const model x = made<small_chains::planar, small_chains::disc>();
  return x;
}
