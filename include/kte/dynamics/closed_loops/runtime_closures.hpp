#pragma once

#include <kte/dynamics/runtime/jacobian.hpp>

namespace kte::detail {

/// The closures of a runtime chain among its elements, in the form of the algorithms on loops. Static chains have the
/// same functions.
struct runtime_closures : runtime_elements {
  const runtime_elements& elements() const { return *this; }
  /// Calls f(number of an element that closes a loop).
  template <class F>
  void each_closure(const F& f) const {
    const auto& elements = chain.wiring().elements;
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (elements[e].closes) f(static_cast<int>(e));
  }
  closure_rows rows(int e) const { return element(e).rows(); }
  void close_frames(int e, const closing_motion<double>& m, closing what, double* rows) const {
    element(e).close_frames(m, what, rows);
  }
  std::array<double, 2> close_coordinates(int e, const double* q, const double* v, double* gradient) const {
    return element(e).close_coordinates(q, v, gradient);
  }
  bool is_upright(int e, const closing_motion<double>& m) const { return element(e).is_upright(m); }
  int element_count() const { return static_cast<int>(chain.wiring().elements.size()); }
  /// Whether an element is a joint or a link.
  bool is_transmission(int e) const { return connection(e).rigid; }
  bool is_time(kind what, int slot) const {
    const auto& signals = chain.wiring().signals;
    return std::any_of(signals.begin(), signals.end(),
                       [&](const auto& x) { return x.what == what && x.slot == slot && x.u < 0; });
  }
  std::string describe(int e) const { return describe_element(element(e)); }
  std::string loop_name(int loop) const {
    return chain.wiring().names[static_cast<std::size_t>(kind::loop)][static_cast<std::size_t>(loop)];
  }
  /// Changes with the wiring.
  std::shared_ptr<const char> layout() const { return chain.wiring().layout; }
};
inline runtime_closures closures_of(const runtime_chain& c) { return {{c}}; }

}  // namespace kte::detail
