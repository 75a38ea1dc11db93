#pragma once

#include <kte/runtime_chain/chain.hpp>

namespace kte {

/// Probable mistakes in a chain, as messages: a coordinate that moves several joints; and a degree of freedom that
/// moves only masses on coordinates, if nothing else is connected to it, or if its name is similar to that of a joint
/// coordinate. Empty without findings.
[[nodiscard]] std::vector<std::string> check_chain(const runtime_chain& c);
/// Probable mistakes in a static chain; see above.
template <class Gravity, class... E>
[[nodiscard]] std::vector<std::string> check_chain(const static_chain<Gravity, E...>& c) {
  runtime_chain r;
  return check_chain(r << c);
}

#ifdef KTE_FUNCTION
KTE_FUNCTION std::vector<std::string> check_chain(const runtime_chain& c) {
  const topology& t = c.wiring();
  struct users {
    std::string joints, first_mass;
    int joint_count = 0, others = 0;
  };
  std::array<std::vector<users>, kinds> used;
  for (std::size_t k = 0; k < kinds; ++k) used[k].resize(t.names[k].size());
  std::vector<std::string> moving;  // coordinates of joints
  for (const auto& e : t.elements)
    for (std::size_t p = 0; p < e.ports.size(); ++p) {
      const auto k = static_cast<std::size_t>(e.ports[p].what), i = static_cast<std::size_t>(e.index[p]);
      auto& x = used[k][i];
      if (e.rigid && is_coordinate(e.ports[p].what) && is_frame(e.ports.back().what)) {
        x.joints += (x.joint_count++ == 0 ? "" : ", ") + t.describe(e);
        moving.push_back(t.names[k][i]);
      } else if (e.ports.size() > 1 || !detail::wiring_rules::moves(e.ports[p].how)) {
        ++x.others;
      } else if (x.first_mass.empty()) {
        x.first_mass = t.describe(e);
      }
    }
  std::vector<std::string> found;
  for (const auto& f : t.free) {
    const auto k = static_cast<std::size_t>(f.what), i = static_cast<std::size_t>(f.slot);
    const auto& [joints, mass, joint_count, others] = used[k][i];
    const auto& name = t.names[k][i];
    if (joint_count > 1) found.push_back("'" + name + "' moves " + std::to_string(joint_count) + " joints: " + joints);
    if (joint_count > 0 || mass.empty()) continue;
    const auto meant = detail::did_you_mean(name, moving);
    if (others == 0 || !meant.empty())
      found.push_back(mass + " is moved by a separate degree of freedom, '" + name + "', by which no joint moves" +
                      meant);
  }
  return found;
}
#endif

}  // namespace kte
