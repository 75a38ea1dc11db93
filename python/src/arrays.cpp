#include "arrays.hpp"

#include <kte/errors.hpp>

#include <cstdint>

#include "parts.hpp"

namespace kte_python {

namespace {

std::string text_of_shape(const py::array& a) { return py::str(a.attr("shape")).cast<std::string>(); }

/// Whether it is a masked array, or a list that has one, nested at most `depth` times. Numbers and plain arrays are
/// found out by their types.
bool is_masked(py::handle x, int depth) {
  PyTypeObject* const type = Py_TYPE(x.ptr());
  if (type == py::detail::npy_api::get().PyArray_Type_ || type == &PyFloat_Type || type == &PyLong_Type) return false;
  if (PyList_Check(x.ptr()) || PyTuple_Check(x.ptr())) {
    if (depth == 0) return false;
    const Py_ssize_t n = PySequence_Fast_GET_SIZE(x.ptr());
    for (Py_ssize_t i = 0; i < n; ++i)
      if (is_masked(PySequence_Fast_GET_ITEM(x.ptr(), i), depth - 1)) return true;
    return false;
  }
  static PyObject* masked = nullptr;
  if (!masked) masked = py::object(py::module_::import("numpy.ma").attr("MaskedArray")).release().ptr();
  return PyType_IsSubtype(type, reinterpret_cast<PyTypeObject*>(masked)) != 0;
}

/// An array of doubles of this machine.
py::array as_doubles(const char* name, py::handle x) {
  refuse_masked(name, x);
  py::array a = py::isinstance<py::array>(x) ? py::reinterpret_borrow<py::array>(x) : py::array::ensure(x);
  if (!a) {
    PyErr_Clear();
    throw py::type_error(std::string("kte: ") + name + " must be numbers, not " + py::repr(x).cast<std::string>());
  }
  const auto* const type = py::detail::array_descriptor_proxy(py::detail::array_proxy(a.ptr())->descr);
  if (type->type_num == py::detail::npy_api::NPY_DOUBLE_ && (type->byteorder == '=' || type->byteorder == '|'))
    return a;
  if (type->kind != 'f' && type->kind != 'i' && type->kind != 'u' && a.size() != 0)
    throw py::type_error(std::string("kte: ") + name + " must be real numbers, not an array of " +
                         py::str(a.dtype()).cast<std::string>());
  auto doubles = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(a);
  if (!doubles) throw py::error_already_set();
  return doubles;
}

/// A number at an address that need not be aligned.
double number_at(const void* x) {
  double number;
  std::memcpy(&number, x, sizeof number);
  return number;
}

[[noreturn]] void refuse(const char* name, const py::array& a, const std::string& expected) {
  throw kte::bad_argument(std::string("kte: ") + name + " has shape " + text_of_shape(a) + ", expected " + expected);
}

}  // namespace

void refuse_masked(const char* name, py::handle x) {
  if (is_masked(x, 3)) [[unlikely]]
    throw py::type_error(std::string("kte: ") + name +
                         " must be numbers without a mask, not a masked array: its filled() or compressed() has such");
}

void bind_arrays(py::module_& m) {
  m.def(
      "_refuse_masked", [](const std::string& name, py::handle x) { refuse_masked(name.c_str(), x); }, py::arg("name"),
      py::arg("x"));
}

numbers::numbers(const char* name, py::handle x, Py_ssize_t n) : name_(name), n_(n) {
  py::array a = as_doubles(name, x);
  const auto dimensions = a.ndim();
  if (dimensions > 0 || n != 1) {
    if (dimensions == 0 || a.shape(dimensions - 1) != n)
      refuse(name, a, "(" + std::to_string(n) + ",) or (..., " + std::to_string(n) + ")");
    leading_.assign(a.shape(), a.shape() + dimensions - 1);
    if (dimensions > 2) a = a.attr("reshape")(states(), n);
    stride_ = a.strides(a.ndim() - 1);
    if (a.ndim() == 2) state_stride_ = a.strides(0);
  }
  data_ = static_cast<const char*>(a.data());
  held_ = std::move(a);
}

const double* numbers::contiguous(Py_ssize_t states, std::vector<double>& memory) const {
  constexpr auto size = static_cast<Py_ssize_t>(sizeof(double));
  const bool aligned = reinterpret_cast<std::uintptr_t>(data_) % alignof(double) == 0;
  const bool side_by_side = aligned && (stride_ == size || n_ == 1) && (state_stride_ == n_ * size || states == 1);
  if (several() && side_by_side) return reinterpret_cast<const double*>(data_);
  memory.resize(static_cast<std::size_t>(states * n_));
  double* to = memory.data();
  for (Py_ssize_t k = 0; k < states; ++k)
    for (Py_ssize_t i = 0; i < n_; ++i)
      std::memcpy(to++, data_ + (several() ? k * state_stride_ : 0) + i * stride_, sizeof(double));
  return memory.data();
}

Eigen::VectorXd vector_from(const char* name, py::handle x, Py_ssize_t n) {
  const py::array a = as_doubles(name, x);
  if (a.ndim() == 0 && (n == 1 || n < 0)) return Eigen::VectorXd::Constant(1, number_at(a.data()));
  if (a.ndim() != 1 || (n >= 0 && a.shape(0) != n)) refuse(name, a, n < 0 ? "(n,)" : "(" + std::to_string(n) + ",)");
  Eigen::VectorXd v(a.shape(0));
  for (Py_ssize_t i = 0; i < v.size(); ++i) v[i] = number_at(a.data(i));
  return v;
}

Eigen::MatrixXd matrix_from(const char* name, py::handle x, Py_ssize_t rows, Py_ssize_t columns) {
  const py::array a = as_doubles(name, x);
  if (a.ndim() != 2 || a.shape(0) != rows || a.shape(1) != columns)
    refuse(name, a, "(" + std::to_string(rows) + ", " + std::to_string(columns) + ")");
  Eigen::MatrixXd m(rows, columns);
  for (Py_ssize_t i = 0; i < rows; ++i)
    for (Py_ssize_t j = 0; j < columns; ++j) m(i, j) = number_at(a.data(i, j));
  return m;
}

py::array_t<std::complex<double>> complex_array(const Eigen::MatrixXcd& m, bool is_vector) {
  py::array_t<std::complex<double>> a(is_vector ? std::vector<Py_ssize_t>{m.rows()}
                                                : std::vector<Py_ssize_t>{m.rows(), m.cols()});
  auto* out = a.mutable_data();
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) *out++ = m(i, j);
  return a;
}

double number_from(const char* name, py::handle x) {
  const double number = PyFloat_AsDouble(x.ptr());
  if (number == -1 && PyErr_Occurred()) {
    PyErr_Clear();
    throw py::type_error(std::string("kte: ") + name + " must be a number, not " + py::repr(x).cast<std::string>());
  }
  return number;
}

array fixed(array a) {
  a.attr("flags").attr("writeable") = false;
  return a;
}

array to_array(const Eigen::VectorXd& x) {
  array a(x.size());
  Eigen::Map<Eigen::VectorXd>(a.mutable_data(), x.size()) = x;
  return a;
}
array to_array(const Eigen::MatrixXd& x) {
  array a({x.rows(), x.cols()});
  write(x, a.mutable_data());
  return a;
}

}  // namespace kte_python
