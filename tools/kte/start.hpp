#pragma once

#include <kte/loops.hpp>

#include <Eigen/Core>

#include "mechanism.hpp"

namespace kte_tool {

/// Where a mechanism is at the start, as the command line says.
struct start_options {
  std::string table, configuration;
  bool given() const { return !table.empty() || !configuration.empty(); }
};
/// --start and --configuration.
command& add_start(command& c, start_options& o);

/// q and v at the start: those of the table, where it has no columns of the configuration of that name, and else of the
/// neutral configuration at rest. Loops are closed from there, with a message if they were open: coordinates with a
/// column of their own are held, if not all of them have one. Throws `cannot_assemble`, `unknown_name` for a
/// configuration that the file does not have, `bad_file` for a table without a row or without columns of the mechanism.
struct initial_state {
  Eigen::VectorXd q, v;

  initial_state(const start_options& o, const mechanism& m, const kte::runtime_chain& c);

 private:
  void close_loops(const mechanism& m, const kte::runtime_chain& c, const kte::held_coordinates& held);
};

}  // namespace kte_tool
