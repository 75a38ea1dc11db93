#pragma once

#include <kte/view/live_options.hpp>
#include <kte/view/page_pull.hpp>
#include <kte/view/scene.hpp>
#include <kte/view/scene_row.hpp>

#include <memory>
#include <string_view>

namespace kte {

/// The part of a `live_page` that does not depend on the chain: the server of the page, its sliders, its buttons, and
/// its clock.
///
/// It listens at 127.0.0.1 only, and answers only requests with the token of 128 bits in its address. Threads of the
/// server serve the pages: `show` never waits for them, and each page gets the newest state after it has shown the
/// previous one. All members may be called in any thread.
class live_server {
 public:
  live_server(const live_server&) = delete;
  live_server& operator=(const live_server&) = delete;
  /// Closes all pages.
  ~live_server();

  /// The address, "http://127.0.0.1:41234/2f...c1/". It gives access to the page and its sliders; keep it secret like a
  /// password.
  const std::string& url() const;
  /// The number of open pages.
  std::size_t pages() const;

  /// Adds a slider. Throws `bad_argument` for a name in use, for limits that are not finite and in order, and for a
  /// value outside of them.
  void slider(std::string_view name, double lower, double upper, double value, std::string_view unit = "1");
  /// The value of a slider. Throws `unknown_name`.
  double value(std::string_view name) const;
  /// The current pull of a page, for the elements `pull_2D`, `pull_3D` of the chain. Its stiffness is chosen for a
  /// natural frequency of 9 rad/s of the mechanism.
  page_pull pull() const;
  /// Whether the page is paused; the program may use `wait`, or this.
  bool paused() const;
  /// Pauses the page, or continues.
  void pause(bool on = true);
  /// Whether Reset was pressed since the last call.
  bool reset();
  /// The speed set in the page, seconds of the simulation per second.
  double speed() const;

  /// Waits until the clock of the page is at t, s. The clock runs at `speed`, and stops while the page is paused. The
  /// buttons Step and Reset let one call return. If t is before the previous t, or the call is late, the clock is set
  /// to t. Returns false after `stop`.
  bool wait(double t);
  /// Waits until a page is open. Returns false after `stop`.
  bool wait_for_page();
  /// Shows a text in the page, replacing the previous one.
  void say(std::string_view text);
  /// Makes `wait` and `wait_for_page` return false from this call on.
  void stop();

 protected:
  /// Serves a scene with one recording, whose columns are those of `publish`. Throws `bad_argument` for invalid
  /// options, and for a port that is not available.
  live_server(const scene& s, const live_options& options);

  void publish(double t, const scene_row& row);

 private:
  struct parts;
  std::unique_ptr<parts> parts_;
};

}  // namespace kte
