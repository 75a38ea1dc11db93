#pragma once

#include <kte/view/svg/path_data.hpp>
#include <kte/view/svg/svg_writer.hpp>

#include <numbers>

namespace kte::detail::svg {

/// The style of a shape.
struct shape_style {
  const char* stroke;  ///< nullptr for none
  double width;        ///< mm
  const char* fill = nullptr;
  const char* dash = nullptr;
  double opacity = 1;  ///< of the fill
};

/// A line, area or circle of a picture. Shapes of one mechanism at several times differ only in their points.
struct drawn_shape {
  shape_style style;
  std::string name;                     ///< shown as a tooltip
  std::vector<picture_point> points;    ///< of a circle: its centre
  double radius = 0;                    ///< of a circle; otherwise 0
  bool closed = false, curved = false;  ///< curved: cubics, three points each after the first

  std::string path() const {
    path_data d;
    d.move(points.front());
    if (curved)
      for (std::size_t i = 1; i + 2 < points.size(); i += 3) d.curve(points[i], points[i + 1], points[i + 2]);
    else
      for (std::size_t i = 1; i < points.size(); ++i) d.line(points[i]);
    if (closed) d.close();
    return d.text();
  }
};

inline void set_style(svg_writer& out, const shape_style& s) {
  if (s.stroke != nullptr) out.set("stroke", s.stroke).set("stroke-width", s.width);
  if (s.fill != nullptr) out.set("fill", s.fill);
  if (s.fill != nullptr && s.opacity < 1) out.set("fill-opacity", s.opacity);
  if (s.dash != nullptr) out.set("stroke-dasharray", s.dash);
}
/// Begins the element of a shape, which the caller ends.
inline void begin_shape(svg_writer& out, const drawn_shape& s) {
  if (s.radius > 0)
    out.begin("circle").set("cx", s.points[0].x).set("cy", s.points[0].y).set("r", s.radius);
  else
    out.begin("path").set("d", s.path());
  set_style(out, s.style);
}
inline void put_shape(svg_writer& out, const drawn_shape& s) {
  begin_shape(out, s);
  if (!s.name.empty()) out.element("title", s.name);
  out.end();
}

/// Points of the ellipse c + a cos u + b sin u in `quarters` curves from u.
template <class Point, class At>
std::vector<Point> ellipse_points(double from, int quarters, const At& at) {
  constexpr double k = 0.5522847498;  // 4/3 tan(pi/8)
  std::vector<Point> points{at(std::cos(from), std::sin(from))};
  for (int i = 0; i < quarters; ++i) {
    const double u = from + i * std::numbers::pi / 2, c = std::cos(u), s = std::sin(u);
    points.push_back(at(c - k * s, s + k * c));
    points.push_back(at(-s + k * c, c + k * s));
    points.push_back(at(-s, c));
  }
  return points;
}

}  // namespace kte::detail::svg
