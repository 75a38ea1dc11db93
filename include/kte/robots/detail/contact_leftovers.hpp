#pragma once

#include <kte/robots/detail/xml_item.hpp>

#include <set>

namespace kte::detail {

/// The properties of contacts in a file that are not read: one warning with their names.
class contact_leftovers {
 public:
  void add(const xml_item& x, std::string_view property) {
    if (!first_) first_.emplace(x);
    names_.emplace(property);
  }
  void warn() const {
    if (!first_) return;
    std::string all;
    for (const auto& n : names_) all += (all.empty() ? "" : ", ") + n;
    first_->moves_differently("of the properties of contacts these are not read: " + all);
  }

 private:
  std::optional<xml_item> first_;
  std::set<std::string> names_;
};

}  // namespace kte::detail
