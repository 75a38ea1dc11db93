#pragma once

#include <kte/contract/record.hpp>
#include <kte/detail/compiled.hpp>
#include <kte/io/field_names.hpp>
#include <kte/io/file.hpp>
#include <kte/io/json_scanner.hpp>
#include <kte/io/numbers.hpp>
#include <kte/io/xml_scanner.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

/// Model files into records. Needs no cereal.
namespace kte {

/// The version of the format that this library writes and reads.
inline constexpr int model_file_version = 1;

namespace detail {

/// Reads a model by either scanner: known fields in any order, each once, none missing; of ports and parameters the
/// names are data.
template <class Scanner>
class model_reader {
 public:
  explicit model_reader(source_text& source) : source_(source), in_(source) {}

  model_record read() {
    model_record m;
    in_.open_document();
    fields<1>("the file", {"kte_model"}, [&](const std::string& name) {
      in_.open_group(name);
      model(m);
    });
    in_.close_document();
    return m;
  }

 private:
  void model(model_record& m) {
    fields<3>("'kte_model'", {"version", "gravity", "elements"}, [&](const std::string& name) {
      if (name == "version") {
        const int version = whole_number(name);
        if (version != model_file_version)
          fail("version " + std::to_string(version) + " of the format; this library reads version " +
               std::to_string(model_file_version));
      } else if (name == "gravity") {
        m.gravity = numbers(name);
        if (m.gravity.size() != 3) fail("'gravity' has " + std::to_string(m.gravity.size()) + " numbers, not 3");
        for (const double g : m.gravity)
          if (!std::isfinite(g)) fail("'gravity' must be finite, got " + number(g));
      } else {
        elements(m.elements);
      }
    });
  }
  void elements(std::vector<element_record>& list) {
    in_.open_list("elements");
    for (std::size_t i = 0; in_.next_item(i); ++i) {
      place_ = "element " + std::to_string(i + 1);
      in_.open_group(place_);
      element(list.emplace_back());
    }
    place_.clear();
  }
  void element(element_record& e) {
    fields<4>("the element", {"type", "version", "ports", "parameters"}, [&](const std::string& name) {
      if (name == "type") {
        e.type = text(name);
        e.place = source_.place(in_.at());
      } else if (name == "version") {
        e.version = whole_number(name);
      } else if (name == "ports") {
        any_fields(name, [&](const std::string& role, file_place at) {
          e.connections.push_back({role, text(role), std::move(at)});
        });
      } else {
        any_fields(name, [&](const std::string& parameter, file_place at) {
          e.parameters.push_back({parameter, numbers(parameter), std::move(at)});
        });
      }
    });
  }

  /// The fields of a group that is open.
  template <std::size_t N, class Read>
  void fields(const char* what, const std::array<std::string_view, N>& known, const Read& read) {
    std::array<bool, N> seen{};
    const std::size_t start = in_.at();
    std::string list, name;
    for (const auto& k : known) list.append(list.empty() ? "" : ", ").append(k);
    while (in_.next_field(name)) {
      const auto k = static_cast<std::size_t>(std::find(known.begin(), known.end(), name) - known.begin());
      if (k == N) fail("unknown field '" + excerpt(name) + "'; " + what + " has " + list);
      if (std::exchange(seen[k], true)) fail("a second '" + name + "'");
      read(name);
    }
    for (std::size_t k = 0; k < N; ++k)
      if (!seen[k]) fail_at(start, what + std::string(" has no '") + std::string(known[k]) + "'");
  }
  template <class Read>
  void any_fields(const std::string& group, const Read& read) {
    std::set<std::string> seen;
    in_.open_group(group);
    for (std::string name; in_.next_field(name);) {
      if (const char* why = name_fault(name)) fail("the name of a field in '" + group + "' " + why);
      if (!seen.insert(name).second) fail("a second '" + excerpt(name) + "' in '" + group + "'");
      read(name, source_.place(in_.at()));
    }
  }
  std::string text(const std::string& name) {
    std::string value = in_.text(name);
    if (const char* why = name_fault(value)) fail("'" + name + "' " + why);
    return value;
  }
  std::vector<double> numbers(const std::string& name) {
    const std::string value = in_.numbers(name);
    std::vector<double> all;
    if (const char* why = text_to_numbers(value, all)) fail("'" + name + "': '" + excerpt(value) + "' " + why);
    return all;
  }
  int whole_number(const std::string& name) {
    const std::string value = in_.numbers(name);
    const char* const end = value.data() + value.size();
    int n{};
    const auto [stop, error] = std::from_chars(value.data(), end, n);
    if (error != std::errc{} || stop != end) fail("'" + name + "': '" + excerpt(value) + "' is not a whole number");
    return n;
  }

  [[noreturn]] void fail(const std::string& why) { fail_at(in_.at(), why); }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& why) {
    source_.fail(offset, place_.empty() ? why : place_ + ": " + why);
  }

  source_text& source_;
  Scanner in_;
  std::string place_;  ///< "element 3"
};

template <class Scanner>
model_record read_model(std::string_view text, std::string name) {
  source_text source(text, std::move(name));
  return model_reader<Scanner>(source).read();
}

#ifdef KTE_EXTERN
KTE_EXTERN template model_record read_model<json_scanner>(std::string_view, std::string);
KTE_EXTERN template model_record read_model<xml_scanner>(std::string_view, std::string);
#endif

/// Whether a model file is XML, by its ending, else JSON. Throws `bad_file` for other endings.
inline bool is_xml_file(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".xml" && extension != ".json")
    raise<bad_file>("kte: '" + path.string() + "': a model file ends in .xml or .json");
  return extension == ".xml";
}

}  // namespace detail

/// A model from a text; `file` is what messages call it. Throws `bad_file` with line and column, and the field.
inline model_record from_json(std::string_view text, const std::string& file = "JSON text") {
  return detail::read_model<detail::json_scanner>(text, file);
}
inline model_record from_xml(std::string_view text, const std::string& file = "XML text") {
  return detail::read_model<detail::xml_scanner>(text, file);
}

/// Reads a file: `to_chain(load_model(path))` is a runtime chain, `from_record(like, load_model(path))` a static one.
/// Throws `bad_file`.
inline model_record load_model(const std::filesystem::path& path) {
  const bool xml = detail::is_xml_file(path);
  const std::string text = detail::read_file(path, detail::largest_model_file);
  return xml ? from_xml(text, path.string()) : from_json(text, path.string());
}

}  // namespace kte
