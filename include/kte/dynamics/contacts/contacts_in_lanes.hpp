#pragma once

#include <kte/contact/detail/friction_in_lanes.hpp>
#include <kte/dynamics/contacts/contact_forces.hpp>

/// The contacts of packs S of states. Lanes may differ in the contacts that touch and slide. The modes that velocities
/// tell, where contacts at rest stick, are solved for all lanes at once (contact/detail/friction_in_lanes.hpp). Lanes
/// whose solution they are not are solved alone, as single states.
namespace kte::detail {

template <class S>
struct contact_in_lanes {
  int closure = 0;  ///< its number among closures and contacts
  int slot = 0;     ///< its number among contacts
  int loop = 0;     ///< the number of its name
  bool planar = false;
  basic_touch<S> place{};
  S friction{};
  S closed{}, slides{};  ///< 1 in lanes where it touches, and slides; 0 in others
  contact_basis<S> basis{};
  bool touches = false;  ///< whether it touches in a lane
  int first = 0;         ///< its first row among those that touch
  struct entries_at {
    int axis = 0;
    std::array<S, 3> left{}, rate{};  ///< e, D^-1 e of tree/loop_loads.hpp
  };
  std::vector<entries_at> path;  ///< in a tree, axes in descending order
  int rows() const { return planar ? 2 : 3; }
};

/// The friction problem of one lane, as `find_friction` reads it.
struct friction_of_lane {
  kept_size<Eigen::MatrixXd> w;
  kept_size<Eigen::VectorXd> bias, forces;
  std::vector<friction_contact<>> laws;
  std::vector<int> touching;  ///< numbers of contacts
  std::vector<int> first;     ///< their first rows
  std::vector<contact_mode> modes;
  friction_solver<double> solver;
  bool polish = false;
  double residual = 0;

  struct rows_of_contact {
    int first;
  };
  rows_of_contact touched(std::size_t i) const { return {first[i]}; }
};

template <class S>
class contacts_in_lanes {
  static constexpr std::size_t lanes = std::size_t{S::lanes};

 public:
  /// `places`: those of the closures and contacts of the chain.
  template <class State>
  contacts_in_lanes(const chain_constraints& c, const State& s, const closure_places& places) : length(places.length) {
    for (std::size_t i = 0; i < places.closures.size(); ++i) {
      const auto& at = places.closures[i];
      if (!c.touches(at.element)) continue;
      refuse_fixed_frames(c, s, at);
      contact_in_lanes<S> x;
      x.closure = static_cast<int>(i), x.slot = at.loop - c.loops(), x.loop = at.loop;
      x.planar = at.rows.count() == 2;
      contacts.push_back(x);
    }
  }

  double length;  ///< of the chain, m
  std::vector<contact_in_lanes<S>> contacts;
  kept_size<Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>> w;  ///< W of contacts that touch in a lane
  kept_size<Eigen::Matrix<S, Eigen::Dynamic, 1>> bias, forces;    ///< u' without contact forces; lambda
  truth_of_lanes<S> several{};

