#include "call.hpp"

#include <kte/dynamics/packs/batch.hpp>

#include <charconv>

namespace kte_python {

namespace {

/// The number of states of a task: of about 20 ms, with `size` the number of elements.
std::size_t states_in_task(std::size_t size, double cost, std::size_t most) {
  const double states = 1e6 / (static_cast<double>(size) * cost + 1);
  return static_cast<std::size_t>(std::clamp(states, 1.0, static_cast<double>(most)));
}

/// All states, in tasks of some each, without the GIL.
class several_states {
 public:
  several_states(const kte::runtime_chain& c, const workspace& w, const std::vector<numbers>& in,
                 const std::vector<double*>& out, const std::vector<std::size_t>& sizes, std::size_t count, double cost,
                 state_function f)
      : chain_(c),
        made_(w),
        in_(in),
        out_(out),
        sizes_(sizes),
        count_(count),
        chunk_(states_in_task(size_of(c), cost, 256)),
        f_(f) {}

  std::size_t tasks() const { return (count_ + chunk_ - 1) / chunk_; }
  void operator()(std::size_t task) {
    workspace w = made_;
    std::vector<double*> to(out_.size());
    const std::size_t last = std::min((task + 1) * chunk_, count_);
    for (std::size_t k = task * chunk_; k < last; ++k) {
      for (std::size_t i = 0; i < in_.size(); ++i)
        in_[i].read(in_[i].several() ? static_cast<Py_ssize_t>(k) : 0, w.x[i]);
      for (std::size_t i = 0; i < to.size(); ++i) to[i] = out_[i] + k * sizes_[i];
      try {
        f_(chain_, w, to.data());
      } catch (const kte::error& e) {
        failure_.at(k, e);
        for (std::size_t i = 0; i < to.size(); ++i)
          std::fill_n(to[i], sizes_[i], std::numeric_limits<double>::quiet_NaN());
      }
    }
  }
  void raise() const { failure_.raise(); }

