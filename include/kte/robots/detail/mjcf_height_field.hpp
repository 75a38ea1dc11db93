#pragma once

#include <kte/io/bytes.hpp>
#include <kte/io/file.hpp>
#include <kte/robots/detail/mjcf_tree.hpp>

#include <bit>

namespace kte::detail {

/// Reads the height field of a geom: from elevation, or from a binary file of int32 nrow, ncol, float32 data. Heights
/// are scaled to 0 and the third number of the size of the asset. A field that cannot be read gives a warning.
inline void read_mjcf_height_field(const xml_item& geom, mjcf_model& model, robot_shape& s) {
  const auto none = [&geom](const std::string& why) { geom.moves_differently("its height field is not read: " + why); };
  const auto name = geom.text("hfield");
  std::optional<xml_item> asset;
  for (const auto& a : xml_item(model.root, model.d).children("asset"))
    for (const auto& h : a.children("hfield"))
      if (h.text_or("name", path_of_text(h.text_or("file", "")).stem().string().c_str()) == name) asset.emplace(h);
  if (!asset) return none("there is no hfield '" + excerpt(name) + "' among the assets");
  const auto size = asset->list("size");
  if (size.size() != 4 || !(size[0] > 0 && size[1] > 0 && size[2] > 0))
    asset->fail("size must have four positive numbers");
  std::vector<double> data;
  double rows = 2, columns = 2;  // a field without data is level
  const auto written_size = [&](const char* attribute) {
    return asset->whole(asset->number(attribute), attribute, 2, 1e6);
  };
  if (asset->has("file")) {
    const auto file = path_of_text(asset->text("file"));
    const auto path = model.path_of(*asset);
    if (lower_extension(path) == ".png") return none("'" + excerpt(file.generic_string()) + "' is an image");
    if (!is_file(path)) return none("there is no file '" + excerpt(path.generic_string()) + "'");
    model.d.files.push_back(path.string());
    const auto bytes = read_file(path, std::size_t{1} << 30);
    byte_reader in(path, bytes);
    rows = in.number<std::uint32_t>("nrow"), columns = in.number<std::uint32_t>("ncol");
    if (static_cast<double>(bytes.size()) != 8 + 4 * rows * columns)
      in.bad("its size is not that of nrow ncol numbers");
    while (data.size() < static_cast<std::size_t>(rows * columns))
      data.push_back(double{std::bit_cast<float>(in.number<std::uint32_t>("a height"))});
  } else if (asset->has("elevation")) {
    rows = written_size("nrow"), columns = written_size("ncol");
    const auto written = asset->list("elevation");  // the row of the largest y is the first
    if (static_cast<double>(written.size()) != rows * columns) asset->fail("elevation must have nrow ncol numbers");
    const auto n = static_cast<std::size_t>(columns);
    for (auto i = written.size(); i > 0; i -= n)
      data.insert(data.end(), written.begin() + static_cast<std::ptrdiff_t>(i - n),
                  written.begin() + static_cast<std::ptrdiff_t>(i));
  } else {
    (void)written_size("nrow"), (void)written_size("ncol");
    data.assign(4, 0.0);
  }
  if (!(rows >= 2 && columns >= 2)) return none("it needs two rows and columns or more");
  for (const double h : data)
    if (!std::isfinite(h)) return none("a height is not finite");
  const auto [least, most] = std::minmax_element(data.begin(), data.end());
  const double low = *least, range = *most - low, scale = range > 0 ? size[2] / range : 0;
  for (auto& h : data) h = (h - low) * scale;
  s.is = robot_shape::form::height_field, s.size = {size[0], size[1], 0};
  s.columns = static_cast<std::size_t>(columns), s.heights = std::move(data);
}

}  // namespace kte::detail
