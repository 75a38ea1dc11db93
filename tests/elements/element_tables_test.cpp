#include <kte/robots/detail/factory_calls.hpp>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "../tools/elements_page/tables.hpp"
#include "catch.hpp"

// The hand-written descriptions of elements, in docs and calls, agree with their ports and parameters.

namespace element_tables_test {

const std::filesystem::path root =
    std::filesystem::path(__FILE__).lexically_normal().parent_path().parent_path().parent_path();

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}
const std::string page = text_of(root / "docs" / "elements.md");

std::string without_line(std::string text, const std::string& line) {
  const auto at = text.find(line + "\n");
  REQUIRE(at != std::string::npos);
  return text.erase(at, line.size() + 1);
}

TEST_CASE("docs/elements.md has the tables of the elements (else: sh tools/elements_page.sh)") {
  CHECK(element_tables::with_tables(page) == page);
}

TEST_CASE("tables follow ports and parameters, and keep what is written by hand") {
  const std::string row = "| `damping` | gen | number, N s/m or Nm s/rad |";
  const auto at = page.find(row);
  REQUIRE(at != std::string::npos);
  const auto line = page.substr(at, page.find('\n', at) - at);
  const auto restored = element_tables::with_tables(without_line(page, line));
  CHECK(restored.find("| `damping` | gen | number | |") != std::string::npos);

  auto wrong = page;
  wrong.replace(at, row.size(), "| `damping` | gen | vector, N s/m |");
  CHECK(element_tables::with_tables(wrong).find("| `damping` | gen | vector") == std::string::npos);

  const std::string foreign = "| `colour` | gen | number | |\n";
  auto more = page;
  more.insert(at, foreign);
  CHECK(element_tables::with_tables(more) == page);

  const auto fresh = element_tables::with_tables("# Elements\n");  // sections are made
  CHECK(fresh.find("\n## `base`\n\n| name | dimension | type | description |\n|-|-|-|-|\n"
                   "| `base` | gen, 2D, 3D | port, declares | |\n") != std::string::npos);
}

TEST_CASE("factories take parameters in the order of the tables, the offset of a contact last") {
  std::size_t checked = 0;
  for (const auto& [type, call] : kte::detail::factory_calls()) {
    if (!call.arguments) continue;  // then they follow one another in the order of tables
    INFO(type);
    std::vector<std::string> expected, last;
    for (const auto& p : call.parameters) {
      if (p.is_fixed() || (p.optional && (p.name == "position" || p.name == "rotation"))) continue;  // no argument
      const bool is_last = p.name == "offset" && type.find("_contact_") != std::string::npos;
      (is_last ? last : expected).emplace_back(p.name);
    }
    expected.insert(expected.end(), last.begin(), last.end());
    const auto text = std::regex_replace(std::string(call.arguments), std::regex("[{}]"), "");
    CHECK(element_tables::split(text == "body" ? "mass, com, inertia" : text, ", ") == expected);
    ++checked;
  }
  CHECK(checked > 20);
}

TEST_CASE("what a factory says to a wrong call begins with the roles of its ports") {
  std::map<std::string, std::multiset<std::string>> roles;
  for (const auto& [stem, family] : element_tables::families())
    for (const auto& [dimension, rows] : family) {
      auto& own = roles[dimension == "-" ? stem : stem + "_" + dimension];
      for (const auto& r : rows)
        if (r.what.starts_with("port")) own.insert(r.name);
    }
  std::size_t checked = 0;
  const std::regex call(R"re(KTE_CALL\((\w+),\s*"\(([^)]*)\))re");
  for (const auto& file : std::filesystem::recursive_directory_iterator(root / "include" / "kte" / "elements")) {
    const auto text = text_of(file);
    for (std::sregex_iterator m(text.begin(), text.end(), call), end; m != end; ++m) {
      const auto own = roles.find((*m)[1].str());
      if (own == roles.end() || own->first.starts_with("base_"))
        continue;  // its argument tells the kind of what it declares
      INFO(own->first);
      auto arguments = element_tables::split(std::regex_replace((*m)[2].str(), std::regex(R"(\[)"), ""), ", ");
      arguments.resize(std::min(arguments.size(), own->second.size()));
      CHECK(std::multiset<std::string>(arguments.begin(), arguments.end()) == own->second);
      ++checked;
    }
  }
  CHECK(checked > 80);
}

}  // namespace element_tables_test
