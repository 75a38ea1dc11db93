#pragma once

#include <kte/runtime_chain/chain.hpp>

#ifdef KTE_FUNCTION
/// The functions of runtime chains, compiled once (kte/detail/compiled.hpp).
namespace kte {

#  ifdef KTE_EXTERN
runtime_chain::~runtime_chain() = default;
#  endif
KTE_FUNCTION std::vector<runtime_chain::output> runtime_chain::outputs(const runtime_state& s) const {
  check(s);
  std::vector<output> all;
  for (const auto& e : wiring().elements) {
    const port& last = e.ports.back();
    if (last.how != access::out || !is_signal(last.what)) continue;
    const int slot = e.index.back();
    output y{wiring().names[static_cast<std::size_t>(last.what)][static_cast<std::size_t>(slot)], {}};
    if (last.what == kind::vector) {
      const vec3<>& v = s.get<kind::vector>(slot);
      y.numbers = {v.x, v.y, v.z};
    } else {
      y.numbers = {s.get<kind::input>(slot)};
    }
    all.push_back(std::move(y));
  }
  return all;
}
KTE_FUNCTION std::size_t runtime_chain::lanes() const {
  std::size_t n = gravity_of_lanes_.empty() ? 1 : gravity_of_lanes_.size();
  for (const auto& e : wiring().elements) n = (std::max)(n, e.element->lanes());
  return n;
}
KTE_FUNCTION runtime_chain& runtime_chain::append(std::unique_ptr<kte_map> e) {
  if (!e) throw bad_argument("kte: a null pointer cannot be appended to a chain");
  kte_map& part = *e;
  if (typeid(part) == typeid(runtime_chain)) {
    auto& c = static_cast<runtime_chain&>(part);
    c.refuse_gravity_of_lanes();
    take(c, std::move(e));
  } else {
    add(&e, 1, part.gravity());
  }
  return *this;
}
KTE_FUNCTION handle runtime_chain::handle_of(std::string_view name, bool (*fits)(kind), const char* wanted) const {
  const topology& t = wiring();
  const kind k = t.kind_of(name, fits(kind::frame_3D));
  if (!fits(k))
    throw unknown_name("kte: '" + std::string(name) + "' is " + detail::text_with_article(k) + ", not " +
                       (wanted[0] == 'i' ? "an " : "a ") + wanted);
  return {k, t.find(name, k), t.layout};
}
KTE_FUNCTION runtime_chain::parts runtime_chain::copies() const {
  parts all;
  all.reserve(elements_.size());
  for (const auto& e : elements_) {
    all.push_back(e->clone());
    if (!all.back()) throw bad_argument("kte: clone() of a part of this chain returned a null pointer");
  }
  return all;
}
KTE_FUNCTION vec3<> runtime_chain::with_gravity_of(const vec3<>& part) const {
  if (gravity_is_written_) return gravity_;
  detail::check_one_gravity(boost::hana::make_tuple(gravity_, part));
  return detail::gravity_of_both(gravity_, part);
}
KTE_FUNCTION void runtime_chain::add(std::unique_ptr<kte_map>* all, std::size_t count, const vec3<>& part) {
  (void)wiring();
  const vec3<> g = with_gravity_of(part);
  if (count == 0) return put_gravity(g);
  if (const std::size_t size = elements_.size() + count; size > elements_.capacity())
    elements_.reserve((std::max)(size, 2 * elements_.capacity()));
  topology& t = topology_.edit();
  const auto before = t.size();
  try {
    for (std::size_t i = 0; i < count; ++i) all[i]->connect(t);
  } catch (...) {
    t.cut(before);
    throw;
  }
  for (std::size_t i = 0; i < count; ++i) elements_.push_back(std::move(all[i]));
  gravity_ = g;
}
KTE_FUNCTION void runtime_chain::take(runtime_chain& c, std::unique_ptr<kte_map> owner) {
  // Moves the fewer to the more, without reserve, so that memory grows with the depth of nesting, not with its square.
  parts& more = emptied_.size() < c.emptied_.size() ? c.emptied_ : emptied_;
  parts& fewer = &more == &emptied_ ? c.emptied_ : emptied_;
  if (const std::size_t size = more.size() + fewer.size() + 1; size > more.capacity())
    more.reserve((std::max)(size, 2 * more.capacity()));
  if (elements_.empty() && c.use_ == use::whole) {
    (void)wiring();
    const vec3<> g = with_gravity_of(c.gravity_);
    c.put_gravity(g);
    gravity_ = g;
    elements_.swap(c.elements_), topology_ = std::move(c.topology_);
  } else {
    add(c.elements_.data(), c.elements_.size(), c.gravity_);
    c.elements_.clear(), c.topology_ = {};
  }
  for (auto& e : fewer) more.push_back(std::move(e));
  more.push_back(std::move(owner));
  if (&more != &emptied_) emptied_.swap(more);
  c.emptied_ = parts(), c.use_ = use::emptied;
}
KTE_FUNCTION model_record record_of(const runtime_chain& c) {
  if (const kte_map* part = c.unrecorded())
    throw bad_argument("kte: the chain holds a '" + detail::type_text(*part) +
                       "', which no record or file can hold: it is neither an element (a kte_element) nor a chain");
  model_record r;
  r.gravity = {c.gravity().x, c.gravity().y, c.gravity().z};
  c.for_each_element([&r](const kte_element& e) { r.elements.push_back(e.record()); });
  return r;
}

}  // namespace kte
#endif
