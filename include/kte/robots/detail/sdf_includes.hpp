#pragma once

#include <kte/robots/detail/included_file.hpp>
#include <kte/robots/detail/sdf_search.hpp>

namespace kte::detail {

/// Replaces <include> elements by the models of other files.
class sdf_includes {
 public:
  sdf_includes(robot_description& d, const robot_options& o, xml_parser parse)
      : d_(d), search_(d, o, parse), parse_(parse) {
    open_.push_back(whole_path(d.source));
  }

  /// Resolves the includes of a model and of its nested models.
  void resolve(xml_node& model) {
    if (++depth_ > deepest_element)
      xml_item(model, d_).fail("models nest deeper than " + std::to_string(deepest_element));
    for (auto& c : model.children) {
      if (c.name == "include") c = included(c);
      if (c.name == "model") resolve(c);
    }
    --depth_;
  }
  /// The replacement of an <include>: a model, an actor or a light, with the name, pose and other settings of the
  /// include; the <robot> of a URDF outside of models.
  xml_node included(const xml_node& n) {
    const xml_item x(n, d_);
    x.only({"uri", "name", "pose", "static", "placement_frame", "plugin"}, {"merge"});
    const auto uri = child_text(x, "uri");
    const auto folder = std::filesystem::path(n.file.empty() ? d_.source : n.file).parent_path();
    const auto path = search_.find(first_child(x, "uri").value(), uri, folder);
    const auto whole = whole_path(path);
    if (std::find(open_.begin(), open_.end(), whole) != open_.end())
      x.fail("'" + excerpt(uri) + "' includes itself, directly or through other files");
    if (open_.size() > deepest) x.fail("files that include each other go deeper than " + std::to_string(deepest));
    if (++count_ > most) x.fail("more than " + std::to_string(most) + " files are included");
    auto file = parsed(x, path, whole);
    if (file.name == "robot") {
      if (open_.size() > 1 || depth_ > 0)
        x.fail("'" + excerpt(uri) + "' is a URDF: only a world or the file itself may include one");
      override_model(x, file);
      return file;
    }
    if (file.name != "sdf")
      x.fail("'" + excerpt(uri) + "' is not a file in SDF: it begins with <" + excerpt(file.name) + ">");
    sdf_upgrade(d_).apply(file);
    auto found = only_model(x, file);
    elements_ += count_of(found);
    if (elements_ > most_elements)
      x.fail("included files have more than " + std::to_string(most_elements) + " elements together");
    if (found.name == "model") {
      override_model(x, found);
      open_.push_back(whole);
      resolve(found);
      open_.pop_back();
    }
    return found;
  }

 private:
  static constexpr std::size_t deepest = 32, most = 1000;

  /// A file is parsed once.
  xml_node parsed(const xml_item& x, const std::filesystem::path& path, const std::filesystem::path& whole) {
    if (const auto known = files_.find(whole); known != files_.end()) return known->second;
    d_.files.push_back(path.string());
    return files_.emplace(whole, included_file(x, path, parse_)).first->second;
  }
  static std::size_t count_of(const xml_node& n) {
    std::size_t all = 1;
    for (const auto& c : n.children) all += count_of(c);
    return all;
  }

  static std::filesystem::path whole_path(const std::filesystem::path& path) {
    std::error_code none;
    return std::filesystem::weakly_canonical(path, none);
  }
  static xml_node only_model(const xml_item& x, xml_node& file) {
    xml_node* found = nullptr;
    for (auto& c : file.children) {
      if (c.name != "model" && c.name != "actor" && c.name != "light") continue;
      if (found != nullptr) x.fail("the file '" + excerpt(c.file) + "' has several models: a file to include has one");
      found = &c;
    }
    if (found == nullptr) x.fail("the file '" + excerpt(file.file) + "' has no model beside its worlds");
    return std::move(*found);
  }
  static void set(xml_node& n, const char* attribute, const std::string& value) {
    for (auto& [key, old] : n.attributes)
      if (key == attribute) {
        old = value;
        return;
      }
    n.attributes.emplace_back(attribute, value);
  }
  static void override_model(const xml_item& x, xml_node& model) {
    if (const auto name = filled_child(x, "name")) set(model, "name", std::string(trimmed_content(*name)));
    if (const auto frame = filled_child(x, "placement_frame")) {
      if (x.children("pose").empty()) frame->fail("needs a <pose>");
      set(model, "placement_frame", std::string(trimmed_content(*frame)));
    }
    if (flag(x, x.text_or("merge", "false"))) set(model, merged, "true");
    for (const char* of : {"pose", "static"})
      if (const auto c = first_child(x, of)) {
        std::erase_if(model.children, [&](const auto& m) { return m.name == of; });
        model.children.push_back(c->node());
      }
    for (const auto& p : x.children("plugin")) model.children.push_back(p.node());
  }

 public:
  /// Marks a model that is merged into the enclosing one.
  static constexpr const char* merged = "kte:merge";

 private:
  robot_description& d_;
  sdf_search search_;
  xml_parser parse_;
  std::vector<std::filesystem::path> open_;
  std::map<std::filesystem::path, xml_node> files_;
  std::size_t count_ = 0, elements_ = 0;
  int depth_ = 0;
};

}  // namespace kte::detail
