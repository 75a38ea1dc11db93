/// kte-header: a robot of a file as a C++ header, in which it is a type (docs/robots_as_types.md). `kte convert` does
/// the same; this is what kte_add_robot builds.
#include <kte/io/printable.hpp>
#include <kte/io/program.hpp>
#include <kte/io/replace_file.hpp>

#include <cstdio>
#include <optional>

#include "header_of_file.hpp"

namespace {

constexpr const char* usage =
    "usage: kte-header robot.urdf|model.json|model.xml|model.kte [-o file] [--name name]\n"
    "Writes the robot as a C++ header to the file, or to standard output. Its name is that of the file unless told.\n";

struct request {
  std::filesystem::path robot;
  std::optional<std::filesystem::path> out;
  std::string name;
  bool help = false;
};

/// Nothing if the arguments are invalid.
std::optional<request> request_of(int count, char** arguments) {
  request r;
  for (int i = 1; i < count; ++i) {
    const std::string_view x = arguments[i];
    if ((x == "-o" || x == "--name") && i + 1 < count) {
      const char* const value = arguments[++i];
      x == "-o" ? void(r.out = value) : void(r.name = value);
    } else if (x == "--help") {
      r.help = true;
    } else if (x.starts_with("-") || !r.robot.empty()) {
      return {};
    } else {
      r.robot = x;
    }
  }
  if (r.robot.empty() && !r.help) return {};
  if (r.name.empty()) r.name = r.robot.stem().string();
  return r;
}

std::string header_of(const request& r) {
  const auto file = r.robot.string();
  return kte_tool::header_of_file(
      kte::detail::text_of_file(r.robot), r.robot, r.name, {}, r.out.value_or(""), [&](const auto& note) {
        const auto text = kte::detail::printable(kte::detail::place_text(file, note.line) + note.text);
        std::fprintf(stderr, "kte-header: %s\n", text.c_str());
      });
}

int run(const request& r) {
  std::error_code none;
  if (r.out && !r.help && std::filesystem::equivalent(*r.out, r.robot, none))
    throw kte::bad_argument("kte: the header '" + r.out->string() + "' would replace the robot");
  const auto text = r.help ? usage : header_of(r);
  if (r.out && !r.help)
    kte::detail::replace_file(*r.out, text);
  else
    kte::detail::write_standard_output(text);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  const auto r = request_of(count, arguments);
  if (!r) {
    std::fputs(usage, stderr);
    return 2;
  }
  return kte::detail::exit_code_of([&] { return run(*r); });
}
