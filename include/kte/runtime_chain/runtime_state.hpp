#pragma once

#include <kte/contract/thing_lists.hpp>
#include <kte/detail/compiled.hpp>
#include <kte/math/plain_scalar.hpp>
#include <kte/runtime_chain/handle.hpp>
#include <kte/runtime_chain/runtime_tree.hpp>
#include <kte/runtime_chain/shared_topology.hpp>
#include <kte/static_chain/state.hpp>

#include <memory>
#include <utility>

namespace kte {

namespace detail {
/// Memory that a state allocates at first use; copies start without it.
class own_memory {
 public:
  own_memory() = default;
  own_memory(const own_memory&) {}
  own_memory& operator=(const own_memory&) {  // NOLINT(bugprone-unhandled-self-assignment)
    made_.reset();
    return *this;
  }
  template <class T, class Make>
  T& get(const Make& make) {
    if (!made_) made_ = std::make_shared<T>(make());
    return *static_cast<T*>(made_.get());
  }
  /// The memory, or nullptr.
  template <class T>
  T* find() {
    return static_cast<T*>(made_.get());
  }

 private:
  std::shared_ptr<void> made_;
};
}  // namespace detail

/// The state of a runtime chain: every coordinate, frame and input by name, and the working memory of the algorithms.
/// It is a value; a moved-from state is that of an empty chain.
///
///   s.frame_2D("joint").position,  s.coordinate("q").q_ddot,  s.input("motor") = 2.0
///
/// S: double, `pack` for several states at once, or for chains of joints, links and bodies another scalar: float, long
/// double, `dual`, multiprecision numbers. Only `runtime_state`, in double, has passes.
template <class S>
class basic_runtime_state {
 public:
  using scalar = S;
  /// The scalar of parameters: for packs packs too, so that lanes may differ in them (`kte::lanes`).
  using parameter = std::conditional_t<detail::is_pack<S>, S, detail::plain_scalar<S>>;
  using tree_type = detail::runtime_tree<parameter>;
  static constexpr bool has_sines = false;  ///< whether sines of coordinates are stored

  explicit basic_runtime_state(shared_topology t);
  basic_runtime_state(const basic_runtime_state& o);
  basic_runtime_state(basic_runtime_state&& o) noexcept;
  /// Strong exception guarantee. Allocates only if the states are of different chains.
  basic_runtime_state& operator=(const basic_runtime_state& o);
  basic_runtime_state& operator=(basic_runtime_state&& o) noexcept {
    basic_runtime_state moved(std::move(o));
    swap(moved);
    return *this;
  }
  ~basic_runtime_state();

  /// Item i of kind K, for the passes.
  template <kind K>
  KTE_INLINE auto& get(int i) {
    return things_.template get<K>(i);
  }
  template <kind K>
  KTE_INLINE const auto& get(int i) const {
    return things_.template get<K>(i);
  }

 private:
  template <kind K, class Self>
  static auto& at(Self& s, const name_or_handle& name) {
    return s.template get<K>(name.find(*s.topology_, K));
  }

 public:
  /// A coordinate by name or handle. Throws `unknown_name`, `bad_argument`.
  gen_coord<S>& coordinate(const name_or_handle& name) { return at<kind::gen>(*this, name); }
  const gen_coord<S>& coordinate(const name_or_handle& name) const { return at<kind::gen>(*this, name); }
  /// A frame in the plane by name or handle. Throws `unknown_name`, `bad_argument`.
  kte::frame_2D<S>& frame_2D(const name_or_handle& name) { return at<kind::frame_2D>(*this, name); }
  const kte::frame_2D<S>& frame_2D(const name_or_handle& name) const { return at<kind::frame_2D>(*this, name); }
  /// A frame in space by name or handle. Throws `unknown_name`, `bad_argument`.
  kte::frame_3D<S>& frame_3D(const name_or_handle& name) { return at<kind::frame_3D>(*this, name); }
  const kte::frame_3D<S>& frame_3D(const name_or_handle& name) const { return at<kind::frame_3D>(*this, name); }
  /// A signal by name or handle. Throws `unknown_name`, `bad_argument`.
  S& input(const name_or_handle& name) { return at<kind::input>(*this, name); }
  S input(const name_or_handle& name) const { return at<kind::input>(*this, name); }
  /// A signal of three numbers by name or handle.
  vec3<S>& vector(const name_or_handle& name) { return at<kind::vector>(*this, name); }
  const vec3<S>& vector(const name_or_handle& name) const { return at<kind::vector>(*this, name); }
  /// An internal state by name or handle.
  internal_state<S>& internal(const name_or_handle& name) { return at<kind::internal>(*this, name); }
  const internal_state<S>& internal(const name_or_handle& name) const { return at<kind::internal>(*this, name); }
  /// The state of a closed loop by name or handle.
  loop_state<S>& loop(const name_or_handle& name) { return at<kind::loop>(*this, name); }
  const loop_state<S>& loop(const name_or_handle& name) const { return at<kind::loop>(*this, name); }
  /// The state of a contact by name or handle.
  contact_state<S>& contact(const name_or_handle& name) { return at<kind::contact>(*this, name); }
  const contact_state<S>& contact(const name_or_handle& name) const { return at<kind::contact>(*this, name); }
  /// A coordinate that is a rotation, by name or handle.
  rotation_coord_3D<S>& rotation_3D(const name_or_handle& name) { return at<kind::rotation_3D>(*this, name); }
  const rotation_coord_3D<S>& rotation_3D(const name_or_handle& name) const {
    return at<kind::rotation_3D>(*this, name);
  }
  /// A coordinate that is a pose in the plane, by name or handle.
  pose_coord_2D<S>& pose_2D(const name_or_handle& name) { return at<kind::pose_2D>(*this, name); }
  const pose_coord_2D<S>& pose_2D(const name_or_handle& name) const { return at<kind::pose_2D>(*this, name); }
  /// A coordinate that is a pose in space, by name or handle.
  pose_coord_3D<S>& pose_3D(const name_or_handle& name) { return at<kind::pose_3D>(*this, name); }
  const pose_coord_3D<S>& pose_3D(const name_or_handle& name) const { return at<kind::pose_3D>(*this, name); }

