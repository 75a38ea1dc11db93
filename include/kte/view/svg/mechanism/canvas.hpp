#pragma once

#include <kte/view/svg/mechanism/mechanism_shapes.hpp>
#include <kte/view/svg/mechanism/option_checks.hpp>
#include <kte/view/svg/mechanism/surroundings.hpp>
#include <kte/view/svg/palette.hpp>
#include <kte/view/svg/text_width.hpp>

namespace kte::detail::svg {

/// A scene in a picture, with a view that shows all of it at given times.
class mechanism_canvas {
 public:
  mechanism_canvas(const scene& s, const picture_options& o)
      : options(o),
        motion((check_picture_options(o), s), o.recording),
        view(view_axes(s, o.look_from)),
        shapes(s, view, o) {
    for (const auto& name : o.trails) trails.push_back(motion.frame(name));
    for (const auto& name : o.labels) labels.push_back(motion.frame(name));
    for (const double t : motion.times())
      if (t >= o.from && t <= o.to) shown_times.push_back(t);
    if (shown_times.empty())
      raise<bad_argument>("kte: the recording of the picture is from " + four_digits(motion.times().front()) + " to " +
                          four_digits(motion.times().back()) + " s, and none of it between " + four_digits(o.from) +
                          " and " + four_digits(o.to));
  }
  mechanism_canvas(const mechanism_canvas&) = delete;
  mechanism_canvas& operator=(const mechanism_canvas&) = delete;

  /// Extends the view to the mechanism at these times, and to trails until the last of them.
  void fit(const std::vector<double>& times) {
    picture_box box;
    for (const double t : times) add_to(box, motion.frames(t));
    if (!trails.empty())
      for (const double t : shown_times) {
        const auto frames = motion.frames(t);
        for (const int i : trails) add_to(box, frames[static_cast<std::size_t>(i)].position);
      }
    if (box.right < box.left) box.add(0, 0);
    const double margin = 3.2 * options.joint_radius + 1, below = options.scale_bar ? font() + 3 : 0;
    const double most = options.most_height > 0 ? options.most_height : 1.2 * options.width;
    const double w = box.right - box.left, h = box.high - box.low, least = 1e-9 * motion.of().size;
    const double room_across = options.width - 2 * margin, room_up = most - 2 * margin - below;
    if (!(room_up > 0))
      raise<bad_argument>("kte: a picture of a mechanism needs a height of more than " + four_digits(most - room_up) +
                          " mm");
    double scale = (std::min)(room_across / (std::max)(w, least), room_up / (std::max)(h, least));
    if (w <= least && h <= least) scale = room_across / (2 * (motion.of().size > 0 ? motion.of().size : 1));
    height = h * scale + 2 * margin + below;
    view.set(scale, (box.left + box.right) / 2, box.high, {options.width / 2, margin});
  }

  double font() const { return options.font_size * 25.4 / 72; }
  /// The path of a frame until a time, as points at least 0.05 mm apart.
  std::vector<picture_point> trail(int frame, double until) const {
    std::vector<picture_point> points;
    for (const double t : shown_times) {
      if (t > until) break;
      const auto p = view(motion.frames(t)[static_cast<std::size_t>(frame)].position);
      if (points.empty() || std::hypot(p.x - points.back().x, p.y - points.back().y) > 0.05) points.push_back(p);
    }
    return points;
  }
  void put_ground(svg_writer& out) const {
    if (!options.ground) return;
    const auto frames = motion.frames(shown_times.front());
    out.begin("g").element("title", "ground");
    for (const int f : grounded_frames(motion))
      for (auto s : ground_symbol(view(frames[static_cast<std::size_t>(f)].position), options.joint_radius)) {
        s.name.clear();
        put_shape(out, s);
      }
    out.end();
  }
  void put_labels(svg_writer& out, const std::vector<placed_frame>& frames) const {
    for (const int f : labels) {
      const auto p = view(frames[static_cast<std::size_t>(f)].position);
      const auto& name = motion.of().frames[static_cast<std::size_t>(f)].name;
      out.begin("text")
          .set("fill", "#000")
          .set("x", p.x + 1.4 * options.joint_radius)
          .set("y", p.y - options.joint_radius);
      out.text(shortened(name, (options.width - p.x) / font())).end();
    }
  }
  void put_scale_bar(svg_writer& out) const {
    if (!options.scale_bar) return;
    const auto bar = round_length_of(0.3 * options.width / view.scale());
    const double length = bar.metres * view.scale(), right = options.width - 2, y = height - 2;
    drawn_shape line{
        styles::ground, "", {{right - length, y - 0.8}, {right - length, y}, {right, y}, {right, y - 0.8}}};
    put_shape(out, line);
    out.begin("text").set("x", right - length / 2).set("y", y - 1).set("text-anchor", "middle").set("fill", "#000");
    out.text(bar.text).end();
  }
  std::string title() const {
    if (!options.title.empty()) return options.title;
    return motion.of().title.empty() ? "A mechanism" : motion.of().title;
  }
  /// A text that lists the parts, and the parts that are not drawn.
  std::string description() const {
    const scene& s = motion.of();
    std::string text = s.bodies.size() == 1 ? "1 body" : std::to_string(s.bodies.size()) + " bodies";
    text += s.joints.size() == 1 ? ", 1 joint. " : ", " + std::to_string(s.joints.size()) + " joints. ";
    const auto missing = shapes.left_out();
    for (std::size_t i = 0; i < missing.size(); ++i) text += (i == 0 ? "Not drawn: " : ", ") + missing[i];
    return text + (missing.empty() ? "" : ".");
  }

  const picture_options& options;
  scene_motion motion;
  scene_view view;
  mechanism_shapes shapes;
  std::vector<int> trails, labels;
  std::vector<double> shown_times;
  double height = 0;

 private:
  void add_to(picture_box& box, const vec3<>& p) const { box.add(view.across(p), view.upwards(p)); }
  void add_to(picture_box& box, const std::vector<placed_frame>& frames) const {
    const scene& s = motion.of();
    const auto add = [&](int i) { add_to(box, frames[static_cast<std::size_t>(i)].position); };
    for (const auto& l : s.links) add(l.from), add(l.to);
    for (const auto& j : s.joints) {
      if (j.kind != "free") add(j.before);
      add(j.after);
    }
    for (const auto& f : s.forces)
      if (f.frames.size() >= 2)
        for (const int i : f.frames) add(i);
    if (!options.bodies) return;
    for (const auto& b : s.bodies) {
      const auto& f = frames[static_cast<std::size_t>(b.frame)];
      const vec3<> centre = f({b.centre[0], b.centre[1], b.centre[2]});
      double x = 0, y = 0;
      for (const auto& axis : half_axes(b, f)) {
        x += view.across(axis) * view.across(axis), y += view.upwards(axis) * view.upwards(axis);
      }
      const double c = view.across(centre), u = view.upwards(centre);
      x = std::sqrt(x), y = std::sqrt(y);
      box.add(c - x, u - y), box.add(c + x, u + y);
    }
  }
};

}  // namespace kte::detail::svg
