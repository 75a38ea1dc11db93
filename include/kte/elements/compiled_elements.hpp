#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/elements/all.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>

/// The elements of elements/all.hpp in runtime chains, which kte::compiled has compiled.
namespace kte {

#ifdef KTE_EXTERN
#  define KTE_ELEMENT(...) \
    KTE_EXTERN template std::unique_ptr<kte_element> detail::adapted(named_element<core::__VA_ARGS__>);
#  include <kte/elements/all.hpp>
#endif

namespace detail {
template <class, class... Core>
struct core_list {};
#define KTE_ELEMENT(...) , core::__VA_ARGS__
/// Their core types.
using all_cores = core_list<void
#include <kte/elements/all.hpp>
                            >;
}  // namespace detail

}  // namespace kte
