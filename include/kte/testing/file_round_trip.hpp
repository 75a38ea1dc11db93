#pragma once

#include <kte/elements/base.hpp>
#include <kte/elements/registry.hpp>
#include <kte/testing/detail/states.hpp>

#include <set>

/// Files contain everything about an element.
namespace kte::testing {

namespace detail {
/// A chain with a single element, after declarations of what it reads.
inline runtime_chain declared(const element_record& r, std::span<const port> ports, std::unique_ptr<kte_map> e) {
  runtime_chain c;
  std::set<std::pair<bool, std::string>> known;  // frames have their own namespace
  for (std::size_t p = 0; p < ports.size(); ++p) {
    const kind k = ports[p].what;
    const std::string& name = r.connections[p].name;
    if (port::declares(ports[p].how) || !known.emplace(is_frame(k), name).second) continue;
    if (k == kind::gen) c << base_gen(name);
    if (k == kind::frame_2D) c << base_2D(name);
    if (k == kind::frame_3D) c << base_3D(name);
  }
  c.append(std::move(e));
  return c;
}
/// Whether the element refuses the state, such as a linkage that does not close.
inline bool refuses(const runtime_chain& c, runtime_state s) {
  try {
    c.doMotion(s);
    return false;
  } catch (const error&) {
    return true;
  }
}
}  // namespace detail

/// For elements that files can hold: the registry makes from the record of the element an element with an equal record.
/// Its passes on random motions and loads give equal numbers, or reject the same motions. Returns 0 if so, otherwise
/// the fraction of differing numbers; 1 if the record differs. Throws `bad_file` if the registry rejects the record.
template <class Draw>
double file_round_trip(const kte_element& e, const element_registry& registry, Draw&& draw) {
  const auto record = e.record();
  auto made = registry.make(record);
  const auto* again = dynamic_cast<const kte_element*>(made.get());
  if (!again || again->record() != record) return 1;
  const auto a = detail::declared(record, e.ports(), e.clone()),
             b = detail::declared(record, e.ports(), std::move(made));
  auto s = a.make_state(), t = b.make_state();
  double most = 0;
  for (int i = 0; i < 20; ++i) {
    detail::draw_motion(s, t, draw);
    const bool refused = detail::refuses(a, s);
    if (refused != detail::refuses(b, t)) return 1;
    if (refused) continue;
    most = (std::max)(most, detail::gap_of_passes(a, s, b, t, draw).share());
  }
  return most;
}
template <class Core, class Draw>
double file_round_trip(const named_element<Core>& e, const element_registry& registry, Draw&& draw) {
  return file_round_trip(kte_map_adapter<Core>(e), registry, draw);
}
template <class Core, class... Keys, class Draw>
double file_round_trip(const element<Core, Keys...>& e, const element_registry& registry, Draw&& draw) {
  return file_round_trip(kte::detail::with_texts(e), registry, draw);
}

}  // namespace kte::testing
