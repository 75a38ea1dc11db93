#include "static_models/model_of.hpp"

const kte::test::model& kte::test::static_models::tree() {
  static const model x = made<::models::tree, ::models::shank, ::models::hand>();
  return x;
}
