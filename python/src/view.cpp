#include <kte/io/recording.hpp>
#include <kte/view.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "call.hpp"
#include "parts.hpp"
#include "recording.hpp"
#include "robots.hpp"

namespace kte_python {

namespace {

array rows_of(const std::vector<double>& all, std::size_t width, std::size_t first, std::size_t count) {
  const std::size_t rows = width == 0 ? 0 : all.size() / width;
  array out({static_cast<Py_ssize_t>(rows), static_cast<Py_ssize_t>(count)});
  double* to = out.mutable_data();
  for (std::size_t i = 0; i < rows; ++i) to = std::copy_n(all.data() + i * width + first, count, to);
  return out;
}
std::size_t nq(const recording_object& r) { return static_cast<std::size_t>(r.chain.nq()); }
std::size_t nv(const recording_object& r) { return static_cast<std::size_t>(r.chain.dofs()); }

/// The columns of a table of quantities, t first.
py::dict columns_of(const recording_object& r, py::handle names) {
  const kte::detail::recording what(kte::detail::slots_of(r.chain),
                                    names.is_none() ? std::vector<std::string>() : names_from(names));
  const std::size_t columns = what.columns.size() - 1;
  std::vector<double> numbers(r.rows() * columns);
  {
    const py::gil_scoped_release without;
    double* to = numbers.data();
    r.replay([&](double, const kte::runtime_state& s) {
      kte::detail::read_recorded(what.cells, s, to);
      to += columns;
    });
  }
  py::dict all;
  all["t"] = rows_of(r.t, 1, 0, 1).attr("ravel")();
  for (std::size_t c = 0; c < columns; ++c)
    all[py::str(what.columns[c + 1])] = rows_of(numbers, columns, c, 1).attr("ravel")();
  return all;
}

py::list events_of(const recording_object& r) {
  py::list all;
  const auto part = [](const Eigen::VectorXd& x, std::size_t first, std::size_t count) {
    return to_array(Eigen::VectorXd(x.segment(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count))));
  };
  for (const auto& e : r.events)
    all.append(
        result("EventOccurrence", py::make_tuple(e.name, e.time, part(e.after, 0, nq(r)), part(e.after, nq(r), nv(r)),
                                                 part(e.before, 0, nq(r)), part(e.before, nq(r), nv(r)), e.what)));
  return all;
}

template <class Chain>
kte::scene recorded(const Chain& chain, const recording_object& r, const std::vector<std::string>& columns) {
  kte::scene_recording<Chain> scene(chain, {.columns = columns});
  r.replay([&scene](double t, const kte::runtime_state& s) { scene.row(t, s); });
  return scene.contents();
}
template <class Chain>
kte::scene standing(const Chain& chain, const std::vector<std::string>& columns) {
  kte::scene_recording<Chain> scene(chain, {.columns = columns});
  auto s = kte::detail::first_state(chain);
  kte::detail::chain_in(chain).doMotion(s);
  scene.row(0.0, s);
  return scene.contents();
}
kte::scene scene_of(py::handle x, const std::vector<std::string>& columns) {
  if (py::isinstance<recording_object>(x)) {
    const auto& r = x.cast<const recording_object&>();
    if (py::isinstance<robot_object>(r.drawn)) {
      auto robot = current(r.drawn.cast<const robot_object&>());
      robot.chain = r.chain;
      const py::gil_scoped_release without;
      return recorded(robot, r, columns);
    }
    const py::gil_scoped_release without;
    return recorded(r.chain, r, columns);
  }
  if (py::isinstance<robot_object>(x)) return standing(current(x.cast<const robot_object&>()), columns);
  return standing(chain_of(x).chain(), columns);
}

void write_page(py::handle x, const std::filesystem::path& path, const std::string& title, py::handle columns,
                std::size_t mesh_bytes, std::size_t recording_bytes) {
  const kte::page_options options{.title = title, .mesh_bytes = mesh_bytes, .recording_bytes = recording_bytes};
  const auto scene = scene_of(x, names_from(columns));
  for (const auto& note : kte::not_drawn(scene)) warn_of_robot("kte: " + note, 2);
  kte::write_page(path, scene, options);
}

}  // namespace

