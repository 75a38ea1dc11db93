#include "robots/iiwa14.hpp"

#include "static_models/model_of.hpp"

const kte::test::model& kte::test::static_models::iiwa14() {
  static const model x = made<robots::iiwa14, robots::iiwa14_names::tool>();
  return x;
}
