// Measures, controls and motors in runtime chains.
#include <kte/elements/list/controls.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>

namespace kte {
#undef KTE_ELEMENT
#define KTE_ELEMENT(...) template std::unique_ptr<kte_element> detail::adapted(named_element<core::__VA_ARGS__>);
#include <kte/elements/list/controls.hpp>
}  // namespace kte
