#pragma once

#include <kte/dynamics/contacts/contact_dynamics_in_lanes.hpp>
#include <kte/dynamics/contacts/contact_jacobian.hpp>

/// `contact_jacobian` in packs S of states in double.
namespace kte {

namespace detail {

template <class S>
class contact_jacobians_in_lanes {
  static constexpr std::size_t lanes = std::size_t{S::lanes};
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

 public:
  contact_jacobians_in_lanes(const runtime_chain& c, basic_runtime_state<S>& s)
      : c_(contacts_of(c)), s_(s), places_(c_, s) {
    if (c.wiring().count(kind::contact) == 0) throw bad_argument("kte: this chain has no contacts");
    place_bodies(c_.elements(), s_);
    for (const auto& at : places_.closures)
      if (c_.touches(at.element)) add(at);
  }
  /// The rows of contacts by their names, or of those that touch.
  matrix rows_of(const chosen_contacts& of) {
    std::vector<const located*> chosen;
    for (const auto& name : of.names) {
      const auto is_named = [&](const located& x) { return c_.loop_name(x.at->loop) == name; };
      const auto found = std::find_if(all_.begin(), all_.end(), is_named);
      if (found == all_.end()) throw unknown_name("kte: this chain has no contact '" + name + "'");
      chosen.push_back(&*found);
    }
    for (const auto& x : all_)
      if (of.names.empty() && touches(x)) chosen.push_back(&x);
    matrix rows(0, s_.dofs());
    for (const auto* x : chosen) append(*x, rows);
    return rows;
  }

 private:
  struct located {
    const closure_place* at;
    closing_motion<S> motion;
    vec3<S> point;
    S gap;
  };
  void add(const closure_place& at) {
    located x{&at, loop_equations::motion_between(s_, at), {}, {}};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const touch place = c_.element(at.element).lane(lane).touch_at(lane_of(x.motion, lane));
      x.gap.set(lane, place.gap);
      x.point.x.set(lane, place.point.x), x.point.y.set(lane, place.point.y), x.point.z.set(lane, place.point.z);
    }
    all_.push_back(x);
  }
  /// Throws `bad_argument` for a contact that touches in some lanes only.
  bool touches(const located& x) const {
    const auto is = x.gap <= S(touching_gap * places_.length);
    if (any(is) && !all(is))
      throw bad_argument("kte: contact '" + c_.loop_name(x.at->loop) +
                         "' touches in some lanes and not in others: give the names of contacts");
    return any(is);
  }
  /// u = R v + (R w) x (c - p), with the velocities v, w of frame2 relative to frame1 in axes of frame2.
  void append(const located& x, matrix& rows) {
    const auto& f = s_.tree().body_tree;
    basic_runtime_jacobian<S> twists = basic_runtime_jacobian<S>::Zero(6, s_.tree().plan.coordinates);
    loop_equations::each_relative_column(
        s_, *x.at, x.motion, [&](int k, const tree::direction<S>& v, const tree::direction<S>& w) {
          tree::put_column<true, S>(twists.col(f.row[static_cast<std::size_t>(k)]).data(), v, w);
        });
    twists = folded(c_.chain, s_, std::move(twists));
    const auto first = rows.rows();
    const int count = x.at->rows.count();
    rows.conservativeResize(first + count, rows.cols());
    const vec3<S> arm = x.point - x.motion.position;
    for (Eigen::Index k = 0; k < twists.cols(); ++k) {
      const S* const t = twists.col(k).data();
      const vec3<S> w = x.motion.rotation * vec3<S>{t[3], t[4], t[5]};
      const vec3<S> u = x.motion.rotation * vec3<S>{t[0], t[1], t[2]} + cross(w, arm);
      rows(first, k) = u.x, rows(first + 1, k) = u.y;
      if (count == 3) rows(first + 2, k) = u.z;
    }
  }

  chain_constraints c_;
  basic_runtime_state<S>& s_;
  closure_places places_;
  std::vector<located> all_;
};

}  // namespace detail

/// In packs S of states; `at_contacts()` are those that touch, in all lanes alike.
template <class S, indexable Q>
requires(detail::has_lanes_of_double<S>) Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> contact_jacobian(
    const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const chosen_contacts& of) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::contact_jacobians_in_lanes<S>(c, s).rows_of(of); });
}
template <class S, indexable Q>
requires(detail::has_lanes_of_double<S>) auto contact_jacobian(const runtime_chain& c, basic_runtime_state<S>& s,
                                                               const Q& q, std::string_view contact) {
  return contact_jacobian(c, s, q, at_contacts(std::string(contact)));
}

}  // namespace kte
