#include "model_json.hpp"

#include <kte/io/record_writer.hpp>

#include "json_text.hpp"

namespace kte::view {

namespace {
class json_fields final : public detail::field_writer {
 public:
  void open_group(const std::string& name) override { open(name, false); }
  void open_list(const std::string& name) override { open(name, true); }
  void close() override {
    if (lists_.back())
      out_.close_list();
    else
      out_.close_object();
    lists_.pop_back();
  }
  void text(const std::string& name, const std::string& value) override {
    put_name(name);
    out_.text(value);
  }
  void numbers(const std::string& name, const std::vector<double>& values) override {
    text(name, detail::numbers_to_text(values));
  }
  void whole_number(const std::string& name, int value) override {
    put_name(name);
    out_.number(value);
  }
  std::string finish() override {
    out_.close_object();
    return std::move(out_.out());
  }
  json_fields() { out_.open_object(); }

 private:
  void put_name(const std::string& name) {
    if (!name.empty()) out_.key(name);
  }
  void open(const std::string& name, bool list) {
    put_name(name);
    if (list)
      out_.open_list();
    else
      out_.open_object();
    lists_.push_back(list);
  }

  json_text out_;
  std::vector<bool> lists_;
};
}  // namespace

std::string model_json(const model_record& m) {
  json_fields out;
  detail::record_writer(out).model_file(m);
  return out.finish();
}

}  // namespace kte::view
