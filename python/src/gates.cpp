#include "gates.hpp"

#include <kte/runtime_chain/forwarding_element.hpp>

#include <algorithm>

namespace kte_python {

namespace {

/// A rigid contact with a gate of the program.
class gated_contact final : public kte::detail::forwarding_element {
 public:
  gated_contact(std::unique_ptr<kte::kte_element> contact, gate g)
      : contact_(std::move(contact)), gate_(std::move(g)) {}
  gated_contact(const gated_contact& o) : forwarding_element(o), contact_(copy_of(*o.contact_)), gate_(o.gate_) {}
  ~gated_contact() override = default;

  std::unique_ptr<kte::kte_map> clone() const override { return std::make_unique<gated_contact>(*this); }
  kte::element_record record() const override {
    throw kte::bad_argument("kte: " + kte::describe_element(*this) +
                            " has a function of its program, which no record or file can hold");
  }
  bool holds_code() const override { return true; }
  bool has_gate() const override { return true; }
  bool admits(double t, const kte::runtime_state& s) const override { return gate_(t, s); }

 private:
  kte::kte_element& inner() override { return *contact_; }
  const kte::kte_element& inner() const override { return *contact_; }

  std::unique_ptr<kte::kte_element> contact_;
  gate gate_;
};

/// The name of a contact; null for other elements.
const std::string* contact_name(const kte::kte_element& e) {
  const auto& last = e.ports().back();
  return last.what == kte::kind::contact && last.how == kte::access::keep ? &e.names().back() : nullptr;
}

}  // namespace

kte::runtime_chain with_gates(const kte::runtime_chain& c, const std::map<std::string, gate>& gates) {
  if (gates.empty()) return c;
  const auto& names = c.wiring().names[static_cast<std::size_t>(kte::kind::contact)];
  for (const auto& [name, g] : gates) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    std::string known;
    for (const auto& n : names) known += (known.empty() ? " (there are '" : ", '") + n + "'";
    throw kte::unknown_name("kte: only_if: this chain has no rigid contact '" + name + "'" +
                            (known.empty() ? "" : known + ")"));
  }
  kte::runtime_chain all;
  all.gravity(c.gravity());
  c.for_each_element([&](const kte::kte_element& e) {
    auto copy = kte::detail::forwarding_element::copy_of(e);
    const auto* const name = contact_name(e);
    const auto found = name ? gates.find(*name) : gates.end();
    if (found == gates.end())
      all.append(std::move(copy));
    else
      all.append(std::make_unique<gated_contact>(std::move(copy), found->second));
  });
  return all;
}

}  // namespace kte_python
