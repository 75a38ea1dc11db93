#pragma once

#include <kte/view/svg/path_data.hpp>

#include <vector>

namespace kte::detail::svg {

/// A curve through many points as a path that looks the same: of points in a row within 0.1 mm from left to right it
/// has the first, the lowest, the highest and the last, so that no spike is lost.
class curve_path {
 public:
  void add(picture_point p) {
    const double column = std::floor(p.x * 10);
    if (count_ == 0 || column != column_) put_kept(), first_ = lowest_ = highest_ = {p, count_}, column_ = column;
    if (p.y < lowest_.point.y) lowest_ = {p, count_};
    if (p.y > highest_.point.y) highest_ = {p, count_};
    last_ = {p, count_++};
    kept_ = true;
  }
  /// The next point begins anew.
  void gap() {
    put_kept();
    if (drawn_ == 1) dots.push_back(at_);
    count_ = 0, drawn_ = 0;
  }
  std::string text() const { return path_.text(); }

  std::vector<picture_point> dots;  ///< points between gaps

 private:
  struct numbered {
    picture_point point;
    std::size_t number;
  };
  void put_kept() {
    if (!kept_) return;
    const bool down = lowest_.number < highest_.number;
    for (const auto& p : {first_, down ? lowest_ : highest_, down ? highest_ : lowest_, last_}) put(p.point);
    kept_ = false;
  }
  /// A path of one point shows nothing: it begins with the second.
  void put(picture_point p) {
    if (drawn_ > 0 && hundredths(p.x) == hundredths(at_.x) && hundredths(p.y) == hundredths(at_.y)) return;
    if (drawn_ == 1) path_.move(at_);
    if (drawn_ > 0) path_.line(p);
    at_ = p, ++drawn_;
  }

  path_data path_;
  numbered first_{}, lowest_{}, highest_{}, last_{};
  double column_ = 0;
  std::size_t count_ = 0, drawn_ = 0;  ///< since the last gap
  bool kept_ = false;
  picture_point at_{};
};

}  // namespace kte::detail::svg
