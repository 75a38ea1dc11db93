#pragma once

#include <kte/io/progress.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#if __has_include(<unistd.h>)
#  include <unistd.h>
#endif

namespace kte {

/// Draws progress as a line of text that is overwritten, on a terminal:
///
///   kte::progress report(0.0, 10.0, kte::progress_bar());
///
///   [##########          ]  50 %  12 s, 12 s left
///
/// In a log file or a pipe it draws nothing by default. The last line, at 100 %, remains.
class progress_bar {
 public:
  /// Where progress is drawn: `on_terminals` only, or `always`.
  enum class draw { on_terminals, always };

  explicit progress_bar(std::FILE* out = stderr, draw when = draw::on_terminals)
      : out_(out), visible_(when == draw::always || is_terminal(out)) {}

  void operator()(double fraction, double elapsed, double left) const {
    if (!visible_) return;
    const auto filled = static_cast<std::size_t>(static_cast<double>(width) * fraction);
    std::string line = duration(elapsed);
    if (fraction < 1 && std::isfinite(left)) line += ", " + duration(left) + " left";
    line.resize(std::max<std::size_t>(line.size(), 32), ' ');  // overwrites longer texts
    std::fprintf(out_, "\r[%s%s] %3.0f %%  %s%s", std::string(filled, '#').c_str(),
                 std::string(width - filled, ' ').c_str(), std::floor(100 * fraction), line.c_str(),
                 fraction < 1 ? "" : "\n");
    std::fflush(out_);
  }

 private:
  static constexpr std::size_t width = 40;

  static bool is_terminal([[maybe_unused]] std::FILE* f) {
#if __has_include(<unistd.h>)
    return ::isatty(::fileno(f)) == 1;
#else
    return false;
#endif
  }
  /// "7 s", "2 min 5 s", "3 h 20 min".
  static std::string duration(double seconds) {
    const auto s = static_cast<long long>((std::min)(seconds, 1e12));
    const auto two = [](long long a, const char* large, long long b, const char* minor_unit) {
      return std::to_string(a) + large + std::to_string(b) + minor_unit;
    };
    if (s < 60) return std::to_string(s) + " s";
    return s < 3600 ? two(s / 60, " min ", s % 60, " s") : two(s / 3600, " h ", s % 3600 / 60, " min");
  }

  std::FILE* out_;
  bool visible_;
};

}  // namespace kte
