#pragma once

#include <kte/contract/nearest_name.hpp>
#include <kte/robots/detail/sdf_includes.hpp>
#include <kte/robots/detail/sdf_shape.hpp>

namespace kte::detail {

/// Chooses the model of a file in SDF that is the robot.
class sdf_choice {
 public:
  struct candidate {
    std::string name;
    xml_node* model = nullptr;
    const xml_node* world = nullptr;
    std::string fault{};  ///< reason why an included file cannot be read
  };

  sdf_choice(robot_description& d, const robot_options& o, xml_parser parse, xml_node& root)
      : d_(d), options_(o), includes_(d, o, parse), root_(root, d) {
    gather(root, nullptr);
    for (auto& w : root.children)
      if (w.name == "world") gather(w, &w);
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& c : all_) all.push_back(c.name);
    return all;
  }

  /// The model named by the options, or by "#2" the second of the file; otherwise the only one, the only one that is
  /// not static, or the only one of these with joints.
  const candidate& choose() const {
    if (all_.empty()) root_.fail("has no <model>");
    const auto& chosen = options_.model.empty() ? likely() : named();
    if (!chosen.fault.empty()) raise<bad_file>(chosen.fault);
    note_others(chosen);
    return chosen;
  }

 private:
  void gather(xml_node& owner, const xml_node* world) {
    for (auto& c : owner.children) {
      if (c.name != "model" && c.name != "include") continue;
      candidate found{xml_item(c, d_).text_or("name", ""), &c, world};
      try {
        if (c.name == "include") {
          found.name = included_name(c);
          c = includes_.included(c);
          if (c.name != "model" && c.name != "robot") continue;
          found.name = xml_item(c, d_).text_or("name", "");
        } else {
          includes_.resolve(c);
        }
      } catch (const bad_file& e) {
        found.fault = e.what();
      }
      all_.push_back(std::move(found));
    }
  }
  std::string included_name(const xml_node& n) const {
    std::string name, uri;
    for (const auto& c : n.children) {
      if (c.name == "name") name = trimmed(c.text);
      if (c.name == "uri") uri = trimmed(c.text);
    }
    return name.empty() ? std::filesystem::path(uri).filename().string() : name;
  }

  bool is_static(const candidate& c) const { return child_flag({*c.model, d_}, "static", false); }
  static bool has_joints(const xml_node& model) {
    return std::any_of(model.children.begin(), model.children.end(),
                       [](const xml_node& c) { return c.name == "joint" || (c.name == "model" && has_joints(c)); });
  }
  /// The first eight models for which `listed`; those whose names occur several times with their numbers.
  template <class Listed>
  std::string list(const Listed& listed) const {
    std::map<std::string_view, std::size_t> count;
    for (const auto& c : all_) ++count[c.name];
    std::string text;
    std::size_t all = 0;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (!listed(all_[i]) || ++all > 8) continue;
      text += (text.empty() ? "'" : ", '") + excerpt(all_[i].name) + "'";
      if (count[all_[i].name] > 1) text += " ('#" + std::to_string(i + 1) + "')";
    }
    return all > 8 ? text + " and " + std::to_string(all - 8) + " more" : text;
  }
  std::string list() const {
    return list([](const candidate&) { return true; });
  }

  const candidate& named() const {
    const candidate* found = nullptr;
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (options_.model == "#" + std::to_string(i + 1)) return all_[i];
    for (const auto& c : all_) {
      if (c.name != options_.model) continue;
      if (found != nullptr)
        root_.fail("has several models called '" + excerpt(c.name) + "': choose by its number, of " +
                   list([&](const candidate& x) { return x.name == options_.model; }));
      found = &c;
    }
    if (found == nullptr) {
      const auto meant = did_you_mean(options_.model, names());
      root_.fail("has no model '" + excerpt(options_.model) + "' (robot_options::model)" +
                 (meant.empty() ? "; its" : meant + " Its") + " models are " + list());
    }
    return *found;
  }
  const candidate& likely() const {
    if (all_.size() == 1) return all_[0];
    std::vector<const candidate*> moving, jointed;
    for (const auto& c : all_) {
      if (!c.fault.empty() || is_static(c)) continue;
      moving.push_back(&c);
      if (has_joints(*c.model)) jointed.push_back(&c);
    }
    if (moving.size() == 1) return *moving[0];
    if (jointed.size() == 1) return *jointed[0];
    std::string faults;
    for (const auto& c : all_)
      if (!c.fault.empty()) faults += "\n  " + c.fault;
    const auto& first = moving.empty() ? all_[0] : *moving[0];
    const auto namesakes = std::count_if(all_.begin(), all_.end(), [&](const auto& c) { return c.name == first.name; });
    const auto chosen = namesakes > 1 ? "#" + std::to_string(&first - all_.data() + 1) : excerpt(first.name);
    root_.fail("has several models: choose one, as by robot_options::model = \"" + chosen + "\", of " + list() +
               faults);
  }
  void note_others(const candidate& chosen) const {
    for (const auto& c : all_) {
      if (&c == &chosen) continue;
      if (!c.fault.empty())
        root_.warn("model '" + excerpt(c.name) + "', which is not the robot, cannot be read: " + c.fault);
      if (options_.contacts.requested() && c.model != nullptr) warn_of_height_maps(*c.model);
    }
    if (all_.size() > 1)
      root_.not_read("the robot is model '" + excerpt(chosen.name) +
                     "'; not read: " + list([&](const candidate& c) { return &c != &chosen; }));
  }

  /// Another model may be the ground; height maps of visuals do not touch.
  void warn_of_height_maps(const xml_node& x) const {
    for (const auto& c : x.children)
      if (c.name == "heightmap")
        warn_of_height_map({c, d_});
      else if (c.name != "visual")
        warn_of_height_maps(c);
  }

  robot_description& d_;
  const robot_options& options_;
  sdf_includes includes_;
  xml_item root_;
  std::vector<candidate> all_;
};

}  // namespace kte::detail
