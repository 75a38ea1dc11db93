#pragma once

#include "session.hpp"

namespace kte::live {

/// Messages to a page: server-sent events `controls`, `state` and `end`; without news a comment, which shows that both
/// are there. Numbers of a state are base64 of float32: 7 of each track, position and quaternion w x y z, q, v,
/// signals, columns.
std::string events_of(const session::page::news& n);

/// Names of columns as a line of a table in CSV has them.
std::vector<std::string> names_in_table(const std::vector<std::string>& names);

}  // namespace kte::live
