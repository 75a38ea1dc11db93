/// kte-header: a robot of a file as a C++ header, in which it is a type (docs/robots.md).
#include <kte/io/model_reader.hpp>
#include <kte/io/replace_file.hpp>
#include <kte/robots/header.hpp>
#include <kte/robots/load_robot.hpp>

#include <cstdio>
#include <optional>

namespace {

constexpr const char* usage =
    "usage: kte-header robot.urdf|model.json|model.xml [-o file] [--name name]\n"
    "Writes the robot as a C++ header to the file, or to standard output. Its name is that of the file unless told.\n";

struct request {
  std::filesystem::path robot;
  std::optional<std::filesystem::path> out;
  std::string name;
};

/// Nothing if the arguments make no sense.
std::optional<request> request_of(int count, char** arguments) {
  request r;
  for (int i = 1; i < count; ++i) {
    const std::string_view x = arguments[i];
    if ((x == "-o" || x == "--name") && i + 1 < count) {
      const char* const value = arguments[++i];
      x == "-o" ? void(r.out = value) : void(r.name = value);
    } else if (x.starts_with("-") || !r.robot.empty()) {
      return {};
    } else {
      r.robot = x;
    }
  }
  if (r.robot.empty()) return {};
  if (r.name.empty()) r.name = r.robot.stem().string();
  return r;
}

/// The library's own files end in .json, or are XML whose first tag is <cereal>; all else describes robots.
bool is_model(const std::filesystem::path& path) {
  if (path.extension() == ".json") return true;
  if (path.extension() != ".xml") return false;
  const auto text = kte::detail::text_of_file(path);
  return text.find("<cereal>") != std::string::npos;
}

std::string header_of(const request& r) {
  if (is_model(r.robot)) return kte::to_header(kte::load_model(r.robot), r.name);
  const auto robot = kte::load_robot(r.robot);
  for (const auto& w : robot.warnings)
    std::fprintf(stderr, "kte-header: %s:%d: %s\n", r.robot.string().c_str(), w.line, w.text.c_str());
  return kte::to_header(robot.chain, r.name, robot.limits);
}

}  // namespace

int main(int count, char** arguments) {
  const auto r = request_of(count, arguments);
  if (!r) {
    std::fputs(usage, stderr);
    return 2;
  }
  try {
    const auto text = header_of(*r);
    if (r->out)
      kte::detail::replace_file(*r->out, text);
    else
      std::fputs(text.c_str(), stdout);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
