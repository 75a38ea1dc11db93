#pragma once

#include <kte/robots/detail/mjcf_tree.hpp>

namespace kte::detail {

/// The colours of the material assets of files in MJCF.
class mjcf_materials {
 public:
  /// The colour of a material, at most four numbers; none if the material or its colour is missing.
  const std::vector<double>& rgba(const std::string& name, const mjcf_model& model) {
    auto& of_model = known_[&model];
    if (of_model.empty()) {
      of_model[""];
      for (const auto& a : xml_item(model.root, model.d).children("asset"))
        for (const auto& written : a.children("material")) {
          const auto m = model.settings.classes().resolved(written, "");
          if (m.has("name") && m.has("rgba")) of_model.emplace(m.text("name"), m.list("rgba"));
        }
    }
    const auto it = of_model.find(name);
    return it == of_model.end() ? of_model[""] : it->second;
  }

 private:
  std::map<const mjcf_model*, std::map<std::string, std::vector<double>, std::less<>>> known_;
};

}  // namespace kte::detail
