#pragma once

#include <kte/robots/detail/included_file.hpp>
#include <kte/robots/detail/mjcf_includes.hpp>
#include <kte/robots/detail/mjcf_settings.hpp>
#include <kte/robots/detail/xml_limits.hpp>

#include <deque>
#include <memory>
#include <unordered_map>

namespace kte::detail {

/// A file in MJCF or a model that it attaches, with its own settings.
struct mjcf_model {
  xml_node root;
  robot_description& d;
  std::filesystem::path folder;
  mjcf_settings settings;
  mjcf_model(xml_node r, robot_description& to, std::filesystem::path in, const robot_options& o)
      : root(std::move(r)), d(to), folder(std::move(in)), settings({root, to}, o) {}

  /// The path of the file of an asset: its name is relative to the folder of meshes, otherwise, in an included file,
  /// to the folder of that file in the folder of meshes, or to the folder of meshes in that folder.
  std::filesystem::path path_of(const xml_item& asset) const {
    const auto file = path_of_text(asset.text("file")), meshes = path_of_text(settings.mesh_folder());
    const auto name = settings.strips_paths() ? file.filename() : file;
    const auto usual = folder / meshes / name;
    if (is_file(usual) || asset.file().empty()) return usual;
    const auto of_include = std::filesystem::path(asset.file()).parent_path();
    for (const auto& other :
         {folder / meshes / of_include.lexically_proximate(folder) / name, of_include / meshes / name})
      if (is_file(other)) return other;
    return usual;
  }
  /// The first body or frame of a name; null: there is none.
  const xml_node* find(const std::string& kind, const std::string& name) {
    if (named_.empty())
      for (const auto& c : root.children)
        if (c.name == "worldbody") list(c);
    const auto it = named_.find(kind + ' ' + name);
    return it == named_.end() ? nullptr : it->second;
  }

 private:
  void list(const xml_node& around) {
    for (const auto& c : around.children) {
      if (c.name != "body" && c.name != "frame") continue;
      for (const auto& [key, value] : c.attributes)
        if (key == "name") named_.try_emplace(c.name + ' ' + value, &c);
      list(c);
    }
  }
  std::unordered_map<std::string, const xml_node*> named_;
};

/// The context of an element of MJCF within its body, from the enclosing <frame>, <replicate> and <attach>.
struct mjcf_scope {
  mjcf_model* model;
  robot_pose place{};              ///< in the axes of the body
  std::string around{};            ///< the class of defaults
  std::string prefix{}, suffix{};  ///< added to names
  bool copied = false;             ///< by <replicate> or <attach>
  std::string named(const std::string& name) const { return prefix + name + suffix; }
};

/// An element of a body, and its context.
struct mjcf_child {
  xml_item x;
  mjcf_scope in;
};

/// The elements of a body with <frame>, <replicate> and <attach> expanded.
class mjcf_tree {
 public:
  mjcf_tree(robot_description& d, const robot_options& o, xml_parser parse) : d_(d), options_(o), parse_(parse) {}

  /// The model of the robot's own file.
  mjcf_model& top(xml_node root) { return load(std::move(root), std::filesystem::path(d_.source).parent_path()); }

  std::vector<mjcf_child> children(const xml_item& x, const mjcf_scope& in) {
    std::vector<mjcf_child> all;
    expand(x, in, all);
    return all;
  }
  const std::deque<mjcf_model>& models() const { return models_; }
  /// The attached models, with the prefixes of their names.
  const std::vector<mjcf_scope>& attached() const { return attached_; }

