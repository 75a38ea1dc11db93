#include <kte/io/limit_records.hpp>
#include <kte/io/model_writer.hpp>
#include <kte/io/program.hpp>
#include <kte/io/replace_file.hpp>
#include <kte/robots/detail/shape_names.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/urdf_writer.hpp>

#include <algorithm>
#include <map>

#include "../kte_header/header_of_file.hpp"
#include "commands.hpp"
#include "mechanism.hpp"
#include "message.hpp"
#include "output_file.hpp"

namespace kte_tool {

namespace {

struct convert_options {
  reading in;
  std::string out, to, name;
  bool lossy = false;
};

enum class target { urdf, mjcf, json, xml, binary, header };

/// By --to, or the ending of the file.
target target_of(const convert_options& o) {
  static const std::map<std::string, target> formats{
      {"urdf", target::urdf},  {"mjcf", target::mjcf},  {"json", target::json}, {"xml", target::xml},
      {"kte", target::binary}, {"hpp", target::header}, {"h", target::header}};
  const auto extension = kte::detail::lower_extension(o.out);
  const auto wanted = !o.to.empty() ? o.to : extension.empty() ? "" : extension.substr(1);
  const auto found = formats.find(wanted);
  if (found != formats.end()) return found->second;
  if (wanted == "sdf") throw kte::bad_argument("kte: SDF is read, but not written; URDF and MJCF are");
  throw usage_error((wanted.empty() ? "'" + o.out + "' says no format" : "there is no format '" + wanted + "'") +
                    ": .urdf, .mjcf, .json, .xml (a model file), .kte, .hpp, or --to");
}

/// Properties that a format cannot represent, each listed once.
class leftovers {
 public:
  explicit leftovers(const mechanism& m) : m_(m) {}
  ~leftovers() {
    for (const auto& text : texts_of(notes_, m_.file)) say(text);
  }
  std::vector<kte::robot_note>* list() { return &notes_; }
  void add(const std::string& text) { notes_.push_back({0, text}); }
  /// What stays of a robot is its chain and its limits.
  void add_all_but_chain(bool limits_stay) {
    const auto& r = m_.robot;
    kte::detail::shape_names names;
    for (const auto& s : r.shapes) names.add(s.frame, s, s.collision);
    for (const auto& s : r.shapes) notes_.push_back({s.line, names.of(s) + " of '" + s.frame + "' is left out"});
    for (const auto& a : r.actuators)
      notes_.push_back(
          {a.line, "actuator " + (a.name.empty() ? "of '" + a.joint + "'" : "'" + a.name + "'") + " is left out"});
    for (const auto& c : r.configurations) notes_.push_back({0, "configuration '" + c.name + "' is left out"});
    if (r.soft_limits.lower != r.limits.lower || r.soft_limits.upper != r.limits.upper) add("soft limits are left out");
    if (m_.model) add_parts_of_model(limits_stay);
  }
  void add_parts_of_model(bool limits_stay) {
    for (const auto& t : m_.model->tools) add("tool '" + t + "' is left out");
    for (const auto& i : m_.model->inputs) add("the value of input '" + i.name + "' is left out");
    if (limits_stay) return;
    for (const auto& l : m_.model->limits) add("limits of '" + l.coordinate + "' are left out");
  }

 private:
  const mechanism& m_;
  std::vector<kte::robot_note> notes_;
};

kte::model_record record_of(const mechanism& m) {
  if (m.model) {
    auto r = *m.model;
    const auto& g = m.chain().gravity();
    r.gravity = {g.x, g.y, g.z};
    return r;
  }
  auto r = kte::record_of(m.chain());
  r.limits = kte::limit_records(m.chain(), m.robot.limits);
  return r;
}

/// As the file describes it, unless options made another robot of it.
template <class Write>
std::string robot_text(const convert_options& o, const mechanism& m, leftovers& left, const Write& write) {
  const kte::robot_writing how{.not_written = left.list(), .lossy = o.lossy};
  if (m.model) left.add_parts_of_model(true);
  for (const auto& c : m.robot.configurations) left.add("configuration '" + c.name + "' is left out");
  const auto& r = o.in.robot;
  const bool as_described = m.description && r.root.empty() && !r.floating_base && !o.in.no_joint_dynamics;
  if (!as_described) return write(m.robot, how);
  auto d = *m.description;
  if (r.gravity) d.gravity = r.gravity;
  return write(d, how);
}

std::string text_of(const convert_options& o, target t, const mechanism& m) {
  leftovers left(m);
  switch (t) {
    case target::urdf:
      return robot_text(o, m, left, [](const auto& x, const auto& how) { return kte::to_urdf(x, how); });
    case target::mjcf:
      return robot_text(o, m, left, [](const auto& x, const auto& how) { return kte::to_mjcf(x, how); });
    case target::json:
      left.add_all_but_chain(true);
      return kte::to_json(record_of(m));
    case target::xml:
      left.add_all_but_chain(true);
      return kte::to_xml(record_of(m));
    case target::binary:
      left.add_all_but_chain(true);
      return kte::to_binary(record_of(m));
    case target::header:
      left.add_all_but_chain(!m.model);
      return header_of_file(kte::detail::text_of_file(o.in.file), o.in.file,
                            o.name.empty() ? std::filesystem::path(o.in.file).stem().string() : o.name,
                            robot_options_of(o.in), o.out, [](const auto&) {});  // which were said already
  }
  return {};
}

int convert(const convert_options& o) {
  const auto t = target_of(o);
  refuse_input_as_output({"OUT", o.out}, {{"FILE", o.in.file}});
  check_contacts(o.in);
  if (o.in.robot.contacts.requested() && (t == target::urdf || t == target::mjcf))
    throw usage_error("--ground is for model files and C++ headers: URDF and MJCF have the shapes that touch");
  const auto m = read_and_warn(o.in);
  refuse_file_of_robot_as_output({"OUT", o.out}, m, o.in);
  for (const auto& text : texts_of(m.robot.not_read, m.file)) say(text);
  const auto text = text_of(o, t, m);
  if (o.out == "-")
    kte::detail::write_standard_output(text);
  else
    kte::detail::replace_file(o.out, text);
  return 0;
}

}  // namespace

void add_convert(command_line& line) {
  const auto o = std::make_shared<convert_options>();
  auto& c = line.add(
      "convert", "converts it to another format",
      "Writes a mechanism in the format given by the ending of OUT: .urdf, .mjcf, .json, .xml or .kte (model files of "
      "the library), .hpp (a C++ header in which it is a type). Standard error lists what the format cannot express. "
      "OUT is replaced only after everything is written.");
  add_reading(c, o->in)
      .word("OUT", o->out, "the file to write; with --to, - is standard output")
      .text("--to", "FORMAT", o->to, "urdf, mjcf, json, xml, kte or hpp, whatever the name of OUT")
      .text("--name", "NAME", o->name, "name of the robot in a C++ header; default: that in the file")
      .flag("--lossy", o->lossy, "omits features that the format cannot express, instead of refusing them");
  add_contacts(c, o->in).runs([o] { return convert(*o); });
}

}  // namespace kte_tool
