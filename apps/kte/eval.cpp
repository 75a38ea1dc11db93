#include "commands.hpp"
#include "digits50.hpp"
#include "eval/rows.hpp"
#include "eval/static_program.hpp"
#include "message.hpp"

namespace kte_tool {

namespace {

struct eval_options {
  reading in;
  evaluate::options what;
  std::string states, digits = "17";
  bool by_type = false;
};

int eval(eval_options& o) {
  if (o.digits != "17" && o.digits != "50") throw usage_error("--precision is 17 or 50, not '" + o.digits + "'");
  o.what.digits = o.digits == "50" ? 50 : 17, o.what.states = o.states;
  try {
    evaluate::operations::of(o.what.ops, false);
  } catch (const kte::bad_argument& e) {
    throw usage_error(std::string(e.what()).substr(5));
  }
  const evaluate::evaluated_robot r(read_and_warn(o.in));
  if (kte::detail::has_loops(r.chain)) {
    const auto ops = evaluate::operations::of(o.what.ops, o.what.derivatives);
    if ((ops.asked && ops.id) || ops.g || ops.h || ops.did || ops.dfd)
      throw kte::bad_argument(
          "kte: the robot has closed loops: --ops fd, m, energy and com are evaluated with them; id, g, h, did and dfd "
          "are not, as the forces of its coordinates are not unique");
    if (!ops.asked) say("the robot has closed loops, so inverse dynamics is left out");
    o.what.loops = true;
  }
  if (o.by_type) return evaluate::run_static(r, o.what);
  if (o.what.digits == 50) {
    print_with_50_digits(r, o.what);
  } else {
    evaluate::runtime_model<double> evaluated(r.chain, o.what.frames);
    print_rows(evaluated, evaluate::state_table(o.what.states), r.coordinates, o.what);
  }
  return 0;
}

}  // namespace

void add_eval(command_line& line) {
  const auto o = std::make_shared<eval_options>();
  add_reading(
      line.add("eval", "computes dynamics at the states of a table",
               "Prints inverse and forward dynamics, mass matrix, energies and centre of mass at the states of a "
               "table. The table has a line of column names (q_0, q_1, ..., v_0, ..., and optionally a_0, ..., tau_0, "
               "...), then one line of numbers per state. Coordinates are in the order of the file."),
      o->in, false)
      .word("STATES", o->states, "the table, with commas between numbers")
      .text("--ops", "NAMES", o->what.ops,
            "only these operations, separated by commas: id, fd, m, g (gravity forces), h (gravity and "
            "velocity-dependent forces), energy, com, did and dfd (derivatives)")
      .texts("--frame", "NAME", o->what.frames,
             "adds the pose of this frame and its Jacobian in world axes; repeatable")
      .flag("--derivatives", o->what.derivatives, "adds the derivatives of inverse and forward dynamics by q and v")
      .text("--precision", "DIGITS", o->digits, "17, the default, or 50: computes with 50 digits")
      .flag("--static", o->by_type, "runs a program for this robot, compiled once and cached")
      .runs([o] { return eval(*o); });
}

}  // namespace kte_tool