 private:
  mjcf_model& load(xml_node root, const std::filesystem::path& folder) {
    mjcf_includes(d_, folder, parse_).resolve(root);
    check_orientations({root, d_});
    return models_.emplace_back(std::move(root), d_, folder, options_);
  }
  void expand(const xml_item& x, const mjcf_scope& in, std::vector<mjcf_child>& all) {
    for (const auto& c : x.children()) {
      if (c.name() == "frame")
        frame(c, in, all);
      else if (c.name() == "replicate")
        replicate(c, in, all);
      else if (c.name() == "attach")
        attach(c, in, all);
      else if (c.name() == "composite" || c.name() == "flexcomp")
        c.fail("is not read: flexible bodies are not modelled");
      else
        all.push_back({c, in});
      if (in.copied) count_copy(c);
    }
  }
  /// Counts what repeating and attaching make.
  void count_copy(const xml_item& x) {
    if (++count_ > most_elements)
      x.fail("<replicate> and <attach> make more than " + std::to_string(most_elements) + " elements");
  }
  void frame(const xml_item& x, mjcf_scope in, std::vector<mjcf_child>& all) {
    const auto own = in.model->settings.classes().cleaned(x);
    own.only(
        {"body", "geom", "site", "joint", "freejoint", "frame", "replicate", "attach", "camera", "light", "inertial"},
        {"name", "childclass", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis"});
    in.place = in.place * in.model->settings.place(own);
    in.around = own.text_or("childclass", in.around.c_str());
    if (!in.around.empty() && !in.model->settings.classes().has(in.around))
      x.fail("there is no default class '" + excerpt(in.around) + "'");
    expand(x, in, all);
  }
  /// Expands <replicate>: copy i is at T^i, T = (offset, euler); its number, with leading zeros, ends its names.
  void replicate(const xml_item& x, mjcf_scope in, std::vector<mjcf_child>& all) {
    x.only({"body", "geom", "site", "frame", "replicate", "attach", "camera", "light"},
           {"count", "sep", "offset", "euler", "childclass"});
    const double count = x.whole(x.number("count"), "count", 1, 1e6);
    const robot_pose step{x.vector_or("offset", {}), in.model->settings.rotation_of_euler(x, x.vector_or("euler", {}))};
    const auto before = in.suffix;
    in.copied = true;
    const std::size_t digits = std::to_string(static_cast<long>(count) - 1).size();
    for (long i = 0; i < static_cast<long>(count); ++i, in.place = in.place * step) {
      auto text = std::to_string(i);
      text.insert(0, digits - (std::min)(digits, text.size()), '0');
      in.suffix = x.text_or("sep", "") + text + before;
      count_copy(x);
      expand(x, in, all);
    }
  }
  /// Expands <attach>: a body or a frame of another model, or all contents of its world; without a model, of this one.
  void attach(const xml_item& x, mjcf_scope in, std::vector<mjcf_child>& all) {
    x.only({}, {"model", "body", "frame", "prefix", "name"});
    if (++depth_ > 32) x.fail("models attach each other more than 32 deep");
    if (x.has("model")) in.model = &model(x, *in.model), in.around.clear();
    in.prefix += x.text_or("prefix", ""), in.copied = true;
    attached_.push_back(in);
    const char* const kind = x.has("frame") ? "frame" : "body";
    const auto name = x.text_or(kind, "");
    bool found = false;
    if (name.empty()) {
      for (const auto& w : xml_item(in.model->root, d_).children("worldbody")) expand(w, in, all), found = true;
    } else if (const auto* const n = in.model->find(kind, name)) {
      found = true;
      const xml_item named(*n, d_);
      n->name == "frame" ? frame(named, in, all) : all.push_back({named, in});
    }
    if (!found) x.fail("there is no " + std::string(kind) + " '" + excerpt(name) + "' to attach");
    --depth_;
  }
  /// The model of an <asset>, read once; without a name it has the name of its file.
  mjcf_model& model(const xml_item& x, mjcf_model& from) {
    auto& known = by_name_[{&from, x.text("model")}];
    return known != nullptr ? *known : *(known = &searched(x, from));
  }
  mjcf_model& searched(const xml_item& x, mjcf_model& from) {
    const auto name = x.text("model");
    for (const auto& a : xml_item(from.root, d_).children("asset"))
      for (const auto& m : a.children("model")) {
        if (m.has("name") && m.text("name") != name) continue;
        auto path = from.folder / m.text("file");
        if (!is_file(path) && !m.file().empty()) path = std::filesystem::path(m.file()).parent_path() / m.text("file");
        auto& known = by_path_[path.string()];
        if (known == nullptr) {
          if (!is_file(path)) m.fail("there is no file '" + excerpt(m.text("file")) + "'");
          d_.files.push_back(path.string());
          known = &load(included_file(m, path, parse_), path.parent_path());
        }
        if (m.has("name") || xml_item(known->root, d_).text_or("model", "") == name) return *known;
      }
    x.fail("there is no model '" + excerpt(name) + "' among the assets");
  }

  robot_description& d_;
  const robot_options& options_;
  xml_parser parse_;
  std::deque<mjcf_model> models_;
  std::map<std::string, mjcf_model*> by_path_;
  std::map<std::pair<const mjcf_model*, std::string>, mjcf_model*> by_name_;  ///< by the model that attaches it
  std::vector<mjcf_scope> attached_;
  int depth_ = 0;
  std::size_t count_ = 0;
};

}  // namespace kte::detail
