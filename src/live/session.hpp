#pragma once

#include <kte/view/scene_row.hpp>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string_view>

#include "pull_rule.hpp"
#include "recording_rows.hpp"

namespace kte::live {

struct slider {
  std::string name, unit;
  double lower, upper, value;
};

/// What the buttons and sliders of the pages say.
struct controls {
  std::vector<slider> sliders;
  double speed = 1;
  bool paused = false, recording = false, full = false;
  std::string message;
};

/// The newest state.
struct shown {
  double t = 0;
  scene_row numbers;
  page_pull pull;
  std::size_t rows = 0;  ///< of the recording then
};

/// What the program and its pages share. The program puts states and asks what the pages say; the threads of pages wait
/// for news. Nothing here waits for a page.
class session {
 public:
  session(const scene& s, std::size_t recording_bytes, bool paused, double speed);

  // ---- the program
  void add(slider s);
  double value(std::string_view name) const;
  bool paused() const;
  double speed() const;
  bool take_reset();
  bool wait(double t);
  bool wait_for_page();
  void say(std::string_view text);
  void stop();
  void publish(double t, const scene_row& row);
  page_pull pull() const;
  std::size_t pages() const;

  // ---- requests of the pages; false for an unknown slider or frame, or a number out of its limits
  void pause(bool on);
  void step();
  void reset();
  void record(bool on);
  bool set_slider(std::size_t index, double value);
  bool set_speed(double value);
  /// Pulls a point of a frame to a target, until `release`, or for as long as a page says so time and again.
  bool pull(std::size_t frame, const vec3<>& point, const vec3<>& target);
  void release();
  recording_rows recorded() const;

  /// A page, if there are not too many already: it counts until it is destroyed.
  class page {
   public:
    explicit page(session& s) : session_(s) {}
    page(const page&) = delete;
    ~page();
    struct news {
      std::optional<controls> of_controls;
      std::optional<shown> of_state;
      bool end = false;
    };
    /// Waits until there is something new, but not for long: not more often than pictures of a screen.
    news next();

   private:
    session& session_;
    std::size_t seen_controls_ = 0, seen_states_ = 0;
    std::chrono::steady_clock::time_point last_{};
  };
  std::shared_ptr<page> open_page();
  /// All pages end; waits for that, but not long.
  void close();
  bool closed() const;

  static constexpr std::size_t most_pages = 8;
  static constexpr double slowest = 1e-3, fastest = 1e3;

 private:
  using clock = std::chrono::steady_clock;
  void changed_controls();
  /// The current pull of a page.
  page_pull pull_now() const;

  mutable std::mutex mutex_;
  std::condition_variable for_program_, for_pages_;
  controls controls_;
  shown shown_;
  recording_rows recording_;
  pull_rule rule_;
  page_pull pull_;
  clock::time_point pulled_at_{};
  std::size_t controls_version_ = 1, states_ = 0, pages_ = 0, steps_ = 0, resets_ = 0, resets_seen_ = 0;
  bool reset_ = false, stopped_ = false, closed_ = false;
  bool clock_stands_ = true;
  double clock_t_ = 0;  ///< s, at clock_at_
  clock::time_point clock_at_{};
};

}  // namespace kte::live
