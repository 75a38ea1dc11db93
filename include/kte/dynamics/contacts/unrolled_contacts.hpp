#pragma once

#include <kte/dynamics/contacts/contact_dynamics_in_lanes.hpp>
#include <kte/dynamics/contacts/ways_of_contacts.hpp>
#include <kte/dynamics/unrolled/articulated.hpp>
#include <kte/dynamics/unrolled/jacobian.hpp>
#include <kte/recursions/inverse_mass.hpp>

/// Accelerations of a static chain with contacts, unrolled. Surfaces are fixed to bases, and bodies are moved by joints
/// and links. The rows of a contact go to the base side by side in the lanes of a register; in packs S of states one by
/// one.
namespace kte::detail {

/// The steps of single states and of packs.
KTE_INLINE void choose_by_motion(const chain_constraints& c, contact_solver& m) {
  choose_contacts(c, m, leaves_by_motion{m}, slides_by_motion{m});
}
template <class S>
KTE_INLINE void choose_by_motion(const chain_constraints& c, contacts_in_lanes<S>& m) {
  m.choose(c);
}
KTE_INLINE bool find_forces(const chain_constraints& c, contact_solver& m) { return solve_friction(c, m); }
template <class S>
KTE_INLINE truth_of_lanes<S> find_forces(const chain_constraints& c, contacts_in_lanes<S>& m) {
  m.solve(c);
  return m.several;
}
inline double length_scale(const contact_solver& m) { return m.equations.places.length; }
template <class S>
double length_scale(const contacts_in_lanes<S>& m) {
  return m.length;
}

/// A chain at rates, with its contacts. `Solver` m: W, bias and forces of the same chain at run time: contact_rows.hpp,
/// or contacts_in_lanes.hpp.
template <class S, class Chain, class Given, class Contacts = typename contacts_among<Chain>::type>
class chain_on_contacts;

template <class S, class Chain, class Given, std::size_t... E>
class chain_on_contacts<S, Chain, Given, std::index_sequence<E...>> : articulated_chain<S, Chain, Given> {
  using base = articulated_chain<S, Chain, Given>;
  using typename base::types;
  using typename base::wiring;
  using simd = tree::simd<S>;
  static constexpr std::size_t lanes = tree::simd_of<S>::count;
  static constexpr std::size_t count = sizeof...(E);
  static constexpr std::array<std::size_t, count> element{E...};
  template <std::size_t C>
  using core_t = core_of<Chain, element[C]>;
  template <std::size_t C>
  using way = way_at_port<Chain, element[C], 1>;
  template <std::size_t C, std::size_t Port>
  static constexpr int slot = wiring::slot(element[C], Port);

 public:
  using typename base::vector;
  KTE_INLINE chain_on_contacts(const Chain& c, const Given& g) : base(c, g) {}
  /// Whether its frames are of this kind.
  static constexpr bool is_supported =
      std::is_same_v<typename base::need, check_need<void, true>> &&
      ((!way_at_port<Chain, E, 0>::moves && way_at_port<Chain, E, 0>::by_joints_and_links &&
        way_at_port<Chain, E, 1>::moves && way_at_port<Chain, E, 1>::by_joints_and_links) &&
       ...);

  /// Accelerations under forces `tau`, and the contact forces, to m. Throws as `accelerate_with_contacts`. Returns
  /// whether there are several solutions.
  template <class Solver>
  KTE_INLINE truth_of_lanes<S> accelerate(const chain_constraints& contacts, Solver& m, const vector& tau, vector& a) {
    truth_of_lanes<S> several{};
    base::accelerate(tau, a, [&](const auto& bodies) KTE_INLINE_LAMBDA {
      this->check_moved();
      unroll<count>([&]<std::size_t C>() KTE_INLINE_LAMBDA { this->template find<C>(contacts, m); });
      choose_by_motion(contacts, m);
      unroll<count>([&]<std::size_t C>() KTE_INLINE_LAMBDA {
        if (m.contacts[C].touches) this->template put_rows<C>(bodies, m);
      });
      m.w.resize(m.bias.size(), m.bias.size());
      unroll<count>([&]<std::size_t C>() KTE_INLINE_LAMBDA {
        unroll<C + 1>([&]<std::size_t D>() KTE_INLINE_LAMBDA {
          if (m.contacts[C].touches && m.contacts[D].touches) this->template multiply<C, D>(m);
        });
      });
      several = find_forces(contacts, m);
      unroll<count>([&]<std::size_t C>() KTE_INLINE_LAMBDA {
        if (m.contacts[C].touches) this->template push<C>(m);
      });
    });
    return several;
  }

