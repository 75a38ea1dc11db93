#pragma once

#include <kte/errors.hpp>
#include <kte/io/archive_record.hpp>
#include <kte/io/field_names.hpp>
#include <kte/io/field_writer.hpp>
#include <kte/io/numbers.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace kte::detail {

/// Writes records to a file of any format. Throws `bad_file` for records that could not be read again: gravity that is
/// not finite, names with control characters or duplicate names, in XML parameter names that are not valid tags.
class record_writer {
 public:
  explicit record_writer(field_writer& out) : out_(out) {}

  /// A file of a chain; version 2 if it contains more.
  void model_file(const model_record& m) {
    out_.open_group("kte_model");
    const bool more = !m.tools.empty() || !m.limits.empty() || !m.inputs.empty();
    out_.whole_number("version", more ? archive_file_version : model_file_version);
    model(m);
    out_.close();
  }
  void archive_file(const archive_record& all) {
    out_.open_group("kte_archive");
    out_.whole_number("version", archive_file_version);
    out_.open_list("roots");
    std::set<std::string_view> names;
    for (const auto& r : all.roots) {
      part_ = "root '" + r.name + "': ";
      out_.open_group("");
      name("name", r.name);
      once(r.name, names);
      std::visit([&](const auto& x) { content(std::string(content_fields[r.content.index()]), x); }, r.content);
      out_.close();
    }
    out_.close();
    out_.close();
  }

 private:
  void content(const std::string& field, const model_record& m) {
    out_.open_group(field);
    model(m);
    out_.close();
  }
  void content(const std::string& field, const thing_record& x) { thing(field, x); }
  void content(const std::string& field, const state_record& s) {
    out_.open_list(field);
    std::set<std::pair<bool, std::string_view>> names;
    for (const auto& x : s.things) {
      if (!names.insert({is_frame(x.what), x.name}).second) fail("it has two things '" + x.name + "'");
      thing("", x);
    }
    out_.close();
  }
  void content(const std::string& field, const calculator_record& c) {
    out_.open_group(field);
    name("chain", c.chain);
    if (!c.of_all) texts("inertias", c.inertias), texts("coordinates", c.coordinates);
    out_.close();
  }
  void content(const std::string& field, const numbers_record& x) { numbers(field, x); }

  void model(const model_record& m) {
    const auto& g = m.gravity;
    if (g.size() != 3 || !std::all_of(g.begin(), g.end(), [](double x) { return std::isfinite(x); }))
      fail("the gravity of a model must be three finite numbers, it is '" + numbers_to_text(g) + "'");
    out_.numbers("gravity", g);
    out_.open_list("elements");
    const std::string before = part_;
    for (const auto& e : m.elements) {
      part_ = before + "element " + std::to_string(&e - m.elements.data() + 1) + " (" + e.type + "): ";
      element(e);
    }
    part_ = before;
    out_.close();
    if (!m.tools.empty()) texts("tools", m.tools);
    if (!m.limits.empty()) limits(m.limits);
    if (!m.inputs.empty()) inputs(m.inputs);
  }
  void element(const element_record& e) {
    out_.open_group("");
    name("type", e.type);
    out_.whole_number("version", e.version);
    std::set<std::string_view> roles, parameters;
    out_.open_group("ports");
    for (const auto& c : e.connections) field("port", c.role, roles), name(c.role, c.name);
    out_.close();
    out_.open_group("parameters");
    for (const auto& p : e.parameters) field("parameter", p.name, parameters), out_.numbers(p.name, p.values);
    out_.close();
    out_.close();
  }
  void limits(const std::vector<limit_record>& all) {
    out_.open_list("limits");
    std::set<std::string_view> coordinates;
    for (const auto& l : all) {
      once(l.coordinate, coordinates);
      out_.open_group("");
      name("coordinate", l.coordinate);
      std::set<std::string_view> known;
      for (const auto& p : l.limits) {
        if (std::find(std::begin(limit_fields), std::end(limit_fields), p.name) == std::end(limit_fields))
          fail("there is no limit '" + p.name + "'");
        once(p.name, known);
        out_.numbers(p.name, p.values);
      }
      out_.close();
    }
    out_.close();
  }
  void inputs(const std::vector<parameter_record>& all) {
    out_.open_list("inputs");
    std::set<std::string_view> known;
    for (const auto& x : all) {
      once(x.name, known);
      out_.open_group("");
      name("name", x.name);
      out_.numbers("value", x.values);
      out_.close();
    }
    out_.close();
  }
  void thing(const std::string& in, const thing_record& x) {
    out_.open_group(in);
    out_.text("type", std::string(kind_names[static_cast<std::size_t>(x.what)]));
    name("name", x.name);
    out_.open_group("values");
    std::set<std::string_view> known;
    for (const auto& v : x.values) field("quantity", v.name, known), numbers(v.name, v.values);
    out_.close();
    out_.close();
  }
  /// Numbers that are exact in double are written as doubles.
  void numbers(const std::string& in, const std::vector<long double>& x) {
    std::vector<double> d;
    d.reserve(x.size());
    for (const long double v : x) d.push_back(static_cast<double>(v));
    if (std::equal(d.begin(), d.end(), x.begin(), [](double a, long double b) { return a == b || std::isnan(b); }))
      out_.numbers(in, d);
    else
      out_.text(in, numbers_to_text(x));
  }
  void texts(const std::string& in, const std::vector<std::string>& all) {
    out_.open_list(in);
    for (const auto& t : all) check_name(in, t), out_.text("", t);
    out_.close();
  }

  void name(const std::string& of, const std::string& x) {
    check_name(of, x);
    out_.text(of, x);
  }
  void check_name(const std::string& of, const std::string& x) const {
    if (const char* why = name_fault(x)) fail("the name '" + x + "' of its " + of + " " + why);
  }
  /// The name of a field that is data.
  void field(const std::string& what, const std::string& x, std::set<std::string_view>& known) const {
    check_name(what, x);
    if (out_.has_tags() && tag_name_length(x) != x.size())
      fail("'" + x + "' is a " + what + ", but not a name for an XML tag");
    if (!known.insert(x).second) fail("it has two " + what + "s '" + x + "'");
  }
  void once(const std::string& x, std::set<std::string_view>& known) const {
    if (!known.insert(x).second) fail("it has '" + x + "' twice");
  }
  [[noreturn]] void fail(const std::string& why) const { raise<bad_file>("kte: " + part_ + why); }

  field_writer& out_;
  std::string part_;
};

}  // namespace kte::detail
