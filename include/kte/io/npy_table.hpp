#pragma once

#include <kte/io/bytes.hpp>
#include <kte/io/table.hpp>

#include <array>
#include <charconv>
#include <span>

/// A table as an NPY file (numpy.lib.format in the NumPy documentation): `np.load(file)["q"]` is column q.
///
///   magic  version  length of the header  header  rows of float64, least significant byte first
///
/// The header is a Python dictionary, padded by spaces to a multiple of 64 bytes:
///
///   {'descr': [('t', '<f8'), ('q', '<f8')], 'fortran_order': False, 'shape': (2,), }
///
/// Version 1.0; or 3.0 for headers beyond 65535 bytes and for names that are not ASCII.
namespace kte::detail {

class npy_table {
 public:
  void head(const std::vector<std::string>& names, std::string& out) {
    std::string header = "{'descr': [";
    for (const auto& n : names) header.append("('").append(n).append("', '<f8'), ");
    header.resize(header.size() - 2);
    header += "], 'fortran_order': False, 'shape': (";
    const bool ascii = std::all_of(header.begin(), header.end(), [](unsigned char c) { return c < 128; });
    const std::size_t least = header.size() + shape_size + 1;
    const bool simple = ascii && 10 + least + 64 <= 65535;
    const std::size_t front = simple ? 10 : 12;
    const std::size_t whole = (front + least + 63) / 64 * 64;
    out.append(magic).append(simple ? "\1" : "\3").push_back('\0');
    if (simple) {
      append_bytes(out, static_cast<std::uint16_t>(whole - front));
    } else {
      append_bytes(out, static_cast<std::uint32_t>(whole - front));
    }
    shape_at_ = front + header.size();
    const auto no_rows = shape(0);
    out.append(header).append(no_rows.data(), no_rows.size());
    out.resize(whole - 1, ' ');
    out.push_back('\n');
  }
  void row(std::span<const double> numbers, std::string& out) const {
    for (const double x : numbers) append_bytes(out, x);
  }
  void tail(std::string&) const {}

  /// The header text at `shape_at` for this number of rows. Its length is constant, so that it can be overwritten while
  /// the table grows.
  static constexpr std::size_t shape_size = 25;
  std::size_t shape_at() const { return shape_at_; }
  static std::array<char, shape_size> shape(std::uint64_t rows) {
    std::array<char, shape_size> text;
    text.fill(' ');
    char* const end = std::to_chars(text.data(), text.data() + text.size(), rows).ptr;
    std::string_view(",), }").copy(end, 5);
    return text;
  }

  static constexpr std::string_view magic = "\x93NUMPY";

 private:
  std::size_t shape_at_ = 0;
};

}  // namespace kte::detail