  /// The place of a contact in each lane, by touch_at(lane). Errors name the contact and the lane.
  template <class TouchAt>
  void put_place(const chain_constraints& c, contact_in_lanes<S>& x, const TouchAt& touch_at) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      touch of_lane;
#if defined(__cpp_exceptions)
      try {
        of_lane = touch_at(lane);
      } catch (const bad_argument& e) {
        refuse_place(c, x, lane, e.what());
      }
#else
      of_lane = touch_at(lane);
#endif
      put_lane(x.place.normal, lane, of_lane.normal), put_lane(x.place.point, lane, of_lane.point);
      put_lane(x.place.slip, lane, of_lane.slip), put_lane(x.place.slip_rate, lane, of_lane.slip_rate);
      x.place.gap.set(lane, of_lane.gap), x.place.bending.set(lane, of_lane.bending);
      x.friction.set(lane, of_lane.law.friction);
    }
    check_normal(c, x);
  }
  /// The place of a contact with the same friction in all lanes.
  KTE_INLINE void put_place(const chain_constraints& c, contact_in_lanes<S>& x, const basic_touch<S>& place) {
    x.place = place, x.friction = S(place.law.friction);
    check_normal(c, x);
  }
  /// Chooses the contacts that touch, by lane, and those that slide, as `choose_contacts` does by velocities. Throws
  /// `bad_argument` for a contact that approaches in a lane.
  void choose(const chain_constraints& c) {
    int row = 0;
    const S rest(rest_velocity * length);
    for (auto& x : contacts) {
      const S normal = dot(x.place.normal, x.place.slip);
      const auto closed = (x.place.gap <= S(touching_gap * length)) & !(normal > rest);
      x.touches = any(closed), x.closed = select(closed, S(1), S(0));
      if (!x.touches) continue;
      if (const auto approaches = closed & (normal < -rest); any(approaches)) [[unlikely]]
        refuse_approach(c, x, select(approaches, S(-normal), S(0)));
      const vec3<S> along = x.place.slip - normal * x.place.normal;
      const S speed = sqrt(dot(along, along));
      const auto slides = closed & (speed > rest);
      x.slides = select(slides, S(1), S(0));
      x.basis = basis_at(x.place.normal, x.planar);
      if (any(slides)) {
        const S inverse = S(1) / select(slides, speed, S(1));
        const auto chosen = [&](const S& moving, const S& at_rest) {
          return select(slides, moving * inverse, at_rest);
        };
        const vec3<S>& t = x.basis[1];
        x.basis =
            basis_along(x.place.normal, vec3<S>{chosen(along.x, t.x), chosen(along.y, t.y), chosen(along.z, t.z)});
      }
      x.first = row, row += x.rows();
    }
    w.resize(row, row), bias.resize(row), forces.setZero(row);
  }
  /// Finds the forces of all lanes, from W and bias. Throws `no_solution` for a lane without forces.
  void solve(const chain_constraints& c) {
    several = {};
    modes_.assign(contacts.size(), S(0));
    of_friction_.clear();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const auto& x = contacts[i];
      if (!x.touches) continue;
      const S slides = select(x.friction == S(0), x.closed, x.slides);
      of_friction_.push_back({x.first, x.rows(), x.friction, x.closed, slides});
      modes_[i] = x.closed * (S(static_cast<double>(contact_mode::sticks)) + slides);
    }
    if (of_friction_.empty()) return;
    const S good = friction_.solve(w, bias, of_friction_, forces);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (good[lane] == 0 || is_enumerated(lane)) solve_alone(c, lane);
  }
  /// The modes of a contact, as numbers.
  const S& modes(std::size_t contact) const { return modes_[contact]; }

 private:
  static void put_lane(vec3<S>& to, std::size_t lane, const vec3<>& x) {
    to.x.set(lane, x.x), to.y.set(lane, x.y), to.z.set(lane, x.z);
  }
  KTE_INLINE void check_normal(const chain_constraints& c, const contact_in_lanes<S>& x) const {
    const S square = dot(x.place.normal, x.place.normal);
    if (all((square > S(0.5)) & (square < S(2)))) [[likely]]
      return;
    std::size_t lane = 0;
    while (square[lane] > 0.5 && square[lane] < 2) ++lane;
    refuse_place(c, x, lane, no_normal_here);
  }
  [[noreturn, gnu::cold]] void refuse_place(const chain_constraints& c, const contact_in_lanes<S>& x, std::size_t lane,
                                            std::string_view why) const {
    raise<bad_argument>(in_lane(lane, lanes, text_of_no_place(std::string(c.loop_name(x.loop)), why)));
  }
  [[noreturn, gnu::cold]] void refuse_approach(const chain_constraints& c, const contact_in_lanes<S>& x,
                                               const S& speed) const {
    std::size_t lane = 0;
    while (speed[lane] == 0) ++lane;
    raise<bad_argument>(in_lane(lane, lanes, text_of_approach(std::string(c.loop_name(x.loop)), speed[lane])));
  }
  /// Whether all solutions of a lane are found, as of a single state.
  bool is_enumerated(std::size_t lane) const {
    int closed = 0;
    for (const auto& x : of_friction_) {
      if (x.closed[lane] == 0) continue;
      if (x.rows == 3) return false;
      ++closed;
    }
    return closed > 0 && closed <= 3;
  }
  [[gnu::noinline]] void solve_alone(const chain_constraints& c, std::size_t lane) {
    auto& m = alone_;
    m.touching.clear(), m.laws.clear(), m.first.clear();
    int count = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const auto& x = contacts[i];
      if (!x.touches || x.closed[lane] == 0) continue;
      friction_contact<> law;
      law.rows = x.rows(), law.friction = x.friction[lane];
      if (x.slides[lane] != 0) law.sliding = std::array<double, 2>{1, 0};
      m.touching.push_back(static_cast<int>(i)), m.laws.push_back(law), m.first.push_back(count);
      count += x.rows();
    }
    m.w.resize(count, count), m.bias.resize(count), m.forces.setZero(count);
    each_row([&](std::size_t i, int own, int all) {
      m.bias[own] = bias[all][lane];
      for (std::size_t j = 0; j < m.touching.size(); ++j)
        for (int k = 0; k < m.laws[j].rows; ++k) m.w(m.first[j] + k, own) = w(of(j).first + k, all)[lane];
      (void)i;
    });
    const auto status = find_friction(m);
    if (!has_forces(status)) [[unlikely]]
      raise<no_solution>(in_lane(lane, lanes, text_of_no_forces(names(c), status, m.residual)));
    several[lane] = status == friction_status::several_solutions;
    for (Eigen::Index k = 0; k < forces.size(); ++k) forces[k].set(lane, 0);
    each_row([&](std::size_t i, int own, int all) {
      forces[all].set(lane, m.forces[own]);
      modes_[static_cast<std::size_t>(m.touching[i])].set(lane, static_cast<double>(m.modes[i]));
    });
  }
  /// Contact j of `alone_`.
  const contact_in_lanes<S>& of(std::size_t j) const { return contacts[static_cast<std::size_t>(alone_.touching[j])]; }
  /// Calls visit(contact, row, row among those of all lanes) for the rows of `alone_`.
  template <class Visit>
  void each_row(const Visit& visit) const {
    for (std::size_t i = 0; i < alone_.touching.size(); ++i)
      for (int k = 0; k < alone_.laws[i].rows; ++k) visit(i, alone_.first[i] + k, of(i).first + k);
  }
  std::string names(const chain_constraints& c) const {
    std::string all;
    for (std::size_t i = 0; i < alone_.touching.size(); ++i)
      all.append(i == 0 ? "'" : ", '").append(c.loop_name(of(i).loop)).append("'");
    return all;
  }

  std::vector<S> modes_;  ///< `contact_mode` as numbers, by contact
  std::vector<friction_contact_in_lanes<S>> of_friction_;
  friction_in_lanes<S> friction_;
  friction_of_lane alone_;
};

