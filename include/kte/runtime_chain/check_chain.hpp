#pragma once

#include <kte/runtime_chain/chain.hpp>

namespace kte {

/// Probable mistakes in a chain, as messages: a coordinate that moves several joints; a degree of freedom that moves
/// only masses on coordinates, if nothing else is connected to it, or if its name is similar to that of a joint
/// coordinate; a degree of freedom that only followers read, if its name is similar to that of a joint coordinate; a
/// follower that nothing reads; a base without a declaration beside declared ones, if no joint or link stands on it, or
/// if its name is similar to that of a frame before it. Of more than 200 names, those after are not compared, which is
/// a finding. Empty without findings.
[[nodiscard]] std::vector<std::string> check_chain(const runtime_chain& c);
/// Probable mistakes in a static chain; see above.
template <class Gravity, class... E>
[[nodiscard]] std::vector<std::string> check_chain(const static_chain<Gravity, E...>& c) {
  runtime_chain r;
  return check_chain(r << c);
}

#ifdef KTE_FUNCTION
namespace detail {
/// Suggestions for names: of the first 200, as each is compared with all others.
class limited_suggestions {
 public:
  std::string did_you_mean(std::string_view written, const std::vector<std::string>& known) {
    return ++count_ > most ? std::string() : detail::did_you_mean(written, known);
  }
  /// Says how many were left out, if any.
  void report(std::vector<std::string>& found) const {
    if (count_ > most)
      found.push_back("the names of " + std::to_string(count_ - most) +
                      " further coordinates are not compared with those of joints, which takes too long: they may be "
                      "misspelt");
  }

 private:
  static constexpr std::size_t most = 200;
  std::size_t count_ = 0;
};
/// The base without a declaration, if others are declared: it may be a misspelt frame, because a chain takes the first
/// frame that is not declared for its base.
inline std::vector<std::string> odd_bases(const topology& t) {
  std::array<std::vector<char>, kinds> declared;
  for (std::size_t k = 0; k < kinds; ++k) declared[k].resize(t.names[k].size());
  bool some = false;
  const auto each_frame = [&t](const auto& visit) {
    for (const auto& e : t.elements)
      for (std::size_t p = 0; p < e.ports.size(); ++p)
        if (is_frame(e.ports[p].what))
          visit(e, e.ports[p].how, static_cast<std::size_t>(e.ports[p].what), static_cast<std::size_t>(e.index[p]));
  };
  each_frame([&](const auto&, access how, std::size_t k, std::size_t i) {
    if (how == access::base) some = true;
    if (how == access::base || t.writers[k][i] >= 0) declared[k][i] = 1;
  });
  const topology::connection* first = nullptr;
  kind what{};
  std::size_t base = 0;
  bool carries = false;
  if (some)
    each_frame([&](const auto& e, access, std::size_t k, std::size_t i) {
      if (declared[k][i]) return;
      if (first == nullptr) first = &e, what = static_cast<kind>(k), base = i;
      carries |= e.rigid;
    });
  if (first == nullptr) return {};
  const auto& frames = t.names[static_cast<std::size_t>(what)];
  const std::vector<std::string> before(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(base));
  const auto meant = did_you_mean(frames[base], before);
  if (carries && meant.empty()) return {};
  const auto own = static_cast<std::size_t>(first->ports.back().what);
  const auto& name = t.names[own][static_cast<std::size_t>(first->index.back())];
  const bool swapped = (first->closes || first->touches) && std::count(before.begin(), before.end(), name) > 0;
  return {t.describe(*first) + " reads '" + frames[base] +
          "', which no element writes or declares: it is a further base" +
          (swapped ? ", and '" + name + "' is a frame: are the names in another order?"
           : meant.empty()
               ? std::string(" (if it is meant, ") + (what == kind::frame_2D ? "base_2D" : "base_3D") + " declares it)"
               : meant)};
}
}  // namespace detail

KTE_FUNCTION std::vector<std::string> check_chain(const runtime_chain& c) {
  const topology& t = c.wiring();
  struct users {
    std::string joints, first_mass, first_follower, writer;
    int joint_count = 0, followers = 0, others = 0;
  };
  std::array<std::vector<users>, kinds> used;
  for (std::size_t k = 0; k < kinds; ++k) used[k].resize(t.names[k].size());
  std::vector<std::string> moving, free;  // coordinates of joints; those that are degrees of freedom
  for (const auto& e : t.elements) {
    const bool follows = is_coordinate(e.ports.back().what) && e.ports.back().how == access::out;
    for (std::size_t p = 0; p < e.ports.size(); ++p) {
      const auto k = static_cast<std::size_t>(e.ports[p].what), i = static_cast<std::size_t>(e.index[p]);
      auto& x = used[k][i];
      if (e.rigid && is_coordinate(e.ports[p].what) && is_frame(e.ports.back().what)) {
        x.joints += (x.joint_count++ == 0 ? "" : ", ") + t.describe(e);
        moving.push_back(t.names[k][i]);
        if (t.writers[k][i] < 0) free.push_back(t.names[k][i]);
      } else if (follows && p + 1 == e.ports.size()) {
        x.writer = t.describe(e);
      } else if (follows) {
        if (x.followers++ == 0) x.first_follower = t.describe(e);
      } else if (e.ports.size() > 1 || !detail::wiring_rules::moves(e.ports[p].how)) {
        ++x.others;
      } else if (x.first_mass.empty()) {
        x.first_mass = t.describe(e);
      }
    }
  }
  auto found = detail::odd_bases(t);
  detail::limited_suggestions suggestions;
  for (const auto& f : t.free) {
    const auto k = static_cast<std::size_t>(f.what), i = static_cast<std::size_t>(f.slot);
    const auto& x = used[k][i];
    const auto& name = t.names[k][i];
    if (x.joint_count > 1)
      found.push_back("'" + name + "' moves " + std::to_string(x.joint_count) + " joints: " + x.joints);
    if (x.joint_count > 0) continue;
    const bool only_leads = x.first_mass.empty() && x.others == 0 && x.followers > 0;
    if (x.first_mass.empty() && !only_leads) continue;
    const auto meant = suggestions.did_you_mean(name, only_leads ? free : moving);
    const std::string separate = " a separate degree of freedom, '" + name + "', by which no joint moves" + meant;
    if (only_leads && !meant.empty())
      found.push_back(x.first_follower + " follows" + separate);
    else if (!only_leads && (x.others + x.followers == 0 || !meant.empty()))
      found.push_back(x.first_mass + " is moved by" + separate);
  }
  for (std::size_t k = 0; k < kinds; ++k)
    for (std::size_t i = 0; i < used[k].size(); ++i)
      if (const auto& x = used[k][i];
          !x.writer.empty() && x.joint_count + x.followers + x.others == 0 && x.first_mass.empty())
        found.push_back(x.writer + " writes '" + t.names[k][i] + "', which nothing reads" +
                        suggestions.did_you_mean(t.names[k][i], free));
  suggestions.report(found);
  return found;
}
#endif

}  // namespace kte
