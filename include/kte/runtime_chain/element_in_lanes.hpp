#pragma once

#include <kte/runtime_chain/forwarding_element.hpp>

#include <memory>
#include <vector>

namespace kte::detail {

/// An element with other parameters in each lane of packs: one element for each lane (`kte::lanes`). Its passes and
/// functions in double are those of the first lane; algorithms on packs call `lane`.
class element_in_lanes final : public forwarding_element {
 public:
  /// Elements of one type with the same connections, one for each lane.
  explicit element_in_lanes(std::vector<std::unique_ptr<kte_element>> all) : all_(std::move(all)) {}
  element_in_lanes(const element_in_lanes& o) : forwarding_element(o) {
    for (const auto& e : o.all_) all_.push_back(copy_of(*e));
  }
  ~element_in_lanes() override = default;

  std::size_t lanes() const override { return all_.size(); }
  const kte_element& lane(std::size_t i) const override { return *all_[i]; }

  void connect(topology& t) override {
    forwarding_element::connect(t);
    for (auto& e : all_) e->connect_as(t.elements.back().index);
  }
  std::unique_ptr<kte_map> clone() const override { return std::make_unique<element_in_lanes>(*this); }
  element_record record() const override {
    throw bad_argument("kte: " + describe_element(*this) + " has other parameters in each lane; records have one");
  }
  /// The rows of lane i for motion i.
  void close_frames(std::span<const closing_motion<double>> motions, double* rows) const override {
    for (std::size_t i = 0; i < motions.size(); ++i, rows += all_rows_of_closing)
      all_[i]->close_frames(motions.subspan(i, 1), rows);
  }
  using forwarding_element::close_frames;

 private:
  kte_element& inner() override { return *all_.front(); }
  const kte_element& inner() const override { return *all_.front(); }

  std::vector<std::unique_ptr<kte_element>> all_;
};

}  // namespace kte::detail
