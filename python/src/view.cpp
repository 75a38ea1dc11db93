#include <kte/io/recording.hpp>
#include <kte/view.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "call.hpp"
#include "parts.hpp"
#include "recorded_numbers.hpp"
#include "recording.hpp"
#include "robots.hpp"

namespace kte_python {

namespace {

array columns_in(const std::vector<double>& all, std::size_t width, std::size_t first, std::size_t count) {
  const std::size_t rows = width == 0 ? 0 : all.size() / width;
  array out({static_cast<Py_ssize_t>(rows), static_cast<Py_ssize_t>(count)});
  double* to = out.mutable_data();
  for (std::size_t i = 0; i < rows; ++i) to = std::copy_n(all.data() + i * width + first, count, to);
  return out;
}
/// Columns of numbers of a recording, `width` of each row. They cannot be written: that would change nothing.
array rows_of(const recording_object& r, const std::vector<double>& all, std::size_t width, std::size_t first,
              std::size_t count, row_choice which = row_choice::asked) {
  array out({static_cast<Py_ssize_t>(r.rows(which)), static_cast<Py_ssize_t>(count)});
  double* to = out.mutable_data();
  for (std::size_t i = 0; i < r.t.size(); ++i)
    if (r.has(which, i)) to = std::copy_n(all.data() + i * width + first, count, to);
  out.attr("flags").attr("writeable") = false;
  return out;
}
std::size_t nq(const recording_object& r) { return static_cast<std::size_t>(r.chain.nq()); }
std::size_t nv(const recording_object& r) { return static_cast<std::size_t>(r.chain.dofs()); }

/// Quantities by their names; without names, those of `columns`.
kte::detail::recording quantities(const recording_object& r, py::handle names) {
  return {kte::detail::slots_of(r.chain), names.is_none() ? std::vector<std::string>() : names_from(names),
          kte::detail::energy_columns::allowed};
}
/// The columns of a table of quantities, t first.
py::dict columns_of(const recording_object& r, py::handle names, row_choice which = row_choice::asked) {
  const auto what = quantities(r, names);
  const std::size_t columns = what.columns.size() - 1;
  std::vector<double> numbers(r.rows(which) * columns);
  {
    const py::gil_scoped_release without;
    double* to = numbers.data();
    signal_watch watch;
    r.replay(which, [&](double, const kte::runtime_state& s) {
      watch();
      read_numbers(what.cells, r.chain, s, to);
      to += columns;
    });
  }
  py::dict all;
  all["t"] = rows_of(r, r.t, 1, 0, 1, which).attr("ravel")();
  for (std::size_t c = 0; c < columns; ++c)
    all[py::str(what.columns[c + 1])] = columns_in(numbers, columns, c, 1).attr("ravel")();
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

/// A page with all rows, so that it shows states before and after events.
template <class Chain>
kte::scene recorded(const Chain& chain, const recording_object& r, const std::vector<std::string>& columns) {
  std::vector<std::string> of_states, of_chain;
  for (const auto& name : columns) {
    const auto& energies = kte::detail::energy_names;
    const bool is_energy = std::find(energies.begin(), energies.end(), name) != energies.end();
    (is_energy ? of_chain : of_states).push_back(name);
  }
  kte::scene_recording<Chain> scene(chain, {.columns = of_states});
  const kte::detail::recording more({}, of_chain, kte::detail::energy_columns::allowed);
  std::vector<double> row(of_chain.size());
  std::vector<std::vector<double>> numbers(of_chain.size());
  signal_watch watch;
  r.replay(row_choice::all, [&](double t, const kte::runtime_state& s) {
    watch();
    scene.row(t, s);
    read_numbers(more.cells, r.chain, s, row.data());
    for (std::size_t i = 0; i < row.size(); ++i) numbers[i].push_back(row[i]);
  });
  for (std::size_t i = 0; i < row.size(); ++i) scene.add_column(of_chain[i], "J", numbers[i]);
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
  py::class_<recording_object>(
      m, "Recording",
      R"(A motion: times, states and inputs, a row for each time asked for; events are a separate list. Other quantities
are computed when asked for:

    rec["tip/position/x"]               one column
    rec["tip/position"]                 an array with the components as columns
    rec[["q", "q/f"]]                   a dict of columns
    rec.to_pandas(["tip/velocity"])     a table with the column t

`tip/acceleration` of a frame is what an accelerometer measures: g upward at rest.)")
      .def_property_readonly(
          "t", [](const recording_object& r) { return rows_of(r, r.t, 1, 0, 1).attr("ravel")(); }, "Times, s, (rows,).")
      .def_property_readonly(
          "q", [](const recording_object& r) { return rows_of(r, r.x, r.nx, 0, nq(r)); }, "Configurations, (rows, nq).")
      .def_property_readonly(
          "v", [](const recording_object& r) { return rows_of(r, r.x, r.nx, nq(r), nv(r)); }, "Velocities, (rows, nv).")
      .def_property_readonly(
          "z", [](const recording_object& r) { return rows_of(r, r.x, r.nx, nq(r) + nv(r), r.nx - nq(r) - nv(r)); },
          "Internal states of elements, (rows, number).")
      .def_property_readonly(
          "u", [](const recording_object& r) { return rows_of(r, r.u, r.nu, 0, r.nu); }, "Inputs, (rows, number).")
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
      .def(
          "columns",
          [](const recording_object& r, py::handle names, bool event_rows) {
            return columns_of(r, names, event_rows ? row_choice::all : row_choice::asked);
          },
          "columns(names=None, event_rows=False)\n\nQuantities by their names: a dict of arrays, t first. Without "
          "names "
          "coordinates, inputs, internal states, and poses of frames. Names are those of docs/recorders.md. With "
          "event_rows there are also rows before and after each event, both at its time.",
          "names"_a = py::none(), "event_rows"_a = false)
      .def("__getitem__",
           [](const recording_object& r, py::handle names) -> py::object {
             auto all = columns_of(r, names);
             const auto wanted = names_from(names);
             if (std::find(wanted.begin(), wanted.end(), "t") == wanted.end()) PyDict_DelItemString(all.ptr(), "t");
             if (!py::isinstance<py::str>(names)) return all;
             const py::list columns(all.attr("values")());
             if (columns.size() == 1) return columns[0];
             return py::module_::import("numpy").attr("column_stack")(columns);
           })
      .def("__contains__",
           [](const recording_object& r, py::handle name) {
             if (!py::isinstance<py::str>(name)) return false;
             try {
               (void)quantities(r, name);
               return true;
             } catch (const kte::unknown_name&) {
               return false;
             }
           })
      .def("__iter__",
           [](const recording_object& r) {
             py::list names;
             for (const auto& name : quantities(r, py::none()).columns) names.append(name);
             return py::iter(names);
           })
      .def(
          "to_pandas",
          [](const recording_object& r, py::handle names, bool event_rows) {
            const auto which = event_rows ? row_choice::all : row_choice::asked;
            return py::module_::import("pandas").attr("DataFrame")(columns_of(r, names, which));
          },
          "to_pandas(names=None, event_rows=False)\n\nThe table of `columns` as a pandas DataFrame.",
          "names"_a = py::none(), "event_rows"_a = false)
      .def(
          "to_xarray",
          [](const recording_object& r, py::handle names, bool event_rows) {
            const auto all = columns_of(r, names, event_rows ? row_choice::all : row_choice::asked);
            py::dict variables, coordinates;
            for (const auto& [name, column] : all)
              (name.cast<std::string>() == "t" ? coordinates : variables)[name] = py::make_tuple("t", column);
            return py::module_::import("xarray").attr("Dataset")(variables, coordinates);
          },
          "to_xarray(names=None, event_rows=False)\n\nThe table of `columns` as an xarray Dataset over t.",
          "names"_a = py::none(), "event_rows"_a = false)
      .def("__len__", [](const recording_object& r) { return r.rows(row_choice::asked); })
      .def(py::pickle(&state_of, &recording_from))
      .def("__repr__", [](const recording_object& r) {
        const auto text = [](double x) { return py::str(py::float_(x)).cast<std::string>(); };
        const auto asked = rows_of(r, r.t, 1, 0, 1);
        std::string s = "<kte.Recording: " + std::to_string(asked.size()) + " rows";
        if (asked.size() > 0)
          s += " from t = " + text(*asked.data()) + " to " + text(asked.data()[asked.size() - 1]) + " s";
        if (!r.events.empty()) s += ", " + std::to_string(r.events.size()) + " events";
        return s + ">";
      });
  m.def("_write_page", &write_page, "x"_a, "path"_a, "title"_a, "columns"_a, "mesh_bytes"_a, "recording_bytes"_a);
}

}  // namespace kte_python
