#pragma once

#include <kte/dynamics/contacts/contact_dynamics.hpp>

#include <algorithm>

namespace kte {

/// The `names` of contacts, an argument of functions of several contacts. Without names: those that touch.
struct chosen_contacts {
  std::vector<std::string> names;
};
/// The contacts, by texts or keys: `at_contacts("left foot", "right foot")`; `at_contacts()` are those that touch.
template <class... Text>
chosen_contacts at_contacts(const Text&... names) {
  return {{detail::text_of_name(names)...}};
}

namespace detail {
/// Places all contacts, at rest, at the positions of the state; returns the numbers of the chosen ones among contacts.
/// Raises `unknown_name`, and `bad_argument` for a chain without contacts, and for a contact that is named twice. With
/// `rows`: J of all.
std::vector<int> place_contacts(const runtime_chain& c, runtime_state& s, const chosen_contacts& chosen, bool rows);
}  // namespace detail

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

KTE_FUNCTION std::vector<int> place_contacts(const runtime_chain& c, runtime_state& s, const chosen_contacts& chosen,
                                             bool rows) {
  auto& m = contact_memory(c, s);
  if (m.contacts.empty()) throw bad_argument("kte: this chain has no contacts");
  m.equations.at_positions(contacts_of(c), s, rows);
  for (auto& x : m.contacts)
    x.place = runtime_elements{c}.element(m.place(x).element).touch_at(m.equations.place(x.closure));
  std::vector<int> numbers;
  for (const auto& name : chosen.names) {
    std::vector<int> all(m.contacts.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    const int number = named_value(m.result.names, all, name);
    if (std::find(numbers.begin(), numbers.end(), number) != numbers.end())
      throw bad_argument("kte: at_contacts: '" + name + "' is named twice");
    numbers.push_back(number);
  }
  for (std::size_t i = 0; chosen.names.empty() && i < m.contacts.size(); ++i)
    if (m.contacts[i].place.gap <= touching_gap * m.equations.places.length) numbers.push_back(static_cast<int>(i));
  return numbers;
}

}  // namespace kte::detail
#endif
