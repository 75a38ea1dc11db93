/// kte-header: a robot of a file as a C++ header, in which it is a type (docs/robots_as_types.md).
#include <kte/io/model_content.hpp>
#include <kte/io/program.hpp>
#include <kte/io/replace_file.hpp>
#include <kte/robots/header.hpp>
#include <kte/robots/load_robot.hpp>

#include <cstdio>
#include <optional>

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

/// Nothing if the arguments make no sense.
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
  const auto bytes = kte::detail::text_of_file(r.robot);
  const auto file = r.robot.string();
  if (const auto model = kte::detail::model_in(bytes, r.robot)) return kte::to_header(*model, r.name);
  const auto robot = kte::to_robot(kte::describe_robot(bytes, file));
  for (const auto& w : robot.warnings)
    std::fprintf(stderr, "kte-header: %s%s\n", kte::detail::place_text(file, w.line).c_str(), w.text.c_str());
  return kte::to_header(robot.chain, r.name, robot.limits);
}

int run(const request& r) {
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
