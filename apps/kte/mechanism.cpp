#include "mechanism.hpp"

#include <kte/elements/registry.hpp>
#include <kte/io/limit_records.hpp>
#include <kte/io/model_content.hpp>
#include <kte/robots/load_robot.hpp>

#include <algorithm>
#include <unordered_set>

#include "message.hpp"
#include "text_format.hpp"

namespace kte_tool {

namespace {

std::string format_of(std::string_view bytes) {
  const auto text = kte::detail::from_first_tag(kte::detail::without_mark(bytes));
  return text.starts_with("<mujoco") ? "MJCF" : text.starts_with("<sdf") ? "SDF" : "URDF";
}

void read_model(const reading& o, mechanism& m) {
  const auto& r = o.robot;
  if (r.floating_base || r.contacts.requested() || o.joint_dynamics || o.no_joint_dynamics || !r.root.empty() ||
      !r.model.empty() || r.quarter_turn_tolerance != kte::robot_options{}.quarter_turn_tolerance)
    throw kte::bad_argument("kte: " + o.file +
                            " is a model file, which is used unchanged: of these options it takes "
                            "--gravity alone");
  m.format = "model file";
  m.robot.name = std::filesystem::path(o.file).stem().string();
  m.robot.chain = kte::to_chain(*m.model);
  if (r.gravity) m.robot.chain.gravity(*r.gravity);
  m.robot.limits = m.robot.soft_limits = kte::limits_of(m.robot.chain, *m.model);
  for (const auto& e : kte::layout(m.robot.chain)) m.robot.joints.push_back(e.name);
}

}  // namespace

command& add_reading(command& c, reading& o, bool joint_dynamics) {
  o.robot.joint_dynamics = joint_dynamics;
  c.word("FILE", o.file, "URDF, MJCF, SDF, or a model file of the library; the content determines the format")
      .vector("--gravity", "X Y Z", o.robot.gravity, "m/s^2; default: that of the file, or (0, 0, -9.81)")
      .flag("--floating-base", o.robot.floating_base, "the root link moves freely, by a coordinate that comes first")
      .text("--root", "LINK", o.robot.root, "the link used as base; default: the root of the file")
      .text("--model", "NAME", o.robot.model, "the model to read from an SDF file with several")
      .texts("--search", "FOLDER", o.robot.search_path, "folder to search for model:// and package://; repeatable")
      .number("--quarter-turns", "RAD", o.robot.quarter_turn_tolerance,
              "angles within this tolerance of a quarter turn become exact; default 1e-15");
  if (joint_dynamics)
    c.flag("--no-joint-dynamics", o.no_joint_dynamics, "omits damping, friction, springs and rotor inertias of joints");
  else
    c.flag("--joint-dynamics", o.joint_dynamics, "includes damping, friction, springs and rotor inertias of joints");
  return c;
}

command& add_contacts(command& c, reading& o) {
  auto& contacts = o.robot.contacts;
  return c
      .text("--ground", "FRAME", contacts.ground,
            "contacts of collision shapes with the ground of this frame, such as world; rigid by default")
      .number("--friction", "MU", contacts.friction, "of all contacts; default: that of the file, or 1")
      .number("--restitution", "E", contacts.restitution, "of all contacts; default: that of the file, or 0")
      .number("--contact-stiffness", "K", contacts.compliant.stiffness, "compliant contacts instead, N/m^1.5")
      .number("--contact-dissipation", "C", contacts.compliant.dissipation, "of compliant contacts, s/m; default 0");
}

void check_contacts(const reading& o) {
  const auto& contacts = o.robot.contacts;
  const auto& soft = contacts.compliant;
  if (!contacts.requested() &&
      (contacts.friction || contacts.restitution || soft.stiffness != 0 || soft.dissipation != 0))
    throw usage_error("--friction, --restitution, --contact-stiffness and --contact-dissipation need --ground");
  if (soft.stiffness == 0 && soft.dissipation != 0)
    throw usage_error("--contact-dissipation needs --contact-stiffness");
}

kte::robot_options robot_options_of(const reading& o) {
  auto wanted = o.robot;
  if (const double x = wanted.quarter_turn_tolerance; !(x >= 0 && x <= 0.1))
    throw usage_error("--quarter-turns is between 0 and 0.1, not " + short_number(x));
  if (o.joint_dynamics || o.no_joint_dynamics) wanted.joint_dynamics = o.joint_dynamics;
  return wanted;
}

mechanism read_mechanism(const reading& o) {
  mechanism m;
  m.file = o.file;
  const auto bytes = kte::detail::text_of_file(o.file);
  m.model = kte::detail::model_in(bytes, o.file, {.warn = [&](const std::string& text) {
                                    m.robot.warnings.push_back(placed({0, text}, o.file));
                                  }});
  if (m.model) {
    read_model(o, m);
    return m;
  }
  const auto wanted = robot_options_of(o);
  m.format = format_of(bytes);
  m.description = kte::describe_robot(bytes, o.file, wanted);
  try {
    m.robot = kte::to_robot(*m.description, wanted);
    for (const auto& c : m.robot.configurations) m.stands |= wanted.contacts.requested() && c.name == "standing";
  } catch (const kte::error& e) {
    throw broken_mechanism(e.what(), m.format, *m.description);
  }
  return m;
}

mechanism read_and_warn(const reading& o, bool with_motors) {
  auto m = read_mechanism(o);
  if (with_motors)
    std::erase_if(m.robot.warnings,
                  [](const auto& n) { return n.text.find("by kte::add_motors alone") != n.text.npos; });
  for (const auto& text : texts_of(m.robot.warnings, m.file)) say(text);
  return m;
}

std::vector<std::string> coordinates_of(const mechanism& m, const kte::runtime_chain& chain) {
  std::unordered_set<std::string> free;
  const std::unordered_set<std::string_view> joints(m.robot.joints.begin(), m.robot.joints.end());
  std::vector<std::string> all;
  for (const auto& e : kte::layout(chain)) {
    free.insert(e.name);
    if (!joints.contains(e.name)) all.push_back(e.name);  // the base is not a joint of the file
  }
  for (const auto& name : m.robot.joints)  // those that follow others have no columns
    if (free.contains(name)) all.push_back(name);
  return all;
}

kte::robot_note placed(kte::robot_note note, const std::string& file) {
  if (!note.text.starts_with("kte: ")) return note;
  note.text.erase(0, 5);
  if (!note.text.starts_with(file + ":")) return note;
  note.text.erase(0, file.size() + 1);
  const auto number_before_colon = [&note] {
    const auto digits = std::min(note.text.find_first_not_of("0123456789"), note.text.size());
    if (digits == 0 || digits > 8 || note.text[digits] != ':') return 0;
    const int number = std::stoi(note.text.substr(0, digits));
    note.text.erase(0, digits + 1);
    return number;
  };
  note.line = number_before_colon();
  if (note.line > 0) number_before_colon();  // the column
  note.text.erase(0, note.text.find_first_not_of(' '));
  return note;
}

std::vector<std::string> texts_of(const std::vector<kte::robot_note>& notes, const std::string& source) {
  std::vector<std::string> all;
  std::unordered_set<std::string> known;
  for (const auto& note : notes) {
    const auto text =
        kte::detail::place_text(note.file.empty() ? source : note.file, note.line) + with_option_names(note.text);
    if (known.insert(text).second) all.push_back(text);
  }
  return all;
}

}  // namespace kte_tool