 private:
  const kte::runtime_chain& chain_;
  const workspace& made_;
  const std::vector<numbers>& in_;
  const std::vector<double*>& out_;
  const std::vector<std::size_t>& sizes_;
  std::size_t count_, chunk_;
  state_function f_;
  kte::batch::detail::failure failure_;
};

std::string text_of(const shape& s) {
  std::string text;
  for (const auto n : s) text += (text.empty() ? "" : " x ") + std::to_string(n);
  return text;
}
/// The leading axes of arguments, nothing for one state; throws `bad_argument` unless they are the same in all
/// arguments of several states.
shape leading_axes(const std::vector<numbers>& in) {
  const numbers* first = nullptr;
  for (const auto& x : in) {
    if (!x.several()) continue;
    if (!first) first = &x;
    if (x.leading() != first->leading())
      throw kte::bad_argument(std::string("kte: ") + x.name() + " has " + text_of(x.leading()) + " states, " +
                              first->name() + " has " + text_of(first->leading()));
  }
  return first ? first->leading() : shape{};
}

/// An array without dimensions is a number.
py::object as_result(array& made) {
  if (made.ndim() == 0) return py::float_(*made.data());
  return std::move(made);
}
py::object as_result(std::vector<array>& made) {
  if (made.size() == 1) return as_result(made[0]);
  py::tuple all(made.size());
  for (std::size_t i = 0; i < made.size(); ++i) all[i] = as_result(made[i]);
  return all;
}

/// One state by a function of a compiled chain.
void call_compiled(const evaluate::library_function& f, const workspace& w, double* const* out) {
  const double* const in[]{w.x[0].data(), w.x[1].data(), w.x[2].data(), w.x[3].data()};
  evaluate::library_failure failure;
  f.one(in, out, failure);
  raise(failure);
}
/// The failure of a state of a part of all states that begins at `first`, with its number in all.
std::string numbered_from(std::size_t first, std::string_view text, std::size_t& state) {
  constexpr std::string_view before = "kte: state ";
  if (!text.starts_with(before)) return std::string(text);
  const auto end = std::from_chars(text.data() + before.size(), text.data() + text.size(), state).ptr;
  state += first;
  return std::string(before) + std::to_string(state) + std::string(end, text.data() + text.size());
}
/// Many states by a function of a compiled chain, in tasks of `chunk`; `sizes` are the numbers of a state in `in`, and
/// `size` that in `out`.
void call_compiled(const evaluate::library_function& f, std::size_t states, std::size_t chunk,
                   const std::vector<const double*>& in, const std::vector<std::size_t>& sizes, double* out,
                   std::size_t size, const interruptible_threads& team) {
  std::mutex guard;
  evaluate::library_failure failure;
  std::size_t failed = states;
  team((states + chunk - 1) / chunk, [&](std::size_t task) {
    const std::size_t first = task * chunk, count = std::min(chunk, states - first);
    std::vector<const double*> from(in.size());
    for (std::size_t i = 0; i < in.size(); ++i) from[i] = in[i] + first * sizes[i];
    evaluate::library_failure of_task;
    f.many(count, from.data(), out + first * size, 1, of_task);
    if (of_task.what == evaluate::library_failure::kind::none) return;
    std::size_t state = 0;
    const auto text = numbered_from(first, of_task.text, state);
    const std::lock_guard lock(guard);
    if (state >= failed) return;
    failed = state, failure.what = of_task.what;
    failure.text[text.copy(failure.text, sizeof failure.text - 1)] = '\0';
  });
  raise(failure);
}

}  // namespace

std::size_t threads_from(py::handle threads) {
  if (!threads || threads.is_none()) return std::max(1U, std::thread::hardware_concurrency());
  const auto n = threads.cast<long long>();
  if (n < 1) throw kte::bad_argument("kte: threads must be at least 1, got " + std::to_string(n));
  return static_cast<std::size_t>(n);
}

bool nan_for_errors(const std::string& errors) {
  if (errors != "raise" && errors != "nan")
    throw kte::bad_argument("kte: errors must be 'raise' or 'nan', got '" + errors + "'");
  return errors == "nan";
}

py::object call(const chain_object& object, std::initializer_list<argument> arguments,
                const std::vector<shape>& results, double cost, const call_options& options, state_function of_chain,
                pack_function packs_of_chain) {
  const auto& c = object.chain();
  std::vector<numbers> in;
  in.reserve(arguments.size());
  for (const auto& a : arguments) in.emplace_back(a.name, a.value, a.what == argument_of::q ? c.nq() : c.dofs());
  lease work(object);
  for (std::size_t i = 0; i < in.size(); ++i)
    work->x[i].resize(std::data(arguments)[i].what == argument_of::q ? c.nq() : c.dofs());
  const bool has_inputs = options.inputs && !options.inputs.is_none();
  if (has_inputs) work.spoil(), put_inputs(c, work->state, options.inputs);

  const auto* const type =
      object.compiled() && !has_inputs ? object.compiled()->find(options.function, options.frame) : nullptr;
  const std::function<void(const kte::runtime_chain&, workspace&, double* const*)> f =
      [type, &of_chain](const kte::runtime_chain& k, workspace& w, double* const* out) {
        type ? call_compiled(*type, w, out) : of_chain(k, w, out);
      };
  const shape leading = leading_axes(in);
  std::vector<array> made;
  std::vector<double*> out;
  std::vector<std::size_t> sizes;
  for (const auto& one : results) {
    shape all = leading;
    all.insert(all.end(), one.begin(), one.end());
    std::size_t size = 1;
    for (const auto n : one) size *= static_cast<std::size_t>(n);
    made.emplace_back(all), out.push_back(made.back().mutable_data()), sizes.push_back(size);
  }
  if (leading.empty()) {
    for (std::size_t i = 0; i < in.size(); ++i) in[i].read(0, work->x[i]);
    run(c, cost, [&] { f(c, *work, out.data()); });
    return as_result(made);
  }

  Py_ssize_t states = 1;
  for (const auto n : leading) states *= n;
  const std::size_t count = static_cast<std::size_t>(states);
  const bool worth = static_cast<double>(count) * static_cast<double>(size_of(c)) * cost > 4000;
  const interruptible_threads team(worth || options.threads ? threads_from(options.threads) : 1);
  try {
    const bool packs_of_type = type && type->many && c.dofs() > 0;
    if (packs_of_type || (packs_of_chain && !type && !has_inputs && object.has_packs())) {
      std::vector<std::vector<double>> memory(in.size());
      std::vector<const double*> from;
      for (std::size_t i = 0; i < in.size(); ++i) from.push_back(in[i].contiguous(states, memory[i]));
      std::vector<std::size_t> widths;
      for (const auto& a : arguments)
        widths.push_back(static_cast<std::size_t>(a.what == argument_of::q ? c.nq() : c.dofs()));
      const py::gil_scoped_release without;
      if (packs_of_type)
        call_compiled(*type, count, states_in_task(size_of(c), cost, 4096), from, widths, out[0], sizes[0], team);
      else
        packs_of_chain(c, count, from, out[0], team);
    } else {
      const py::gil_scoped_release without;
      several_states all(c, *work, in, out, sizes, count, cost, f);
      if (count > 0) team(all.tasks(), all);
      all.raise();
    }
  } catch (const kte::error&) {
    if (!options.nan_for_errors) throw;
  }
  return as_result(made);
}

py::object result(const char* name, const py::tuple& values) {
  return py::module_::import("kte._results").attr(name)(*values);
}

}  // namespace kte_python
