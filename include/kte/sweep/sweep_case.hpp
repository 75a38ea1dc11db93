#pragma once

#include <kte/contract/core_in_scalar.hpp>
#include <kte/sweep/sweep_cases.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace kte {

/// One case of a sweep, as the function of the sweep gets it: the values of its columns. S: double, or a pack with
/// cases in its lanes.
template <class S>
class sweep_case {
 public:
  using scalar = S;

  static constexpr std::size_t lanes = detail::lanes_in<S>;

  /// Case `first`; with packs the cases from `first` on, those after `last` replaced by it.
  sweep_case(const sweep_cases& cases, std::uint64_t first, std::uint64_t last) : cases_(cases) {
    for (std::size_t lane = 0; lane < lanes; ++lane) index_[lane] = (std::min)(first + lane, last);
  }
  /// These cases in lanes.
  sweep_case(const sweep_cases& cases, const std::array<std::uint64_t, lanes>& index) : cases_(cases), index_(index) {}

  /// The value of a column by its number.
  [[nodiscard]] S operator[](std::size_t column) const {
    if constexpr (detail::is_pack<S>) {
      S x;
      for (std::size_t lane = 0; lane < std::size_t{S::lanes}; ++lane)
        x.set(lane, static_cast<typename S::value_type>(cases_(index(lane), column)));
      return x;
    } else {
      return static_cast<S>(cases_(index_[0], column));
    }
  }
  /// The value of a column by its name. Throws `unknown_name`.
  [[nodiscard]] S operator[](std::string_view name) const {
    const auto& names = cases_.names();
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) detail::raise<unknown_name>("kte: the cases have no column '" + std::string(name) + "'");
    return (*this)[static_cast<std::size_t>(at - names.begin())];
  }
  [[nodiscard]] S operator[](const char* name) const { return (*this)[std::string_view(name)]; }
  /// The number of the case, or of that in a lane.
  [[nodiscard]] std::uint64_t index(std::size_t lane = 0) const { return index_[lane]; }

 private:
  const sweep_cases& cases_;
  std::array<std::uint64_t, lanes> index_;
};

}  // namespace kte