void bind_view(py::module_& m) {
  using namespace py::literals;
  py::class_<recording_object>(m, "Recording",
                               R"(A motion: times, states and inputs. Other quantities are computed when asked for:

    rec["tip/position/x"]               one column, or several: rec[["q", "q/f"]]
    rec.to_pandas(["tip/velocity"])     a table with the column t)")
      .def_property_readonly(
          "t", [](const recording_object& r) { return rows_of(r.t, 1, 0, 1).attr("ravel")(); }, "Times, s, (rows,).")
      .def_property_readonly(
          "q", [](const recording_object& r) { return rows_of(r.x, r.nx, 0, nq(r)); }, "Configurations, (rows, nq).")
      .def_property_readonly(
          "v", [](const recording_object& r) { return rows_of(r.x, r.nx, nq(r), nv(r)); }, "Velocities, (rows, nv).")
      .def_property_readonly(
          "z", [](const recording_object& r) { return rows_of(r.x, r.nx, nq(r) + nv(r), r.nx - nq(r) - nv(r)); },
          "Internal states of elements, (rows, number).")
      .def_property_readonly(
          "u", [](const recording_object& r) { return rows_of(r.u, r.nu, 0, r.nu); }, "Inputs, (rows, number).")
      .def_property_readonly(
          "events", &events_of,
          "Events, in the order of time: `EventOccurrence(name, time, q, v, q_before, v_before, what)`.")
      .def_property_readonly(
          "reason", [](const recording_object& r) { return r.reason; },
          "Why the integration ended: 'end_time', 'terminal' (an event) or 'zeno' (infinitely many events).")
      .def_property_readonly(
          "stopped_by", [](const recording_object& r) { return r.stopped_by; }, "The event that ended it.")
      .def_property_readonly(
          "statistics", [](const recording_object& r) { return statistics_of(r.statistics); },
          "Counts of steps, rejected steps, evaluations, Jacobians and factorizations, since the start: a dict.")
      .def_property_readonly(
          "chain", [](const recording_object& r) { return std::make_unique<chain_object>(r.chain); },
          "The chain, with inputs for the forces of `control`.")
      .def("columns", &columns_of,
           "columns(names=None)\n\nQuantities by their names: a dict of arrays, t first. Without names coordinates, "
           "inputs, internal states, and poses of frames. Names are those of docs/recorders.md.",
           "names"_a = py::none())
      .def("__getitem__",
           [](const recording_object& r, py::handle names) -> py::object {
             auto all = columns_of(r, names);
             PyDict_DelItemString(all.ptr(), "t");
             if (py::isinstance<py::str>(names) && py::len(all) == 1) return py::list(all.attr("values")())[0];
             return all;
           })
      .def(
          "to_pandas",
          [](const recording_object& r, py::handle names) {
            return py::module_::import("pandas").attr("DataFrame")(columns_of(r, names));
          },
          "to_pandas(names=None)\n\nThe table of `columns` as a pandas DataFrame.", "names"_a = py::none())
      .def("__len__", &recording_object::rows)
      .def(py::pickle(&state_of, &recording_from))
      .def("__repr__", [](const recording_object& r) {
        const auto text = [](double x) { return py::str(py::float_(x)).cast<std::string>(); };
        std::string s = "<kte.Recording: " + std::to_string(r.rows()) + " rows";
        if (r.rows() > 0) s += " from t = " + text(r.t.front()) + " to " + text(r.t.back()) + " s";
        if (!r.events.empty()) s += ", " + std::to_string(r.events.size()) + " events";
        return s + ">";
      });
  m.def("_write_page", &write_page, "x"_a, "path"_a, "title"_a, "columns"_a, "mesh_bytes"_a, "recording_bytes"_a);
}

}  // namespace kte_python
