#pragma once

#include <kte/detail/raise.hpp>
#include <kte/errors.hpp>
#include <kte/robots/writing.hpp>

namespace kte::detail {

/// The colour as four numbers, or none; three numbers get an opacity of 1.
inline std::vector<double> colour_of(const robot_shape& s) {
  auto rgba = s.rgba;
  if (rgba.size() == 3) rgba.push_back(1);
  return rgba.size() == 4 ? rgba : std::vector<double>{};
}

/// Collects the contents of a robot that the written format does not support: listed, or rejected where they change the
/// motion.
class unwritten {
 public:
  /// `before`: notes on contents lost in earlier steps.
  unwritten(const robot_writing& o, std::string format, std::vector<robot_note> before)
      : o_(o), format_(std::move(format)), notes_(std::move(before)) {}

  void list(int line, std::string what) { notes_.push_back({line, std::move(what)}); }
  /// Notes a change of the motion; `instead` describes the content of a lossy file.
  void change(int line, const std::string& of, const std::string& why, const std::string& instead) {
    if (!o_.lossy)
      raise<bad_argument>("kte: " + of + ": " + why + ", which " + format_ +
                          " cannot say (robot_writing::lossy: " + instead + ")");
    list(line, of + ": " + why + ", which " + format_ + " cannot say: " + instead);
  }
  /// Notes compensations of weight, which no format supports for all readers.
  void compensations(const robot_description& d) {
    for (const auto& l : d.links)
      if (l.gravity_compensation != 0)
        change(l.line, "link '" + l.name + "'", "a force bears a part of its weight", "it is left out");
  }
  [[noreturn]] void refuse(const std::string& of, const std::string& why) const {
    raise<bad_argument>("kte: " + of + ": " + why + ", which " + format_ + " cannot say");
  }
  const std::vector<robot_note>& notes() const { return notes_; }
  /// Hands over the notes. Call this last, when nothing is rejected any more.
  void hand_over() {
    if (o_.not_written) o_.not_written->insert(o_.not_written->end(), notes_.begin(), notes_.end());
  }

 private:
  const robot_writing& o_;
  std::string format_;
  std::vector<robot_note> notes_;
};

}  // namespace kte::detail
