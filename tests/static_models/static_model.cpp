#include "static_models/static_model.hpp"

Eigen::VectorXd kte::test::random_vector(int n, double size, random_numbers& random) {
  Eigen::VectorXd x(n);
  for (auto& e : x) e = random(size);
  return x;
}
