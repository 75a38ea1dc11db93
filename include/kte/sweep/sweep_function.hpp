#pragma once

#include <kte/sweep/detail/sweep_rows.hpp>
#include <kte/sweep/sweep_case.hpp>

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace kte {

namespace detail {

/// Computes the cases from `begin` to `end`, exclusive. `names`: of the kept numbers.
using range_function = std::function<void(const sweep_cases&, const std::vector<std::string>& names,
                                          std::uint64_t begin, std::uint64_t end, sweep_rows&)>;

template <class Result>
void check_kept(const Result& kept, std::size_t columns) {
  check_kept_size(static_cast<std::size_t>(kept.size()), columns);
}
template <class P, class Simulation>
class lane_queue;
/// Calls body(), and `failed` with the reason if it throws.
template <class Body, class Failed>
void or_reason(const Body& body, const Failed& failed) {
  try {
    body();
  } catch (const std::exception& e) {
    failed(e.what());
  } catch (...) {
    failed("an exception of unknown type");
  }
}

/// One case after the other: f(const sweep_case<double>&) returns the kept numbers.
template <class F>
class one_by_one {
 public:
  explicit one_by_one(F f) : f_(std::move(f)) {}
  void operator()(const sweep_cases& cases, const std::vector<std::string>& names, std::uint64_t begin,
                  std::uint64_t end, sweep_rows& out) {
    for (std::uint64_t i = begin; i < end; ++i)
      or_reason(
          [&] {
            const auto& kept = f_(sweep_case<double>(cases, i, i));
            check_kept(kept, names.size());
            out.add(
                i, [&kept](std::size_t k) { return static_cast<double>(kept[static_cast<decltype(kept.size())>(k)]); },
                names);
          },
          [&](const char* reason) { out.add_failure(i, reason); });
  }

 private:
  F f_;
};

}  // namespace detail

/// A function of a sweep that computes many cases at a time, one in each lane of packs P:
///
///   kte::in_packs<kte::pack<double, 8>>([](const auto& c) { return std::array{2 * c["length"]}; })
///
/// f(const sweep_case<P>&) returns the kept numbers as packs. Packs are formed from the cases of a shard in order. If f
/// throws, its cases are computed again, each alone in all lanes, to find those that fail. Simulations (`final_state`)
/// may have lanes with their own steps, which get the next case when they end.
template <class P, class F>
class in_packs_of {
 public:
  explicit in_packs_of(F f) : f_(std::move(f)) {}
  void operator()(const sweep_cases& cases, const std::vector<std::string>& names, std::uint64_t begin,
                  std::uint64_t end, detail::sweep_rows& out) {
    if constexpr (in_lanes()) {
      const auto results = detail::lane_queue<P, F>(f_, cases, names.size())(begin, end);
      for (std::uint64_t i = begin; i < end; ++i) {
        const auto& r = results[static_cast<std::size_t>(i - begin)];
        if (r.failure.empty())
          out.add(
              i, [&r](std::size_t k) { return r.kept[k]; }, names);
        else
          out.add_failure(i, r.failure);
      }
    } else {
      by_packs(cases, names, begin, end, out);
    }
  }

 private:
  static constexpr bool in_lanes() {
    if constexpr (requires { F::has_events; })
      return F::template in_lanes<P>;
    else
      return false;
  }
  void by_packs(const sweep_cases& cases, const std::vector<std::string>& names, std::uint64_t begin, std::uint64_t end,
                detail::sweep_rows& out) {
    constexpr std::uint64_t width = P::lanes;
    for (std::uint64_t first = begin; first < end; first += width) {
      const std::uint64_t last = (std::min)(first + width, end) - 1;
      detail::or_reason([&] { add(cases, names, first, last, out); },
                        [&](const char* reason) {
                          if (first == last) return out.add_failure(first, reason);
                          for (std::uint64_t i = first; i <= last; ++i)
                            detail::or_reason([&] { add(cases, names, i, i, out); },
                                              [&](const char* why) { out.add_failure(i, why); });
                        });
    }
  }
  void add(const sweep_cases& cases, const std::vector<std::string>& names, std::uint64_t first, std::uint64_t last,
           detail::sweep_rows& out) {
    const auto& kept = f_(sweep_case<P>(cases, first, last));
    detail::check_kept(kept, names.size());
    for (std::uint64_t i = first; i <= last; ++i)
      out.add(
          i, [&](std::size_t k) { return static_cast<double>(kept[static_cast<decltype(kept.size())>(k)][i - first]); },
          names);
  }
  F f_;
};
/// A function f of a sweep on packs P; see `in_packs_of`.
template <class P, class F>
[[nodiscard]] in_packs_of<P, F> in_packs(F f) {
  return in_packs_of<P, F>(std::move(f));
}

namespace detail {
template <class F>
range_function range_function_of(F f) {
  if constexpr (std::is_invocable_v<F&, const sweep_case<double>&>) {
    return one_by_one<F>(std::move(f));
  } else {
    return f;
  }
}
}  // namespace detail

}  // namespace kte
