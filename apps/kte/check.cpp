#include <kte/io/program.hpp>
#include <kte/robots/check_robot.hpp>
#include <kte/robots/detail/robot_findings.hpp>
#include <kte/runtime_chain/check_chain.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "commands.hpp"
#include "json_writer.hpp"
#include "message.hpp"
#include "odd_numbers.hpp"
#include "recorded_scene.hpp"

namespace kte_tool {

namespace {

struct options {
  reading in;
  bool json = false, strict = false;
};

/// The findings: texts with positions, unread parts of the file, and moving parts.
struct findings {
  std::string format;
  std::vector<kte::robot_note> odd, not_read;
  std::optional<structure> parts;  ///< none where the file is no mechanism
  std::string loops;               ///< rows, rank and mobility of closures
};

/// Removes all notes but the first of those that are equal.
void keep_first(std::vector<kte::robot_note>& list) {
  std::set<std::tuple<std::string, int, std::string>> known;
  std::erase_if(list, [&known](const auto& n) { return !known.emplace(n.text, n.line, n.file).second; });
}

/// Adds findings about loops; their rows, rank and mobility are listed separately.
void look_at_loops(const kte::robot& r, findings& f) {
  for (const auto& text : kte::detail::loop_findings(r))
    if (text.starts_with("closed loops: "))
      f.loops = text;
    else
      f.odd.push_back({0, text});
  std::erase_if(f.odd, [&f](const kte::robot_note& n) { return n.text == f.loops; });
}

/// Adds meshes that are missing or broken; those of other formats than kte reads are listed as not read.
void look_at_meshes(const mechanism& m, findings& f) {
  for (const auto& note : meshes_not_drawn(m))
    (note.find(" are read (link ") == note.npos ? f.odd : f.not_read).push_back({0, note});
}

findings look_at(const options& o) {
  findings f;
  try {
    const auto m = read_mechanism(o.in);
    f.format = m.format, f.not_read = m.robot.not_read;
    if (m.model) f.odd = m.robot.warnings;
    if (m.description)
      for (const auto& n : kte::check_robot(*m.description, o.in.robot)) f.odd.push_back(n);
    for (const auto& text : kte::check_chain(m.chain())) f.odd.push_back({0, text});
    look_at_loops(m.robot, f);
    look_at_meshes(m, f);
    f.parts.emplace(m.robot);
    for (const auto& b : f.parts->bodies)
      if (m.model && b.as_published)
        f.odd.push_back(
            {0, "body of '" + b.frame + "': its inertia is not physically realizable, and taken as published"});
    for (const auto& text : odd_numbers(m, *f.parts)) f.odd.push_back({0, text});
  } catch (const broken_mechanism& e) {
    f.format = e.format, f.not_read = e.description.not_read;
    for (const auto& n : kte::check_robot(e.description, o.in.robot)) f.odd.push_back(placed(n, o.in.file));
  }
  keep_first(f.odd), keep_first(f.not_read);
  return f;
}

/// "7 degrees of freedom (7 revolute), 2 followers, 8 bodies of 32.1 kg, 17 frames, 1.3 m large"
std::string mobility_text(const structure& s) {
  std::map<std::string, std::size_t> kinds;
  std::size_t followers = 0;
  int dofs = 0;
  for (const auto& c : s.coordinates) {
    dofs += c.nv;
    followers += c.v < 0;
  }
  for (const auto& f : s.frames)
    if (f.parent >= 0 && !f.moved_by.empty()) ++kinds[short_type(f.by)];
  std::string joints;
  for (const auto& [type, n] : kinds) joints += (joints.empty() ? "" : ", ") + std::to_string(n) + " " + type;
  return degrees_text(dofs) + (joints.empty() ? "" : " (" + joints + ")") +
         (followers ? ", " + counted(followers, "follower") : "") + ", " + bodies_text(s.bodies.size()) + " of " +
         short_number(s.mass) + " kg, " + counted(s.frames.size(), "frame") + ", " + size_text(s.size);
}

/// The texts of notes, of each kind at most three: kinds differ in more than names in quotes, numbers and lines.
std::string grouped(const std::vector<std::string>& texts, const std::string& indent) {
  struct group {
    std::vector<std::string> texts;
    std::size_t more = 0;
  };
  std::vector<std::pair<std::string, group>> all;
  std::map<std::string, std::size_t> known;
  for (const auto& text : texts) {
    std::string kind;
    bool quoted = false;
    for (const char c : text) {
      if (c == '\'') quoted = !quoted;
      if (!quoted && !std::isdigit(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != 'e') kind += c;
    }
    const auto [at, first] = known.emplace(kind, all.size());
    if (first) all.emplace_back(kind, group{});
    auto& g = all[at->second].second;
    g.texts.size() < 3 ? g.texts.push_back(text) : void(++g.more);
  }
  std::string s;
  for (const auto& [kind, g] : all) {
    for (const auto& text : g.texts) s += indent + text + '\n';
    if (g.more > 0) s += indent + "and " + std::to_string(g.more) + " more of this kind (all: --json)\n";
  }
  return s;
}

std::string text_of(const findings& f, const options& o) {
  const auto file = printable(o.in.file);
  std::string s = grouped(texts_of(f.odd, file), "");
  if (s.empty()) s = file + ": nothing odd is found\n";
  if (const auto ignored = texts_of(f.not_read, ""); !ignored.empty()) {
    s += "not read (" + std::to_string(ignored.size()) + "):\n" + grouped(ignored, "  ");
  }
  if (f.parts) s += file + " (" + f.format + "): " + mobility_text(*f.parts) + '\n';
  if (!f.loops.empty()) s += f.loops + '\n';
  return s;
}

std::string json_of(const findings& f, const options& o) {
  json_writer j;
  const auto notes = [&](const char* name, const std::vector<kte::robot_note>& all) {
    j.key(name).list();
    for (const auto& n : all)
      j.object()
          .member("file", n.file.empty() ? o.in.file : n.file)
          .member("line", n.line)
          .member("text", with_option_names(n.text))
          .member("changes_motion", n.changes_motion)
          .end();
    j.end();
  };
  j.object().member("file", o.in.file).member("format", f.format).member("is_mechanism", f.parts.has_value());
  notes("odd", f.odd), notes("not_read", f.not_read);
  if (!f.loops.empty()) j.member("loops", f.loops);
  if (f.parts) {
    int dofs = 0;
    std::size_t followers = 0;
    for (const auto& c : f.parts->coordinates) dofs += c.nv, followers += c.v < 0;
    j.member("degrees_of_freedom", dofs).member("followers", followers).member("bodies", f.parts->bodies.size());
    j.member("mass", f.parts->mass).member("size", f.parts->size).member("frames", f.parts->frames.size());
  }
  return j.end().text();
}

int check(const options& o) {
  check_contacts(o.in);
  const auto f = look_at(o);
  kte::detail::write_standard_output(printable_lines(o.json ? json_of(f, o) : text_of(f, o)));
  return !f.parts || (o.strict && !f.odd.empty()) ? 1 : 0;
}

}  // namespace

void add_check(command_line& line) {
  const auto o = std::make_shared<options>();
  auto& c = line.add(
      "check", "reports what is unusual about a mechanism",
      "Reports what is unusual about a mechanism: inertias that are not physically realizable, joints that move no "
      "mass, empty ranges, masses, lengths and angles that appear to be in other units, a nearly singular mass "
      "matrix, links and joints that do not form a tree. Then lists the parts of the file that were not read, and "
      "the number of degrees of freedom. The exit code is 1 if the file is not a mechanism.");
  add_reading(c, o->in)
      .flag("--strict", o->strict, "exit code 1 also if anything is unusual")
      .flag("--json", o->json, "prints JSON");
  add_contacts(c, o->in).runs([o] { return check(*o); });
}

}  // namespace kte_tool
