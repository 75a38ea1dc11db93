/// The pictures of the documentation are those that examples/pictures.cpp makes, up to the last digits.
#define main make_pictures
#include "pictures.cpp"
#undef main

#include "catch.hpp"
#include "io/scratch.hpp"
#include "view/svg_document.hpp"

namespace svg_example_test {

const std::filesystem::path kept = std::filesystem::path(__FILE__).parent_path() / "../../docs/pictures";

std::string text_of(const std::filesystem::path& file) { return kte::detail::read_file(file); }

/// A text without its numbers, and these.
struct skeleton {
  std::string words;
  std::vector<double> numbers;
  explicit skeleton(const std::string& text) {
    for (const char* p = text.c_str(); *p != 0;) {
      char* end{};
      const bool begins = std::isdigit(static_cast<unsigned char>(*p)) != 0 || *p == '-' || *p == '.';
      const double x = begins ? std::strtod(p, &end) : 0;
      if (!begins || end == p) {
        if (*p != ' ') words += *p;  // a blank, or the sign of the next number, stands between numbers
        ++p;
        continue;
      }
      numbers.push_back(x), words += '#', p = end;
    }
  }
};

TEST_CASE("the pictures of the documentation are those that the example makes") {
  const kte::test::scratch_folder folder;
  std::string name = "pictures", path = folder.path.string();
  char* arguments[]{name.data(), path.data(), nullptr};
  REQUIRE(make_pictures(2, arguments) == 0);
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path)) {
    const auto made = text_of(entry.path()), there = text_of(kept / entry.path().filename());
    CAPTURE(entry.path().filename());
    CHECK(kte::test::read_svg(made).children[0].text == kte::test::read_svg(there).children[0].text);
    const skeleton a(made), b(there);
    if (entry.path().stem() != "double_pendulum_plot")
      CHECK(a.words == b.words);  // curves drop points that are the same
    if (a.numbers.size() == b.numbers.size()) {
      double worst = 0;
      for (std::size_t i = 0; i < a.numbers.size(); ++i)  // two roundings; lengths of paths are sums of many
        worst = (std::max)(worst, std::abs(a.numbers[i] - b.numbers[i]) / (0.03 + 1e-3 * std::abs(b.numbers[i])));
      CHECK(worst <= 1);
    }
    ++count;
  }
  CHECK(count == 5);
}

TEST_CASE("the picture of README moves without scripts, and is small") {
  const auto text = text_of(kept / "double_pendulum.svg");
  CHECK(text.size() < 60000);
  CHECK(text.find("<script") == std::string::npos);
  CHECK(kte::test::read_svg(text).all("animate").size() > 5);
}

}  // namespace svg_example_test
