#pragma once

#include <kte/errors.hpp>
#include <kte/view/svg/decimals.hpp>
#include <kte/view/svg/mechanism/options.hpp>

namespace kte::detail::svg {

/// Throws `bad_argument` for invalid options.
inline void check_picture_options(const picture_options& o) {
  const auto refuse = [](const std::string& what) { raise<bad_argument>("kte: a picture of a mechanism " + what); };
  if (!(o.width >= 10 && o.width <= 2000)) refuse("is 10 to 2000 mm wide, not " + four_digits(o.width));
  if (!(o.most_height >= 0 && o.most_height <= 5000))
    refuse("is at most 5000 mm high, not " + four_digits(o.most_height));
  if (!(o.joint_radius > 0 && o.joint_radius * 12 <= o.width))
    refuse("has joints of a radius up to a 12th of its width, not " + four_digits(o.joint_radius) + " mm");
  if (!(o.font_size >= 1 && o.font_size * 4 <= o.width))
    refuse("has letters of 1 to " + four_digits(o.width / 4) + " points, not " + four_digits(o.font_size));
  if (!(o.palest >= 0 && o.palest <= 1)) refuse("has opacities of 0 to 1, not " + four_digits(o.palest));
  for (const double x : o.look_from)
    if (!std::isfinite(x)) refuse("is seen from a direction of three finite numbers");
}

}  // namespace kte::detail::svg
