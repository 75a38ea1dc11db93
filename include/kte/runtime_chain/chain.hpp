#pragma once

#include <kte/detail/type_text.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>
#include <kte/runtime_chain/static_chain_map.hpp>

#include <algorithm>
#include <typeinfo>
#include <utility>
#include <vector>

namespace kte {

/// A chain assembled at run time, with texts as names:
///
///   runtime_chain c;
///   c << revolute_joint_2D("q", "base", "joint") << rigid_link_2D("joint", "tip", along_x(0.5));
///
/// Elements, rules and passes are those of static chains. A static chain is appended as one element; of a runtime chain
/// all elements are appended. Appended elements cannot be changed. A chain is a value; it can be shared between
/// threads, each with its own state. A moved-from chain is empty.
class runtime_chain : public kte_map {
 public:
  runtime_chain() = default;
  runtime_chain(const runtime_chain& o)
      : kte_map(o),
        gravity_(o.gravity_),
        gravity_of_lanes_(o.gravity_of_lanes_),
        gravity_is_written_(o.gravity_is_written_) {
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
  ~runtime_chain() override;  // the place of the virtual functions in the library
#else
  ~runtime_chain() override = default;
#endif

  /// Appends an element, a static chain, or a chain. Throws `bad_wiring`, with strong exception guarantee.
  template <class Core>
  runtime_chain& operator<<(named_element<Core> e) {
    return append(detail::adapted(std::move(e)));
  }
  template <class... Core>
  runtime_chain& operator<<(named_elements<Core...> e) {
    std::apply(
        [this](auto&... each) {
          std::unique_ptr<kte_map> all[]{detail::adapted(std::move(each))...};
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
    c.refuse_gravity_of_lanes();
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
    static_assert(detail::fit<T>, "kte: a chain consists of elements and chains; this argument is neither");
    return *this;
  }
  /// Appends an element, a static chain or a chain. The elements of a runtime chain are moved out of it; calls through
  /// other pointers to it throw `bad_argument`. Throws `bad_wiring`.
  runtime_chain& append(std::unique_ptr<kte_map> e);

  /// Sets gravity, m/s^2, in axes of the bases; a new state starts with bases accelerated against it. It applies to the
  /// whole chain, whatever gravity its parts have. Without this call, the chain takes the gravity of the first appended
  /// part with nonzero gravity, and rejects parts with a different one (`bad_wiring`). A change invalidates existing
  /// states. Throws `bad_parameter` unless it is finite.
  template <class X, class Y, class Z>
  runtime_chain& gravity(const vec3<X, Y, Z>& g) {
    detail::check_gravity(g);
    if (!gravity_of_lanes_.empty()) gravity_of_lanes({});
    put_gravity(as<double>(g)), gravity_is_written_ = true;
    return *this;
  }
  /// Sets gravity, m/s^2: `.gravity({0, 0, -9.81})`.
  runtime_chain& gravity(const vec3<>& g) { return gravity<double, double, double>(g); }
  template <class Number>
  runtime_chain& gravity(const Number&) {
    static_assert(detail::fit<Number>,
                  "kte: gravity is a vector in the axes of the bases, m/s^2: .gravity(kte::along_z(-9.81))");
    return *this;
  }
  vec3<> gravity() const override { return gravity_; }
  /// Sets gravity for each lane of packs (`kte::lanes`), m/s^2; an empty list: equal in all lanes.
  runtime_chain& gravity_of_lanes(std::vector<vec3<>> g) {
    for (const auto& x : g) detail::check_gravity(x);
    gravity_of_lanes_.clear();
    if (!g.empty()) gravity(g.front());
    if (use_ == use::whole) topology_.edit().layout = std::make_shared<char>();
    gravity_of_lanes_ = std::move(g);
    return *this;
  }
  const std::vector<vec3<>>& gravity_of_lanes() const { return gravity_of_lanes_; }
  /// The number of lanes with their own parameters or gravity (`kte::lanes`); 1 for other chains.
  [[nodiscard]] std::size_t lanes() const;

  /// A handle of a frame, in the plane or in space, for calls that take a name. Throws `unknown_name`.
  [[nodiscard]] handle frame(std::string_view name) const { return handle_of(name, is_frame, "frame"); }
  /// A handle of a coordinate of any kind. Throws `unknown_name`.
  [[nodiscard]] handle coordinate(std::string_view name) const { return handle_of(name, is_coordinate, "coordinate"); }
  /// A handle of an input. Throws `unknown_name`.
  [[nodiscard]] handle input(std::string_view name) const {
    return handle_of(
        name, [](kind k) { return k == kind::input; }, "input");
  }
  /// A handle of an internal state. Throws `unknown_name`.
  [[nodiscard]] handle internal(std::string_view name) const {
    return handle_of(
        name, [](kind k) { return k == kind::internal; }, "internal state");
  }

  /// A state for this chain: all coordinates and rates are zero, and the bases accelerate against gravity. Throws
  /// `bad_wiring` if an element acts on a coordinate by which nothing moves, `bad_argument` if S is not double and
  /// there are elements other than joints, links and bodies.
  template <class S = double>
  [[nodiscard]] basic_runtime_state<S> make_state() const;

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

  /// A signal that an element writes (measures, controls): its `name` and `numbers`.
  struct output {
    std::string_view name;
    std::vector<double> numbers;
  };
  /// The signals that elements write, in their order, computed by the last doMotion.
  [[nodiscard]] std::vector<output> outputs(const runtime_state& s) const;

  std::unique_ptr<kte_map> clone() const override { return std::make_unique<runtime_chain>(*this); }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const override {
    for (const auto& e : elements_) e->for_each_element(visit);
  }
  const kte_map* unrecorded() const override {
    for (const auto& e : elements_)
      if (const kte_map* part = e->unrecorded()) return part;
    return nullptr;
  }
  /// Makes this chain a part of another one, without its own states.
  void connect(topology& t) override {
    for (const auto& e : elements_) e->connect(t);
    topology_ = {}, use_ = use::part;
  }

  /// The wiring of the chain. Throws `bad_argument` if the chain is part of another one.
  [[nodiscard]] const topology& wiring() const {
    if (use_ != use::whole) [[unlikely]]
      throw bad_argument("kte: this chain is part of another one: use the wiring and states of that one");
    return *topology_;
  }
  /// The wiring of the chain, to share.
  [[nodiscard]] const shared_topology& shared_wiring() const { return (void)wiring(), topology_; }
  /// The number of degrees of freedom.
  [[nodiscard]] int dofs() const { return wiring().nv; }
  /// The number of entries in a configuration q.
  [[nodiscard]] int nq() const { return wiring().nq; }
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
  void refuse_gravity_of_lanes() const {
    if (!gravity_of_lanes_.empty())
      throw bad_argument("kte: a chain with gravity in lanes cannot be a part of another: append it before kte::lanes");
  }
  vec3<> with_gravity_of(const vec3<>& part) const;
  /// States contain the accelerations of bases against the gravity with which they were made.
  void put_gravity(const vec3<>& g) {
    if (g == gravity_) return;
    if (use_ == use::whole) topology_.edit().layout = std::make_shared<char>();
    gravity_ = g;
  }
  /// Adds all parts or none: `all` is then moved from, or the chain is unchanged. (A span would instantiate 200 more
  /// templates.)
  void add(std::unique_ptr<kte_map>* all, std::size_t count, const vec3<>& part);
  /// Takes all elements of a chain, which becomes unusable and is held by `owner`, or leaves this chain unchanged.
  void take(runtime_chain& c, std::unique_ptr<kte_map> owner);
  void swap(runtime_chain& o) noexcept {
    std::swap(elements_, o.elements_), std::swap(emptied_, o.emptied_), std::swap(topology_, o.topology_);
    std::swap(gravity_, o.gravity_), std::swap(gravity_of_lanes_, o.gravity_of_lanes_);
    std::swap(gravity_is_written_, o.gravity_is_written_), o.use_ = std::exchange(use_, o.use_);
  }

  parts elements_;
  parts emptied_;  ///< appended chains, for callers that still point to them
  shared_topology topology_;
  vec3<> gravity_{};
  std::vector<vec3<>> gravity_of_lanes_;  ///< if it differs; gravity_ is then that of the first
  bool gravity_is_written_ = false;
  use use_ = use::whole;
};
/// The name of this class in ReaK.
using kte_map_chain = runtime_chain;

template <class S>
basic_runtime_state<S> runtime_chain::make_state() const {
  const auto& t = wiring();
  t.check_complete();
  if (const auto n = lanes(); n > 1 && n != detail::lanes_in<S>) [[unlikely]]
    throw bad_argument("kte: this chain has " + std::to_string(n) +
                       " lanes, its states are those of packs: make_state" + "<kte::pack<double, " + std::to_string(n) +
                       ">>(chain)");
  basic_runtime_state<S> s(topology_);
  vec3<S> up = as<S>(vec3<>{} - gravity_);
  if constexpr (detail::is_pack<S>)
    for (std::size_t i = 0; i < gravity_of_lanes_.size(); ++i) {
      using number = typename S::value_type;
      const vec3<>& g = gravity_of_lanes_[i];
      up.x.set(i, static_cast<number>(-g.x)), up.y.set(i, static_cast<number>(-g.y));
      up.z.set(i, static_cast<number>(-g.z));
    }
  for (std::size_t i = 0; i < t.names[1].size(); ++i)
    if (t.writers[1][i] < 0) s.template get<kind::frame_2D>(static_cast<int>(i)).acceleration = {up.x, up.y};
  for (std::size_t i = 0; i < t.names[2].size(); ++i)
    if (t.writers[2][i] < 0) s.template get<kind::frame_3D>(static_cast<int>(i)).acceleration = up;
  return s;
}
/// `make_state<S>(c)` and `dofs(c)`, with the names of static chains.
template <class S = double>
[[nodiscard]] basic_runtime_state<S> make_state(const runtime_chain& c) {
  return c.make_state<S>();
}
[[nodiscard]] inline int dofs(const runtime_chain& c) { return c.dofs(); }

#ifdef KTE_EXTERN
KTE_EXTERN template runtime_state runtime_chain::make_state<double>() const;
#endif

/// The record of a runtime chain; elements of its parts are listed one by one. Throws `bad_argument` if a part is
/// neither an element nor a chain.
[[nodiscard]] model_record record_of(const runtime_chain& c);

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/runtime_chain/chain_functions.hpp>
#endif
