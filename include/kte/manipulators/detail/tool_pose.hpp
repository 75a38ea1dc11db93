#pragma once

#include <kte/manipulators/detail/raw_answers.hpp>

/// The pose of a tool, for one posture or many, and its distance from the desired pose.
namespace kte::detail {

template <class S>
using plain_pose_of = pose<rotation_matrix<S>, vec3<S>>;

/// The pose of the tool at joint angles t: product of exponentials.
template <class S>
plain_pose_of<S> tool_pose(const arm_geometry& arm, const by_joint<S>& t) {
  const auto turn = turns_of(t);
  plain_pose_of<S> x{as<S>(arm.tool.rotation), as<S>(arm.tool.position)};
  for (auto i = static_cast<std::size_t>(arm.n); i-- > 0;) {
    const vec3<S> h = as<S>(arm.axis[i]);
    if (arm.slides[i]) {
      x.position = x.position + t[i] * h;
    } else {
      const vec3<S> o = as<S>(arm.point[i]);
      const auto r = as<S>(rotation_about(h, turn.cosine[i], turn.sine[i]));
      x = {r * x.rotation, vec3<S>(o + r * vec3<S>(x.position - o))};
    }
  }
  return x;
}

/// The distance of two poses, m and rad.
template <class S>
struct pose_gap {
  S position, rotation;
};
/// The angle between two rotations, with the Frobenius norm F, is 2 asin(F(R1 - R2) / sqrt 8).          (1)
template <class S>
pose_gap<S> gap_of_squares(const S& position, const S& rotation) {
  using std::asin;
  using std::sqrt;
  const S square = rotation / S(8), half = sqrt(square);
  const truth<S> tiny = square * square < S(std::numeric_limits<S>::epsilon());
  const S by_series = half * (S(2) + square / S(3));  // asin x = x + x^3/6
  if (all(tiny)) return {sqrt(position), by_series};
  const truth<S> less = half < S(1);
  const S angle = select(less, S(S(2) * asin(select(less, half, S(0)))), half_turn<S>());
  return {sqrt(position), select(tiny, by_series, angle)};
}
template <class S>
pose_gap<S> gap_between(const plain_pose_of<S>& a, const plain_pose_of<S>& b) {
  const vec3<S> d = a.position - b.position;
  const auto m = as<S>(a.rotation - b.rotation);
  return gap_of_squares(S(dot(d, d)), S(dot(m.x, m.x) + dot(m.y, m.y) + dot(m.z, m.z)));
}

/// Several postures, with the values of one joint in adjacent memory: rows that are padded to full registers.
template <class S>
struct postures {
  using row = typename raw_answers<S>::row;

  std::size_t size = 0;
  by_joint<row> sine, cosine, t;

  by_joint<S> posture(std::size_t a) const {
    by_joint<S> x{};
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = t[i][a];
    return x;
  }
  /// Computes the tool poses of all postures by their sines and cosines, and their errors.
  void look_at_gaps(const arm_geometry& arm, const plain_pose_of<S>& wanted, row& position, row& rotation) const {
    using L = typename answer_pack<S>::type;
    const plain_pose_of<L> there{as<L>(wanted.rotation), as<L>(wanted.position)};
    for (std::size_t first = 0; first < size; first += answer_pack<S>::count) {
      plain_pose_of<L> x{as<L>(arm.tool.rotation), as<L>(arm.tool.position)};
      for (auto i = static_cast<std::size_t>(arm.n); i-- > 0;) {
        const vec3<L> h = as<L>(arm.axis[i]), o = as<L>(arm.point[i]);
        if (arm.slides[i]) {
          x.position = x.position + load_pack(t[i].data() + first) * h;
        } else {
          const auto r =
              as<L>(rotation_about(h, load_pack(cosine[i].data() + first), load_pack(sine[i].data() + first)));
          x = {as<L>(r * x.rotation), vec3<L>(o + r * vec3<L>(x.position - o))};
        }
      }
      const auto gap = gap_between(x, there);
      store_pack(gap.position, position.data() + first), store_pack(gap.rotation, rotation.data() + first);
    }
  }
};

}  // namespace kte::detail
