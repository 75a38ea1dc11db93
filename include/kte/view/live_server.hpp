#pragma once

#include <kte/view/live_options.hpp>
#include <kte/view/page_pull.hpp>
#include <kte/view/scene.hpp>
#include <kte/view/scene_row.hpp>

#include <memory>
#include <string_view>

namespace kte {

/// What a `live_page` is, whatever the chain: the server of the page, its sliders, its buttons, and its clock.
///
/// It listens at 127.0.0.1 alone, and answers who knows the address with its token of 128 bits. Threads of its own
/// serve the pages: `show` never waits for them, and each gets the newest state when it has taken the one before. All
/// members may be called in any thread.
class live_server {
 public:
  live_server(const live_server&) = delete;
  live_server& operator=(const live_server&) = delete;
  /// Tells the pages that this is the end, and closes them.
  ~live_server();

  /// "http://127.0.0.1:41234/2f...c1/". Who has it sees the page and moves the sliders: it is to be kept as a password.
  const std::string& url() const;
  /// How many pages are open.
  std::size_t pages() const;

  /// A slider, from now on. Throws `bad_argument` for a name that is there, for limits that are not in order or not
  /// finite, and for a value outside of them.
  void slider(std::string_view name, double lower, double upper, double value, std::string_view unit = "1");
  /// Where it stands. Throws `unknown_name`.
  double value(std::string_view name) const;
  /// What a page pulls now, for the elements `pull_2D`, `pull_3D` of the chain. Its stiffness is that by which the mass
  /// of the mechanism would swing at 9 rad/s.
  page_pull pull() const;
  /// Whether the page says so; the program goes on by `wait`, or by itself.
  bool paused() const;
  void pause(bool on = true);
  /// Whether Reset was pressed since the last call.
  bool reset();
  /// Seconds of the simulation in a second, as the page has it.
  double speed() const;

  /// Waits until the clock of the page is at t, s: it runs at `speed`, and stands while the page is paused. Step lets
  /// one call through, Reset too. A t before the last one, and one that comes late, sets the clock to it. False after
  /// `stop`.
  bool wait(double t);
  /// Waits until a page is open. False after `stop`.
  bool wait_for_page();
  /// A sentence for the page, in place of the one before.
  void say(std::string_view text);
  /// From now on `wait` and `wait_for_page` give false.
  void stop();

 protected:
  /// Serves a scene with one recording, whose columns are those of `publish`. Throws `bad_argument` for options that
  /// make no sense, and for a port where it cannot listen.
  live_server(const scene& s, const live_options& options);

  void publish(double t, const scene_row& row);

 private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

}  // namespace kte
