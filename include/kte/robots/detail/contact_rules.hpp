#pragma once

#include <kte/contract/contact.hpp>
#include <kte/robots/detail/robot_ground.hpp>

#include <map>
#include <set>

namespace kte::detail {

/// Which shapes touch which surfaces of the ground, and with what coefficients.
class contact_rules {
 public:
  contact_rules(const robot_description& d, const robot_contact_options& o)
      : d_(d), o_(o), used_(d.contact_pairs.size(), false) {
    for (std::size_t k = 0; k < d.contact_pairs.size(); ++k) {
      const auto& p = d.contact_pairs[k];
      if (p.excluded)
        excluded_.insert(names(p.name1, p.name2));
      else
        pairs_[names(p.name1, p.name2)].push_back(k);
    }
  }

  /// The law of a shape on a surface, if they touch: by a pair of the file, otherwise by their types, unless their
  /// links are excluded.
  std::optional<contact_law> law(const ground_surface& g, const robot_link& l, const robot_shape& s) {
    const robot_contact_pair* pair = nullptr;
    const bool excluded = excluded_.contains(names(l.name, g.link.empty() ? o_.ground : g.link));
    if (const auto all = pairs_.find(names(s.name, g.name)); !s.name.empty() && all != pairs_.end())
      for (const auto k : all->second) used_[k] = true, pair = &d_.contact_pairs[k];
    if (pair == nullptr && (excluded || !by_type(s.touch, g.touch()))) return {};
    return law_of(s.touch, g.touch(), pair);
  }
  /// Warns of pairs that are not with the ground.
  void note_unused(std::vector<robot_note>& warnings) const {
    for (std::size_t k = 0; k < used_.size(); ++k)
      if (const auto& p = d_.contact_pairs[k]; !used_[k] && !p.excluded)
        warnings.push_back({p.line,
                            "the contact of '" + p.name1 + "' and '" + p.name2 +
                                "' is not one of a moving body with the ground: it is not modelled",
                            p.file, true});
  }

 private:
  using two_names = std::pair<std::string_view, std::string_view>;
  /// In either order.
  static two_names names(std::string_view a, std::string_view b) { return std::minmax(a, b); }
  static bool by_type(const robot_touch& a, const robot_touch& b) {
    return (a.type & b.affinity) != 0 || (b.type & a.affinity) != 0;
  }
  /// The coefficients of the options; otherwise those of the pair, of the shape of higher priority, or the larger ones.
  contact_law law_of(const robot_touch& a, const robot_touch& b, const robot_contact_pair* pair) const {
    const auto chosen = [&](const auto& x, const auto& y) {
      return a.priority > b.priority ? x : b.priority > a.priority ? y : (std::max)(x, y);
    };
    const bool rough = chosen(a.dimensions, b.dimensions) > 1;
    const double of_shapes = rough ? chosen(a.friction, b.friction).value_or(1) : 0;
    contact_law found;
    found.friction = o_.friction.value_or(pair != nullptr ? pair->friction.value_or(of_shapes) : of_shapes);
    found.restitution = o_.restitution.value_or(chosen(a.restitution, b.restitution).value_or(0));
    return found;
  }

  const robot_description& d_;
  const robot_contact_options& o_;
  std::vector<bool> used_;  ///< by pair
  std::map<two_names, std::vector<std::size_t>> pairs_;
  std::set<two_names> excluded_;
};

}  // namespace kte::detail
