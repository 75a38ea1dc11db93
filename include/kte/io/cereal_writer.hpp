#pragma once

#include <kte/errors.hpp>
#include <kte/io/field_writer.hpp>
#include <kte/io/numbers.hpp>

#include <cereal/archives/json.hpp>
#include <cereal/archives/xml.hpp>

#include <limits>
#include <new>
#include <optional>
#include <sstream>

namespace kte::detail {

/// Writes a text to a stream and verifies that it was accepted. (Streams catch exceptions of their buffers and only set
/// a flag.) Independent of what the stream contained before.
struct whole_text {
  const std::string& text;
  friend std::ostream& operator<<(std::ostream& out, const whole_text& x) {
    out << x.text << '\0';
    if (!out) throw std::bad_alloc();
    return out;
  }
};

/// JSON and XML by cereal. Keeps pointers to names and texts until `finish`. Throws `bad_alloc` rather than returning
/// an incomplete text.
template <class Archive>
class cereal_writer final : public field_writer {
 public:
  cereal_writer() = default;
  cereal_writer(const cereal_writer&) = delete;
  cereal_writer& operator=(const cereal_writer&) = delete;
  /// An unfinished archive must not write its end.
  ~cereal_writer() override {
    if (!archive_) return;
    out_.setstate(std::ios::badbit);
    if constexpr (!is_xml) archive_->makeArray();
  }

  void open_group(const std::string& name) override {
    put_name(name);
    archive_->startNode();
  }
  void open_list(const std::string& name) override {
    open_group(name);
    if constexpr (is_xml) {
      archive_->appendAttribute("size", "dynamic");
    } else {
      archive_->makeArray();
    }
  }
  void close() override { archive_->finishNode(); }
  void text(const std::string& name, const std::string& value) override {
    put_name(name);
    if constexpr (is_xml) {
      archive_->startNode();
      archive_->saveValue(whole_text{value});
      archive_->finishNode();
    } else {
      if (constexpr std::size_t most = (std::numeric_limits<unsigned>::max)(); value.size() > most)
        raise<bad_file>("kte: a text of " + std::to_string(value.size()) + " bytes: in JSON there may be " +
                        std::to_string(most));
      archive_->writeName();
      archive_->saveValue(value);
    }
  }
  void numbers(const std::string& name, const std::vector<double>& values) override {
    text(name, numbers_to_text(values));
  }
  void whole_number(const std::string& name, int value) override {
    if constexpr (is_xml) {
      text(name, std::to_string(value));
    } else {
      put_name(name);
      archive_->writeName();
      archive_->saveValue(value);
    }
  }
  bool has_tags() const override { return is_xml; }
  std::string finish() override {
    archive_.reset();
    if (!out_) throw std::bad_alloc();
    std::string all = std::move(out_).str();
    if (all.back() != '\n') all += '\n';
    return all;
  }

 private:
  static constexpr bool is_xml = std::is_same_v<Archive, cereal::XMLOutputArchive>;

  /// Items are all called <value>. cereal would number them, and the numbers would change with each insertion.
  void put_name(const std::string& name) {
    if (!name.empty()) {
      archive_->setNextName(name.c_str());
    } else if constexpr (is_xml) {
      archive_->setNextName("value");
    }
  }

  std::ostringstream out_;
  std::optional<Archive> archive_{std::in_place, out_};
};

}  // namespace kte::detail
