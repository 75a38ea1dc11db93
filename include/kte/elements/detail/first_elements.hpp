#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/elements/all.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>

/// The first half of elements/all.hpp in runtime chains: kte::compiled compiles it apart, because it takes long.
namespace kte {

#ifdef KTE_EXTERN
#  define KTE_ELEMENT(...) \
    KTE_EXTERN template std::unique_ptr<kte_element> detail::adapted(named_element<core::__VA_ARGS__>);
#  define KTE_ELEMENT_OF_SECOND_HALF(...)
#  include <kte/elements/all.hpp>
#endif

}  // namespace kte
