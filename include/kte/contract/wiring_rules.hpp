#pragma once

#include <kte/contract/port.hpp>

/// The rules by which elements are connected, for both kinds of chains: static chains ask the compiler, runtime chains
/// as elements are appended. Each says what is wrong in its own words (contract/checks.hpp,
/// runtime_chain/topology.hpp).
namespace kte::detail {

/// What breaks them.
enum class problem : unsigned char {
  none,
  same_text,            ///< the name is that of something else: of another kind, in static chains of another key.
                        ///< (Names of frames live apart from all others.)
  written_twice,        ///< another element has written this name before
  read_before_written,  ///< an element before has read it
  unknown,              ///< nothing before writes it, and it is no base or coordinate of the chain
  moves_nothing         ///< a coordinate that is acted upon or measured, and by which nothing moves
};

/// The state of a name when a port is connected to it.
struct name_before {
  bool used = false;      ///< by a port before
  bool same = false;      ///< as the same thing
  bool declared = false;  ///< written or given by a port before
};

/// Goes through the ports of a chain, in order.
class wiring_rules {
 public:
  constexpr explicit wiring_rules(bool base_known = false) : base_known_(base_known) {}
  constexpr problem broken_by(kind what, access how, const name_before& name) {
    if (name.used) {
      if (!name.same) return problem::same_text;
      if (!port::declares(how)) return problem::none;
      return name.declared ? problem::written_twice : problem::read_before_written;
    }
    if (port::declares(how)) return problem::none;
    if (what == kind::internal) return problem::unknown;
    if (!is_frame(what)) return problem::none;
    if (base_known_) return problem::unknown;
    base_known_ = true;  // the first frame that is read is the base of the chain
    return problem::none;
  }
  /// Whether a use makes a coordinate a degree of freedom, unless an element writes it. One without such a use that
  /// nothing declares moves nothing.
  static constexpr bool moves(access how) { return how == access::in || how == access::angle; }

 private:
  bool base_known_;
};

}  // namespace kte::detail
