#pragma once

#include <kte/io/binary_layout.hpp>
#include <kte/io/bytes.hpp>
#include <kte/io/field_writer.hpp>

#include <unordered_map>

namespace kte::detail {

/// Binary model files (io/binary_layout.hpp).
class binary_writer final : public field_writer {
 public:
  binary_writer() { put(binary_tag::group); }

  void open_group(const std::string& name) override { put_name(name), put(binary_tag::group); }
  void open_list(const std::string& name) override { put_name(name), put(binary_tag::list); }
  void close() override { put(binary_tag::end); }
  void text(const std::string& name, const std::string& value) override { put_name(name), put_text(value); }
  void numbers(const std::string& name, const std::vector<double>& values) override {
    put_name(name), put(binary_tag::numbers), put_count(values.size());
    for (const double x : values) append_bytes(out_, x);
  }
  std::string finish() override {
    put(binary_tag::end);
    return std::move(out_);
  }

 private:
  void put(binary_tag t) { out_.push_back(static_cast<char>(t)); }
  void put_count(std::uint64_t n) {
    for (; n >= 0x80; n >>= 7) out_.push_back(static_cast<char>(0x80 | (n & 0x7F)));
    out_.push_back(static_cast<char>(n));
  }
  void put_name(const std::string& name) {
    if (!name.empty()) put_text(name);
  }
  void put_text(const std::string& text) {
    if (text.size() <= longest_known) {
      const auto [known, fresh] = known_.emplace(text, known_.size());
      if (!fresh) return put(binary_tag::known), put_count(known->second);
    }
    put(binary_tag::text), put_count(text.size());
    out_ += text;
  }

  std::string out_{binary_magic};
  std::unordered_map<std::string, std::size_t> known_;
};

}  // namespace kte::detail
