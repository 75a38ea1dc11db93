#pragma once

#include <kte/io/field_writer.hpp>
#include <kte/io/numbers.hpp>

#include <cereal/archives/json.hpp>
#include <cereal/archives/xml.hpp>
#include <cereal/types/string.hpp>

#include <optional>
#include <sstream>

namespace kte::detail {

/// JSON and XML by cereal. Of names and texts it keeps pointers until `finish`.
template <class Archive>
class cereal_writer final : public field_writer {
 public:
  void open_group(const std::string& name) override {
    if (const char* n = name_of(name)) archive_->setNextName(n);
    archive_->startNode();
  }
  void open_list(const std::string& name) override {
    open_group(name);
    (*archive_)(cereal::make_size_tag(cereal::size_type{}));
  }
  void close() override { archive_->finishNode(); }
  void text(const std::string& name, const std::string& value) override {
    if (const char* n = name_of(name)) {
      (*archive_)(cereal::make_nvp(n, value));
    } else {
      (*archive_)(value);
    }
  }
  void numbers(const std::string& name, const std::vector<double>& values) override {
    text(name, numbers_to_text(values));
  }
  void whole_number(const std::string& name, int value) override { (*archive_)(cereal::make_nvp(name, value)); }
  bool has_tags() const override { return std::is_same_v<Archive, cereal::XMLOutputArchive>; }
  std::string finish() override {
    archive_.reset();
    std::string all = std::move(out_).str();
    if (all.back() != '\n') all += '\n';
    return all;
  }

 private:
  /// Items are all called <value>: by cereal with their numbers, which then change with each that is put in between.
  const char* name_of(const std::string& name) const {
    return !name.empty() ? name.c_str() : has_tags() ? "value" : nullptr;
  }

  std::ostringstream out_;
  std::optional<Archive> archive_{std::in_place, out_};
};

}  // namespace kte::detail
