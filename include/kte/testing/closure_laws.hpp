#pragma once

#include <kte/contract/closure.hpp>
#include <kte/testing/element_laws.hpp>

/// Laws of closures of frames, for closures of kte and of users, like those of testing/element_laws.hpp. Together with
/// `loads_are_opposite` they are complete.
namespace kte::testing {

namespace detail {
/// The results of `rows(core, motion of frame2 in frame1)` as numbers.
template <class S, class Core, class Rows>
auto rows_of(trial<S, Core>& x, const Rows& rows) {
  const auto m = kte::detail::as_closing_motion<S>(relative(spatial(x.template at<0>()), spatial(x.template at<1>())));
  return kte::detail::rows_in_numbers<S>(rows(m));
}
/// The derivatives of its residuals along the motion of both frames.
template <class S, class Core>
auto derived_residuals(trial<S, Core>& x, const Core& core) {
  return derivatives<S>([&](const S& t) {
    auto y = x;
    y.move(t);
    return rows_of(y, [&core](const auto& m) { return core.residual(m); });
  });
}
}  // namespace detail

/// `residual_dot` is the derivative of `residual`, along any motion of both frames.
template <class S, class Element, class Draw>
S residual_dot_is_derivative(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [&e](auto& x) {
    const auto given = detail::rows_of(x, [&e](const auto& m) { return e.core.residual_dot(m); });
    return detail::difference<S, given.size()>(detail::derived_residuals(x, e.core).first, given);
  });
}
/// `residual_ddot` is the second derivative.
template <class S, class Element, class Draw>
S residual_ddot_is_derivative(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [&e](auto& x) {
    const auto given = detail::rows_of(x, [&e](const auto& m) { return e.core.residual_ddot(m); });
    return detail::difference<S, given.size()>(detail::derived_residuals(x, e.core).second, given);
  });
}
/// The power of its loads is the sum of its forces times `residual_dot`, and zero while the loop is closed.
template <class S, class Element, class Draw>
S loop_does_no_work(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [&e](auto& x) {
    x.doForce();
    S sum(0), sizes(0);
    x.for_each([&](const port&, auto& thing) {
      const auto [p, s] = detail::power(thing);
      sum = sum + p, sizes = sizes + s;
    });
    const auto& loop = x.output();
    const auto rates = detail::rows_of(x, [&e](const auto& m) { return e.core.residual_dot(m); });
    for (std::size_t k = 0; k < rates.size(); ++k) {
      const S power(kte::detail::row_of(loop.force, loop.torque, e.core.rows, static_cast<int>(k)) * rates[k]);
      sum = sum - power, sizes = sizes + detail::magnitude(power);
    }
    return detail::ratio(sum, sizes);
  });
}

}  // namespace kte::testing
