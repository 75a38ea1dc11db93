#pragma once

#include <kte/dynamics/runtime/frames.hpp>
#include <kte/tree/jacobian.hpp>

#include <string>
#include <type_traits>
#include <utility>

/// Jacobians of frames of runtime chains, into memory of the state or of the caller.
namespace kte {

/// The Jacobian of a frame of a runtime chain, 6 x dofs.
template <class S>
using basic_runtime_jacobian = Eigen::Matrix<S, 6, Eigen::Dynamic>;
/// The Jacobian of a frame of a runtime chain, 6 x dofs, in double.
using runtime_jacobian = basic_runtime_jacobian<double>;

namespace detail {
/// Adds the columns of followers, times their ratios, to the columns of the degrees of freedom that they follow, and
/// drops those of prescribed coordinates.
template <class S>
Eigen::Matrix<S, 6, Eigen::Dynamic> folded(const runtime_chain& c, basic_runtime_state<S>& s,
                                           Eigen::Matrix<S, 6, Eigen::Dynamic> a) {
  if (a.cols() == s.dofs()) return a;
  pull_back_followers(runtime_elements{c}, s,
                      [&a](int to, int from, const S& ratio) { a.col(to) += ratio * a.col(from); });
  return a.leftCols(s.dofs());
}
/// The Jacobian of a frame that follows others, by unit rates.
template <class S>
basic_runtime_jacobian<S> jacobian_by_rates(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x,
                                            bool world) {
  static_assert(goes_through_passes<S>);
  basic_runtime_jacobian<S> j(6, s.dofs());
  const runtime_vector<S> v = read_numbers<vector_of::v>(s);
  runtime_vector<S> rates = runtime_vector<S>::Zero(s.dofs());
  const auto velocity = [&] {
    write_numbers<vector_of::v>(s, rates, "v");
    move(c.wiring(), s, x);
    return with_motion(s, x, [world](const auto& m) { return engine::velocities_of<S>(m, world); });
  };
  const auto at_rest = velocity();  // not zero if bases move
  engine::put_velocities_at_unit_rates<S>(j, rates, [&]() -> linear_angular<S> {
    const auto [linear, angular] = velocity();
    return {linear - at_rest.linear, angular - at_rest.angular};
  });
  write_numbers<vector_of::v>(s, v, "v");
  return j;
}
/// A pointer to the first number of a Jacobian, and the stride between its columns.
template <class S>
struct columns_of_six {
  S* begin;
  Eigen::Index stride;
};
/// Writes zeros to all columns except those of the axes of body nodes on the way to a base. `way` is in ascending
/// order.
template <class P, class S>
void clear_beside(const tree::body_tree<P>& f, std::span<const int> way, const columns_of_six<S>& j, int columns) {
  const auto clear = [&j](int first, int end) KTE_INLINE_LAMBDA {
    if (j.stride == 6 && first < end)
      std::fill(j.begin + 6 * first, j.begin + 6 * end, S(0));
    else
      for (int k = first; k < end; ++k) std::fill_n(j.begin + j.stride * k, 6, S(0));
  };
  for (const int i : way) {
    const auto& r = f.nodes[static_cast<std::size_t>(i)];
    clear(r.first + r.axes, columns);
    columns = r.first;
  }
  clear(0, columns);
}
/// Writes the Jacobian over all degrees of freedom, at positions that have been checked.
template <class S>
void write_jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x, bool world,
                    const columns_of_six<S>& to) {
  const auto& t = s.tree();
  const auto& place = t.body_tree.frame(x.what, x.index);
  const auto assign = [&](const basic_runtime_jacobian<S>& j) {
    Eigen::Map<basic_runtime_jacobian<S>, 0, Eigen::OuterStride<>>(to.begin, 6, j.cols(), to.stride) = j;
  };
  if constexpr (std::is_same_v<S, double>)
    if (place.slot < 0) [[unlikely]]
      return assign(jacobian_by_rates(c, s, x, world));
  if constexpr (!std::is_same_v<S, double>) refuse_following(c, s, x);
  const auto put = [&](const columns_of_six<S>& j, int columns) {
    const auto way = place_ancestors(runtime_elements{c}, s, place.slot);
    const bool add = !t.body_tree.in_order;
    clear_beside(t.body_tree, add ? std::span<const int>() : way, j, columns);
    const auto put_one = [add, j, row = t.body_tree.row.data()](int k, const auto& v, const auto& w) KTE_INLINE_LAMBDA {
      if (add) [[unlikely]]
        tree::put_column<true, S>(j.begin + j.stride * row[k], v, w);
      else
        tree::put_column<false, S>(j.begin + j.stride * k, v, w);
    };
    if (world) {
      const int base = way.empty() ? place.slot : t.body_tree.nodes[static_cast<std::size_t>(way.back())].parent;
      tree::jacobian_columns_in_world(t.body_tree, s.work, place, way, axes_of_base(s, base), put_one);
    } else {
      tree::dense_pose<S> seen;
      (void)tree::jacobian_columns(t.body_tree, s.work, place, seen, put_one);
    }
  };
  if (t.plan.coordinates == s.dofs()) [[likely]]
    return put(to, s.dofs());
  basic_runtime_jacobian<S> all(6, t.plan.coordinates);
  put({all.data(), 6}, t.plan.coordinates);
  assign(folded(c, s, std::move(all)));
}

/// A matrix of the caller, or a block of one.
template <class J>
concept matrix_like = requires(J& j) {
  j.rows();
  j.cols();
};
/// Whether a matrix can be resized.
template <class J>
inline constexpr bool grows = std::is_base_of_v<Eigen::PlainObjectBase<J>, J>&& J::ColsAtCompileTime ==
                                  Eigen::Dynamic &&
                              (J::RowsAtCompileTime == Eigen::Dynamic || J::RowsAtCompileTime == 6);
template <class S, class J>
void check_room(const J& j, int dofs) {
  static_assert(std::is_same_v<typename J::Scalar, S>, "kte: a Jacobian is made of the numbers of its state");
  if constexpr (!grows<J>)
    if (j.rows() != 6 || j.cols() != dofs) [[unlikely]]
      throw bad_argument("kte: a Jacobian of 6 x " + std::to_string(dofs) + " does not fit into " +
                         std::to_string(j.rows()) + " x " + std::to_string(j.cols()));
}
template <class S, class J>
void put_jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x, bool world, J& j) {
  static_assert(!std::is_const_v<J> && bool(J::Flags & Eigen::DirectAccessBit) && !J::IsRowMajor &&
                    int(J::InnerStrideAtCompileTime) == 1,
                "kte: a Jacobian needs writable memory stored by columns: a matrix, 6 rows of one or a map");
  if constexpr (grows<J>)
    if (j.rows() != 6 || j.cols() != s.dofs()) j.resize(6, s.dofs());  // the check avoids a division in resize
  write_jacobian(c, s, x, world, columns_of_six<S>{j.data(), j.outerStride()});
}
template <class S>
basic_runtime_jacobian<S> jacobian_of(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x,
                                      bool world) {
  basic_runtime_jacobian<S> j;
  put_jacobian(c, s, x, world, j);
  return j;
}
template <class S, class J>
void put_jacobian_at_state(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame, bool world,
                           J& j) {
  check_motion(c, s);
  const auto x = find_frame(c, frame);
  check_room<S>(j, s.dofs());
  check_positions(s);
  put_jacobian(c, s, x, world, j);
}
template <class S, class Q, class J>
void put_jacobian_at(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const name_or_handle& frame,
                     bool world, J& j) {
  check_motion(c, s);
  const auto x = find_frame(c, frame);
  check_room<S>(j, s.dofs());
  return take<keeping::if_needed>(c, s, q).call([&] { put_jacobian(c, s, x, world, j); });
}
}  // namespace detail

#ifdef KTE_EXTERN
namespace detail {
KTE_EXTERN template void write_jacobian(const runtime_chain&, runtime_state&, const runtime_frame&, bool,
                                        const columns_of_six<double>&);
}  // namespace detail
#endif

}  // namespace kte
