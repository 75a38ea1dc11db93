#include <kte/adapters/sundials/handles.hpp>

#include "catch.hpp"

namespace handles_test {

using namespace kte::sundials::detail;

int freed = 0;
void count_one(int* p) { freed += *p; }
void count_one_at(void** p) {
  freed += *static_cast<int*>(*p);
  *p = nullptr;
}

TEST_CASE("SUNDIALS: owners free once what they have, by the function of its kind, and nothing else") {
  int three = 3;
  freed = 0;
  {
    std::unique_ptr<int, freed_by<count_one>> first(&three), second = std::move(first), none;
    CHECK(freed == 0);
    CHECK(*second == 3);
  }
  CHECK(freed == 3);
  std::unique_ptr<void, freed_by_address<count_one_at>>{&three}.reset();
  CHECK(freed == 6);
}

TEST_CASE("SUNDIALS: a null pointer is memory that is short") {
  int x = 0;
  CHECK(made(&x) == &x);
  CHECK_THROWS_AS(made(static_cast<int*>(nullptr)), std::bad_alloc);
}

TEST_CASE("SUNDIALS: vectors and matrices are seen in place, matrices by rows and columns") {
  const auto context = make_context();
  const vector_handle v(made(N_VNew_Serial(3, context.get())));
  numbers<Eigen::Vector3d>(v.get()) = Eigen::Vector3d(1, 2, 3);
  CHECK(NV_Ith_S(v.get(), 1) == 2);
  NV_Ith_S(v.get(), 2) = 7;
  CHECK(numbers<Eigen::VectorXd>(v.get()) == Eigen::Vector3d(1, 2, 7));
  const matrix_handle m(made(SUNDenseMatrix(2, 3, context.get())));
  auto seen = numbers(m.get());
  REQUIRE(seen.rows() == 2);
  REQUIRE(seen.cols() == 3);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 3; ++j) seen(i, j) = 10 * i + j;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 3; ++j) CHECK(SM_ELEMENT_D(m.get(), i, j) == 10 * i + j);
}

TEST_CASE("SUNDIALS: a dense system is of the size of its vector, and solved") {
  const auto context = make_context();
  const vector_handle b(made(N_VNew_Serial(3, context.get()))), x(made(N_VNew_Serial(3, context.get())));
  const dense_linear_solver solver(b.get(), context.get());
  auto a = numbers(solver.matrix.get());
  REQUIRE(a.rows() == 3);
  REQUIRE(a.cols() == 3);
  a << 0, 2, 0, 1, 0, 0, 0, 1, 4;  // pivots are to be found
  numbers<Eigen::Vector3d>(b.get()) = a * Eigen::Vector3d(1, -2, 3);
  REQUIRE(SUNLinSolSetup(solver.solver.get(), solver.matrix.get()) == 0);
  REQUIRE(SUNLinSolSolve(solver.solver.get(), solver.matrix.get(), x.get(), b.get(), 0) == 0);
  CHECK(numbers<Eigen::Vector3d>(x.get()) == Eigen::Vector3d(1, -2, 3));  // small integers: exact
}

}  // namespace handles_test
