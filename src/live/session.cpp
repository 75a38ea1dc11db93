#include "session.hpp"

#include <kte/contract/nearest_name.hpp>
#include <kte/errors.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace kte::live {

using lock = std::unique_lock<std::mutex>;
using seconds = std::chrono::duration<double>;

namespace {
constexpr seconds between_pictures{1.0 / 60}, silence{1}, late{0.1}, farewell{0.5}, hold{2};
}

session::session(const scene& s, std::size_t recording_bytes, bool paused, double speed)
    : recording_(1 + s.recordings.front().columns.size(), recording_bytes), rule_(s) {
  controls_.paused = paused, controls_.speed = speed;
}

void session::changed_controls() {
  ++controls_version_;
  for_pages_.notify_all(), for_program_.notify_all();
}

void session::add(slider s) {
  const lock l(mutex_);
  for (const auto& known : controls_.sliders)
    if (known.name == s.name) detail::raise<bad_argument>("kte: the page has a slider '" + s.name + "' already");
  if (!std::isfinite(s.lower) || !std::isfinite(s.upper) || !(s.lower < s.upper) ||
      !(s.value >= s.lower && s.value <= s.upper))
    detail::raise<bad_argument>("kte: slider '" + s.name + "' goes from " + detail::number(s.lower) + " to " +
                                detail::number(s.upper) + " and stands at " + detail::number(s.value) +
                                ": limits are finite and in order, and the value is between them");
  controls_.sliders.push_back(std::move(s));
  changed_controls();
}
double session::value(std::string_view name) const {
  const lock l(mutex_);
  std::vector<std::string> known;
  for (const auto& s : controls_.sliders) {
    if (s.name == name) return s.value;
    known.push_back(s.name);
  }
  detail::raise<unknown_name>("kte: the page has no slider '" + std::string(name) + "'" +
                              detail::did_you_mean(name, known));
}
bool session::paused() const {
  const lock l(mutex_);
  return controls_.paused;
}
double session::speed() const {
  const lock l(mutex_);
  return controls_.speed;
}
bool session::take_reset() {
  const lock l(mutex_);
  return std::exchange(reset_, false);
}
std::size_t session::pages() const {
  const lock l(mutex_);
  return pages_;
}

bool session::wait(double t) {
  lock l(mutex_);
  bool first = true;
  for (;; first = false) {
    if (stopped_) return false;
    const auto now = clock::now();
    const auto set_clock = [&] { clock_t_ = t, clock_at_ = now, clock_stands_ = false; };
    if (resets_seen_ != resets_) {
      resets_seen_ = resets_;
      return set_clock(), true;
    }
    if (controls_.paused) {
      clock_stands_ = true;
      if (steps_ > 0) return --steps_, true;
      for_program_.wait(l);
      continue;
    }
    const seconds ahead((t - clock_t_) / controls_.speed), passed = now - clock_at_;
    if (clock_stands_ || t < clock_t_ || (first && passed - ahead > late)) return set_clock(), true;
    if (passed >= ahead) return true;
    for_program_.wait_for(l, std::min(ahead - passed, seconds(3600)));
  }
}
bool session::wait_for_page() {
  lock l(mutex_);
  for_program_.wait(l, [this] { return stopped_ || pages_ > 0; });
  return !stopped_;
}
void session::say(std::string_view text) {
  const lock l(mutex_);
  controls_.message = text;
  changed_controls();
}
void session::stop() {
  const lock l(mutex_);
  stopped_ = true;
  for_program_.notify_all();
}

void session::publish(double t, const scene_row& row) {
  const lock l(mutex_);
  shown_.t = t, shown_.numbers = row, shown_.pull = pull_now();
  if (controls_.recording) {
    recording_.add(t, row.cells);
    shown_.rows = recording_.rows();
    if (recording_.full()) {
      controls_.recording = false, controls_.full = true;
      changed_controls();
    }
  }
  ++states_;
  for_pages_.notify_all();
}

void session::pause(bool on) {
  const lock l(mutex_);
  if (controls_.paused == on) return;
  controls_.paused = on, steps_ = 0;
  changed_controls();
}
void session::step() {
  const lock l(mutex_);
  if (!controls_.paused) {
    controls_.paused = true, steps_ = 0;
  } else {
    ++steps_;
  }
  changed_controls();
}
void session::reset() {
  const lock l(mutex_);
  reset_ = true, ++resets_;
  controls_.message.clear();
  changed_controls();
}
void session::record(bool on) {
  const lock l(mutex_);
  if (on) recording_.clear(), shown_.rows = 0, controls_.full = false;
  controls_.recording = on;
  changed_controls();
}
bool session::set_slider(std::size_t index, double value) {
  const lock l(mutex_);
  if (index >= controls_.sliders.size()) return false;
  auto& s = controls_.sliders[index];
  if (!(value >= s.lower && value <= s.upper)) return false;
  s.value = value;
  changed_controls();
  return true;
}
bool session::set_speed(double value) {
  const lock l(mutex_);
  if (!(value >= slowest && value <= fastest)) return false;
  const auto now = clock::now();
  clock_t_ += controls_.speed * seconds(now - clock_at_).count(), clock_at_ = now;
  controls_.speed = value;
  changed_controls();
  return true;
}
bool session::pull(std::size_t frame, const vec3<>& point, const vec3<>& target) {
  const lock l(mutex_);
  const auto wanted = rule_.pull(frame, point, target);
  if (!wanted) return false;
  pull_ = *wanted, pulled_at_ = clock::now();
  return true;
}
void session::release() {
  const lock l(mutex_);
  pull_ = {};
}
page_pull session::pull() const {
  const lock l(mutex_);
  return pull_now();
}
page_pull session::pull_now() const { return clock::now() - pulled_at_ < hold ? pull_ : page_pull(); }
recording_rows session::recorded() const {
  const lock l(mutex_);
  return recording_;
}

std::shared_ptr<session::page> session::open_page() {
  const lock l(mutex_);
  if (pages_ >= most_pages || closed_) return nullptr;
  ++pages_;
  for_program_.notify_all();
  return std::make_shared<page>(*this);
}
session::page::~page() {
  const lock l(session_.mutex_);
  --session_.pages_;
  session_.for_program_.notify_all();
}
session::page::news session::page::next() {
  auto& s = session_;
  lock l(s.mutex_);
  const auto closed = [&s] { return s.closed_; };
  s.for_pages_.wait_until(l, last_ + std::chrono::duration_cast<clock::duration>(between_pictures), closed);
  s.for_pages_.wait_for(
      l, silence, [&] { return s.closed_ || seen_controls_ != s.controls_version_ || seen_states_ != s.states_; });
  news n;
  n.end = s.closed_;
  if (seen_controls_ != s.controls_version_) n.of_controls = s.controls_;
  if (seen_states_ != s.states_) n.of_state = s.shown_;
  seen_controls_ = s.controls_version_, seen_states_ = s.states_;
  last_ = clock::now();
  return n;
}
void session::close() {
  lock l(mutex_);
  closed_ = stopped_ = true;
  for_pages_.notify_all(), for_program_.notify_all();
  for_program_.wait_for(l, farewell, [this] { return pages_ == 0; });
}
bool session::closed() const {
  const lock l(mutex_);
  return closed_;
}

}  // namespace kte::live
