#pragma once

#include <kte/io/replace_file.hpp>
#include <kte/view/svg/mechanism/canvas.hpp>

namespace kte {

namespace detail::svg {

/// The times at which a mechanism is drawn.
inline std::vector<double> picture_times(const mechanism_canvas& c) {
  const auto& o = c.options;
  const double first = c.motion.times().front(), last = c.motion.times().back();
  if (!(o.every >= 0 && std::isfinite(o.every)))
    raise<bad_argument>("kte: a picture every " + four_digits(o.every) + " s");
  if (!o.times.empty()) {
    if (o.every > 0) raise<bad_argument>("kte: a picture has either `times` or `every`, not both");
    for (const double t : o.times)
      if (!(t >= first && t <= last))
        raise<bad_argument>("kte: a picture at " + four_digits(t) + " s of a recording from " + four_digits(first) +
                            " to " + four_digits(last) + " s");
    return o.times;
  }
  const double from = c.shown_times.front(), to = c.shown_times.back();
  std::vector<double> times{from};
  if (o.every == 0) return times;
  const double count = std::floor((to - from) / o.every + 1e-9);
  if (count >= 1000)
    raise<bad_argument>("kte: a picture every " + four_digits(o.every) +
                        " s has more than 1000 positions of the mechanism");
  for (int i = 1; i <= static_cast<int>(count); ++i) times.push_back((std::min)(from + i * o.every, to));
  return times;
}

}  // namespace detail::svg

/// A mechanism at several times of a recording, drawn over each other, earlier times paler. Returns SVG 1.1 as text.
///
///   kte::write_picture("swing.svg", recording.contents(), {.every = 0.1, .trails = {"tip"}});
///
/// Links are lines; joints circles, boxes and cylinders; bodies the outlines of their ellipsoids of inertia; springs,
/// dampers and beams have their symbols. Planar scenes are drawn in their plane, others in parallel projection along
/// `look_from`. Parts without a symbol are named in the description (`<desc>`).
///
/// Throws `unknown_name` for frames that do not exist, `bad_argument` for times that were not recorded, invalid sizes,
/// and scenes whose parts do not fit together.
[[nodiscard]] inline std::string picture(const scene& s, const picture_options& o = {}) {
  using namespace detail::svg;
  mechanism_canvas c(s, o);
  const auto times = picture_times(c);
  c.fit(times);
  svg_writer out;
  std::string when = times.size() == 1 ? "At " : "At " + std::to_string(times.size()) + " times from ";
  when += four_digits(times.front()) + (times.size() == 1 ? "" : " to " + four_digits(times.back())) + " s. ";
  begin_picture(out, o.width, c.height, o.font, c.font(), c.title(), when + c.description());
  for (std::size_t i = 0; i < c.trails.size(); ++i) {
    const auto points =
        c.trail(c.trails[i], times.size() == 1 ? c.shown_times.back() : *std::max_element(times.begin(), times.end()));
    shape_style style = styles::trail;
    style.stroke = palette[i % palette.size()];
    if (points.size() > 1) put_shape(out, {style, "path of " + o.trails[i], points});
  }
  c.put_ground(out);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double last = static_cast<double>(times.size() - 1), part = last > 0 ? static_cast<double>(i) / last : 1;
    out.begin("g");
    if (i + 1 < times.size()) out.set("opacity", o.palest + (1 - o.palest) * part);
    out.element("title", "t = " + four_digits(times[i]) + " s");
    for (const auto& shape : c.shapes.at(c.motion.frames(times[i]))) put_shape(out, shape);
    out.end();
  }
  c.put_labels(out, c.motion.frames(times.back()));
  c.put_scale_bar(out);
  return out.end().document();
}

/// Writes a picture to a file, which is replaced after all is written. Throws `bad_file` if it cannot be written.
inline void write_picture(const std::filesystem::path& file, const scene& s, const picture_options& o = {}) {
  detail::replace_file(file, picture(s, o));
}

}  // namespace kte
