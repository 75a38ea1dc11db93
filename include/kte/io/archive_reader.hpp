#pragma once

#include <kte/io/archive_record.hpp>
#include <kte/io/model_fields.hpp>

namespace kte {

namespace detail {

/// Reads a file of any format: known fields in any order, each once, all required fields.
class archive_reader {
 public:
  archive_reader(field_scanner& in, const read_options& options) : in_(in, options) {}

  /// A file with a single model is an archive with the root "model".
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
      model_fields(in_).read("'kte_model'", m, true);
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
        if (const int v = in_.whole_number(name); v != archive_file_version) in_.refuse_version(v);
        return;
      }
      in_.groups(name, "root", [&] {
        root(all.roots.emplace_back());
        in_.once(names, all.roots.back().name);
      });
    });
    check_chains(all);
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
        model_fields(in_).read("'chain'", r.content.emplace<model_record>(), false);
      } else if (name == kinds[1]) {
        in_.in().open_group(name);
        thing(r.content.emplace<thing_record>());
      } else if (name == kinds[2]) {
        auto& s = r.content.emplace<state_record>();
        std::set<std::string> names;
        in_.groups(name, "thing", [&] {
          auto& x = s.things.emplace_back();
          thing(x);
          if (!names.insert((is_frame(x.what) ? "frame " : "other ") + x.name)
                   .second)  // frames and others have separate namespaces
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
  /// Calculators refer to chains, which must exist.
  void check_chains(const archive_record& all) {
    std::set<std::string> chains;
    for (const auto& r : all.roots)
      if (std::holds_alternative<model_record>(r.content)) chains.insert(r.name);
    for (const auto& r : all.roots)
      if (const auto* c = std::get_if<calculator_record>(&r.content); c && !chains.contains(c->chain))
        raise<bad_file>("kte: " + to_string(r.place) + "root '" + r.name + "' is of the chain '" + c->chain +
                        "', which is not a root of the archive");
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
  field_reader in_;
  bool opened_ = false;
};

}  // namespace detail
}  // namespace kte
