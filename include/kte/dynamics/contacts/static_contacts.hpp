#pragma once

#include <kte/dynamics/closed_loops/static_closures.hpp>
#include <kte/dynamics/contacts/check_contact_frames.hpp>
#include <kte/dynamics/contacts/contacts_in_lanes.hpp>
#include <kte/dynamics/contacts/strike.hpp>

namespace kte::detail {

template <class Core>
struct closes_or_touches : std::bool_constant<is_closure<Core> || is_contact<Core>> {};

/// The closures and contacts of a static chain, as in dynamics/contacts/runtime_contacts.hpp.
template <class Chain, class Given>
struct static_contacts : static_closures<Chain, Given, closes_or_touches> {
  static_assert(sizeof(check_contact_frames<Chain>) > 0);
  using base = static_closures<Chain, Given, closes_or_touches>;
  using wiring = typename Chain::wiring;

  bool touches(int e) const {
    bool is = false;
    this->at(e, [&is]<class Core>(const Core&) { is = is_contact<Core>; });
    return is;
  }
  touch touch_at(int e, const closing_motion<double>& m) const {
    touch found;
    this->at(e, [&]<class Core>(const Core& core) {
      if constexpr (is_contact<Core>) found = core.touch_at(m);
    });
    return found;
  }
  double contact_size(int e) const {
    double size = 0;
    this->at(e, [&]<class Core>(const Core& core) {
      if constexpr (is_contact<Core>) size = core.size();
    });
    return size;
  }
  bool has_gate(int e) const {
    bool has = false;
    this->at(e, [&has]<class Core>(const Core&) { has = detail::has_gate<Core>; });
    return has;
  }
  int written(int e) const { return base::written(e) + (touches(e) ? loops() : 0); }
  /// The name of a frame.
  static std::string name_of(kind what, int slot) {
    return what == kind::frame_2D ? base::template name<kind::frame_2D>(slot)
                                  : base::template name<kind::frame_3D>(slot);
  }
  static std::string loop_name(int i) {
    return i < loops() ? base::template name<kind::loop>(i) : base::template name<kind::contact>(i - loops());
  }
  static constexpr int loops() { return wiring::count(kind::loop); }
};

/// The state of a static chain with contacts, and the memory for them.
template <class Chain, class S = double>
struct static_contact_state : static_state<double, Chain> {
  explicit static_contact_state(const Chain& c)
      : static_state<double, Chain>(c), contacts(static_contacts<Chain, nothing>{{{c, nothing_given}}}, *this) {}
  contact_solver contacts;
  impact_memory impacts;

 private:
  static constexpr nothing nothing_given{};
};
/// The memory for the contacts of packs S.
template <class Chain, class S>
requires(is_pack<S>) struct static_contact_state<Chain, S> {
  explicit static_contact_state(const Chain& c)
      : static_contact_state(static_contacts<Chain, nothing>{{{c, nothing_given}}}) {}
  contacts_in_lanes<S> lanes;

 private:
  static constexpr nothing nothing_given{};
  explicit static_contact_state(const static_contacts<Chain, nothing>& contacts)
      : static_contact_state(contacts, static_state<S, Chain>(contacts.chain)) {}
  static_contact_state(const static_contacts<Chain, nothing>& contacts, const static_state<S, Chain>& s)
      : lanes(contacts, s, closure_places(contacts, s)) {}
};

}  // namespace kte::detail
