#pragma once

#include <kte/events/event_list.hpp>

#include <type_traits>

namespace kte::detail {

/// The events so far, for the report, and whether to stop.
template <class X, class List>
class event_record {
 public:
  using S = typename X::Scalar;

  event_record(List& events, const X& x) : events_(events), latest_{0, S(0), x, x, false, {}, {}, S(0)} {}

  /// Begins an event, with the state before it.
  void before(std::size_t k, std::string_view name, const S& t, const X& x) {
    latest_.event = k;
    latest_.name = name;
    latest_.time = latest_.until = t;
    latest_.before = x;
  }
  /// Completes it, with the state after `reset` or `rest`, and what has changed.
  void after(const X& x, bool rest, std::string_view what = {}) {
    latest_.after = x;
    latest_.what = what;
    latest_.rest = rest;
    if constexpr (std::is_same_v<decltype(events_.sink), no_handler>) {
      report_.events.push_back(latest_);
    } else {
      events_.sink(std::as_const(latest_));
    }
    if (++report_.count > events_.settings.most) stop(stop_reason::zeno, latest_.event, latest_.name);
  }

  /// As `after`, of a bridge to the time t.
  void after_bridge(const S& t, const X& x, std::string_view what) {
    latest_.until = t;
    after(x, false, what);
  }
  /// Stops the integration; the first reason is kept.
  void stop(stop_reason why, std::size_t k, std::string_view name) {
    if (stopped_) return;
    stopped_ = true;
    report_.reason = why;
    report_.stopped_by = k;
    report_.stopped_by_name = name;
  }
  bool stopped() const { return stopped_; }
  event_report<X>& report() { return report_; }

 private:
  List& events_;
  event_occurrence<X> latest_;
  event_report<X> report_;
  bool stopped_ = false;
};

}  // namespace kte::detail
