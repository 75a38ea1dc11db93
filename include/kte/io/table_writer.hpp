#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/io/file.hpp>
#include <kte/io/mcap_table.hpp>
#include <kte/io/npy_table.hpp>
#include <kte/io/table_format.hpp>
#include <kte/io/table_row.hpp>
#include <kte/io/text_table.hpp>

#include <variant>

namespace kte {

/// Writes a table to a file row by row, in the format of its extension (`table_format`).
///
///   kte::table_writer out("run.csv", {"t", "theta", "omega"});
///   solver.integrate(10.0, kte::every(0.01), [&](double t, const auto& x) { out.row(t, x); });
///   out.close();
///
/// `read_table` restores every double bit for bit. The first column is time: in seconds for MCAP; for PlotJuggler it
/// must increase and be named `t`. Names with slashes, `tip/position/x`, are shown as trees.
///
/// Rows are buffered. Flushed rows can be read even if the program fails later. A row does not allocate, except long
/// ones before the first flush. Throws `bad_file` with the path and the reason if the file cannot be opened or written,
/// at the latest in `close`. The destructor closes the file and does not throw.
class table_writer {
 public:
  /// A writer to a file, with the names of its columns. Throws `bad_argument` for an unknown extension; for no names;
  /// and for a name that is empty, occurs twice, or has a blank, a comma, a quote or a backslash.
  table_writer(const std::filesystem::path& path, const std::vector<std::string>& names)
      : table_writer(path, names, format_of(path)) {}
  /// A writer to a file in a given format.
  table_writer(const std::filesystem::path& path, const std::vector<std::string>& names, table_format format);
  table_writer(const table_writer&) = delete;
  table_writer& operator=(const table_writer&) = delete;
  ~table_writer();  // NOLINT(bugprone-exception-escape): the variant always has a value

  /// Writes a row of numbers and vectors of numbers. Throws `bad_argument` unless there is one number per column.
  template <class... T>
  void row(const T&... values) {
    add(row_.gather(values...));
  }
  /// Passes all rows to the operating system, so that they survive a failure of the program.
  void flush();
  /// Flushes after this number of rows; 0, the default: when the buffer is full.
  void flush_every(std::size_t rows) { most_waiting_ = rows; }
  /// Writes the remaining rows and closes the file. A second call does nothing.
  void close();

 private:
  using media = std::variant<detail::text_table, detail::npy_table, detail::mcap_table>;
  static constexpr std::size_t capacity = 1 << 16;

  static media medium_of(table_format f);
  void add(std::span<const double> numbers);
  void check_open() const;
  [[noreturn]] void fail(const char* action, int code);

  // Returns the error number, or 0.
  int write(const char* bytes, std::size_t n);
  int write_buffer();
  int count_rows(const detail::npy_table& npy);
  std::pair<const char*, int> finish();

  std::filesystem::path path_;
  detail::table_row row_;
  media medium_;
  detail::file_handle file_;
  std::string buffer_;
  std::uint64_t rows_ = 0;
  std::size_t waiting_ = 0, most_waiting_ = 0;
};

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte {

KTE_FUNCTION table_writer::table_writer(const std::filesystem::path& path, const std::vector<std::string>& names,
                                        table_format format)
    : path_(path),
      row_(detail::check_column_names(names).size(), ": '" + path.string() + "'"),
      medium_(medium_of(format)),
      file_(detail::open_file(path, "wb")) {
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  buffer_.reserve(2 * capacity);
  std::visit([&](auto& m) { m.head(names, buffer_); }, medium_);
}
KTE_FUNCTION table_writer::~table_writer() { finish(); }  // NOLINT(bugprone-exception-escape)

KTE_FUNCTION void table_writer::add(std::span<const double> numbers) {
  check_open();
  const std::size_t before = buffer_.size();
  try {
    std::visit([&](auto& m) { m.row(numbers, buffer_); }, medium_);
  } catch (...) {
    buffer_.resize(before);  // removes the incomplete row
    throw;
  }
  ++rows_;
  if (++waiting_ == most_waiting_ || buffer_.size() > capacity) flush();
}
KTE_FUNCTION void table_writer::flush() {
  check_open();
  if (const int code = write_buffer()) fail("write", code);
}
KTE_FUNCTION void table_writer::close() {
  const auto [action, code] = finish();
  if (code != 0) fail(action, code);
}

KTE_FUNCTION table_writer::media table_writer::medium_of(table_format f) {
  switch (f) {
    case table_format::npy:
      return detail::npy_table();
    case table_format::mcap:
      return detail::mcap_table();
    default:
      return detail::text_table(detail::separator_of(f));
  }
}
KTE_FUNCTION void table_writer::check_open() const {
  if (!file_) [[unlikely]]
    detail::raise<bad_file>("kte: cannot write '" + path_.string() + "': it is closed");
}
KTE_FUNCTION void table_writer::fail(const char* action, int code) {
  file_.reset();
  detail::raise_file(action, path_, code);
}

KTE_FUNCTION int table_writer::write(const char* bytes, std::size_t n) {
  errno = 0;
  if (std::fwrite(bytes, 1, n, file_.get()) == n) return 0;
  return errno != 0 ? errno : EIO;
}
KTE_FUNCTION int table_writer::write_buffer() {
  if (const int code = write(buffer_.data(), buffer_.size())) return code;
  buffer_.clear();
  waiting_ = 0;
  const auto* const npy = std::get_if<detail::npy_table>(&medium_);
  return npy == nullptr ? 0 : count_rows(*npy);
}
/// Called after rows are written, so that the header never counts rows that are missing.
KTE_FUNCTION int table_writer::count_rows(const detail::npy_table& npy) {
  const auto shape = npy.shape(rows_);
  if (std::fseek(file_.get(), static_cast<long>(npy.shape_at()), SEEK_SET) != 0) return errno;
  if (const int code = write(shape.data(), shape.size())) return code;
  return std::fseek(file_.get(), 0, SEEK_END) == 0 ? 0 : errno;
}
KTE_FUNCTION std::pair<const char*, int> table_writer::finish() {
  if (!file_) return {"", 0};
  std::visit([&](auto& m) { m.tail(buffer_); }, medium_);
  if (const int code = write_buffer()) return {"write", code};
  return {"close", std::fclose(file_.release()) == 0 ? 0 : errno};
}

}  // namespace kte
#endif
