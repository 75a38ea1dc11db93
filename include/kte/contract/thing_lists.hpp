#pragma once

#include <kte/contract/thing.hpp>

#include <tuple>
#include <utility>
#include <vector>

namespace kte::detail {

/// All items of a chain, by kind and index.
template <class S, class Kinds = std::make_index_sequence<kinds>>
class thing_lists;
template <class S, std::size_t... K>
class thing_lists<S, std::index_sequence<K...>> {
 public:
  /// Makes count(k) items of each kind k.
  template <class Count>
  explicit thing_lists(const Count& count)
      : of_(std::vector<std::tuple_element_t<K, things<S>>>(static_cast<std::size_t>(count(static_cast<kind>(K))))...) {
  }

  template <kind What>
  KTE_INLINE auto& get(int i) {
    return of_kind<What>(of_)[static_cast<std::size_t>(i)];
  }
  template <kind What>
  KTE_INLINE const auto& get(int i) const {
    return of_kind<What>(of_)[static_cast<std::size_t>(i)];
  }

 private:
  std::tuple<std::vector<std::tuple_element_t<K, things<S>>>...> of_;
};

}  // namespace kte::detail
