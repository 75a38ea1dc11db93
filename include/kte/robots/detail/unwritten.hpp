#pragma once

#include <kte/detail/raise.hpp>
#include <kte/errors.hpp>
#include <kte/robots/writing.hpp>

namespace kte::detail {

/// Four numbers, or none: three are opaque.
inline std::vector<double> colour_of(const robot_shape& s) {
  auto rgba = s.rgba;
  if (rgba.size() == 3) rgba.push_back(1);
  return rgba.size() == 4 ? rgba : std::vector<double>{};
}

/// What a format has no words for, while a robot is written: listed, or refused where it changes the motion.
class unwritten {
 public:
  /// `before` is what was lost on the way here.
  unwritten(const robot_writing& o, std::string format, std::vector<robot_note> before)
      : o_(o), format_(std::move(format)), notes_(std::move(before)) {}

  void list(int line, std::string what) { notes_.push_back({line, std::move(what)}); }
  /// `instead` is what a lossy file has.
  void change(int line, const std::string& of, const std::string& why, const std::string& instead) {
    if (!o_.lossy)
      raise<bad_argument>("kte: " + of + ": " + why + ", which " + format_ +
                          " cannot say (robot_writing::lossy: " + instead + ")");
    list(line, of + ": " + why + ", which " + format_ + " cannot say: " + instead);
  }
  [[noreturn]] void refuse(const std::string& of, const std::string& why) const {
    raise<bad_argument>("kte: " + of + ": " + why + ", which " + format_ + " cannot say");
  }
  const std::vector<robot_note>& notes() const { return notes_; }
  /// At the end, when nothing can be refused any more.
  void hand_over() {
    if (o_.not_written) o_.not_written->insert(o_.not_written->end(), notes_.begin(), notes_.end());
  }

 private:
  const robot_writing& o_;
  std::string format_;
  std::vector<robot_note> notes_;
};

}  // namespace kte::detail
