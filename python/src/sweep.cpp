#include <kte/sweep.hpp>

#include <condition_variable>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <thread>

#include "call.hpp"
#include "native_run.hpp"
#include "parts.hpp"
#include "sweep_cases.hpp"

namespace kte_python {

namespace {

using kte::detail::sweep_rows;

/// An object of Python that threads without the GIL may copy.
using shared_object = std::shared_ptr<const py::object>;
shared_object shared(py::object o) {
  return {new py::object(std::move(o)), [](const py::object* p) {
            const py::gil_scoped_acquire with;
            delete p;
          }};
}

/// The text of an exception of a function of the program.
std::string reason_of(const py::error_already_set& e) {
  const auto text = py::str(e.value()).cast<std::string>();
  if (py::isinstance(e.value(), py::module_::import("kte.errors").attr("Error"))) return text;
  return py::str(e.type().attr("__name__")).cast<std::string>() + (text.empty() ? "" : ": " + text);
}

/// A function of the program: function(number of the case, values) returns the kept numbers.
class python_run {
 public:
  python_run(py::object function, stop_flag stop) : function_(shared(std::move(function))), stop_(std::move(stop)) {}
  void operator()(const kte::sweep_cases& cases, const column_names& kept, std::uint64_t begin, std::uint64_t end,
                  sweep_rows& out) {
    const py::gil_scoped_acquire with;
    for (std::uint64_t i = begin; i < end; ++i) {
      if (*stop_) throw stopped{};
      py::list values;
      for (std::size_t j = 0; j < cases.names().size(); ++j) values.append(cases(i, j));
      try {
        const auto x = (*function_)(i, values).cast<std::vector<double>>();
        kte::detail::check_kept(x, kept.size());
        out.add(
            i, [&x](std::size_t k) { return x[k]; }, kept);
      } catch (const py::error_already_set& e) {
        if (!e.matches(PyExc_Exception)) throw;
        out.add_failure(i, reason_of(e));
      } catch (const kte::error& e) {
        out.add_failure(i, in_python(e.what()));
      }
    }
  }

 private:
  shared_object function_;
  stop_flag stop_;
};

/// A simulation or operation, without the GIL; `packs`: in packs where it can be.
class run_of_library {
 public:
  run_of_library(std::shared_ptr<const native_run> run, bool packs, stop_flag stop)
      : run_(std::move(run)), packs_(packs), stop_(std::move(stop)) {}
  void operator()(const kte::sweep_cases& cases, const column_names& kept, std::uint64_t begin, std::uint64_t end,
                  sweep_rows& out) {
    const auto run = run_->clone();
    std::vector<double> values(cases.names().size()), numbers;
    std::vector<std::vector<double>> done;
    if (packs_) done = run->in_packs(cases, begin, end);
    for (std::uint64_t i = begin; i < end; ++i) {
      if (*stop_) throw stopped{};
      numbers.clear();
      if (packs_) numbers = std::move(done[static_cast<std::size_t>(i - begin)]);
      try {
        if (numbers.empty()) {
          for (std::size_t j = 0; j < values.size(); ++j) values[j] = cases(i, j);
          (*run)(values, numbers);
        }
        out.add(
            i, [&numbers](std::size_t k) { return numbers[k]; }, kept);
      } catch (const std::exception& e) {
        out.add_failure(i, in_python(e.what()));
      }
    }
  }

 private:
  std::shared_ptr<const native_run> run_;
  bool packs_;
  stop_flag stop_;
};

using failures = std::vector<std::pair<std::uint64_t, std::string>>;

/// Results that come from elsewhere: fetch(begin, end) returns numbers, (cases, columns), and failures.
class fetched_run {
 public:
  explicit fetched_run(py::object fetch) : fetch_(shared(std::move(fetch))) {}
  void operator()(const kte::sweep_cases&, const column_names& kept, std::uint64_t begin, std::uint64_t end,
                  sweep_rows& out) {
    const py::gil_scoped_acquire with;
    const auto result = (*fetch_)(begin, end).cast<py::tuple>();
    const auto m = matrix_from("the results of a shard", result[0], static_cast<Py_ssize_t>(end - begin),
                               static_cast<Py_ssize_t>(kept.size()));
    out.numbers.resize(static_cast<std::size_t>(m.size()));
    write(m, out.numbers.data());
    for (const auto& [i, reason] : result[1].cast<failures>()) out.failures.push_back({i, reason});
  }

