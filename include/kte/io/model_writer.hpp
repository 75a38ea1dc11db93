#pragma once

#include <kte/io/model_reader.hpp>

#include <cereal/archives/json.hpp>
#include <cereal/archives/xml.hpp>
#include <cereal/types/string.hpp>

#include <sstream>

/// Records into model files, by cereal.
namespace kte {

template <class Archive>
void save(Archive& ar, const element_record& e);

namespace detail {

/// Throws `bad_file` where a file could not hold the model, so that it could not be read again.
class model_check {
 public:
  model_check(const model_record& m, bool xml) : xml_(xml) {
    const auto& g = m.gravity;
    if (g.size() != 3 || !std::all_of(g.begin(), g.end(), [](double x) { return std::isfinite(x); }))
      raise<bad_file>("kte: the gravity of a model must be three finite numbers, it is '" + numbers_to_text(g) + "'");
    for (const auto& e : m.elements) {
      place_ = "kte: element " + std::to_string(&e - m.elements.data() + 1) + " (" + e.type + "): ";
      name("type", e.type);
      std::set<std::string_view> roles, parameters;
      for (const auto& c : e.connections) field("port", c.role, roles), name(c.role, c.name);
      for (const auto& p : e.parameters) field("parameter", p.name, parameters);
    }
  }

 private:
  void name(const std::string& of, const std::string& x) const {
    if (const char* why = name_fault(x)) raise<bad_file>(place_ + "the name '" + x + "' of its " + of + " " + why);
  }
  void field(const std::string& what, const std::string& x, std::set<std::string_view>& known) const {
    name(what, x);
    if (xml_ && tag_name_length(x) != x.size())
      raise<bad_file>(place_ + "'" + x + "' is a " + what + ", but no name for a tag of XML");
    if (!known.insert(x).second) raise<bad_file>(place_ + "it has two " + what + "s '" + x + "'");
  }

  bool xml_;
  std::string place_;
};

/// Fields whose names are data.
struct text_fields {
  std::vector<std::pair<std::string, std::string>> fields;
};
template <class Archive>
void save(Archive& ar, const text_fields& x) {
  for (const auto& [name, value] : x.fields) ar(cereal::make_nvp(name, value));
}

struct element_list {
  const std::vector<element_record>& elements;
};
template <class Archive>
void save(Archive& ar, const element_list& x) {
  ar(cereal::make_size_tag(static_cast<cereal::size_type>(x.elements.size())));
  for (const auto& e : x.elements) ar(e);
}

struct model_root {
  const model_record& model;
};
template <class Archive>
void save(Archive& ar, const model_root& x) {
  ar(cereal::make_nvp("version", model_file_version), cereal::make_nvp("gravity", numbers_to_text(x.model.gravity)),
     cereal::make_nvp("elements", element_list{x.model.elements}));
}

template <class Archive>
std::string write(const model_record& m) {
  std::ostringstream out;
  {
    Archive ar(out);
    ar(cereal::make_nvp("kte_model", model_root{m}));
  }
  return out.str();
}

}  // namespace detail

template <class Archive>
void save(Archive& ar, const element_record& e) {
  detail::text_fields ports, parameters;
  for (const auto& c : e.connections) ports.fields.emplace_back(c.role, c.name);
  for (const auto& p : e.parameters) parameters.fields.emplace_back(p.name, detail::numbers_to_text(p.values));
  ar(cereal::make_nvp("type", e.type), cereal::make_nvp("version", e.version), cereal::make_nvp("ports", ports),
     cereal::make_nvp("parameters", parameters));
}

/// A model as a text. Throws `bad_file` for what `from_json`, `from_xml` would not read again: gravity that is not
/// finite, names with control characters, and for XML parameters whose names cannot be tags.
inline std::string to_json(const model_record& m) {
  detail::model_check(m, false);
  return detail::write<cereal::JSONOutputArchive>(m) + "\n";
}
inline std::string to_xml(const model_record& m) {
  detail::model_check(m, true);
  return detail::write<cereal::XMLOutputArchive>(m);
}

}  // namespace kte
