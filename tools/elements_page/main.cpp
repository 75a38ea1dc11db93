#include <filesystem>
#include <fstream>
#include <iostream>

#include "tables.hpp"

/// Rewrites the tables of docs/elements.md: kte_elements_page docs/elements.md
int main(int, char** argv) {
  if (!argv[1] || !std::filesystem::exists(argv[1])) {
    std::cerr << "kte: call it as elements_page docs/elements.md\n";
    return 1;
  }
  std::ostringstream page;
  page << std::ifstream(argv[1]).rdbuf();
  std::ofstream(argv[1]) << element_tables::with_tables(page.str());
}
