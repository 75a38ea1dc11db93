#include "start.hpp"

#include <kte/dynamics/configuration_space.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "state_input.hpp"

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
}  // namespace

command& add_start(command& c, start_options& o) {
  return c
      .text("--start", "TABLE", o.table,
            "initial q and v, from the first row: columns q_0, ..., v_0, ... as for kte eval, or named as in "
            "recordings; default 0")
      .text("--configuration", "NAME", o.configuration, "initial q: a named configuration of the file (MJCF)");
}

initial_state::initial_state(const start_options& o, const mechanism& m, const kte::runtime_chain& c)
    : q(o.configuration.empty() ? Eigen::VectorXd(kte::neutral_configuration(c)) : configuration(o.configuration, m)),
      v(Eigen::VectorXd::Zero(c.dofs())) {
  if (o.table.empty()) return;
  const evaluate::state_table table(o.table);
  if (table.rows() == 0) throw kte::bad_file("kte: " + o.table + ": has no row of numbers");
  const state_input input(table, m, c);
  input.read_q(0, q), input.read_v(0, v);
}

}  // namespace kte_tool
