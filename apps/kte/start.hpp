#pragma once

#include <kte/loops.hpp>

#include <Eigen/Core>

#include "mechanism.hpp"

namespace kte_tool {

/// The initial state of a mechanism on the command line.
struct start_options {
  std::string table, configuration;
  bool given() const { return !table.empty() || !configuration.empty(); }
};
/// --start and --configuration.
command& add_start(command& c, start_options& o);

/// q and v at the start: those of the table; for coordinates without columns those of the named configuration,
/// otherwise the neutral configuration at rest. Open loops are closed from there, with a message; coordinates with a
/// column are held, unless all have one. Throws `cannot_assemble`, `unknown_name` for a configuration that the file
/// does not have, `bad_file` for a table without a row or without columns of the mechanism.
struct initial_state {
  Eigen::VectorXd q, v;

  initial_state(const start_options& o, const mechanism& m, const kte::runtime_chain& c);

 private:
  void close_loops(const mechanism& m, const kte::runtime_chain& c, const kte::held_coordinates& held);
};

}  // namespace kte_tool
