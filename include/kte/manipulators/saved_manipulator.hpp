#pragma once

#include <kte/elements/registry.hpp>
#include <kte/io/limit_records.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>
#include <kte/runtime_chain/from_record.hpp>

/// Loads manipulators with their tools and limits from files. `save_model` and `archive::add` write them like chains.
namespace kte {

/// The manipulator in a model file:
///
///   auto arm = kte::to_manipulator(kte::load_model("arm.json"));
///   auto arm = kte::to_manipulator(archive.model("arm"));
///
/// Limits that the file does not have are infinite. Throws what `to_chain` throws, and `bad_file` for a model without
/// tools; for such a model use `kte::manipulator(kte::to_chain(record), "hand")`.
[[nodiscard]] inline manipulator<runtime_chain> to_manipulator(const model_record& m,
                                                               const element_registry& registry) {
  if (m.tools.empty()) throw bad_file("kte: a chain without tools is not a manipulator");
  const auto c = to_chain(m, registry);
  return {c, m.tools, limits_of(c, m)};
}
template <class = void>
[[nodiscard]] manipulator<runtime_chain> to_manipulator(const model_record& m) {
  return to_manipulator(m, element_registry::standard());
}

/// A static manipulator of the type of `like`, with the numbers and limits of a file. Throws `bad_file`, naming the
/// element or tool that differs and the difference.
template <class Chain, key_type... Tools>
[[nodiscard]] manipulator<Chain, detail::tool_keys<Tools...>> from_record(
    const manipulator<Chain, detail::tool_keys<Tools...>>& like, const model_record& m) {
  const auto wanted = like.tools();
  if (!std::equal(wanted.begin(), wanted.end(), m.tools.begin(), m.tools.end()))
    detail::raise<bad_file>(
        "kte: the tools of the file differ from those of the static manipulator, whose first tool is '" +
        std::string(wanted[0]) + "'");
  const auto c = from_record(like.chain(), m);
  return {c, Tools{}..., limits_of(c, m)};
}

}  // namespace kte
