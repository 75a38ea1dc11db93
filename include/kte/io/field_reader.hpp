#pragma once

#include <kte/detail/function_ref.hpp>
#include <kte/io/field_names.hpp>
#include <kte/io/field_scanner.hpp>
#include <kte/io/numbers.hpp>
#include <kte/io/read_options.hpp>
#include <kte/io/source_text.hpp>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <utility>

namespace kte::detail {

/// Reads the groups and lists of files. Messages begin with the current part of the model.
class field_reader {
 public:
  field_reader(field_scanner& in, const read_options& options) : in_(in), options_(options) {}

  field_scanner& in() { return in_; }
  file_place place() { return in_.place(in_.at()); }
  [[noreturn]] void fail(const std::string& why) { fail_at(in_.at(), why); }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& why) {
    in_.fail_at(offset, part_.empty() ? why : part_ + ": " + why);
  }
  /// Sets the beginning of messages, "element 3"; returns the previous one.
  std::string part(std::string name) { return std::exchange(part_, std::move(name)); }

  /// Reads the fields of an open group: required and optional ones, in any order, each once. Fields that begin with x_
  /// are reported to `warn` and skipped.
  using names = std::initializer_list<std::string_view>;
  void fields(const char* what, names needed, names others, function_ref<void(const std::string&)> read) {
    const std::size_t start = in_.at();
    unsigned seen = 0;
    for (std::string name; in_.next_field(name);) {
      const std::size_t k = number_of(name, needed, others);
      if (k == needed.size() + others.size()) {
        leave_out(what, name, needed, others);
        continue;
      }
      if (((seen >> k) & 1u) != 0) fail("a second '" + name + "'");
      seen |= 1u << k;
      read(name);
    }
    for (std::size_t k = 0; k < needed.size(); ++k)
      if (((seen >> k) & 1u) == 0)
        fail_at(start, what + std::string(" has no '") + std::string(needed.begin()[k]) + "'");
  }
  /// A group of fields whose names are data.
  void any_fields(const std::string& group, function_ref<void(const std::string&, const file_place&)> read) {
    std::set<std::string> seen;
    in_.open_group(group);
    for (std::string name; in_.next_field(name);) {
      if (const char* why = name_fault(name)) fail("the name of a field in '" + group + "' " + why);
      if (!seen.insert(name).second) fail("a second '" + excerpt(name) + "' in '" + group + "'");
      count_item();
      read(name, place());
    }
  }
  /// Reads a list; calls read(i) for each item.
  void list(const std::string& name, function_ref<void(std::size_t)> read) {
    in_.open_list(name);
    for (std::size_t i = 0; in_.next_item(i); ++i) count_item(), read(i);
  }
  /// Reads a list of groups, named "element 3" in messages.
  void groups(const std::string& name, const std::string& called, function_ref<void()> read) {
    const std::string before = part_.empty() ? called : part_ + ", " + called;
    const std::string outside = part_;
    list(name, [&](std::size_t i) {
      part_ = before + " " + std::to_string(i + 1);
      in_.open_group(part_);
      read();
    });
    part_ = outside;
  }

  /// Throws for names that occur twice.
  void once(std::set<std::string>& seen, const std::string& name) {
    if (!seen.insert(name).second) fail("a second '" + excerpt(name) + "'");
  }
  [[noreturn]] void refuse_version(int version) {
    fail("version " + std::to_string(version) + " of the format; this library reads versions 1 and 2");
  }

  std::string text(const std::string& name) {
    std::string value = in_.text(name);
    if (const char* why = name_fault(value)) fail("'" + name + "' " + why);
    return value;
  }
  std::vector<std::string> texts(const std::string& name) {
    std::vector<std::string> all;
    list(name, [&](std::size_t) { all.push_back(text(name)); });
    return all;
  }
  template <class Real>
  std::vector<Real> numbers(const std::string& name) {
    std::vector<double> plain;
    if (in_.take_numbers(plain)) {
      if constexpr (std::is_same_v<Real, double>) return plain;
      return {plain.begin(), plain.end()};
    }
    const std::string value = in_.numbers(name);
    std::vector<Real> all;
    if (const char* why = text_to_numbers(value, all)) fail("'" + name + "': '" + excerpt(value) + "' " + why);
    return all;
  }
  int whole_number(const std::string& name) {
    const std::string value = in_.numbers(name);
    const char* const end = value.data() + value.size();
    int n{};
    const auto [stop, error] = std::from_chars(value.data(), end, n);
    if (error != std::errc{} || stop != end) fail("'" + name + "': '" + excerpt(value) + "' is not a whole number");
    return n;
  }

 private:
  /// The index of a field among both lists; their total size if it is in neither.
  static std::size_t number_of(std::string_view name, names needed, names others) {
    std::size_t k = 0;
    for (const auto& some : {needed, others})
      for (const auto& n : some) {
        if (n == name) return k;
        ++k;
      }
    return k;
  }
  void leave_out(const std::string& what, const std::string& name, names needed, names others) {
    std::string known;
    for (const auto& some : {needed, others})
      for (const auto& n : some) known.append(known.empty() ? "" : ", ").append(n);
    const std::string why = "unknown field '" + excerpt(name) + "'";
    if (!name.starts_with("x_")) fail(why + "; " + what + " has " + known);
    if (!options_.warn) fail(why + ", which may be omitted if read_options::warn is set");
    const std::string begin = "kte: " + to_string(place()) + (part_.empty() ? "" : part_ + ": ");
    if (std::vector<double> none; !in_.take_numbers(none)) in_.numbers(name);
    options_.warn(begin + why + " is left out");
  }
  void count_item() {
    if (++items_ > options_.max_items)
      fail("the file holds more than " + std::to_string(options_.max_items) + " things (read_options::max_items)");
  }

  field_scanner& in_;
  const read_options& options_;
  std::string part_;
  std::size_t items_ = 0;
};

}  // namespace kte::detail
