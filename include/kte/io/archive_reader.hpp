#pragma once

#include <kte/io/archive_record.hpp>
#include <kte/io/field_reader.hpp>

#include <array>
#include <cmath>

namespace kte {

namespace detail {

/// Reads a file of any format: known fields in any order, each once, none missing that must be there.
class archive_reader {
 public:
  archive_reader(field_scanner& in, const read_options& options) : in_(in, options) {}

  /// A file of one model is an archive with the root "model".
  archive_record read() {
    archive_record all;
    in_.in().open_document();
    const std::size_t start = in_.in().at();
    in_.fields("the file", {}, {"kte_model", "kte_archive"}, [&](const std::string& name) {
      if (!all.roots.empty() || opened_) in_.fail("a file has either a 'kte_model' or a 'kte_archive'");
      opened_ = true;
      const auto place = in_.place();
      in_.in().open_group(name);
      if (name == "kte_archive") return archive(all);
      model_record m;
      model("'kte_model'", m, true);
      all.roots.push_back({"model", std::move(m), place});
    });
    if (!opened_) in_.fail_at(start, "the file has no 'kte_model'");
    in_.in().close_document();
    return all;
  }

 private:
  void archive(archive_record& all) {
    std::set<std::string> names;
    in_.fields("'kte_archive'", {"version", "roots"}, {}, [&](const std::string& name) {
      if (name == "version") {
        if (const int v = in_.whole_number(name); v != archive_file_version) refuse(v);
        return;
      }
      in_.groups(name, "root", [&] {
        root(all.roots.emplace_back());
        once(names, all.roots.back().name);
      });
    });
    check_chains(all);
  }
  void once(std::set<std::string>& names, const std::string& name) {
    if (!names.insert(name).second) in_.fail("a second '" + excerpt(name) + "'");
  }
  void root(root_record& r) {
    bool filled = false;
    const auto& kinds = content_fields;
    const std::size_t start = in_.in().at();
    r.place = in_.place();
    in_.fields("the root", {"name"}, {kinds[0], kinds[1], kinds[2], kinds[3], kinds[4]}, [&](const std::string& name) {
      if (name == "name") {
        r.name = in_.text(name);
        return;
      }
      if (std::exchange(filled, true)) in_.fail("a root is one thing, not a '" + name + "' too");
      if (name == kinds[0]) {
        in_.in().open_group(name);
        model("'chain'", r.content.emplace<model_record>(), false);
      } else if (name == kinds[1]) {
        in_.in().open_group(name);
        thing(r.content.emplace<thing_record>());
      } else if (name == kinds[2]) {
        auto& s = r.content.emplace<state_record>();
        std::set<std::string> names;
        in_.groups(name, "thing", [&] {
          auto& x = s.things.emplace_back();
          thing(x);
          if (!names.insert((is_frame(x.what) ? "frame " : "other ") + x.name).second)  // which live apart
            in_.fail("a second thing '" + x.name + "'");
        });
      } else if (name == kinds[3]) {
        in_.in().open_group(name);
        calculator(r.content.emplace<calculator_record>());
      } else {
        r.content = in_.numbers<long double>(name);
      }
    });
    if (!filled) in_.fail_at(start, "the root has none of chain, thing, state, mass_matrix_calc, numbers");
  }
  /// Calculators share chains, which must be there.
  void check_chains(const archive_record& all) {
    std::set<std::string> chains;
    for (const auto& r : all.roots)
      if (std::holds_alternative<model_record>(r.content)) chains.insert(r.name);
    for (const auto& r : all.roots)
      if (const auto* c = std::get_if<calculator_record>(&r.content); c && !chains.contains(c->chain))
        raise<bad_file>("kte: " + to_string(r.place) + "root '" + r.name + "' is of the chain '" + c->chain +
                        "', which is no root of the archive");
  }

  void model(const char* what, model_record& m, bool alone) {
    int version = archive_file_version;
    bool more = false;
    const std::size_t start = in_.in().at();
    const auto read = [&](const std::string& name) {
      if (name == "version") {
        version = in_.whole_number(name);
        if (version != model_file_version && version != archive_file_version) refuse(version);
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
      in_.fields(what, {"version", "gravity", "elements"}, {"tools", "limits", "inputs"}, read);
      if (more && version == model_file_version)
        in_.fail_at(start, "tools, limits and inputs are there from version 2 on, this is version 1");
    } else {
      in_.fields(what, {"gravity", "elements"}, {"tools", "limits", "inputs"}, read);
    }
  }
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
  /// What a model of a manipulator has besides a chain.
  void read_more(const std::string& name, model_record& m) {
    if (name == "tools") {
      m.tools = in_.texts(name);
    } else if (name == "limits") {
      std::set<std::string> names;
      in_.groups(name, "limit", [&] {
        limit(m.limits.emplace_back());
        once(names, m.limits.back().coordinate);
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
        once(names, x.name);
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
  void thing(thing_record& x) {
    in_.fields("the thing", {"type", "name", "values"}, {}, [&](const std::string& name) {
      if (name == "type") {
        x.what = kind_of(in_.text(name));
      } else if (name == "name") {
        x.name = in_.text(name), x.place = in_.place();
      } else {
        in_.any_fields(name, [&](const std::string& quantity, const file_place& at) {
          x.values.push_back({quantity, in_.numbers<long double>(quantity), at});
        });
      }
    });
  }
  kind kind_of(const std::string& name) {
    const auto* const k = std::find(std::begin(kind_names), std::end(kind_names), name);
    if (k == std::end(kind_names)) in_.fail("there is no thing of type '" + excerpt(name) + "'");
    return static_cast<kind>(k - std::begin(kind_names));
  }
  void calculator(calculator_record& c) {
    in_.fields("the calculator", {"chain"}, {"inertias", "coordinates"}, [&](const std::string& name) {
      if (name == "chain") {
        c.chain = in_.text(name);
        return;
      }
      c.of_all = false;
      (name == "inertias" ? c.inertias : c.coordinates) = in_.texts(name);
    });
  }
  [[noreturn]] void refuse(int version) {
    in_.fail("version " + std::to_string(version) + " of the format; this library reads versions 1 and 2");
  }

  field_reader in_;
  bool opened_ = false;
};

}  // namespace detail
}  // namespace kte
