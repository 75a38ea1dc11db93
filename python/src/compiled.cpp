#include "compiled.hpp"

#include <kte/io/replace_file.hpp>
#include <kte/robots/header.hpp>

#include <dlfcn.h>
#include <fcntl.h>
#include <fstream>

#include "chain.hpp"
#include "eval/program_cache.hpp"
#include "eval/static_build.hpp"
#include "parts.hpp"
#include "signal_watch.hpp"

namespace kte_python {

namespace {

/// The file of this module.
std::filesystem::path module_file() {
  Dl_info found{};
  dladdr(reinterpret_cast<const void*>(&bind_compiled), &found);
  return found.dli_fname;
}

/// What the options -march=native depend on.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string all;
  for (std::string line; std::getline(file, line) && !line.empty();)
    if (line.starts_with("model") || line.starts_with("flags")) all += line + '\n';
  return all;
}

std::string source_of(const std::vector<std::string>& frames) {
  constexpr const char* functions[]{"inverse_dynamics",
                                    "forward_dynamics",
                                    "mass_matrix",
                                    "mass_matrix_inverse",
                                    "nonlinear_effects",
                                    "gravity_forces",
                                    "inverse_dynamics_derivatives",
                                    "forward_dynamics_derivatives",
                                    "energy"};
  std::string s =
      "#include \"eval/static_library_of.hpp\"\n#include \"robot.hpp\"\n\n"
      "using library = evaluate::library_of<robots::robot>;\n"
      "extern \"C\" __attribute__((visibility(\"default\"))) const evaluate::library_function kte_functions[] = {\n";
  for (const std::string name : functions) {
    const bool packs = name == functions[0] || name == functions[1] || name == functions[2];
    s += "  {\"" + name + "\", nullptr, library::" + name + ", " +
         (packs ? "library::" + name + "_of_states" : "nullptr") + "},\n";
  }
  for (const auto& frame : frames)
    for (const std::string name : {"forward_kinematics", "jacobian", "jacobian_in_world_axes"}) {
      const auto text = kte::detail::cpp_text(frame);
      s += "  {\"" + name + "\", " + text + ", library::" + name + "<" + text + ">, nullptr},\n";
    }
  return s + "  {nullptr, nullptr, nullptr, nullptr}};\n";
}

/// The first lines of a file.
std::string head_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string all, line;
  for (int i = 0; i < 12 && std::getline(file, line); ++i) all += '\n' + line.substr(0, 300);
  return all;
}

void compile(const std::vector<std::string>& words, const std::filesystem::path& folder) {
  const auto log = folder / "messages";
  const evaluate::descriptor messages(open(log.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (messages.get() < 0) kte::detail::raise_file("write", log, errno);
  evaluate::child_end end{};
  try {
    end = evaluate::compile(words, folder, messages.get(), signal_watch());
  } catch (const kte::bad_file& e) {
    throw kte::bad_file(e.what() + std::string("; kte.compile needs a C++ compiler, of the variable CXX or as g++"));
  }
  if (end.code != 0)
    throw kte::bad_argument("kte: '" + words.front() + "' does not compile this robot: it ended " + end.how +
                            head_of(log));
}

}  // namespace

std::shared_ptr<const compiled_functions> compile_chain(const kte::runtime_chain& c, std::vector<std::string> frames) {
  for (const auto& name : frames) static_cast<void>(c.wiring().frame(name));
  const auto own = module_file();
  const auto installed = own.parent_path() / "include";
  auto words = evaluate::compiler_words(installed, installed);
  words.insert(words.end(), {"-march=native", "-shared", "-fPIC", "-fvisibility=hidden"});
  const std::string header = kte::to_header(c, "robot"), source = source_of(frames);
  std::string all = header + source + evaluate::time_of_build(own) + processor();
  for (const auto& word : words) all += '\n' + word;
  const evaluate::program_cache cache(evaluate::cache_folder());
  const std::string name = evaluate::hash_text(all), path = cache.path_of(name).string();
  auto file = cache.find(name);
  if (file.get() < 0) {
    cache.add(name, [&](const std::filesystem::path& folder) {
      kte::detail::replace_file(folder / "robot.hpp", header);
      kte::detail::replace_file(folder / "main.cpp", source);
      compile(words, folder);
    });
    file = cache.find(name);
  }
  void* const library = file.get() < 0 ? nullptr : dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const functions = library ? dlsym(library, "kte_functions") : nullptr;
  if (!functions) {
    const char* const why = file.get() < 0 ? "it was damaged right after it was written" : dlerror();
    throw kte::bad_file("kte: cannot load '" + path + "': " + (why ? why : "it has no functions"));
  }
  return std::make_shared<const compiled_functions>(static_cast<evaluate::library_functions>(functions),
                                                    std::move(frames));
}

void raise(const evaluate::library_failure& f) {
  switch (f.what) {
    case evaluate::library_failure::kind::none:
      return;
    case evaluate::library_failure::kind::singular_mass_matrix:
      throw kte::singular_mass_matrix(f.text);
    default:
      throw kte::bad_argument(f.text);
  }
}

namespace {
void refuse_uncompiled(const kte::runtime_chain& c) {
  for (const auto k : {kte::kind::loop, kte::kind::contact})
    if (const auto& names = c.wiring().names[static_cast<std::size_t>(k)]; !names.empty())
      throw kte::bad_argument(
          "kte: compile: chains with closed loops or rigid contacts are not compiled; this one has '" + names.front() +
          "'");
}
}  // namespace

void bind_compiled(py::module_& m) {
  using namespace py::literals;
  m.def(
      "compile",
      [](py::handle chain, py::handle frames) {
        const auto& c = chain_of(chain);
        refuse_uncompiled(c.chain());
        auto made = std::make_unique<chain_object>(c);
        auto names = names_from(frames);
        std::shared_ptr<const compiled_functions> functions;
        {
          const py::gil_scoped_release without;
          functions = compile_chain(made->chain(), std::move(names));
        }
        made->compiled(std::move(functions));
        return made;
      },
      R"(compile(chain, frames=())

The chain as a type: a `Chain` whose functions are compiled for it by the compiler of this machine, once, which takes some
ten seconds; then they are in ~/.cache/kte. Compiled are inverse_dynamics, forward_dynamics, mass_matrix, mass_matrix_inverse,
nonlinear_effects, gravity_forces, energy, and the derivatives of dynamics; of `frames` also forward_kinematics, and jacobian in own
and world axes. Their results differ from those of the chain by rounding. Everything else works as for the chain. With
`inputs`, and if an element is added, functions are those of the chain.

The compiler is that of the variable CXX, or that of the build of kte. Raises BadArgument with its first messages if it
fails, BadFile if there is none. Ctrl-C stops it.)",
      "chain"_a, "frames"_a = py::tuple());
}

}  // namespace kte_python
