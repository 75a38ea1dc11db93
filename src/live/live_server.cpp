#include <kte/errors.hpp>
#include <kte/view/live_server.hpp>

#include <cmath>

#include "../view/page_text.hpp"
#include "server.hpp"

namespace kte {

namespace {
std::vector<std::string> names_of(const scene& s) {
  std::vector<std::string> names{"t"};
  for (const auto& c : s.recordings.front().columns) names.push_back(c.name);
  return names;
}
const live_options& checked(const live_options& o) {
  if (o.port < 0 || o.port > 65535)
    detail::raise<bad_argument>("kte: a port is a number from 1 to 65535, or 0 for one that is free, not " +
                                std::to_string(o.port));
  if (!(o.speed >= live::session::slowest && o.speed <= live::session::fastest))
    detail::raise<bad_argument>("kte: the speed of a live page is between " + detail::number(live::session::slowest) +
                                " and " + detail::number(live::session::fastest) + ", not " + detail::number(o.speed));
  return o;
}
}  // namespace

struct live_server::parts {
  live::session session;
  live::server server;

  parts(const scene& s, const live_options& o)
      : session(s, o.recording_bytes, o.paused, o.speed),
        server(session, view::page_text(s, {.title = o.title, .mesh_bytes = o.mesh_bytes}, "kte", true), names_of(s),
               o.port) {}
};

live_server::live_server(const scene& s, const live_options& options)
    : parts_(std::make_unique<parts>(s, checked(options))) {}
live_server::~live_server() = default;

const std::string& live_server::url() const { return parts_->server.url(); }
std::size_t live_server::pages() const { return parts_->session.pages(); }
void live_server::slider(std::string_view name, double lower, double upper, double value, std::string_view unit) {
  parts_->session.add({std::string(name), std::string(unit), lower, upper, value});
}
double live_server::value(std::string_view name) const { return parts_->session.value(name); }
bool live_server::paused() const { return parts_->session.paused(); }
void live_server::pause(bool on) { parts_->session.pause(on); }
bool live_server::reset() { return parts_->session.take_reset(); }
double live_server::speed() const { return parts_->session.speed(); }
bool live_server::wait(double t) {
  if (!std::isfinite(t)) detail::raise<bad_argument>("kte: a page waits for a time, not " + detail::number(t));
  return parts_->session.wait(t);
}
bool live_server::wait_for_page() { return parts_->session.wait_for_page(); }
void live_server::say(std::string_view text) { parts_->session.say(text); }
void live_server::stop() { parts_->session.stop(); }

page_pull live_server::pull() const { return parts_->session.pull(); }
void live_server::publish(double t, const scene_row& row) { parts_->session.publish(t, row); }

}  // namespace kte
