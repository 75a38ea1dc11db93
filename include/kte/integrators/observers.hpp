#pragma once

#include <kte/integrators/time_grid.hpp>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

/// Output times, stop times, and the values that observers return.
namespace kte {

/// Values that an observer may return, of type bool: `return height > 0 ? kte::go_on : kte::stop`.
inline constexpr bool go_on = true, stop = false;

/// Why an integration ended: it reached `end_time`, or one of the other reasons.
enum class stop_reason {
  end_time,
  terminal,  ///< a terminal event
  zeno,      ///< resets accumulate, two of them cannot be separated, or there are too many events
  observer   ///< an observer returned `stop`
};

namespace detail {
/// A list of times from anything with data() and size(), or from braces; copied.
template <class T>
class time_list {
 public:
  template <class List>
  requires requires(const List& l) {
    { l.data() } -> std::convertible_to<const T*>;
    l.size();
  }
  explicit time_list(const List& times) : times_(times.data(), times.data() + static_cast<std::size_t>(times.size())) {}
  time_list(std::initializer_list<T> times) : times_(times) {}

  std::size_t count() const { return times_.size(); }
  const T& operator[](std::size_t i) const { return times_[i]; }

  /// Throws `bad_argument` unless the times are finite, between t and t_end, and ordered in this direction.
  template <class S>
  void check(const S& t, const S& t_end, const char* name) const {
    S last = t;
    for (std::size_t i = 0; i < times_.size(); ++i) {
      const S now = S(times_[i]);
      const bool follows = t < t_end ? last <= now && now <= t_end : last >= now && now >= t_end;
      if (!follows) [[unlikely]]
        raise<bad_argument>(std::string("kte: ") + name + " " + std::to_string(i) + " is " + number(as_double(now)) +
                            ", not between " + number(as_double(last)) + " and " + number(as_double(t_end)) +
                            ": they go in order from the present time to the end time");
      last = now;
    }
  }

 private:
  std::vector<T> times_;
};
template <class List>
using number_in = std::remove_cvref_t<decltype(*std::declval<const List&>().data())>;
template <class T>
concept single_time = !requires(const T& x) {
  x.data();
};
}  // namespace detail

/// Times at which an observer is called, by dense output: `solver.integrate(10, kte::at(times), observer)`, or
/// `kte::at{0.1, 0.5, 2.0}`. The times are ordered in the direction of integration.
template <class T>
struct at : detail::time_list<T> {
  using detail::time_list<T>::time_list;
  bool event_rows = false;  ///< whether the observer is also called before and after events

  /// Also calls the observer with the states before and after each event that acts, both at its time.
  [[nodiscard]] at with_event_rows() const {
    at all = *this;
    all.event_rows = true;
    return all;
  }
};
template <class List>
at(const List&) -> at<detail::number_in<List>>;
template <detail::single_time T, std::same_as<T>... More>
at(T, More...) -> at<T>;

/// Times at which steps end exactly: `solver.integrate(10, kte::through(times), ...)`. f is evaluated again after each
/// of them, so an observer of every step may change there what f depends on.
template <class T>
struct through : detail::time_list<T> {
  using detail::time_list<T>::time_list;
};
template <class List>
through(const List&) -> through<detail::number_in<List>>;
template <detail::single_time T, std::same_as<T>... More>
through(T, More...) -> through<T>;

namespace detail {

/// The times of samples; count() is their number. Throws `bad_argument` for invalid times.
template <class S>
class even_samples {
 public:
  static constexpr bool has_end = true;
  even_samples(const S& t, const S& t_end, const every<S>& e) : grid_(t, t_end, e.spacing, "spacing of samples") {}
  long long count() const { return grid_.intervals() + 1; }
  S operator[](long long i) const { return grid_[i]; }

 private:
  time_grid<S> grid_;
};
template <class S, class T>
class listed_samples {
 public:
  static constexpr bool has_end = false;
  listed_samples(const S& t, const S& t_end, const at<T>& times) : times_(times) {
    times.check(t, t_end, "output time");
  }
  long long count() const { return static_cast<long long>(times_.count()); }
  S operator[](long long i) const { return S(times_[static_cast<std::size_t>(i)]); }

 private:
  at<T> times_;
};
template <class S, class T>
auto sample_times(const S& t, const S& t_end, const every<T>& e) {
  return even_samples<S>(t, t_end, every<S>(S(e.spacing)));
}
template <class S, class T>
auto sample_times(const S& t, const S& t_end, const at<T>& times) {
  return listed_samples<S, T>(t, t_end, times);
}

struct no_stops {
  static constexpr std::size_t count() { return 0; }
  template <class S>
  static constexpr void check(const S&, const S&, const char*) {}
};

}  // namespace detail
}  // namespace kte
