#pragma once

#include <kte/detail/type_text.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>
#include <kte/runtime_chain/static_chain_map.hpp>

#include <algorithm>
#include <typeinfo>
#include <utility>
#include <vector>

namespace kte {

/// A chain put together at run time, under names that are texts:
///
///   runtime_chain c;
///   c << revolute_joint_2D("q", "base", "joint") << rigid_link_2D("joint", "tip", along_x(0.5));
///
/// The same elements, rules and passes as in a static chain. A static chain is appended as one element, of another
/// runtime chain its elements. Elements do not change once they are in; a chain is a value and may be shared between
/// threads, each with a state of its own. One that is moved from is empty.
class runtime_chain : public kte_map {
 public:
  runtime_chain() = default;
  runtime_chain(const runtime_chain& o) : kte_map(o), gravity_(o.gravity_), gravity_is_written_(o.gravity_is_written_) {
    auto all = o.copies();
    add(all.data(), all.size(), {});
    if (o.use_ == use::whole) topology_.edit().layout = o.topology_->layout;
  }
  runtime_chain(runtime_chain&& o) noexcept { swap(o); }
  runtime_chain& operator=(runtime_chain o) noexcept {
    swap(o);
    return *this;
  }
#ifdef KTE_EXTERN
  ~runtime_chain() override;  // where it is, virtual functions are compiled
#else
  ~runtime_chain() override = default;
#endif

  /// Appends an element, a static chain, or a chain. Throws `bad_wiring`; the chain is then as before.
  template <class Core>
  runtime_chain& operator<<(named_element<Core> e) {
    return append(std::make_unique<kte_map_adapter<Core>>(std::move(e)));
  }
  template <class... Core>
  runtime_chain& operator<<(named_elements<Core...> e) {
    std::apply(
        [this](auto&... each) {
          std::unique_ptr<kte_map> all[]{std::make_unique<kte_map_adapter<Core>>(std::move(each))...};
          add(all, sizeof...(Core), {});
        },
        e.all);
    return *this;
  }
  template <class Gravity, class... E>
  runtime_chain& operator<<(const static_chain<Gravity, E...>& c) {
    return append(std::make_unique<static_chain_map<static_chain<Gravity, E...>>>(c));
  }
  runtime_chain& operator<<(const runtime_chain& c) {
    auto all = c.copies();
    add(all.data(), all.size(), c.gravity_);
    return *this;
  }
  template <class Core, class... Keys>
  runtime_chain& operator<<(const element<Core, Keys...>&) {
    static_assert(
        detail::fit<Core>,
        "kte: a runtime chain is connected by texts; elements with keys are for kte::chain, and static chains "
        "can be appended");
    return *this;
  }
  runtime_chain& operator<<(detail::refused) { return *this; }
  template <class T>
  requires(!std::is_class_v<T>) runtime_chain& operator<<(const T&) {
    static_assert(detail::fit<T>, "kte: a chain is made of elements and of chains, and this is neither");
    return *this;
  }
  /// A runtime chain gives its elements away: what still points to it can only throw `bad_argument`.
  runtime_chain& append(std::unique_ptr<kte_map> e);

  /// Gravity in the axes of the bases, m/s^2; a new state starts with bases accelerated against it. Written here it
  /// holds for the whole, whatever its parts have; else the chain takes that of the first part appended that has one,
  /// not zero, and refuses another (`bad_wiring`). States made before are refused where it changes. Throws
  /// `bad_parameter` for what is not finite.
  template <class X, class Y, class Z>
  runtime_chain& gravity(const vec3<X, Y, Z>& g) {
    detail::check_gravity(g);
    put_gravity(as<double>(g)), gravity_is_written_ = true;
    return *this;
  }
  /// `.gravity({0, 0, -9.81})`
  runtime_chain& gravity(const vec3<>& g) { return gravity<double, double, double>(g); }
  template <class Number>
  runtime_chain& gravity(const Number&) {
    static_assert(detail::fit<Number>,
                  "kte: gravity is a vector in the axes of the bases, m/s^2: .gravity(kte::along_z(-9.81))");
    return *this;
  }
  vec3<> gravity() const override { return gravity_; }

  /// Looked up once, for calls that take a name: a frame of either kind, a coordinate of any kind, an input, an
  /// internal state. Throws `unknown_name`.
  handle frame(std::string_view name) const { return handle_of(name, is_frame, "frame"); }
  handle coordinate(std::string_view name) const { return handle_of(name, is_coordinate, "coordinate"); }
  handle input(std::string_view name) const {
    return handle_of(
        name, [](kind k) { return k == kind::input; }, "input");
  }
  handle internal(std::string_view name) const {
    return handle_of(
        name, [](kind k) { return k == kind::internal; }, "internal state");
  }

  /// A state for this chain: everything at zero and at rest. Throws `bad_wiring` if an element acts on a coordinate
  /// by which nothing moves, `bad_argument` if S is not double and elements have laws of their own.
  template <class S = double>
  basic_runtime_state<S> make_state() const;

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

  /// The signals that elements write (measures, controls), in their order, as of the last doMotion: a name and the
  /// numbers of each.
  struct output {
    std::string_view name;
    std::vector<double> numbers;
  };
  std::vector<output> outputs(const runtime_state& s) const;

