#pragma once

#include <kte/errors.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace kte {

/// A case without a result: its number, and the reason.
struct sweep_failure {
  std::uint64_t index = 0;  ///< the number of the case
  std::string reason;       ///< the text of the exception
  friend bool operator==(const sweep_failure&, const sweep_failure&) = default;
};

namespace detail {

inline void check_kept_size(std::size_t numbers, std::size_t columns) {
  if (numbers != columns)
    raise<bad_argument>("kte: the function of the sweep gave " + std::to_string(numbers) + " numbers for " +
                        std::to_string(columns) + " columns");
}

/// The results of the cases from `begin` on, in order.
struct sweep_rows {
  std::uint64_t begin = 0;
  std::size_t columns = 0;        ///< kept numbers of a case
  std::vector<double> numbers{};  ///< case by case; NaN where a case fails
  std::vector<sweep_failure> failures{};

  [[nodiscard]] std::uint64_t count() const { return columns == 0 ? 0 : numbers.size() / columns; }
  /// Adds a case; number(k): kept number k.
  template <class Number>
  void add(std::uint64_t index, const Number& number, const std::vector<std::string>& names) {
    const char* undefined = nullptr;
    for (std::size_t k = 0; k < columns; ++k) {
      const double x = number(k);
      if (x != x && undefined == nullptr) undefined = names[k].c_str();
      numbers.push_back(x);
    }
    if (undefined != nullptr) failures.push_back({index, "'" + std::string(undefined) + "' is not a number"});
  }
  void add_failure(std::uint64_t index, std::string reason) {
    numbers.insert(numbers.end(), columns, std::numeric_limits<double>::quiet_NaN());
    failures.push_back({index, std::move(reason)});
  }
};

}  // namespace detail
}  // namespace kte