 private:
  shared_object fetch_;
};

bool is_simulation(py::handle run) {
  return py::isinstance(run, py::module_::import("kte.sweeps").attr("SimulationRun"));
}
std::unique_ptr<native_run> run_from(py::handle run, const column_names& columns, const column_names& quantities,
                                     stop_flag stop) {
  if (is_simulation(run)) return make_simulation_run(run, columns, quantities, std::move(stop));
  return make_operation_run(run, columns, quantities);
}
/// The function of a sweep: a callable, or a run of the library, the quantities that it keeps, and whether it may
/// compute cases in packs.
kte::detail::range_function function_from(py::object run, const column_names& columns, stop_flag stop) {
  if (!py::isinstance<py::tuple>(run)) return python_run(std::move(run), std::move(stop));
  const auto [native, quantities, packs] = run.cast<std::tuple<py::object, column_names, bool>>();
  return run_of_library(run_from(native, columns, quantities, stop), packs, stop);
}

/// Runs shards in threads, while this one looks for Ctrl-C, which ends the sweep, as an exception of a shard does.
class watched_threads {
 public:
  watched_threads(std::size_t threads, stop_flag stop) : threads_(threads), stop_(std::move(stop)) {}
  void operator()(std::size_t tasks, const std::function<void(std::size_t)>& task) const {
    std::exception_ptr failure, interrupted;
    std::mutex guard;
    std::condition_variable changed;
    bool done = false;
    std::thread team([&] {
      try {
        kte::batch::threads{threads_}(tasks, [&](std::size_t i) {
          try {
            if (!*stop_) task(i);
          } catch (const stopped&) {
          } catch (...) {
            *stop_ = true;
            throw;
          }
        });
      } catch (...) {
        failure = std::current_exception();
      }
      const std::lock_guard lock(guard);
      done = true, changed.notify_one();
    });
    std::unique_lock lock(guard);
    while (!changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return done; })) {
      lock.unlock();
      try {
        const py::gil_scoped_acquire with;
        if (!interrupted && PyErr_CheckSignals() != 0) throw py::error_already_set();
      } catch (...) {
        interrupted = std::current_exception(), *stop_ = true;
      }
      lock.lock();
    }
    lock.unlock();
    team.join();
    if (interrupted) std::rethrow_exception(interrupted);
    if (failure) std::rethrow_exception(failure);
  }

 private:
  std::size_t threads_;
  stop_flag stop_;
};

/// Runs shards in the order in which `completed` gives their numbers.
class by_completion {
 public:
  explicit by_completion(py::object completed) : completed_(shared(std::move(completed))) {}
  void operator()(std::size_t, const std::function<void(std::size_t)>& task) const {
    const py::gil_scoped_acquire with;
    for (const auto i : *completed_) {
      const auto number = i.cast<std::size_t>();
      const py::gil_scoped_release without;
      task(number);
    }
  }

 private:
  shared_object completed_;
};

py::object as_python(const kte::sweep_progress& p) {
  return result("SweepProgress", py::make_tuple(p.total, p.found, p.done, p.failed, p.seconds, p.rate(), p.left()));
}
py::dict statistics_of(const kte::sweep_summary& s) {
  py::dict all;
  for (const auto& c : s.statistics)
    all[py::str(c.name)] = result("ColumnStatistics", py::make_tuple(c.count, c.least, c.most, c.mean, c.deviation()));
  return all;
}
py::object as_python(const kte::sweep_summary& s) {
  return result("SweepSummary", py::make_tuple(s.cases, s.failed, statistics_of(s)));
}
py::tuple as_python(const kte::sweep_table& t) {
  py::dict columns;
  for (std::size_t j = 0; j < t.rows.names.size(); ++j) {
    const auto& x = t.rows.columns[j];
    columns[py::str(t.rows.names[j])] =
        to_array(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()))));
  }
  py::list reasons;
  for (const auto& f : t.failures) reasons.append(result("SweepFailure", py::make_tuple(f.index, f.reason)));
  return py::make_tuple(columns, reasons, as_python(t.summary));
}

using named_texts = std::vector<std::pair<std::string, std::string>>;

