#pragma once

#include <kte/dynamics/closed_loops/runtime_closures.hpp>

namespace kte::detail {

/// The closures and contacts of a runtime chain among its elements. Contacts are numbered after the closures.
struct runtime_contacts : runtime_closures {
  template <class F>
  void each_closure(const F& f) const {
    const auto& elements = chain.wiring().elements;
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (elements[e].closes || elements[e].touches) f(static_cast<int>(e));
  }
  bool touches(int e) const { return connection(e).touches; }
  touch touch_at(int e, const closing_motion<double>& m) const { return element(e).touch_at(m); }
  double contact_size(int e) const { return element(e).contact_size(); }
  bool has_gate(int e) const { return element(e).has_gate(); }
  int written(int e) const { return runtime_elements::written(e) + (touches(e) ? loops() : 0); }
  std::string name_of(kind what, int slot) const {
    return chain.wiring().names[static_cast<std::size_t>(what)][static_cast<std::size_t>(slot)];
  }
  std::string loop_name(int i) const {
    return i < loops() ? name_of(kind::loop, i) : name_of(kind::contact, i - loops());
  }
  int loops() const { return chain.wiring().count(kind::loop); }
};
inline runtime_contacts contacts_of(const runtime_chain& c) { return {{{c}}}; }

}  // namespace kte::detail
