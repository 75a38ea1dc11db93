/// Evaluates a robot of a file at the states of a table: inverse and forward dynamics, mass matrix, energies, centre of
/// mass, frames, derivatives (docs/evaluate.md).
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "evaluate/check.hpp"
#include "evaluate/robot_file.hpp"
#include "evaluate/rows.hpp"
#include "evaluate/runtime_model.hpp"
#include "evaluate/static_program.hpp"

namespace {

template <class S>
void print(const evaluate::robot_file& r, const evaluate::options& o) {
  evaluate::runtime_model<S> model(r.chain, o.frames);
  print_rows(model, evaluate::state_table(o.states), r.coordinates, o);
}

int run(int count, char** arguments) {
  const auto o = evaluate::read_options(count, arguments);
  if (o.help || o.check) {
    kte::detail::write_standard_output(o.help ? evaluate::usage : evaluate::check_text(o));
    return 0;
  }
  const auto r = evaluate::read_robot(o);
  for (const auto& text : r.warnings) std::fprintf(stderr, "evaluate: %s\n", text.c_str());
  if (o.by_type) return evaluate::run_static(r, o, count, arguments);
  if (o.digits == 50)
    print<boost::multiprecision::cpp_bin_float_50>(r, o);
  else
    print<double>(r, o);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 1) {
    std::fputs(evaluate::usage, stderr);
    return 2;
  }
  return kte::detail::exit_code_of([&] { return run(count, arguments); });
}
