#include <kte/elements/compiled_elements.hpp>
#include <kte/elements/law_follower.hpp>
#include <kte/elements/law_signal.hpp>

#include "catch.hpp"

// The contract of an element is that of every element of the library, and of one written from its page.

namespace element_core_test {

using namespace kte;

template <class Core>
constexpr int shapes = base_core<Core> + force_core<Core> +
                       (link_core<Core> || joint_core<Core>)+coordinate_follower_core<Core> +
                       frame_follower_core<Core> + signal_core<Core> + closure_core<Core> + contact_core<Core>;

template <class Core>
void check_core() {
  INFO(std::string_view(Core::type));
  CHECK(core_in_files<Core>);
  CHECK(shapes<Core> == 1);
  CHECK(stateful_core<Core> == (detail::kept_count<Core> > 0));
  CHECK(lock_core<Core> == locks_coordinate<Core>);
  CHECK(distributed_mass_core<Core> == distributed_mass<Core>);
}

/// Air drag, F = -c v.
struct drag {
  static constexpr type_name type{"drag", kind::frame_3D};
  static constexpr std::array<port, 1> ports{{{kind::frame_3D, access::on, "frame"}}};
  static constexpr bool reads_positions = true;
  double damping;

  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    return make_loads(wrench{-damping * x.velocity, zero3{}});
  }
  constexpr void check(const parameter_check& where) const { where.not_negative(damping, "damping"); }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("damping", self.damping);
  }
};
/// One that returns a wrench in place of loads, one with too many, and one that does not say how to check.
struct bare_wrench : drag {
  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    return wrench{-damping * x.velocity, zero3{}};
  }
};
struct two_loads : drag {
  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    return make_loads(wrench{-damping * x.velocity, zero3{}}, one);
  }
};
struct no_check {
  static constexpr auto type = drag::type;
  static constexpr auto ports = drag::ports;
};
struct no_parameters_named {
  static constexpr auto type = drag::type;
  static constexpr auto ports = drag::ports;
  constexpr void check(const parameter_check&) const {}
};

static_assert(force_core<drag> && core_in_files<drag> && reads_positions<drag> && power_dual<drag>);
static_assert(!body_core<drag> && !joint_core<drag> && !signal_core<drag> && !holds_code<drag> && !is_load<drag>);
static_assert(element_core<bare_wrench> && !force_core<bare_wrench>);
static_assert(element_core<two_loads> && !force_core<two_loads>);
static_assert(!element_core<no_check> && !element_core<int>);
static_assert(element_core<no_parameters_named> && !core_in_files<no_parameters_named>);

static_assert(joint_core<core::spherical_joint> && !link_core<core::spherical_joint>);
static_assert(link_core<core::rigid_link<kind::frame_2D, no_rotation, vec3<one_t, zero_t, zero_t>>>);
static_assert(body_core<core::inertia_gen<double>> && is_rigid_body<core::inertia_gen<double>>);
static_assert(prescribed_motion_core<core::position_control_gen> &&
              !prescribed_motion_core<core::mimic<double, double>>);
static_assert(prescribed_motion_core<core::position_control<kind::frame_3D>>);

TEST_CASE("each core of the library has one shape of the contract") {
  []<class... Core>(detail::core_list<void, Core...>) { (check_core<Core>(), ...); }(detail::all_cores{});
}

}  // namespace element_core_test
