#include "sweep_cases.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "chain.hpp"
#include "parts.hpp"

namespace kte_python {

namespace {

std::string text_of(const made_by& how) {
  if (std::string_view(how.function) == "_product")
    return py::repr(how.arguments[0]).cast<std::string>() + " * " + py::repr(how.arguments[1]).cast<std::string>();
  std::string s = std::string("kte.") + how.function + "(";
  for (std::size_t i = 0; i < how.arguments.size(); ++i)
    s.append(i == 0 ? "" : ", ").append(py::repr(how.arguments[i]).cast<std::string>());
  return s + ")";
}
py::tuple reduced(const made_by& how) {
  return py::make_tuple(py::module_::import("kte.sweeps").attr("_remade"), py::make_tuple(how.function, how.arguments));
}

std::vector<kte::distributed> distributions_from(py::handle columns) {
  std::vector<kte::distributed> all;
  for (const auto c : columns) {
    if (!py::isinstance<distribution_object>(c))
      throw py::type_error("kte: columns must be distributions, as kte.uniform('tool/mass', 0, 5), not " +
                           py::repr(c).cast<std::string>());
    all.push_back(c.cast<const distribution_object&>().value);
  }
  return all;
}
/// A list of the columns; one column may be alone.
py::list list_of(py::handle columns) {
  if (!py::isinstance<distribution_object>(columns)) return py::list(py::reinterpret_borrow<py::object>(columns));
  py::list one;
  one.append(columns);
  return one;
}
/// A whole number that is not negative.
std::uint64_t whole(const char* name, py::handle n) {
  const auto number = py::reinterpret_steal<py::int_>(PyNumber_Index(n.ptr()));
  if (!number) throw py::error_already_set();
  const std::uint64_t x = PyLong_AsUnsignedLongLong(number.ptr());
  if (PyErr_Occurred()) {
    PyErr_Clear();
    throw kte::bad_argument(std::string("kte: ") + name + " must be from 0 to 2^64 - 1, got " +
                            py::repr(number).cast<std::string>());
  }
  return x;
}

cases_object list_from(py::handle names, py::handle values) {
  auto all = names_from(names);
  const auto columns = static_cast<Py_ssize_t>(all.size());
  if (const auto given = py::array::ensure(values); given && (given.ndim() != 2 || given.shape(1) != columns))
    throw kte::bad_argument("kte: values has shape " + py::str(given.attr("shape")).cast<std::string>() +
                            ", expected (cases, " + std::to_string(columns) + ")");
  const numbers x("values", values, columns);
  std::vector<double> memory;
  const double* const from = x.contiguous(x.states(), memory);
  const auto size = static_cast<std::size_t>(x.states() * columns);
  const auto data = std::make_shared<const std::vector<double>>(from, from + size);
  array kept({x.states(), columns});
  std::copy_n(data->data(), size, kept.mutable_data());
  const auto width = static_cast<std::size_t>(columns);
  return {{all, static_cast<std::uint64_t>(x.states()),
           [data, width](std::uint64_t i, std::size_t j) { return (*data)[static_cast<std::size_t>(i) * width + j]; }},
          {"list_of_cases", py::make_tuple(all, kept)}};
}

array values_of(const cases_object& c, std::uint64_t begin, std::uint64_t end) {
  const std::size_t columns = c.cases.names().size();
  array all({static_cast<Py_ssize_t>(end - begin), static_cast<Py_ssize_t>(columns)});
  double* to = all.mutable_data();
  for (std::uint64_t i = begin; i < end; ++i)
    for (std::size_t j = 0; j < columns; ++j) *to++ = c.cases(i, j);
  return all;
}

}  // namespace

void bind_sweep_cases(py::module_& m) {
  using namespace py::literals;
  py::class_<distribution_object>(m, "Distribution",
                                  "The distribution of a column: of `random_cases` and `sobol_cases`.")
      .def_property_readonly(
          "name", [](const distribution_object& d) { return d.value.name(); }, "The name of the column.")
      .def("__reduce__", [](const distribution_object& d) { return reduced(d.how); })
      .def("__repr__", [](const distribution_object& d) { return text_of(d.how); });
  py::class_<cases_object>(m, "Cases", R"(What a sweep varies: a number of cases, with a value for each column.

    kte.one_of("length", [0.5, 1.0]) * kte.evenly("tool/mass", 1, 2, 101)      # a grid of 202 cases

`len(cases)` is the number of cases, `cases[i]` a dict of the values of one, `cases[i:j]` a list of cases. Values are functions of the number of the
case, computed on access.)")
      .def_property_readonly(
          "names", [](const cases_object& c) { return c.cases.names(); }, "The names of the columns.")
      .def(
          "values",
          [](const cases_object& c, std::uint64_t begin, py::handle end) {
            const std::uint64_t last = end.is_none() ? c.cases.count() : whole("end", end);
            if (begin > last || last > c.cases.count())
              throw kte::bad_argument("kte: there are " + std::to_string(c.cases.count()) + " cases, not those from " +
                                      std::to_string(begin) + " to " + std::to_string(last));
            return values_of(c, begin, last);
          },
          "values(begin=0, end=None)\n\nThe values of these cases, (cases, columns).", "begin"_a = 0,
          "end"_a = py::none())
      .def("__len__", [](const cases_object& c) { return c.cases.count(); })
      .def("__getitem__",
           [](py::object self, const py::slice& range) -> py::object {
             const auto& c = self.cast<const cases_object&>();
             return py::cast(list_from(py::cast(c.cases.names()), self.attr("values")().attr("__getitem__")(range)));
           })
      .def("__getitem__",
           [](const cases_object& c, long long i) {
             const auto n = static_cast<long long>(c.cases.count());
             if (i < -n || i >= n) throw py::index_error("kte: there are " + std::to_string(n) + " cases");
             const auto row = static_cast<std::uint64_t>(i < 0 ? i + n : i);
             py::dict all;
             for (std::size_t j = 0; j < c.cases.names().size(); ++j)
               all[py::str(c.cases.names()[j])] = c.cases(row, j);
             return all;
           })
      .def(
          "__mul__",
          [](py::object a, py::object b) -> py::object {
            if (!py::isinstance<cases_object>(b)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
            return py::cast(cases_object{a.cast<const cases_object&>().cases * b.cast<const cases_object&>().cases,
                                         {"_product", py::make_tuple(a, b)}});
          },
          "Every case of a with every case of b; those of b change faster.")
      .def("__reduce__", [](const cases_object& c) { return reduced(c.how); })
      .def("__repr__", [](const cases_object& c) { return text_of(c.how); });

  const auto distribution = [&m](const char* name, kte::distributed (*make)(std::string, double, double),
                                 const char* first, const char* second, const char* doc) {
    m.def(
        name,
        [name, make](const std::string& column, double a, double b) {
          return distribution_object{make(column, a, b), {name, py::make_tuple(column, a, b)}};
        },
        doc, "name"_a, py::arg(first), py::arg(second));
  };
  distribution("uniform", kte::uniform, "least", "most",
               "uniform(name, least, most)\n\nA column that is evenly distributed from `least` to `most`.");
  distribution(
      "log_uniform", kte::log_uniform, "least", "most",
      "log_uniform(name, least, most)\n\nA column whose logarithm is evenly distributed; bounds are positive.");
  distribution("normal", kte::normal, "mean", "deviation",
               "normal(name, mean, deviation)\n\nA normally distributed column.");
  m.def(
      "one_of",
      [](const std::string& name, py::handle values) {
        const auto x = vector_from("values", values, -1);
        return cases_object{kte::one_of(name, {x.data(), x.data() + x.size()}),
                            {"one_of", py::make_tuple(name, to_array(x).attr("tolist")())}};
      },
      "one_of(name, values)\n\nCases: one column with these values.", "name"_a, "values"_a);
  m.def(
      "evenly",
      [](const std::string& name, double first, double last, py::handle n) {
        return cases_object{kte::evenly(name, first, last, whole("n", n)),
                            {"evenly", py::make_tuple(name, first, last, n)}};
      },
      "evenly(name, first, last, n)\n\nCases: one column with n evenly spaced values.", "name"_a, "first"_a, "last"_a,
      "n"_a);
  m.def("list_of_cases", &list_from,
        "list_of_cases(names, values)\n\nGiven cases: names of columns, and values of shape (cases, columns).",
        "names"_a, "values"_a);
  m.def(
      "random_cases",
      [](py::handle n, py::handle seed, py::handle columns) {
        const auto all = list_of(columns);
        return cases_object{kte::random_cases(whole("n", n), whole("seed", seed), distributions_from(all)),
                            {"random_cases", py::make_tuple(n, seed, all)}};
      },
      R"(random_cases(n, seed, columns)

n cases of independent random numbers; columns are distributions: `uniform`, `log_uniform`, `normal`. A case depends on the
seed and its number only: more cases begin with the same ones.)",
      "n"_a, "seed"_a, "columns"_a);
  m.def(
      "sobol_cases",
      [](py::handle n, py::handle columns) {
        const auto all = list_of(columns);
        return cases_object{kte::sobol_cases(whole("n", n), distributions_from(all)),
                            {"sobol_cases", py::make_tuple(n, all)}};
      },
      R"(sobol_cases(n, columns)

n points of Sobol's sequence with these distributions, up to 21 columns: they fill ranges more evenly than random numbers;
best for n a power of two.)",
      "n"_a, "columns"_a);
  m.def(
      "_product", [](py::object a, py::object b) { return a * b; }, "a"_a, "b"_a);
}

}  // namespace kte_python
