#pragma once

#include <kte/io/archive_record.hpp>
#include <kte/io/field_reader.hpp>

#include <cmath>

namespace kte::detail {

/// Reads the fields of a chain, and those of a manipulator model.
class model_fields {
 public:
  explicit model_fields(field_reader& in) : in_(in) {}

  /// Reads an open group. `alone`: the group is the whole file and has a version.
  void read(const char* what, model_record& m, bool alone) {
    int version = archive_file_version;
    bool more = false;
    const std::size_t start = in_.in().at();
    const auto visit = [&](const std::string& name) {
      if (name == "version") {
        version = in_.whole_number(name);
        if (version != model_file_version && version != archive_file_version) in_.refuse_version(version);
      } else if (name == "gravity") {
        gravity(m.gravity);
      } else if (name == "elements") {
        in_.groups(name, "element", [&] { element(m.elements.emplace_back()); });
      } else {
        more = true;
        read_more(name, m);
      }
    };
    if (alone) {
      in_.fields(what, {"version", "gravity", "elements"}, {"tools", "limits", "inputs"}, visit);
      if (more && version == model_file_version)
        in_.fail_at(start, "tools, limits and inputs are there from version 2 on, this is version 1");
    } else {
      in_.fields(what, {"gravity", "elements"}, {"tools", "limits", "inputs"}, visit);
    }
  }

 private:
  void gravity(std::vector<double>& g) {
    g = in_.numbers<double>("gravity");
    if (g.size() != 3) in_.fail("'gravity' has " + std::to_string(g.size()) + " numbers, not 3");
    for (const double x : g)
      if (!std::isfinite(x)) in_.fail("'gravity' must be finite, got " + number(x));
  }
  void element(element_record& e) {
    in_.fields("the element", {"type", "version", "ports", "parameters"}, {}, [&](const std::string& name) {
      if (name == "type") {
        e.type = in_.text(name);
        e.place = in_.place();
      } else if (name == "version") {
        e.version = in_.whole_number(name);
      } else if (name == "ports") {
        in_.any_fields(name, [&](const std::string& role, const file_place& at) {
          e.connections.push_back({role, in_.text(role), at});
        });
      } else {
        in_.any_fields(name, [&](const std::string& parameter, const file_place& at) {
          e.parameters.push_back({parameter, in_.numbers<double>(parameter), at});
        });
      }
    });
  }
  /// Reads the fields that a manipulator model has in addition to a chain.
  void read_more(const std::string& name, model_record& m) {
    if (name == "tools") {
      m.tools = in_.texts(name);
    } else if (name == "limits") {
      std::set<std::string> names;
      in_.groups(name, "limit", [&] {
        limit(m.limits.emplace_back());
        in_.once(names, m.limits.back().coordinate);
      });
    } else {
      std::set<std::string> names;
      in_.groups(name, "input", [&] {
        auto& x = m.inputs.emplace_back();
        in_.fields("the input", {"name", "value"}, {}, [&](const std::string& field) {
          if (field == "name") {
            x.name = in_.text(field), x.place = in_.place();
          } else {
            x.values = in_.numbers<double>(field);
          }
        });
        in_.once(names, x.name);
      });
    }
  }
  void limit(limit_record& l) {
    const auto& f = limit_fields;
    in_.fields("the limit", {"coordinate"}, {f[0], f[1], f[2], f[3], f[4], f[5]}, [&](const std::string& name) {
      if (name == "coordinate") {
        l.coordinate = in_.text(name), l.place = in_.place();
        return;
      }
      auto at = in_.place();
      l.limits.push_back({name, in_.numbers<double>(name), at});
    });
  }

  field_reader& in_;
};

}  // namespace kte::detail
