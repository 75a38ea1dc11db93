#pragma once

#include <kte/io/table.hpp>
#include <kte/io/table_row.hpp>

namespace kte {

/// A table in memory with the interface of `table_writer`:
///
///   kte::memory_table out({"t", "q"});
///   out.row(0.0, x);
///   out["q"].back();
///
/// `flush`, `flush_every` and `close` do nothing.
class memory_table {
 public:
  /// An empty table. Throws `bad_argument` for names that `table_writer` rejects.
  explicit memory_table(const std::vector<std::string>& names)
      : row_(detail::check_column_names(names).size(), ""), table_{names, {}} {
    table_.columns.resize(names.size());
  }

  /// Appends a row, as `table_writer::row`. Allocates as std::vector does when it grows, unless `reserve` was called.
  template <class... T>
  void row(const T&... values) {
    const auto numbers = row_.gather(values...);
    for (auto& c : table_.columns)
      if (c.size() == c.capacity()) c.reserve(2 * c.size() + 1);  // all columns or none, so that rows are not split
    for (std::size_t j = 0; j < numbers.size(); ++j) table_.columns[j].push_back(numbers[j]);
  }
  /// Reserves memory for this number of rows.
  void reserve(std::size_t rows) {
    for (auto& c : table_.columns) c.reserve(rows);
  }
  // No effect; for the interface of `table_writer`.
  void flush() {}
  void flush_every(std::size_t) {}
  void close() {}

  /// The table.
  [[nodiscard]] const table& contents() const { return table_; }
  /// The column of a name. Throws `unknown_name`.
  [[nodiscard]] const std::vector<double>& operator[](std::string_view name) const { return table_[name]; }

 private:
  detail::table_row row_;
  table table_;
};

}  // namespace kte