 private:
  /// The motion of the frame at a port of a contact, relative to its base, from that of the frame before element N of
  /// the way there.
  template <class Way, std::size_t N = 0, class M>
  KTE_INLINE auto moved(const M& m) const {
    if constexpr (N == Way::length) {
      return motion{m.position, m.rotation, m.velocity, m.ang_velocity, zero3{}, zero3{}};
    } else {
      constexpr std::size_t e = Way::elements[N];
      return moved<Way, N + 1>(compose(m, this->template joint_motion<e>()));
    }
  }
  template <std::size_t C, std::size_t Port>
  KTE_INLINE auto moved() const {
    return moved<branch<Chain, core_t<C>::ports[Port].what, slot<C, Port>>>(
        motion{zero3{}, no_rotation{}, zero3{}, zero3{}, skip{}, skip{}});
  }
  /// The motion of joint or link I.
  template <std::size_t I>
  KTE_INLINE auto joint_motion() const {
    const auto& core = this->chain_.template core<I>();
    if constexpr (coordinates_of<core_of<Chain, I>> == 0) {
      return core.relative();
    } else {
      return relative_at(core, this->template joint_coordinate<I>());
    }
  }
  /// The place and slip velocity of contact C.
  template <std::size_t C, class Solver>
  KTE_INLINE void find(const chain_constraints& contacts, Solver& m) {
    motion_[C] = as_closing_motion<S>(relative(moved<C, 0>(), moved<C, 1>()));
    const auto& core = this->chain_.template core<element[C]>();
    if constexpr (!is_pack<S>)
      m.put_place(contacts, m.contacts[C], [&]() KTE_INLINE_LAMBDA { return core.touch_at(motion_[C]); });
    else if constexpr (requires { requires core_t<C>::touches_in_packs; })
      m.put_place(contacts, m.contacts[C], core.touch_at(motion_[C]));
    else
      m.put_place(contacts, m.contacts[C], [&](std::size_t lane) { return core.touch_at(lane_of(motion_[C], lane)); });
  }
  /// Its rows of B, and `bias`.
  template <std::size_t C, class Bodies, class Solver>
  KTE_INLINE void put_rows(const Bodies& bodies, Solver& m) {
    const auto& x = m.contacts[C];
    const S unit(1 / length_scale(m));
    std::array<S, row_lanes> axis[3]{}, rates{x.place.bending * unit};
    for (std::size_t k = 0; k < 3; ++k)
      axis[0][k] = unit * x.basis[k].x, axis[1][k] = unit * x.basis[k].y, axis[2][k] = unit * x.basis[k].z;
    const auto to_body = transpose(motion_[C].rotation);
    const vec3<S> arm = x.place.point - motion_[C].position;
    const vec3<S> apart = x.place.slip_rate - as<S>(transpose(moved<C, 0>().rotation) * base_acceleration());
    for (std::size_t first = 0; first < core_t<C>::rows.count(); first += lanes) {
      vec3<simd> rows;
      simd rate;
      tree::load<S>(rows.x, axis[0].data() + first), tree::load<S>(rows.y, axis[1].data() + first);
      tree::load<S>(rows.z, axis[2].data() + first), tree::load<S>(rate, rates.data() + first);
      send<C, std::size_t{way<C>::tip}>(
          bodies, first, in_axes_of<core_t<C>::ports[1].what>(to_body * rows, to_body * cross(arm, rows)), rate);
      rate += apart.x * rows.x + apart.y * rows.y + apart.z * rows.z;
      tree::store<S>(rate, rates.data() + first);
    }
    for (int k = 0; k < core_t<C>::rows.count(); ++k) m.bias[x.first + k] = rates[static_cast<std::size_t>(k)];
  }
  template <kind K>
  KTE_INLINE static auto in_axes_of(const vec3<simd>& force, const vec3<simd>& torque) {
    if constexpr (K == kind::frame_2D) {
      return wrench{vec3{force.x, force.y, zero}, vec3{zero, zero, torque.z}};
    } else {
      return wrench{force, torque};
    }
  }
  /// All bases have one acceleration.
  KTE_INLINE auto base_acceleration() const { return -this->chain_.gravity(); }

