#pragma once

#include <kte/io/replace_file.hpp>
#include <kte/view/svg/mechanism/canvas.hpp>

namespace kte {

namespace detail::svg {

/// Begins an animation of an attribute over the whole time, repeated forever.
inline svg_writer& begin_animation(svg_writer& out, const char* attribute, const std::string& values, double seconds) {
  return out.begin("animate")
      .set("attributeName", attribute)
      .set("dur", decimal(seconds) + "s")
      .set("repeatCount", "indefinite")
      .set("values", values);
}
/// Animates an attribute by its values at all times, unless they are equal.
template <class Value>
void animate(svg_writer& out, const char* attribute, std::size_t count, double seconds, const Value& value) {
  std::string values;
  bool moves = false;
  const std::string first = value(std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    const std::string v = value(i);
    moves = moves || v != first;
    values.append(i == 0 ? "" : ";").append(v);
  }
  if (moves) begin_animation(out, attribute, values, seconds).end();
}

/// The positions of a moving picture.
class moving_shapes {
 public:
  explicit moving_shapes(mechanism_canvas& c) : c_(c) {
    const auto& o = c.options;
    const double from = c.shown_times.front(), to = c.shown_times.back();
    const auto refuse = [](const std::string& what) { raise<bad_argument>("kte: a moving picture " + what); };
    if (!o.times.empty() || o.every != 0) refuse("shows all times: .from and .to say which, not .times or .every");
    if (!(o.rate > 0 && o.speed > 0)) refuse("has a rate and a speed above 0");
    if (!(to > from)) refuse("needs a recording of some duration");
    seconds = (to - from) / o.speed;
    const double count = std::ceil(seconds * o.rate);
    if (!(count <= 100000)) refuse("of " + four_digits(seconds) + " s has more than 100000 positions");
    std::vector<double> times;
    for (int i = 0; i <= static_cast<int>(count); ++i) times.push_back(from + (to - from) * i / count);
    c.fit(times);
    for (const double t : times) {
      const auto frames = c.motion.frames(t);
      at.push_back(c.shapes.at(frames));
    }
    for (std::size_t k = 0; k < trail_parts * (times.size() - 1) + 1; ++k) {
      const auto frames = c.motion.frames(from + (to - from) * static_cast<double>(k) / (count * trail_parts));
      auto& row = trails.emplace_back();
      for (const int f : c.trails) row.push_back(c.view(frames[static_cast<std::size_t>(f)].position));
    }
  }
  /// Whether the last position equals the first.
  bool closed() const {
    double most = 0;
    for (std::size_t i = 0; i < at.front().size(); ++i)
      for (std::size_t k = 0; k < at.front()[i].points.size(); ++k) {
        const auto &a = at.front()[i].points[k], &b = at.back()[i].points[k];
        most = (std::max)(most, std::hypot(a.x - b.x, a.y - b.y));
      }
    return most < 0.3;
  }
  void put(svg_writer& out) const {
    for (std::size_t i = 0; i < at.front().size(); ++i) {
      const auto& first = at.front()[i];
      begin_shape(out, first);
      if (!first.name.empty()) out.element("title", first.name);
      const auto shape = [&](std::size_t k) -> const drawn_shape& { return at[k][i]; };
      if (first.radius > 0) {
        animate(out, "cx", at.size(), seconds, [&](std::size_t k) { return decimal(shape(k).points[0].x); });
        animate(out, "cy", at.size(), seconds, [&](std::size_t k) { return decimal(shape(k).points[0].y); });
      } else {
        animate(out, "d", at.size(), seconds, [&](std::size_t k) { return shape(k).path(); });
      }
      out.end();
    }
  }
  /// The last part of the path of a frame, as dashes that move along it and fade with age.
  void put_trail(svg_writer& out, std::size_t trail, const char* colour) const {
    path_data path;
    std::vector<double> along{0};
    for (std::size_t k = 0; k < trails.size(); ++k) {
      const auto p = trails[k][trail];
      if (k == 0) {
        path.move(p);
        continue;
      }
      path.line(p);
      const auto q = trails[k - 1][trail];
      const auto step = [](double to, double from) {
        return static_cast<double>(hundredths(to) - hundredths(from)) / 100;
      };
      along.push_back(along.back() + std::hypot(step(p.x, q.x), step(p.y, q.y)));
    }
    for (const double part : {1.6, 0.9, 0.4}) {  // relative to the width of the picture
      const double dash = part * c_.options.width;
      out.begin("path").set("d", path.text()).set("stroke", colour).set("stroke-width", 0.5).set("stroke-opacity", 0.3);
      out.set("stroke-linecap", "butt").set("stroke-dasharray", decimal(dash) + " " + decimal(along.back() + dash + 1));
      animate(out, "stroke-dashoffset", at.size(), seconds,
              [&](std::size_t k) { return decimal(dash - along[trail_parts * k]); });
      out.end();
    }
  }

  static constexpr std::size_t trail_parts = 2;    ///< trail points per position
  std::vector<std::vector<drawn_shape>> at;        ///< at all positions
  std::vector<std::vector<picture_point>> trails;  ///< the points of all trails
  double seconds = 0;

 private:
  const mechanism_canvas& c_;
};

}  // namespace detail::svg

/// A moving mechanism of a recording, in a loop: SVG 1.1 with animations and without scripts. Browsers also show it as
/// an image in a page; other programs show the first position. Drawn like `picture`; if the last position differs from
/// the first, it fades out and in.
///
/// Throws what `picture` throws, and `bad_argument` for a recording with a single time.
[[nodiscard]] inline std::string moving_picture(const scene& s, const picture_options& o = {}) {
  using namespace detail::svg;
  mechanism_canvas c(s, o);
  const moving_shapes shapes(c);
  svg_writer out;
  begin_picture(out, o.width, c.height, o.font, c.font(), c.title(),
                "Moving for " + four_digits(shapes.seconds) + " s, again and again. " + c.description());
  c.put_ground(out);
  c.put_scale_bar(out);
  out.begin("g");
  if (!shapes.closed()) {
    begin_animation(out, "opacity", "0;1;1;0", shapes.seconds).set("keyTimes", "0;0.03;0.95;1").end();
  }
  for (std::size_t i = 0; i < c.trails.size(); ++i) shapes.put_trail(out, i, palette[i % palette.size()]);
  shapes.put(out);
  out.end();
  return out.end().document();
}

/// Writes a moving picture to a file, which is replaced after all is written. Throws `bad_file` if it cannot be
/// written.
inline void write_moving_picture(const std::filesystem::path& file, const scene& s, const picture_options& o = {}) {
  detail::replace_file(file, moving_picture(s, o));
}

}  // namespace kte
