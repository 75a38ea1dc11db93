#pragma once

#include <filesystem>
#include <string>

namespace kte_tool {

/// Writes a picture in SVG as PNG with `dpi` dots per inch, by rsvg-convert. The file is replaced when all of it is
/// there. Throws `kte::bad_file` where rsvg-convert is not installed or fails.
void write_png(const std::filesystem::path& file, const std::string& svg, double dpi);

}  // namespace kte_tool
