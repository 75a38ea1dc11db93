#pragma once

#include <kte/chain/kte_map_adapter.hpp>
#include <kte/chain/static_chain_map.hpp>
#include <kte/detail/type_text.hpp>

#include <utility>
#include <vector>

namespace kte {

/// A chain put together at run time, under names that are texts:
///
///   kte_map_chain c;
///   c << revolute_joint_2D("q", "base", "joint") << rigid_link_2D("joint", "tip", along_x(0.5));
///
/// The same elements, rules and passes as in a static chain. Static chains and other runtime chains are appended as one
/// element. Elements do not change once they are in; a chain is a value and may be shared between threads, each with a
/// state of its own.
class kte_map_chain : public kte_map {
 public:
  kte_map_chain() = default;
  kte_map_chain(const kte_map_chain& o) : kte_map(o), gravity_(o.gravity_) {
    for (const auto& e : o.elements_) append(e->clone());
    if (o.topology_) topology_->layout = o.topology_->layout;
  }
  kte_map_chain(kte_map_chain&&) = default;
  kte_map_chain& operator=(kte_map_chain o) noexcept {
    std::swap(elements_, o.elements_), std::swap(topology_, o.topology_), std::swap(gravity_, o.gravity_);
    return *this;
  }
  ~kte_map_chain() override = default;

  /// Appends an element, a static chain, or a chain. Throws `bad_wiring`; the chain is then as before.
  template <class Core>
  kte_map_chain& operator<<(named_element<Core> e) {
    static_assert(sizeof(detail::check_need<Core, detail::knows_its_needs<Core, runtime_state>>) > 0);
    return append(std::make_unique<kte_map_adapter<Core>>(std::move(e)));
  }
  template <class Gravity, class... E>
  kte_map_chain& operator<<(const static_chain<Gravity, E...>& c) {
    return append(std::make_unique<static_chain_map<static_chain<Gravity, E...>>>(c));
  }
  kte_map_chain& operator<<(const kte_map_chain& c) { return append(c.clone()); }
  template <class Core, class... Keys>
  kte_map_chain& operator<<(const element<Core, Keys...>&) {
    static_assert(
        detail::fit<Core>,
        "kte: a runtime chain is connected by texts; elements with keys are for kte::chain, and static chains "
        "can be appended");
    return *this;
  }
  kte_map_chain& operator<<(detail::refused) { return *this; }
  kte_map_chain& append(std::unique_ptr<kte_map> e) {
    const bool single = dynamic_cast<const kte_element*>(e.get()) != nullptr;
    if (elements_.size() == elements_.capacity()) elements_.reserve(2 * elements_.size() + 8);
    if (single && topology_.use_count() == 1) {
      e->connect(*topology_);
    } else {  // states keep what they were made for, and a chain that fails half-way leaves nothing behind
      auto next = std::make_shared<topology>(*topology_);
      e->connect(*next);
      topology_ = std::move(next);
    }
    elements_.push_back(std::move(e));
    return *this;
  }

  /// Gravity in the axes of the bases, m/s^2; a new state starts with bases accelerated against it.
  template <class X, class Y, class Z>
  kte_map_chain& gravity(const vec3<X, Y, Z>& g) {
    gravity_ = as<double>(g);
    return *this;
  }
  template <class Number>
  kte_map_chain& gravity(const Number&) {
    static_assert(detail::fit<Number>,
                  "kte: gravity is a vector in the axes of the bases, m/s^2: .gravity(kte::along_z(-9.81))");
    return *this;
  }
  const vec3<>& gravity() const { return gravity_; }

  /// A state for this chain: everything at zero and at rest. Throws `bad_wiring` if a force acts on a coordinate that
  /// no element moves by.
  runtime_state make_state() const {
    topology_->check_complete();
    runtime_state s(topology_);
    const auto& t = *topology_;
    const vec3<> up = vec3<>{} - gravity_;
    for (std::size_t i = 0; i < t.names[1].size(); ++i)
      if (t.writers[1][i] < 0) s.get<kind::frame_2D>(static_cast<int>(i)).acceleration = {up.x, up.y};
    for (std::size_t i = 0; i < t.names[2].size(); ++i)
      if (t.writers[2][i] < 0) s.get<kind::frame_3D>(static_cast<int>(i)).acceleration = up;
    return s;
  }

  void doMotion(runtime_state& s) const override {
    check(s);
    for (const auto& e : elements_) e->doMotion(s);
  }
  void clearForce(runtime_state& s) const override {
    check(s);
    for (const auto& e : elements_) e->clearForce(s);
  }
  void doForce(runtime_state& s) const override {
    check(s);
    for (auto e = elements_.rbegin(); e != elements_.rend(); ++e) (*e)->doForce(s);
  }

  std::unique_ptr<kte_map> clone() const override { return std::make_unique<kte_map_chain>(*this); }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const override {
    for (const auto& e : elements_) e->for_each_element(visit);
  }
  const kte_map* unrecorded() const override {
    for (const auto& e : elements_)
      if (const kte_map* part = e->unrecorded()) return part;
    return nullptr;
  }
  void connect(topology& t) override {
    for (const auto& e : elements_) e->connect(t);
    topology_ = nullptr;
  }

  const topology& wiring() const { return *topology_; }
  /// Degrees of freedom, and numbers of a configuration.
  int dofs() const { return topology_->nv; }
  int nq() const { return topology_->nq; }
  /// Throws `bad_argument` unless the state was made for this chain as it is now. (As part of another chain it has no
  /// states of its own.)
  void check(const runtime_state& s) const {
    if (topology_ && s.made_for()->layout != topology_->layout) [[unlikely]]
      throw bad_argument("kte: this state was made for another chain, or before the last element was appended");
  }

 private:
  std::vector<std::unique_ptr<kte_map>> elements_;
  std::shared_ptr<topology> topology_ = std::make_shared<topology>();
  vec3<> gravity_{};
};

/// A runtime chain as plain data; what is in it is listed element by element. Throws `bad_argument` if a part of it is
/// neither an element nor a chain.
inline model_record record_of(const kte_map_chain& c) {
  if (const kte_map* part = c.unrecorded())
    throw bad_argument("kte: the chain holds a '" + detail::type_text(*part) +
                       "', which no record or file can hold: it is neither an element (a kte_element) nor a chain");
  model_record r;
  r.gravity = {c.gravity().x, c.gravity().y, c.gravity().z};
  c.for_each_element([&r](const kte_element& e) { r.elements.push_back(e.record()); });
  return r;
}

}  // namespace kte
