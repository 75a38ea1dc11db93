#pragma once

#include <kte/chain/from_record.hpp>
#include <kte/chain/registry.hpp>
#include <kte/io/numbers.hpp>
#include <kte/io/syntax.hpp>

#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

/// Models as XML and JSON, by cereal. A file is a flat list of elements in their order:
///
///   {"kte_model": {"version": 1, "gravity": "0 0 -9.81", "elements": [
///       {"type": "rigid_link_3D", "version": 1,
///        "ports": {"base": "ground", "end": "elbow"},
///        "parameters": {"position": "0 0 0.36", "rotation": "1 0 0 0 1 0 0 0 1"}}]}}
///
/// Numbers are texts of the shortest digits that read back to the same double (docs/file_format.md).
namespace kte {

/// The version of the format that this library writes and reads.
inline constexpr int model_file_version = 1;

namespace detail {

/// Fields whose names are data.
struct text_fields {
  std::vector<std::pair<std::string, std::string>> fields;
};
template <class Archive>
void save(Archive& ar, const text_fields& x) {
  for (const auto& [name, value] : x.fields) ar(cereal::make_nvp(name, value));
}
template <class Archive>
void load(Archive& ar, text_fields& x) {
  while (const char* name = ar.getNodeName()) {
    std::string field = name, value;
    ar(value);
    x.fields.emplace_back(std::move(field), std::move(value));
  }
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
template <class Archive>
void load(Archive& ar, element_record& e) {
  detail::text_fields ports, parameters;
  ar(cereal::make_nvp("type", e.type), cereal::make_nvp("version", e.version), cereal::make_nvp("ports", ports),
     cereal::make_nvp("parameters", parameters));
  for (auto& [role, name] : ports.fields) e.connections.push_back({role, name});
  for (auto& [name, text] : parameters.fields) {
    try {
      e.parameters.push_back({name, detail::text_to_numbers(text)});
    } catch (const bad_file& error) {
      throw bad_file(e.type + ": parameter '" + name + "': " + error.what());
    }
  }
}

namespace detail {

/// The list of elements; a message tells which one could not be read.
struct element_list {
  std::vector<element_record>* elements;
};
template <class Archive>
void save(Archive& ar, const element_list& x) {
  ar(cereal::make_size_tag(static_cast<cereal::size_type>(x.elements->size())));
  for (const auto& e : *x.elements) ar(e);
}
template <class Archive>
void load(Archive& ar, element_list& x) {
  cereal::size_type count{};
  ar(cereal::make_size_tag(count));
  for (cereal::size_type i = 0; i < count; ++i) {
    element_record e;
    try {
      ar(e);
    } catch (const std::exception& error) {
      throw bad_file("element " + std::to_string(i + 1) + ": " + error.what());
    }
    x.elements->push_back(std::move(e));
  }
}

struct model_root {
  model_record* model;
};
template <class Archive>
void save(Archive& ar, const model_root& x) {
  ar(cereal::make_nvp("version", model_file_version), cereal::make_nvp("gravity", numbers_to_text(x.model->gravity)),
     cereal::make_nvp("elements", element_list{&x.model->elements}));
}
template <class Archive>
void load(Archive& ar, model_root& x) {
  int version{};
  ar(cereal::make_nvp("version", version));
  if (version != model_file_version)
    throw bad_file("version " + std::to_string(version) + " of the format; this library reads version " +
                   std::to_string(model_file_version));
  std::string gravity;
  ar(cereal::make_nvp("gravity", gravity));
  x.model->gravity = text_to_numbers(gravity);
  element_list list{&x.model->elements};
  ar(cereal::make_nvp("elements", list));
}

template <class Archive>
std::string write(const model_record& m) {
  model_record copy = m;
  std::ostringstream out;
  {
    Archive ar(out);
    ar(cereal::make_nvp("kte_model", model_root{&copy}));
  }
  return out.str();
}
template <class Archive>
model_record read(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  model_record m;
  model_root root{&m};
  try {
    Archive ar(in);
    ar(cereal::make_nvp("kte_model", root));
  } catch (const std::exception& e) {
    throw bad_file("kte: " + file + ": " + e.what());
  }
  return m;
}

}  // namespace detail

/// A model as a text; `file` is what messages call it.
inline std::string to_json(const model_record& m) { return detail::write<cereal::JSONOutputArchive>(m) + "\n"; }
inline std::string to_xml(const model_record& m) { return detail::write<cereal::XMLOutputArchive>(m); }
/// Throws `bad_file` with the place: line and column for bad syntax, else the element.
inline model_record from_json(const std::string& text, const std::string& file = "JSON text") {
  detail::check_json(file, text);
  return detail::read<cereal::JSONInputArchive>(text, file);
}
inline model_record from_xml(const std::string& text, const std::string& file = "XML text") {
  detail::check_xml(file, text);
  return detail::read<cereal::XMLInputArchive>(text, file);
}

/// Writes a chain of either kind to a file, by its ending: .xml or .json. The file is replaced only when all is
/// written. Throws `bad_file`.
template <class Chain>
void save_model(const std::filesystem::path& path, const Chain& chain) {
  const bool xml = path.extension() == ".xml";
  if (!xml && path.extension() != ".json")
    throw bad_file("kte: " + path.string() + ": a model file ends in .xml or .json");
  const std::filesystem::path part = path.string() + ".part";
  {
    std::ofstream out(part, std::ios::binary);
    const auto record = record_of(chain);
    out << (xml ? to_xml(record) : to_json(record)) << std::flush;
    if (!out) throw bad_file("kte: " + path.string() + ": cannot be written: " + std::strerror(errno));
  }
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (error) throw bad_file("kte: " + path.string() + ": cannot be written: " + error.message());
}

/// Reads a file: `to_chain(load_model(path))` is a runtime chain, `from_record(like, load_model(path))` a static one.
/// Throws `bad_file`.
inline model_record load_model(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in) throw bad_file("kte: " + path.string() + ": cannot be read: " + std::strerror(errno));
  if (path.extension() == ".xml") return from_xml(text.str(), path.string());
  if (path.extension() == ".json") return from_json(text.str(), path.string());
  throw bad_file("kte: " + path.string() + ": a model file ends in .xml or .json");
}

}  // namespace kte
