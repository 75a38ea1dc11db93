#pragma once

#include <kte/dynamics/runtime/jacobian.hpp>

namespace kte::detail {

/// The closures of a chain among its elements, and `with_contacts` its contacts, which are numbered after them.
struct chain_constraints : runtime_elements {
  bool with_contacts = false;

  const runtime_elements& elements() const { return *this; }
  /// Calls f(number of an element that closes a loop, or touches).
  template <class F>
  void each_closure(const F& f) const {
    const auto& elements = chain.wiring().elements;
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (elements[e].closes || (with_contacts && elements[e].touches)) f(static_cast<int>(e));
  }
  closure_rows rows(int e) const { return element(e).rows(); }
  void close_frames(int e, const closing_motion<double>& m, closing what, double* rows) const {
    element(e).close_frames(m, what, rows);
  }
  std::array<double, 2> close_coordinates(int e, const double* q, const double* v, double* gradient) const {
    return element(e).close_coordinates(q, v, gradient);
  }
  bool is_upright(int e, const closing_motion<double>& m) const { return element(e).is_upright(m); }
  bool touches(int e) const { return with_contacts && connection(e).touches; }
  touch touch_at(int e, const closing_motion<double>& m) const { return element(e).touch_at(m); }
  double contact_size(int e) const { return element(e).contact_size(); }
  bool has_gate(int e) const { return element(e).has_gate(); }

  int element_count() const { return static_cast<int>(chain.wiring().elements.size()); }
  /// Whether an element is a joint or a link.
  bool is_transmission(int e) const { return connection(e).rigid; }
  bool is_time(kind what, int slot) const {
    const auto& signals = chain.wiring().signals;
    return std::any_of(signals.begin(), signals.end(),
                       [&](const auto& x) { return x.what == what && x.slot == slot && x.u < 0; });
  }
  int written(int e) const { return runtime_elements::written(e) + (touches(e) ? loops() : 0); }
  int loops() const { return chain.wiring().count(kind::loop); }
  std::string describe(int e) const { return describe_element(element(e)); }
  std::string name_of(kind what, int slot) const {
    return chain.wiring().names[static_cast<std::size_t>(what)][static_cast<std::size_t>(slot)];
  }
  std::string loop_name(int i) const {
    return i < loops() ? name_of(kind::loop, i) : name_of(kind::contact, i - loops());
  }
  /// Changes with the wiring.
  std::shared_ptr<const char> layout() const { return chain.wiring().layout; }
};
inline chain_constraints closures_of(const runtime_chain& c) { return {{c}}; }
inline chain_constraints contacts_of(const runtime_chain& c) { return {{c}, true}; }

}  // namespace kte::detail