/// Writes all contacts to at(slot), after `solve`.
template <class S, class At>
void put_contacts_at(const contacts_in_lanes<S>& m, const At& at) {
  for (std::size_t i = 0; i < m.contacts.size(); ++i) {
    const auto& x = m.contacts[i];
    contact_state<S>& to = at(x.slot);
    to.gap = x.place.gap, to.slip = x.place.slip, to.point = x.place.point;
    to.force = to.direction = {S(0), S(0), S(0)}, to.mode = m.modes(i);
    if (!x.touches) continue;
    for (int k = 0; k < x.rows(); ++k)
      to.force = to.force + S(m.forces[x.first + k] * S(1 / m.length)) * x.basis[static_cast<std::size_t>(k)];
    const auto slides = to.mode == S(2);
    if (!any(slides)) continue;
    // where it is at rest, against the force
    const vec3<S> against = dot(x.place.normal, to.force) * x.place.normal - to.force;
    const S size = sqrt(dot(against, against)), inverse = select(size > S(0), S(1) / size, S(0));
    const auto chosen = [&](const S& moving, const S& force) {
      return select(slides, select(x.slides > S(0.5), moving, force * inverse), S(0));
    };
    const vec3<S>& t = x.basis[1];
    to.direction = {chosen(t.x, against.x), chosen(t.y, against.y), chosen(t.z, against.z)};
  }
}

}  // namespace kte::detail
