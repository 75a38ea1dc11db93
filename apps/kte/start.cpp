#include "start.hpp"

#include <kte/dynamics/configuration_space.hpp>
#include <kte/robots/detail/robot_findings.hpp>
#include <kte/runtime_chain.hpp>

#include "message.hpp"
#include "state_input.hpp"
#include "text_format.hpp"

namespace kte_tool {

namespace {
Eigen::VectorXd configuration(const std::string& name, const mechanism& m) {
  std::string known;
  for (const auto& c : m.robot.configurations) {
    known += (known.empty() ? "" : ", ") + ("'" + c.name + "'");
    if (c.name == name) return Eigen::Map<const Eigen::VectorXd>(c.q.data(), static_cast<Eigen::Index>(c.q.size()));
  }
  throw kte::unknown_name("kte: " + m.file + " has no configuration '" + name + "'" +
                          (known.empty() ? "" : ", but " + known));
}
/// The configuration in which a robot with contacts stands; that of the file in which its loops are closed and its
/// bodies are above the ground, if it has one; or else the neutral one.
Eigen::VectorXd usual_configuration(const mechanism& m, const kte::runtime_chain& c) {
  if (m.stands) return configuration("standing", m);
  if ((kte::detail::has_loops(c) || !m.robot.contacts.empty()) && c.nq() == m.chain().nq())
    return kte::detail::start_of_loops(m.robot);
  return kte::neutral_configuration(c);
}
}  // namespace

command& add_start(command& c, start_options& o) {
  return c
      .text("--start", "TABLE", o.table,
            "initial q and v, from the first row: columns q_0, ..., v_0, ... as for kte eval, or named as in "
            "recordings; default 0")
      .text("--configuration", "NAME", o.configuration, "initial q: a named configuration of the file (MJCF)");
}

initial_state::initial_state(const start_options& o, const mechanism& m, const kte::runtime_chain& c)
    : q(o.configuration.empty() ? usual_configuration(m, c) : configuration(o.configuration, m)),
      v(Eigen::VectorXd::Zero(c.dofs())) {
  kte::held_coordinates held;
  if (!o.table.empty()) {
    const evaluate::state_table table(o.table);
    if (table.rows() == 0) throw kte::bad_file("kte: " + o.table + ": has no row of numbers");
    const state_input input(table, m, c);
    input.read_q(0, q), input.read_v(0, v);
    const auto all = kte::layout(c);
    for (const auto& e : all)
      if (input.has_q(e.q)) held.names.push_back(e.name);
    if (held.names.size() == all.size()) held.names.clear();
  }
  if (kte::detail::has_loops(c)) close_loops(m, c, held);
}

void initial_state::close_loops(const mechanism& m, const kte::runtime_chain& c, const kte::held_coordinates& held) {
  auto s = c.make_state();
  const auto before = kte::loops(c, s, q);
  if (before.gap > 1e-10) {  // as near as files are written
    q = kte::assemble(c, s, q, held);
    say(m.file + ": the start is assembled: the closure '" + before.widest + "' was open by " +
        short_number(before.gap) + " (m or rad)");
  }
  const Eigen::VectorXd closed = kte::consistent_velocities(c, s, q, v);
  if ((closed - v).cwiseAbs().maxCoeff() > 1e-10 * (1 + v.cwiseAbs().maxCoeff()))
    say(m.file + ": the velocities at the start are the nearest that keep its loops closed");
  v = closed;
}

}  // namespace kte_tool
