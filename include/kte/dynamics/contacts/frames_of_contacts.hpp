#pragma once

#include <kte/dynamics/closed_loops/closure_places.hpp>

namespace kte::detail {

/// Raises `bad_argument` for a contact whose frames no joint moves relative to each other: W of it is zero.
template <class State>
void refuse_fixed_frames(const chain_constraints& c, const State& s, const closure_place& x) {
  const char* where = fixed_frames(s, x);
  if (where == nullptr) [[likely]]
    return;
  const auto name = [&c](const runtime_frame& frame) { return "'" + c.name_of(frame.what, frame.index) + "'"; };
  raise<bad_argument>("kte: contact '" + std::string(c.loop_name(x.loop)) + "': no joint moves its frames " +
                      name(x.frame1) + " and " + name(x.frame2) + " relative to each other: they are " + where);
}

}  // namespace kte::detail
