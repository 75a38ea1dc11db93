#pragma once

#include <kte/contract/port.hpp>

/// The rules of connections, for both kinds of chains. Static chains apply them at compile time, runtime chains when
/// elements are appended. Each reports violations in its own words (contract/checks.hpp, runtime_chain/topology.hpp).
namespace kte::detail {

/// Violations of the rules.
enum class problem : unsigned char {
  none,
  same_text,            ///< the name belongs to another kind of item, in static chains to another key
                        ///< (frames have their own namespace)
  written_twice,        ///< another element has written this name before
  read_before_written,  ///< an earlier element has read it
  unknown,              ///< no earlier element writes it, and it is neither a base nor a coordinate of the chain
  moves_nothing         ///< a coordinate with forces or sensors by which nothing moves
};

/// The state of a name when a port is connected to it.
struct name_before {
  bool used = false;      ///< an earlier port has the name
  bool same = false;      ///< as an item of this kind
  bool declared = false;  ///< an earlier port has written or declared it
};

/// Applies the rules to the ports of a chain, in order.
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
  /// Whether a use makes a coordinate a degree of freedom, unless an element writes it. A coordinate without such a use
  /// or a declaration moves nothing.
  static constexpr bool moves(access how) { return how == access::in || how == access::angle; }

 private:
  bool base_known_;
};

}  // namespace kte::detail
