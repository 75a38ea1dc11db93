#pragma once

#include <Eigen/Core>

#include <cstring>
#include <pybind11/numpy.h>
#include <string>
#include <vector>

#include "argument_names.hpp"

namespace kte_python {

namespace py = pybind11;
using array = py::array_t<double>;

/// Throws TypeError, which names the argument, for a masked array of numpy and for a list or tuple that has one: an
/// array of its numbers would have those that are masked too.
void refuse_masked(const char* name, py::handle x);

/// An argument of n numbers, of one state or of several: an array of shape (n,) or (..., n), of any strides, or what
/// numpy makes an array of. States count in the order of C.
class numbers {
 public:
  /// Throws `bad_argument` with the expected shape, TypeError for masked arrays and for what are no real numbers.
  numbers(const char* name, py::handle x, Py_ssize_t n);

  bool several() const { return !leading_.empty(); }
  /// The shape without its last axis.
  const std::vector<Py_ssize_t>& leading() const { return leading_; }
  Py_ssize_t states() const {
    Py_ssize_t all = 1;
    for (const auto n : leading_) all *= n;
    return all;
  }
  /// The numbers of a state.
  void read(Py_ssize_t state, Eigen::VectorXd& x) const {
    const char* from = data_ + state * state_stride_;
    for (Py_ssize_t i = 0; i < n_; ++i) std::memcpy(&x[i], from + i * stride_, sizeof(double));  // may not be aligned
  }
  /// The numbers of n states side by side; a single state is repeated.
  const double* contiguous(Py_ssize_t states, std::vector<double>& memory) const;
  const char* name() const { return name_; }

 private:
  const char* name_;
  py::object held_;
  const char* data_;
  Py_ssize_t n_, stride_ = 0, state_stride_ = 0;
  std::vector<Py_ssize_t> leading_;
};

/// An array of n numbers; of any number of them if n < 0.
Eigen::VectorXd vector_from(const char* name, py::handle x, Py_ssize_t n);
/// A matrix.
Eigen::MatrixXd matrix_from(const char* name, py::handle x, Py_ssize_t rows, Py_ssize_t columns);
/// A number that is finite or not.
double number_from(const char* name, py::handle x);
/// The array, which cannot be written any more: what belongs to an object, and would not change it.
array fixed(array a);
/// A new array of a vector.
array to_array(const Eigen::VectorXd& x);
/// A new array of a matrix, by rows.
array to_array(const Eigen::MatrixXd& x);
/// A new complex array of a vector or a matrix, by rows.
py::array_t<std::complex<double>> complex_array(const Eigen::MatrixXcd& m, bool is_vector);

/// Writes the numbers of a matrix by rows.
template <class M>
void write(const M& m, double* out) {
  const Eigen::Index rows = m.rows(), columns = m.cols();
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j) *out++ = m(i, j);
}
template <class V>
void write_xyz(const V& v, double* out) {
  out[0] = v.x, out[1] = v.y, out[2] = v.z;
}

}  // namespace kte_python
