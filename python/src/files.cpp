#include <kte/elements/registry.hpp>
#include <kte/io/model_file.hpp>

#include <pybind11/stl/filesystem.h>

#include "chain.hpp"
#include "parts.hpp"

namespace kte_python {

void bind_files(py::module_& m) {
  using namespace py::literals;
  m.def(
      "save_model",
      [](const std::filesystem::path& path, py::handle chain) { kte::save_model(path, chain_of(chain).chain()); },
      "save_model(path, chain)\n\nWrites a chain to a file, by its extension: .json, .xml, or .kte (binary).", "path"_a,
      "chain"_a);
  m.def(
      "load_model",
      [](const std::filesystem::path& path) {
        return std::make_unique<chain_object>(kte::to_chain(kte::load_model(path)));
      },
      "load_model(path)\n\nReads a chain from a model file: JSON, XML or binary.", "path"_a);
}

}  // namespace kte_python