  std::unique_ptr<kte_map> clone() const override { return std::make_unique<runtime_chain>(*this); }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const override {
    for (const auto& e : elements_) e->for_each_element(visit);
  }
  const kte_map* unrecorded() const override {
    for (const auto& e : elements_)
      if (const kte_map* part = e->unrecorded()) return part;
    return nullptr;
  }
  /// For elements that hold a chain: it is then a part, without states of its own.
  void connect(topology& t) override {
    for (const auto& e : elements_) e->connect(t);
    topology_ = {}, use_ = use::part;
  }

  /// Throws `bad_argument` if it is part of another chain.
  const topology& wiring() const {
    if (use_ != use::whole) [[unlikely]]
      throw bad_argument("kte: this chain has become part of another one, which alone has its wiring and states");
    return *topology_;
  }
  /// Degrees of freedom, and numbers of a configuration.
  int dofs() const { return wiring().nv; }
  int nq() const { return wiring().nq; }
  /// Throws `bad_argument` unless the state was made for this chain as it is now.
  template <class S>
  void check(const basic_runtime_state<S>& s) const {
    if (use_ != use::part && s.made_for()->layout != wiring().layout) [[unlikely]]
      throw bad_argument(
          "kte: this state was made for another chain, or before the last element was appended or gravity was "
          "changed");
  }

 private:
  using parts = std::vector<std::unique_ptr<kte_map>>;
  enum class use : unsigned char {
    whole,
    part,     ///< its elements are connected to another chain
    emptied,  ///< its elements are in another chain
  };

  handle handle_of(std::string_view name, bool (*fits)(kind), const char* wanted) const;
  parts copies() const;
  vec3<> with_gravity_of(const vec3<>& part) const;
  /// States hold the accelerations of bases against the gravity with which they were made.
  void put_gravity(const vec3<>& g) {
    if (g == gravity_) return;
    if (use_ == use::whole) topology_.edit().layout = std::make_shared<char>();
    gravity_ = g;
  }
  /// All or none: `all` is then moved from, or the chain is as before. (A span takes 200 templates more.)
  void add(std::unique_ptr<kte_map>* all, std::size_t count, const vec3<>& part);
  /// All elements of a chain, which is then of no use; `owner` holds it. Or the chain is as before.
  void take(runtime_chain& c, std::unique_ptr<kte_map> owner);
  void swap(runtime_chain& o) noexcept {
    std::swap(elements_, o.elements_), std::swap(emptied_, o.emptied_), std::swap(topology_, o.topology_);
    std::swap(gravity_, o.gravity_), std::swap(gravity_is_written_, o.gravity_is_written_),
        o.use_ = std::exchange(use_, o.use_);
  }

  parts elements_;
  parts emptied_;  ///< chains that were appended, for those who still point to them
  shared_topology topology_;
  vec3<> gravity_{};
  bool gravity_is_written_ = false;
  use use_ = use::whole;
};
/// The name that it has in ReaK.
using kte_map_chain = runtime_chain;

template <class S>
basic_runtime_state<S> runtime_chain::make_state() const {
  const auto& t = wiring();
  t.check_complete();
  basic_runtime_state<S> s(topology_);
  const vec3<S> up = as<S>(vec3<>{} - gravity_);
  for (std::size_t i = 0; i < t.names[1].size(); ++i)
    if (t.writers[1][i] < 0) s.template get<kind::frame_2D>(static_cast<int>(i)).acceleration = {up.x, up.y};
  for (std::size_t i = 0; i < t.names[2].size(); ++i)
    if (t.writers[2][i] < 0) s.template get<kind::frame_3D>(static_cast<int>(i)).acceleration = up;
  return s;
}
/// The same as of static chains: `c.make_state<S>()`, `c.dofs()`.
template <class S = double>
basic_runtime_state<S> make_state(const runtime_chain& c) {
  return c.make_state<S>();
}
inline int dofs(const runtime_chain& c) { return c.dofs(); }

#ifdef KTE_FUNCTION
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
KTE_FUNCTION runtime_chain& runtime_chain::append(std::unique_ptr<kte_map> e) {
  if (!e) throw bad_argument("kte: nothing can be appended to a chain by a null pointer");
  kte_map& part = *e;
  if (typeid(part) == typeid(runtime_chain)) {
    auto& c = static_cast<runtime_chain&>(part);
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
    if (!all.back()) throw bad_argument("kte: clone() of a part of this chain gave a null pointer");
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
  // The fewer to the more, and no room is kept: a nest is as large as it is deep, not as its square.
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
#endif
#ifdef KTE_EXTERN
KTE_EXTERN template runtime_state runtime_chain::make_state<double>() const;
#endif

/// A runtime chain as plain data; what is in it is listed element by element. Throws `bad_argument` if a part of it is
/// neither an element nor a chain.
model_record record_of(const runtime_chain& c);
#ifdef KTE_FUNCTION
KTE_FUNCTION model_record record_of(const runtime_chain& c) {
  if (const kte_map* part = c.unrecorded())
    throw bad_argument("kte: the chain holds a '" + detail::type_text(*part) +
                       "', which no record or file can hold: it is neither an element (a kte_element) nor a chain");
  model_record r;
  r.gravity = {c.gravity().x, c.gravity().y, c.gravity().z};
  c.for_each_element([&r](const kte_element& e) { r.elements.push_back(e.record()); });
  return r;
}
#endif

}  // namespace kte
