#include "messages.hpp"

#include <kte/math/quaternion.hpp>

#include <array>

#include "../view/json_text.hpp"

namespace kte::live {

namespace {
std::string event(const char* name, const std::string& data) {
  return std::string("event: ") + name + "\ndata: " + data + "\n\n";
}
std::string text_of(const controls& c) {
  view::json_text j;
  j.open_object();
  j.key("paused"), j.boolean(c.paused);
  j.key("recording"), j.boolean(c.recording);
  j.key("full"), j.boolean(c.full);
  j.key("speed"), j.number(c.speed);
  j.key("message"), j.text(c.message);
  j.key("sliders"), j.open_list();
  for (const auto& s : c.sliders) {
    j.open_object();
    j.key("name"), j.text(s.name), j.key("unit"), j.text(s.unit);
    j.key("lower"), j.number(s.lower), j.key("upper"), j.number(s.upper), j.key("value"), j.number(s.value);
    j.close_object();
  }
  j.close_list(), j.close_object();
  return j.out();
}
void put(view::json_text& j, const page_pull& p) {
  j.open_object();
  j.key("frame"), j.text(p.frame);
  j.key("point"), j.list(std::array{p.point.x, p.point.y, p.point.z});
  j.key("target"), j.list(std::array{p.target.x, p.target.y, p.target.z});
  j.key("stiffness"), j.number(p.stiffness), j.key("damping"), j.number(p.damping);
  j.close_object();
}
std::string text_of(const shown& s) {
  std::vector<float> numbers;
  const auto add = [&numbers](double x) { numbers.push_back(static_cast<float>(x)); };
  for (std::size_t k = 0; k < s.numbers.poses.size(); k += 12) {
    const double *p = &s.numbers.poses[k], *r = p + 3;
    const auto q = to_quaternion(mat3<vec3<>>{{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}});
    for (const double x : {p[0], p[1], p[2], q.w, q.x, q.y, q.z}) add(x);
  }
  for (const auto* const list : {&s.numbers.q, &s.numbers.v, &s.numbers.signals, &s.numbers.cells})
    for (const double x : *list) add(x);
  view::json_text j;
  j.open_object();
  j.key("t"), j.number(s.t), j.key("rows"), j.number(static_cast<double>(s.rows));
  j.key("numbers"), j.numbers_in_base64(std::span<const float>(numbers));
  j.key("pull");
  s.pull.frame.empty() ? j.null() : put(j, s.pull);
  j.close_object();
  return j.out();
}
}  // namespace

std::string events_of(const session::page::news& n) {
  std::string text;
  if (n.of_controls) text += event("controls", text_of(*n.of_controls));
  if (n.of_state) text += event("state", text_of(*n.of_state));
  if (n.end) text += event("end", "{}");
  return text.empty() ? ":\n\n" : text;
}

std::vector<std::string> names_in_table(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const auto& name : names) {
    std::string text;
    bool plain = true;
    for (const char c : name) {
      const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
      plain = plain && !control && c != ' ' && c != ',' && c != '"' && c != '\'' && c != '\\';
      text.append(c == '"' ? 2 : 1, control ? '_' : c);
    }
    all.push_back(plain ? text : '"' + text + '"');
  }
  return all;
}

}  // namespace kte::live
