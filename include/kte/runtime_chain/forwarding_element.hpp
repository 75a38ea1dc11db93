#pragma once

#include <kte/runtime_chain/kte_map.hpp>
#include <kte/runtime_chain/topology.hpp>

#include <memory>

namespace kte::detail {

/// An element that is another one in all that a derived class does not change.
class forwarding_element : public kte_element {
 public:
  static std::unique_ptr<kte_element> copy_of(const kte_element& e) {
    auto copy = e.clone();
    auto* const element = dynamic_cast<kte_element*>(copy.get());
    if (element == nullptr) throw bad_argument("kte: clone() of " + describe_element(e) + " did not return an element");
    (void)copy.release();
    return std::unique_ptr<kte_element>(element);
  }

  void connect(topology& t) override {
    inner().connect(t);
    t.elements.back().element = this;
  }
  void connect_as(std::span<const int> index) override { inner().connect_as(index); }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const override { visit(*this); }
  std::string_view type() const override { return inner().type(); }
  std::span<const port> ports() const override { return inner().ports(); }
  std::span<const std::string> names() const override { return inner().names(); }
  bool holds_code() const override { return inner().holds_code(); }
  bool switches() const override { return inner().switches(); }
  element_numbers<double> numbers() const override { return inner().numbers(); }
  closure_rows rows() const override { return inner().rows(); }
  touch touch_at(const closing_motion<double>& m) const override { return inner().touch_at(m); }
  basic_touch<derivative_number> touch_at(const closing_motion<derivative_number>& m) const override {
    return inner().touch_at(m);
  }
  double contact_size() const override { return inner().contact_size(); }
  bool has_gate() const override { return inner().has_gate(); }
  bool admits(double t, const runtime_state& s) const override { return inner().admits(t, s); }
  std::span<const std::string_view> closure_parameters() const override { return inner().closure_parameters(); }

  void doMotion(runtime_state& s) const override { inner().doMotion(s); }
  void clearForce(runtime_state& s) const override { inner().clearForce(s); }
  void doForce(runtime_state& s) const override { inner().doForce(s); }
  double kinetic_energy(runtime_state& s) const override { return inner().kinetic_energy(s); }
  double potential_energy(runtime_state& s) const override { return inner().potential_energy(s); }
  double switching(runtime_state& s) const override { return inner().switching(s); }
  void mass_loads(runtime_state& s) const override { inner().mass_loads(s); }
  vec3<> first_moment(runtime_state& s) const override { return inner().first_moment(s); }
  bool holds(runtime_state& s) const override { return inner().holds(s); }
  double capacity(runtime_state& s) const override { return inner().capacity(s); }
  void switch_over(runtime_state& s) const override { inner().switch_over(s); }
  double friction(runtime_state& s, const wrench<vec3<>, vec3<>>& end) const override {
    return inner().friction(s, end);
  }
  void derive_forces(runtime_state& s) const override { inner().derive_forces(s); }
  void derive_motion(derivative_state& s) const override { inner().derive_motion(s); }
  void derive_force(derivative_state& s) const override { inner().derive_force(s); }
  derivative_number derive_friction(
      derivative_state& s, const wrench<vec3<derivative_number>, vec3<derivative_number>>& end) const override {
    return inner().derive_friction(s, end);
  }
  void close_frames(const closing_motion<double>& m, closing what, double* rows) const override {
    inner().close_frames(m, what, rows);
  }
  void close_frames(std::span<const closing_motion<double>> motions, double* rows) const override {
    inner().close_frames(motions, rows);
  }
  void close_frames(const closing_motion<derivative_number>& m, closing what, derivative_number* rows) const override {
    inner().close_frames(m, what, rows);
  }

 protected:
  virtual kte_element& inner() = 0;
  virtual const kte_element& inner() const = 0;
};

}  // namespace kte::detail