  /// An item by key, as in states of static chains. Throws `unknown_name`.
  template <key_type Key>
  const auto& operator[](const Key&) const {
    return at<Key::what>(*this, name_or_handle(std::string_view(Key::name)));
  }

  /// Generalized coordinate number i among the degrees of freedom. Throws `bad_argument` for an i out of range.
  gen_coord<S>& coordinate(int i) { return get<kind::gen>(free_coordinate(i)); }
  const gen_coord<S>& coordinate(int i) const { return get<kind::gen>(free_coordinate(i)); }
  /// The number of degrees of freedom.
  int dofs() const { return topology_->nv; }
  /// The number of entries in a configuration q.
  int nq() const { return topology_->nq; }

  /// The coordinates that are degrees of freedom, with their places in q and v.
  std::span<const detail::freedom> freedoms() const { return topology_->free; }

  /// The wiring of the chain that this state was made for.
  const shared_topology& made_for() const { return topology_; }
  /// The kinematic tree of the chain.
  const tree_type& tree() const { return *tree_; }
  /// The kinematic tree of the chain, shared.
  const std::shared_ptr<const tree_type>& shared_tree() const { return tree_; }

 private:
  int free_coordinate(int i) const {
    detail::check_coordinate(i, static_cast<int>(free_coordinates_.size()));
    return free_coordinates_[static_cast<std::size_t>(i)];
  }
  /// The wiring of an empty chain, for moved-from states. It is made with the first state, because memory may be
  /// exhausted later.
  static const std::shared_ptr<const tree_type>& no_tree() {
    static const auto none = std::make_shared<const tree_type>(detail::tree_of<parameter>(topology()));
    return none;
  }
  void swap(basic_runtime_state& o) noexcept {
    std::swap(topology_, o.topology_), std::swap(things_, o.things_);
    std::swap(free_coordinates_, o.free_coordinates_);
    std::swap(tree_, o.tree_), std::swap(work, o.work), std::swap(before, o.before);
  }

  shared_topology topology_;
  std::shared_ptr<const tree_type> tree_;
  detail::thing_lists<S> things_;
  std::vector<int> free_coordinates_;

 public:
  /// Working memory of the algorithms; not for users.
  detail::loop_memory<parameter, S> work;
  detail::own_memory with_derivatives;
  detail::own_memory loops;
  detail::own_memory lane;      ///< of packs: a state in double for one lane; not for users
  detail::own_memory contacts;  ///< of contact dynamics; not for users
  detail::own_memory impacts;   ///< of impacts; not for users
  std::vector<S> before;        ///< q, v, a that a call has replaced, until the call can no longer fail
};

// Defined outside the class. Members defined in the class would be inline, and g++ also compiles inline members that
// are `extern`.
template <class S>
basic_runtime_state<S>::basic_runtime_state(shared_topology t)
    : topology_(std::move(t)),
      tree_(std::make_shared<tree_type>(detail::tree_of<parameter>(*topology_))),
      things_([this](kind k) { return topology_->count(k); }),
      work(*tree_, topology_->nv, topology_->elements.size()),
      before(static_cast<std::size_t>(topology_->nq + 2 * topology_->nv)) {
  detail::check_scalar<S>(*topology_, *tree_);
  (void)no_tree();
  for (const auto& f : topology_->free)
    if (f.what == kind::gen) free_coordinates_.push_back(f.slot);
}
template <class S>
basic_runtime_state<S>::basic_runtime_state(const basic_runtime_state& o) = default;
template <class S>
basic_runtime_state<S>::basic_runtime_state(basic_runtime_state&& o) noexcept
    : topology_(std::move(o.topology_)),
      tree_(std::exchange(o.tree_, no_tree())),
      things_(std::move(o.things_)),
      free_coordinates_(std::move(o.free_coordinates_)),
      work(std::move(o.work)),
      before(std::move(o.before)) {}
template <class S>
basic_runtime_state<S>& basic_runtime_state<S>::operator=(const basic_runtime_state& o) {
  if (topology_->layout == o.topology_->layout) {
    topology_ = o.topology_, tree_ = o.tree_, things_ = o.things_;
  } else {
    basic_runtime_state copy(o);
    swap(copy);
  }
  return *this;
}
template <class S>
basic_runtime_state<S>::~basic_runtime_state() = default;

#ifdef KTE_EXTERN
KTE_EXTERN template class basic_runtime_state<double>;
#endif

}  // namespace kte
