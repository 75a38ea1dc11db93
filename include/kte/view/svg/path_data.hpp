#pragma once

#include <kte/view/svg/decimals.hpp>

namespace kte::detail::svg {

/// A point of a picture: mm from its left and top edge.
struct picture_point {
  double x, y;
};

/// The attribute `d` of a path. Each point is rounded once; relative steps are differences of rounded points.
class path_data {
 public:
  void move(picture_point p) {
    command('M');
    number(hundredths(p.x)), number(hundredths(p.y));
    to(p);
  }
  void line(picture_point p) {
    command('l');
    step(p);
    to(p);
  }
  /// A cubic of two control points and an end.
  void curve(picture_point a, picture_point b, picture_point end) {
    command('c');
    step(a), step(b), step(end);
    to(end);
  }
  void close() { text_ += 'z', last_ = 'z'; }
  const std::string& text() const { return text_; }

 private:
  void command(char c) {
    if (c != last_ || c == 'M') text_ += c, first_ = true;
    last_ = c;
  }
  void number(long n) {
    if (!first_ && n >= 0) text_ += ' ';
    append_hundredths(text_, n);
    first_ = false;
  }
  void step(picture_point p) { number(hundredths(p.x) - x_), number(hundredths(p.y) - y_); }
  void to(picture_point p) { x_ = hundredths(p.x), y_ = hundredths(p.y); }

  std::string text_;
  char last_ = 0;
  bool first_ = true;
  long x_ = 0, y_ = 0;
};

}  // namespace kte::detail::svg
