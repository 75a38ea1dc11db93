#pragma once

#include <Eigen/Core>

#include <memory>
#include <new>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <type_traits>

/// Owners of objects allocated by SUNDIALS, and its vectors as Eigen maps.
namespace kte::sundials::detail {

template <auto Free>
struct freed_by {
  template <class T>
  void operator()(T* p) const {
    Free(p);
  }
};
/// For deleters that take a pointer to the pointer.
template <auto Free>
struct freed_by_address {
  template <class T>
  void operator()(T* p) const {
    Free(&p);
  }
};

template <class Pointer, class Deleter>
using handle = std::unique_ptr<std::remove_pointer_t<Pointer>, Deleter>;

using context_handle = handle<SUNContext, freed_by_address<SUNContext_Free>>;
using vector_handle = handle<N_Vector, freed_by<N_VDestroy>>;
using matrix_handle = handle<SUNMatrix, freed_by<SUNMatDestroy>>;
using linear_solver_handle = handle<SUNLinearSolver, freed_by<SUNLinSolFree>>;
using nonlinear_solver_handle = handle<SUNNonlinearSolver, freed_by<SUNNonlinSolFree>>;

/// Checks the result of a SUNDIALS constructor, which is null if memory is exhausted.
template <class T>
T* made(T* p) {
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

inline context_handle make_context() {
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  return context_handle(made(context));
}

/// The numbers of a vector.
template <class X>
Eigen::Map<X> numbers(N_Vector v) {
  return Eigen::Map<X>(N_VGetArrayPointer(v), static_cast<Eigen::Index>(N_VGetLength(v)));
}
inline Eigen::Map<Eigen::MatrixXd> numbers(SUNMatrix m) {
  return {SUNDenseMatrix_Data(m), static_cast<Eigen::Index>(SUNDenseMatrix_Rows(m)),
          static_cast<Eigen::Index>(SUNDenseMatrix_Columns(m))};
}

/// Linear systems with a dense matrix, solved by LU factors.
struct dense_linear_solver {
  dense_linear_solver(N_Vector like, SUNContext context)
      : matrix(made(SUNDenseMatrix(N_VGetLength(like), N_VGetLength(like), context))),
        solver(made(SUNLinSol_Dense(like, matrix.get(), context))) {}

  matrix_handle matrix;
  linear_solver_handle solver;
};

}  // namespace kte::sundials::detail
