#pragma once

#include <kte/runtime_chain/kte_map.hpp>
#include <kte/runtime_chain/topology.hpp>

#include <memory>
#include <vector>

namespace kte::detail {

/// An element with other parameters in each lane of packs: one element for each lane (`kte::lanes`). Its passes and
/// functions in double are those of the first lane; algorithms on packs call `lane`.
class element_in_lanes final : public kte_element {
 public:
  /// Elements of one type with the same connections, one for each lane.
  explicit element_in_lanes(std::vector<std::unique_ptr<kte_element>> all) : all_(std::move(all)) {}
  element_in_lanes(const element_in_lanes& o) : kte_element(o) {
    for (const auto& e : o.all_) all_.push_back(copy_of(*e));
  }
  ~element_in_lanes() override = default;

  std::size_t lanes() const override { return all_.size(); }
  const kte_element& lane(std::size_t i) const override { return *all_[i]; }
  static std::unique_ptr<kte_element> copy_of(const kte_element& e) {
    auto copy = e.clone();
    auto* const element = dynamic_cast<kte_element*>(copy.get());
    if (element == nullptr) throw bad_argument("kte: clone() of " + describe_element(e) + " did not return an element");
    (void)copy.release();
    return std::unique_ptr<kte_element>(element);
  }

  void connect(topology& t) override {
    first().connect(t);
    auto& c = t.elements.back();
    c.element = this;
    for (auto& e : all_) e->connect_as(c.index);
  }
  std::unique_ptr<kte_map> clone() const override { return std::make_unique<element_in_lanes>(*this); }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const override { visit(*this); }
  element_record record() const override {
    throw bad_argument("kte: " + describe_element(*this) + " has other parameters in each lane; records have one");
  }
  std::string_view type() const override { return first().type(); }
  std::span<const port> ports() const override { return first().ports(); }
  std::span<const std::string> names() const override { return first().names(); }
  bool holds_code() const override { return first().holds_code(); }
  bool switches() const override { return first().switches(); }
  element_numbers<double> numbers() const override { return first().numbers(); }
  closure_rows rows() const override { return first().rows(); }
  touch touch_at(const closing_motion<double>& m) const override { return first().touch_at(m); }
  basic_touch<derivative_number> touch_at(const closing_motion<derivative_number>& m) const override {
    return first().touch_at(m);
  }
  bool has_gate() const override { return first().has_gate(); }
  bool admits(const runtime_state& s) const override { return first().admits(s); }
  std::span<const std::string_view> closure_parameters() const override { return first().closure_parameters(); }

  void doMotion(runtime_state& s) const override { first().doMotion(s); }
  void clearForce(runtime_state& s) const override { first().clearForce(s); }
  void doForce(runtime_state& s) const override { first().doForce(s); }
  double kinetic_energy(runtime_state& s) const override { return first().kinetic_energy(s); }
  double potential_energy(runtime_state& s) const override { return first().potential_energy(s); }
  double switching(runtime_state& s) const override { return first().switching(s); }
  void mass_loads(runtime_state& s) const override { first().mass_loads(s); }
  vec3<> first_moment(runtime_state& s) const override { return first().first_moment(s); }
  bool holds(runtime_state& s) const override { return first().holds(s); }
  double capacity(runtime_state& s) const override { return first().capacity(s); }
  void switch_over(runtime_state& s) const override { first().switch_over(s); }
  double friction(runtime_state& s, const wrench<vec3<>, vec3<>>& end) const override {
    return first().friction(s, end);
  }
  void derive_forces(runtime_state& s) const override { first().derive_forces(s); }
  void derive_motion(derivative_state& s) const override { first().derive_motion(s); }
  void derive_force(derivative_state& s) const override { first().derive_force(s); }
  derivative_number derive_friction(
      derivative_state& s, const wrench<vec3<derivative_number>, vec3<derivative_number>>& end) const override {
    return first().derive_friction(s, end);
  }
  /// The rows of lane i for motion i.
  void close_frames(std::span<const closing_motion<double>> motions, double* rows) const override {
    for (std::size_t i = 0; i < motions.size(); ++i, rows += all_rows_of_closing)
      all_[i]->close_frames(motions.subspan(i, 1), rows);
  }
  using kte_element::close_frames;

 private:
  kte_element& first() { return *all_.front(); }
  const kte_element& first() const { return *all_.front(); }

  std::vector<std::unique_ptr<kte_element>> all_;
};

}  // namespace kte::detail
