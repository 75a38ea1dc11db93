#pragma once

#include <kte/io/binary_layout.hpp>
#include <kte/io/bytes.hpp>
#include <kte/io/field_scanner.hpp>
#include <kte/io/utf8.hpp>

#include <algorithm>
#include <limits>

namespace kte::detail {

/// A binary model file (io/binary_layout.hpp). Counts are checked against the size of the file before they are used.
class binary_scanner final : public field_scanner {
 public:
  /// `file` is the name of the file in messages; the bytes must outlive this object.
  binary_scanner(std::string_view bytes, std::string file)
      : bytes_(bytes), file_(std::make_shared<const std::string>(std::move(file))) {}

  std::size_t at() const override { return at_; }
  void open_document() override {
    if (!bytes_.starts_with(binary_magic)) fail_at(0, "this is not a binary model file");
    i_ = binary_magic.size();
    open_group("the model");
  }
  void close_document() override {
    if (i_ != bytes_.size()) fail_at(i_, "unexpected content after the end of the model");
  }
  void open_group(const std::string& what) override { open(binary_tag::group, what, "a group"); }
  void open_list(const std::string& what) override { open(binary_tag::list, what, "a list"); }
  bool next_field(std::string& name) override {
    if (ends()) return false;
    name = text("the name of a field");
    return true;
  }
  bool next_item(std::size_t) override { return !ends(); }

  std::string text(const std::string& name) override {
    const auto tag = next_tag();
    if (tag == binary_tag::known) {
      const auto which = count();
      if (which >= known_.size()) fail_at(at_, "'" + excerpt(name) + "': there is no such text before it");
      return std::string(known_[static_cast<std::size_t>(which)]);
    }
    if (tag != binary_tag::text) fail_at(at_, "'" + excerpt(name) + "' is not a text");
    const auto bytes = take(count(), 1);
    for (std::size_t i = 0, n = 0; i < bytes.size(); i += n)
      if ((n = utf8_length(bytes.substr(i))) == 0) fail_at(at_, "this is not UTF-8");
    if (bytes.size() <= longest_known) known_.push_back(bytes);
    return std::string(bytes);
  }
  std::string numbers(const std::string& name) override { return text(name); }
  bool take_numbers(std::vector<double>& all) override {
    if (i_ >= bytes_.size() || static_cast<binary_tag>(bytes_[i_]) != binary_tag::numbers) return false;
    next_tag();
    const auto bytes = take(count(), 8);
    all.reserve(all.size() + bytes.size() / 8);
    for (std::size_t i = 0; i < bytes.size(); i += 8) all.push_back(real_from_bytes(bytes.substr(i, 8)));
    return true;
  }

  file_place place(std::size_t offset) override {
    constexpr std::size_t largest = (std::numeric_limits<int>::max)();
    return {file_, 0, static_cast<int>((std::min)(offset, largest))};
  }

 private:
  static std::string excerpt(const std::string& name) { return name.substr(0, 80); }
  [[noreturn]] void cut_off() { fail_at(bytes_.size(), "the file ends in the middle of the model"); }
  unsigned char next_byte() {
    if (i_ >= bytes_.size()) cut_off();
    return static_cast<unsigned char>(bytes_[i_++]);
  }
  binary_tag next_tag() {
    at_ = i_;
    return static_cast<binary_tag>(next_byte());
  }
  void open(binary_tag due, const std::string& what, const char* kind) {
    if (next_tag() != due) fail_at(at_, "'" + excerpt(what) + "' must be " + kind);
  }
  bool ends() {
    if (i_ >= bytes_.size()) cut_off();
    if (static_cast<binary_tag>(bytes_[i_]) != binary_tag::end) return false;
    next_tag();
    return true;
  }
  std::uint64_t count() {
    std::uint64_t n = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint64_t byte = next_byte(), bits = byte & 0x7F;
      if (shift > 63 || (bits << shift) >> shift != bits) fail_at(at_, "a count that does not fit in 64 bits");
      n |= bits << shift;
      if ((byte & 0x80) == 0) return n;
    }
  }
  /// n parts of `each` bytes.
  std::string_view take(std::uint64_t n, std::size_t each) {
    if (n > (bytes_.size() - i_) / each) cut_off();
    const auto part = bytes_.substr(i_, static_cast<std::size_t>(n) * each);
    i_ += part.size();
    return part;
  }

  std::string_view bytes_;
  std::shared_ptr<const std::string> file_;
  std::size_t i_ = 0, at_ = 0;
  std::vector<std::string_view> known_;
};

}  // namespace kte::detail
