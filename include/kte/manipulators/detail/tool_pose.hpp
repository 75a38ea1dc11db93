#pragma once

#include <kte/manipulators/detail/raw_answers.hpp>
#include <kte/tree/lanes.hpp>

/// Where a tool is, of one posture and of many, and how far that is from where it is wanted.
namespace kte::detail {

template <class S>
using plain_pose_of = pose<rotation_matrix<S>, vec3<S>>;

/// The pose of the tool at t, by joint of the arm: products of exponentials.
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

/// m and rad between two poses.
template <class S>
struct pose_gap {
  S position, rotation;
};
/// With F the norm of Frobenius, the angle between two rotations is 2 asin(F(R1 - R2) / sqrt 8).          (1)
template <class S>
pose_gap<S> gap_of_squares(const S& position, const S& rotation) {
  using std::asin;
  using std::sqrt;
  const S square = rotation / S(8), half = sqrt(square);
  const bool small = square * square < S(std::numeric_limits<S>::epsilon());  // asin x = x + x^3/6
  return {sqrt(position), small         ? S(half * (S(2) + square / S(3)))
                          : half < S(1) ? S(S(2) * asin(half))
                                        : half_turn<S>()};
}
template <class S>
pose_gap<S> gap_between(const plain_pose_of<S>& a, const plain_pose_of<S>& b) {
  const vec3<S> d = a.position - b.position;
  const auto m = as<S>(a.rotation - b.rotation);
  return gap_of_squares(S(dot(d, d)), S(dot(m.x, m.x) + dot(m.y, m.y) + dot(m.z, m.z)));
}

/// Several postures, all numbers of one joint side by side, as registers take them. What is behind the last posture up
/// to a full register are numbers too.
template <class S>
struct postures {
  static constexpr std::size_t most = raw_answers<S>::most;
  using one_each = std::array<S, most>;

  std::size_t size = 0;
  by_joint<one_each> sine, cosine, t;

  /// The pose of the tool of each, by its sines and cosines, and what that misses.
  void look_at_gaps(const arm_geometry& arm, const plain_pose_of<S>& wanted, std::array<pose_gap<S>, most>& gap) const {
    using lane = tree::lanes<S>;
    constexpr std::size_t lanes = tree::lanes_of<S>::count;
    for (std::size_t first = 0; first < size; first += lanes) {
      lane x[3][4];  // the rows of R, p
      put(x, arm.tool.rotation, arm.tool.position);
      for (auto i = static_cast<std::size_t>(arm.n); i-- > 0;) {
        const vec3<S> h = as<S>(arm.axis[i]), o = as<S>(arm.point[i]);
        lane s, c;
        if (arm.slides[i]) {
          tree::load(s, t[i].data() + first);
          x[0][3] += s * h.x, x[1][3] += s * h.y, x[2][3] += s * h.z;
          continue;
        }
        tree::load(s, sine[i].data() + first), tree::load(c, cosine[i].data() + first);
        const lane k = S(1) - c, sx = s * h.x, sy = s * h.y, sz = s * h.z;
        const lane kxy = k * S(h.x * h.y), kyz = k * S(h.y * h.z), kzx = k * S(h.z * h.x);
        const lane r[3][3]{{k * S(h.x * h.x) + c, kxy - sz, kzx + sy},
                           {kxy + sz, k * S(h.y * h.y) + c, kyz - sx},
                           {kzx - sy, kyz + sx, k * S(h.z * h.z) + c}};
        x[0][3] -= o.x, x[1][3] -= o.y, x[2][3] -= o.z;
        for (std::size_t j = 0; j < 4; ++j) {
          const lane a = x[0][j], b = x[1][j], d = x[2][j];
          for (std::size_t l = 0; l < 3; ++l) x[l][j] = r[l][0] * a + r[l][1] * b + r[l][2] * d;
        }
        x[0][3] += o.x, x[1][3] += o.y, x[2][3] += o.z;
      }
      lane w[3][4];
      put(w, wanted.rotation, wanted.position);
      lane position{}, rotation{};
      for (std::size_t l = 0; l < 3; ++l) {
        for (std::size_t j = 0; j < 3; ++j) rotation += (x[l][j] - w[l][j]) * (x[l][j] - w[l][j]);
        position += (x[l][3] - w[l][3]) * (x[l][3] - w[l][3]);
      }
      std::array<S, lanes> p, q;
      tree::store(position, p.data()), tree::store(rotation, q.data());
      for (std::size_t l = 0; l < lanes && first + l < size; ++l) gap[first + l] = gap_of_squares(p[l], q[l]);
    }
  }

 private:
  template <class Lane, class Matrix, class Vector>
  static void put(Lane (&x)[3][4], const Matrix& r, const Vector& p) {
    const Lane zero{};
    x[0][0] = zero + S(r.x.x), x[0][1] = zero + S(r.x.y), x[0][2] = zero + S(r.x.z), x[0][3] = zero + S(p.x);
    x[1][0] = zero + S(r.y.x), x[1][1] = zero + S(r.y.y), x[1][2] = zero + S(r.y.z), x[1][3] = zero + S(p.y);
    x[2][0] = zero + S(r.z.x), x[2][1] = zero + S(r.z.y), x[2][2] = zero + S(r.z.z), x[2][3] = zero + S(p.z);
  }
};

}  // namespace kte::detail