kte::sweep_options options_from(std::uint64_t shard_size, const std::string& note, const named_texts& depends_on,
                                py::object progress) {
  kte::sweep_options o{.shard_size = shard_size, .note = note, .depends_on = depends_on};
  if (progress.is_none()) return o;
  o.progress = [report = shared(std::move(progress))](const kte::sweep_progress& p) {
    const py::gil_scoped_acquire with;
    (*report)(as_python(p));
  };
  return o;
}

py::object run_sweep(const cases_object& cases, const column_names& kept, py::object run, py::object to,
                     std::size_t threads, std::uint64_t shard_size, const std::string& note,
                     const named_texts& depends_on, py::object progress, py::object completed) {
  const auto stop = std::make_shared<std::atomic<bool>>(false);
  auto options = options_from(shard_size, note, depends_on, std::move(progress));
  kte::detail::range_function f;
  if (completed.is_none()) {
    options.executor = watched_threads(threads, stop);
    f = function_from(std::move(run), cases.cases.names(), stop);
  } else {
    options.executor = by_completion(std::move(completed));
    f = fetched_run(std::move(run));
  }
  const kte::sweep sweep(cases.cases, kept, std::move(f), std::move(options));
  if (to.is_none()) {
    kte::sweep_table table;
    {
      const py::gil_scoped_release without;
      table = sweep.table();
    }
    return as_python(table);
  }
  const auto path = to.cast<std::filesystem::path>();
  kte::sweep_summary summary;
  {
    const py::gil_scoped_release without;
    summary = sweep.to(path);
  }
  return as_python(summary);
}

/// The numbers that a simulation or operation keeps for these columns; throws for what it does not know.
column_names kept_names(py::handle run, const column_names& columns, const column_names& quantities) {
  return run_from(run, columns, quantities, std::make_shared<std::atomic<bool>>(false))->kept();
}

std::vector<std::uint64_t> missing_shards(const cases_object& cases, const column_names& kept, py::handle to,
                                          std::uint64_t shard_size, const std::string& note,
                                          const named_texts& depends_on) {
  const auto f = [](const auto&) { return std::array<double, 0>(); };
  const kte::sweep sweep(cases.cases, kept, f, options_from(shard_size, note, depends_on, py::none()));
  if (!to.is_none()) return sweep.missing(to.cast<std::filesystem::path>());
  std::vector<std::uint64_t> all(static_cast<std::size_t>(sweep.shards()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

/// The cases from `begin` on with these values, by a worker: kept numbers and failures.
py::tuple run_range(const column_names& columns, const column_names& kept, py::object run, std::uint64_t begin,
                    py::handle values) {
  const auto width = static_cast<Py_ssize_t>(columns.size());
  const auto x = std::make_shared<const Eigen::MatrixXd>(
      matrix_from("values", values, py::cast<py::array>(values).shape(0), width));
  const auto count = static_cast<std::uint64_t>(x->rows());
  const kte::sweep_cases cases(columns, begin + count, [x, begin](std::uint64_t i, std::size_t j) {
    return (*x)(static_cast<Eigen::Index>(i - begin), static_cast<Eigen::Index>(j));
  });
  auto f = function_from(std::move(run), columns, std::make_shared<std::atomic<bool>>(false));
  sweep_rows rows;
  rows.begin = begin, rows.columns = kept.size();
  {
    const py::gil_scoped_release without;
    f(cases, kept, begin, begin + count, rows);
  }
  array numbers({x->rows(), static_cast<Eigen::Index>(kept.size())});
  std::copy(rows.numbers.begin(), rows.numbers.end(), numbers.mutable_data());
  failures all;
  for (const auto& each : rows.failures) all.emplace_back(each.index, each.reason);
  return py::make_tuple(numbers, all);
}

}  // namespace

void bind_sweep(py::module_& m) {
  using namespace py::literals;
  m.def("_run_sweep", &run_sweep, "cases"_a, "kept"_a, "run"_a, "to"_a, "threads"_a, "shard_size"_a, "note"_a,
        "depends_on"_a, "progress"_a, "completed"_a);
  m.def("_kept_names", &kept_names, "run"_a, "columns"_a, "quantities"_a);
  m.def("_missing_shards", &missing_shards, "cases"_a, "kept"_a, "to"_a, "shard_size"_a, "note"_a, "depends_on"_a);
  m.def("_run_range", &run_range, "columns"_a, "kept"_a, "run"_a, "begin"_a, "values"_a);
}

}  // namespace kte_python
