#pragma once

#include <kte/view/svg/path_data.hpp>

#include <array>
#include <set>
#include <vector>

namespace kte::detail::svg {

/// A curve through many points as a path of equal appearance: for points within 0.1 mm from left to right it has the
/// first, the lowest, the highest and the last, so that no spike is lost. In dense curves points are at multiples of
/// 0.05 mm, and repeated segments, as in a limit cycle, are drawn once.
class curve_path {
 public:
  explicit curve_path(bool crowded) : crowded_(crowded) {}

  void add(picture_point p) {
    const double column = std::floor(p.x * 10);
    if (count_ == 0 || column != column_) put_kept(), first_ = lowest_ = highest_ = {p, count_}, column_ = column;
    if (p.y < lowest_.point.y) lowest_ = {p, count_};
    if (p.y > highest_.point.y) highest_ = {p, count_};
    last_ = {p, count_++};
    kept_ = true;
  }
  /// Ends a curve segment; the next point starts a new one.
  void gap() {
    put_kept();
    if (drawn_ == 1 && dotted_.insert({hundredths(at_.x / 10), hundredths(at_.y / 10)}).second) dots.push_back(at_);
    count_ = 0, drawn_ = 0, pen_is_down_ = false;
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
  void put(picture_point p) {
    if (crowded_) p = {std::round(20 * p.x) / 20, std::round(20 * p.y) / 20};
    const std::array<long, 2> from{hundredths(at_.x), hundredths(at_.y)}, to{hundredths(p.x), hundredths(p.y)};
    if (drawn_ > 0 && from == to) return;
    if (drawn_ > 0 && (!crowded_ || lines_.insert(std::minmax(from, to)).second)) {
      if (!pen_is_down_) path_.move(at_);
      path_.line(p), pen_is_down_ = true;
    } else {
      pen_is_down_ = false;
    }
    at_ = p, ++drawn_;
  }

  bool crowded_;
  path_data path_;
  std::set<std::pair<std::array<long, 2>, std::array<long, 2>>> lines_;  ///< segments drawn so far, by their ends
  std::set<std::array<long, 2>> dotted_;                                 ///< positions of dots, in 0.1 mm
  numbered first_{}, lowest_{}, highest_{}, last_{};
  double column_ = 0;
  std::size_t count_ = 0, drawn_ = 0;  ///< since the last gap
  bool kept_ = false, pen_is_down_ = false;
  picture_point at_{};
};

}  // namespace kte::detail::svg
