/// Evaluates a robot of a file at the states of a table: inverse and forward dynamics, mass matrix, energies, centre of
/// mass, frames, derivatives (docs/evaluate.md).
#include <kte/robots/check_robot.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "evaluate/robot_file.hpp"
#include "evaluate/rows.hpp"
#include "evaluate/runtime_model.hpp"
#include "evaluate/static_program.hpp"

namespace {

int check(const evaluate::options& o) {
  const auto found = check_robot(kte::describe_robot(kte::detail::read_file(o.robot), o.robot.string()),
                                 evaluate::robot_options_of(o));
  for (const auto& note : found)
    std::printf("%s%s\n", kte::detail::place_text(o.robot.string(), note.line).c_str(), note.text.c_str());
  if (found.empty()) std::printf("%s: nothing odd is found\n", o.robot.c_str());
  return 0;
}

template <class S>
void print(const evaluate::robot_file& r, const evaluate::options& o) {
  evaluate::runtime_model<S> model(r.chain, o.frames);
  print_rows(model, evaluate::state_table(o.states), r.coordinates, o);
}

int run(int count, char** arguments) {
  const auto o = evaluate::read_options(count, arguments);
  if (o.check) return check(o);
  const auto r = evaluate::read_robot(o);
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
  try {
    return run(count, arguments);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
