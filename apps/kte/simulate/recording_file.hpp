#pragma once

#include <kte/dynamics/energy.hpp>
#include <kte/io/memory_table.hpp>
#include <kte/io/replace_file.hpp>
#include <kte/io/table_writer.hpp>
#include <kte/view/write_mcap.hpp>

#include <algorithm>
#include <chrono>
#include <optional>

#include "message.hpp"
#include "recorded_scene.hpp"
#include "recorded_state.hpp"

namespace kte_tool {

/// A file of the numbers of states over time. MCAP also has what Foxglove shows in space: it is written at the end.
///
/// Rows go to a part file beside it, which replaces the file when rows after the start are flushed: after a second, or
/// at the end. From then on rows are flushed every second. Until then an earlier file remains. Pipes and other
/// files that are not regular are written directly.
class recording_file {
  using clock = std::chrono::steady_clock;

 public:
  recording_file(const std::string& path, const mechanism& m, const kte::runtime_chain& c,
                 const std::vector<std::string>& names)
      : path_(path), target_(kte::detail::link_target(path)), m_(m), state_(c, names) {
    std::vector<std::string> columns{"t"};
    for (const auto& x : state_.columns()) columns.push_back(x.name);
    columns.insert(columns.end(), kte::detail::energy_names.begin(), kte::detail::energy_names.end());
    numbers_.resize(columns.size() - 1);
    const auto format = kte::format_of(path);
    if (format == kte::table_format::mcap) kept_.emplace(columns);
    std::error_code error;
    const auto old = std::filesystem::status(target_, error);
    const bool exists = std::filesystem::exists(old);
    if (exists && !std::filesystem::is_regular_file(old)) {
      out_.emplace(path, columns, format);
      return;
    }
    part_.emplace(target_, exists);
    if (exists) {
      std::filesystem::permissions(part_->path(), old.permissions(), error);
      if (error) kte::detail::raise_file("write", path, error.value());
    }
    out_.emplace(part_->path(), columns, format);
  }
  void row(double t, const kte::runtime_chain& c, const kte::runtime_state& s) {
    state_.read(s, numbers_.data());
    auto own = s;  // energies use its memory
    const auto e = kte::energy(c, own);
    double* const last = numbers_.data() + state_.columns().size();
    last[0] = e.kinetic, last[1] = e.potential, last[2] = e.kinetic + e.potential;
    out_->row(t, numbers_);
    if (kept_) kept_->row(t, numbers_);
    ++rows_;
    if (t > 0) flush_after_a_second();
  }
  /// Writes the remaining rows; without rows after the start, an earlier file remains.
  void close() {
    out_->close();
    if (!has_moved_) return;
    replace_earlier();
    if (!kept_) return;
    try {
      kte::write_mcap(path_, scene_of(m_, kept_->contents(), "", {}));
    } catch (const kte::bad_argument& e) {
      say(path_ + " has numbers only, and nothing to draw: " + std::string(e.what()).substr(5));
    }
  }
  std::size_t rows() const { return rows_; }

 private:
  void flush_after_a_second() {
    has_moved_ = true;
    const auto now = clock::now();
    if (now - flushed_ < std::chrono::seconds(1)) return;
    flushed_ = now;
    out_->flush();
    replace_earlier();
  }
  void replace_earlier() {
    if (!part_) return;
    if (const int code = part_->rename_to(target_)) kte::detail::raise_file("write", path_, code);
    part_.reset();
  }

  std::string path_;
  std::filesystem::path target_;
  const mechanism& m_;
  recorded_state state_;
  std::vector<double> numbers_;
  std::optional<kte::detail::part_file> part_;  ///< until it has replaced the earlier file
  std::optional<kte::table_writer> out_;
  std::optional<kte::memory_table> kept_;
  std::size_t rows_ = 0;
  bool has_moved_ = false;  ///< whether there is a row after the start
  clock::time_point flushed_ = clock::now();
};

}  // namespace kte_tool
