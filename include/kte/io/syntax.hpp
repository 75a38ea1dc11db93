#pragma once

#include <kte/errors.hpp>

#include <cereal/archives/json.hpp>
#include <cereal/archives/xml.hpp>

#include <cctype>
#include <string>
#include <vector>

/// Checks the syntax of a model file before cereal reads it, by the parsers that cereal brings: cereal itself does not
/// say where an error is, and overflows the stack on deep nesting.
namespace kte::detail {

/// Deeper than any model file; both parsers recurse.
inline constexpr int deepest_nesting = 16;
/// Larger than any model file, in characters.
inline constexpr std::size_t largest_file = std::size_t{1} << 28;

[[noreturn]] inline void fail_at(const std::string& file, std::string_view text, std::size_t offset,
                                 const std::string& why) {
  std::size_t line = 1, column = 1;
  for (std::size_t i = 0; i < offset && i < text.size(); ++i) text[i] == '\n' ? (++line, column = 1) : ++column;
  throw bad_file("kte: " + file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + why);
}

#if defined(CEREAL_RAPIDJSON_NAMESPACE)
namespace json_parser = CEREAL_RAPIDJSON_NAMESPACE;
#else
namespace json_parser = RAPIDJSON_NAMESPACE;
#endif

struct json_depth : json_parser::BaseReaderHandler<json_parser::UTF8<>, json_depth> {
  int depth = 0;
  bool StartObject() { return ++depth <= deepest_nesting; }
  bool StartArray() { return ++depth <= deepest_nesting; }
  bool EndObject(json_parser::SizeType) { return --depth >= 0; }
  bool EndArray(json_parser::SizeType) { return --depth >= 0; }
};

inline void check_json(const std::string& file, const std::string& text) {
  if (text.size() > largest_file) fail_at(file, text, 0, "the file is too large for a model");
  if (const auto nul = text.find('\0'); nul != std::string::npos) fail_at(file, text, nul, "there is a zero byte");
  json_depth handler;
  json_parser::Reader reader;
  json_parser::StringStream stream(text.c_str());
  reader.Parse<json_parser::kParseIterativeFlag | json_parser::kParseValidateEncodingFlag>(stream, handler);
  if (!reader.HasParseError()) return;
  const char* why = "this is not JSON";
  switch (reader.GetParseErrorCode()) {
    case json_parser::kParseErrorDocumentEmpty:
      why = "the file is empty";
      break;
    case json_parser::kParseErrorDocumentRootNotSingular:
      why = "something follows the end of the model";
      break;
    case json_parser::kParseErrorTermination:
      why = "the nesting is too deep for a model";
      break;
    default:
      break;
  }
  const bool cut = reader.GetErrorOffset() >= text.find_last_not_of(" \t\r\n") + 1;
  fail_at(file, text, reader.GetErrorOffset(), cut && !text.empty() ? "the file ends in the middle of the model" : why);
}

inline void check_xml(const std::string& file, const std::string& text) {
  if (text.size() > largest_file) fail_at(file, text, 0, "the file is too large for a model");
  if (const auto nul = text.find('\0'); nul != std::string::npos) fail_at(file, text, nul, "there is a zero byte");
  int depth = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '<' && text[i + 1] == '/') depth -= 1;
    if (text[i] == '<' && (std::isalpha(static_cast<unsigned char>(text[i + 1])) || text[i + 1] == '_')) depth += 1;
    if (text[i] == '/' && text[i + 1] == '>') depth -= 1;
    if (depth > deepest_nesting) fail_at(file, text, i, "the nesting is too deep for a model");
  }
  std::vector<char> buffer(text.c_str(), text.c_str() + text.size() + 1);
  cereal::rapidxml::xml_document<> document;
  try {
    document.parse<cereal::rapidxml::parse_validate_closing_tags | cereal::rapidxml::parse_declaration_node>(
        buffer.data());
  } catch (const cereal::rapidxml::parse_error& e) {
    const auto offset = static_cast<std::size_t>(e.where<char>() - buffer.data());
    const bool cut = offset >= text.find_last_not_of(" \t\r\n") + 1;
    fail_at(file, text, offset, cut && !text.empty() ? "the file ends in the middle of the model" : e.what());
  }
  int roots = 0;
  for (auto* n = document.first_node(); n != nullptr; n = n->next_sibling()) {
    if (n->type() != cereal::rapidxml::node_element) continue;
    if (++roots == 2)
      fail_at(file, text, static_cast<std::size_t>(n->name() - buffer.data()),
              "something follows the end of the model");
  }
  if (roots == 0) fail_at(file, text, text.size(), "the file is empty");
}

}  // namespace kte::detail
