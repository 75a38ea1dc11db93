#include <kte/elements/registry.hpp>
#include <kte/io/model_file.hpp>

#include <pybind11/stl/filesystem.h>

#include "chain.hpp"
#include "parts.hpp"
#include "signal_watch.hpp"

namespace kte_python {

void bind_files(py::module_& m) {
  using namespace py::literals;
  m.def(
      "save_model",
      [](const std::filesystem::path& path, py::handle chain) {
        using format = kte::model_format;
        const auto as = kte::detail::model_format_of(path);
        auto record = kte::detail::record_of_model(chain_of(chain).chain());
        const auto text = run_aside([as, record = std::move(record)] {
          return as == format::xml    ? kte::to_xml(record)
                 : as == format::json ? kte::to_json(record)
                                      : kte::to_binary(record);
        });
        kte::detail::replace_file(path, text);
      },
      "save_model(path, chain)\n\nWrites a chain to a file, by its extension: .json, .xml, or .kte (binary).", "path"_a,
      "chain"_a);
  m.def(
      "load_model",
      [](const std::filesystem::path& path) {
        return std::make_unique<chain_object>(run_aside([path] { return kte::to_chain(kte::load_model(path)); }));
      },
      "load_model(path)\n\nReads a chain from a model file: JSON, XML or binary.", "path"_a);
}

}  // namespace kte_python