  /// The loads of contact C at the end of element I, to the base, for rows from `first` on; adds their powers on bias
  /// accelerations to `rate`.
  template <std::size_t C, std::size_t I, class Bodies, class Load>
  KTE_INLINE void send(const Bodies& bodies, std::size_t first, const Load& load, simd& rate) {
    const auto b = bodies.template body<I>();
    using body = std::remove_const_t<decltype(b)>;
    const auto beyond = engine::load_beyond_axes<body::axes - 1>(
        b, load, [](auto) KTE_INLINE_LAMBDA { return zero; }, this->factors_.data() + b.first(),
        [&](int k, const auto& e) KTE_INLINE_LAMBDA {
          const auto row = static_cast<std::size_t>(b.first() + k);
          simd left{};
          add(left, e), add(rate, this->factors_[row].rate * e);
          tree::store<S>(left, left_[row].data() + row_lanes * C + first);
          tree::store<S>(simd(this->factors_[row].inverse * left), rate_[row].data() + row_lanes * C + first);
        });
    add(rate, dot(beyond.force, b.more.bias.linear) + dot(beyond.torque, b.more.bias.angular));
    const auto on_parent = engine::pulled_back(b, beyond);
    constexpr int parent = Bodies::template parent<I>;
    if constexpr (parent >= 0)
      send<C, std::size_t{parent}>(bodies, first, on_parent, rate);
    else
      add(rate, dot(on_parent.force, base_acceleration()));
  }
  template <class X>
  KTE_INLINE static void add(simd& sum, const X& x) {
    if constexpr (!typed_constant<X>) sum += x;
  }
  /// The block of W of contacts C and D.
  template <std::size_t C, std::size_t D, class Solver>
  KTE_INLINE void multiply(Solver& m) const {
    static constexpr const auto& c = way<C>::rows;
    static constexpr const auto& d = way<D>::rows;
    constexpr std::size_t shared = [] {
      std::size_t n = 0;
      while (n < c.count && n < d.count && c.row[n] == d.row[n]) ++n;
      return n;
    }();
    constexpr int of_c = core_t<C>::rows.count(), of_d = core_t<D>::rows.count();
    const Eigen::Index first_c = m.contacts[C].first, first_d = m.contacts[D].first, size = m.w.rows();
    S* const w = m.w.data();
    for (std::size_t first = 0; first < of_c; first += lanes) {
      std::array<simd, of_d> sum{};
      for (std::size_t i = 0; i < shared; ++i) {
        const auto row = static_cast<std::size_t>(c.row[i]);
        simd left;
        tree::load<S>(left, left_[row].data() + row_lanes * C + first);
        for (std::size_t k = 0; k < of_d; ++k) sum[k] += rate_[row][row_lanes * D + k] * left;
      }
      for (int k = 0; k < of_d; ++k) {
        S column[lanes];
        tree::store<S>(sum[static_cast<std::size_t>(k)], column);
        for (int n = 0, r = static_cast<int>(first); n < static_cast<int>(lanes) && r < of_c; ++n, ++r)
          w[(first_d + k) * size + first_c + r] = w[(first_c + r) * size + first_d + k] = column[n];
      }
    }
  }
  /// Adds the effect of the forces of contact C on the rates of axes.
  template <std::size_t C, class Solver>
  KTE_INLINE void push(const Solver& m) {
    const int first = m.contacts[C].first;
    for (std::size_t i = 0; i < way<C>::rows.count; ++i) {
      const auto row = static_cast<std::size_t>(way<C>::rows.row[i]);
      S sum(0);
      for (int k = 0; k < core_t<C>::rows.count(); ++k)
        sum += rate_[row][row_lanes * C + static_cast<std::size_t>(k)] * m.forces[first + k];
      this->factors_[row].rate += sum;
    }
  }

  std::array<closing_motion<S>, count> motion_;  ///< of bodies at surfaces
  using rows_of_contacts = std::array<std::array<S, row_lanes * count>, std::size_t{Chain::dofs} + 1>;
  rows_of_contacts left_, rate_;  ///< by row of v: e and D^-1 e of recursions/inverse_mass.hpp
};

/// A base under gravity, without positions that only contacts read: these place their frames themselves.
template <class Chain>
KTE_INLINE constexpr auto base_beside_contacts(const Chain& c) {
  return base_under_gravity<Chain, Chain::reads_positions_but_contacts>(c);
}
template <class Chain, class S>
using given_on_contacts = given<configuration<S, typename Chain::wiring, const S*>, each<S, const S*>, same<zero_t>,
                                decltype(base_beside_contacts(std::declval<const Chain&>())), true>;
/// Whether it applies to a chain.
template <class Chain, class S>
inline constexpr bool unrolls_contacts = [] {
  if constexpr (!(unrolls_all<Chain::size> && Chain::common_but_contacts && is_tree_of_joints<Chain>))
    return false;
  else if constexpr (!std::is_void_v<first_element<Chain, has_own_loads>>)
    return false;
  else
    return chain_on_contacts<S, Chain, given_on_contacts<Chain, S>>::is_supported;
}();
/// The memory for contacts of the chain at run time.
inline contact_solver& solver_of(const runtime_chain& c, runtime_state& s) { return contact_memory(c, s); }
template <class S>
contacts_in_lanes<S>& solver_of(const runtime_chain& c, basic_runtime_state<S>& s) {
  return contacts_in_lanes_of(c, s).solver();
}

}  // namespace kte::detail
