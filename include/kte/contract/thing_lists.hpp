#pragma once

#include <kte/contract/thing.hpp>

#include <tuple>
#include <utility>
#include <vector>

namespace kte::detail {

template <class S, std::size_t Kind>
struct list_of_kind {
  std::vector<std::tuple_element_t<Kind, things<S>>> items;
};
/// All items of a chain, by kind and index. (A std::tuple would instantiate all its constructors.)
template <class S, class Kinds = std::make_index_sequence<kinds>>
class thing_lists;
template <class S, std::size_t... K>
class thing_lists<S, std::index_sequence<K...>> : list_of_kind<S, K>... {
 public:
  /// Makes count(k) items of each kind k.
  template <class Count>
  explicit thing_lists(const Count& count)
      : list_of_kind<S, K>{
            decltype(list_of_kind<S, K>::items)(static_cast<std::size_t>(count(static_cast<kind>(K))))}... {}

  template <kind What>
  KTE_INLINE auto& get(int i) {
    return list_of_kind<S, static_cast<std::size_t>(What)>::items[static_cast<std::size_t>(i)];
  }
  template <kind What>
  KTE_INLINE const auto& get(int i) const {
    return list_of_kind<S, static_cast<std::size_t>(What)>::items[static_cast<std::size_t>(i)];
  }
};

}  // namespace kte::detail
