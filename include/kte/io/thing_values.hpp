#pragma once

#include <kte/contract/thing.hpp>
#include <kte/errors.hpp>
#include <kte/frames/coordinates.hpp>
#include <kte/frames/frame_3D.hpp>
#include <kte/frames/gen_coord.hpp>
#include <kte/frames/internal_state.hpp>
#include <kte/io/archive_record.hpp>
#include <kte/io/numbers.hpp>
#include <kte/math/quaternion.hpp>

#include <algorithm>
#include <concepts>

/// Values of coordinates, frames and signals as plain data, and back.
namespace kte::detail {

/// Calls visit(name, value) for the independent values of an item; sines and matrices are derived from them.
template <class T, class Visit>
void visit_quantities(T& x, const Visit& visit) {
  const auto member = [&](const char* name, auto& value) { visit(name, value); };
  if constexpr (std::floating_point<T> || requires {
                  x.z;
                  requires requires { x.x; };
                }) {  // a signal
    member("value", x);
  } else {
    if constexpr (requires { x.q; }) member("q", x.q), member("q_dot", x.q_dot), member("q_ddot", x.q_ddot);
    if constexpr (requires { x.f; }) member("f", x.f);
    if constexpr (requires { x.position; }) member("position", x.position);
    if constexpr (requires { x.rotation; }) member("rotation", x.rotation);
    if constexpr (requires { x.angle; }) member("angle", x.angle);
    if constexpr (requires { x.velocity; }) member("velocity", x.velocity);
    if constexpr (requires { x.ang_velocity; }) member("ang_velocity", x.ang_velocity);
    if constexpr (requires { x.acceleration; }) member("acceleration", x.acceleration);
    if constexpr (requires { x.ang_acceleration; }) member("ang_acceleration", x.ang_acceleration);
    if constexpr (requires { x.residual; }) {
      member("residual", x.residual), member("ang_residual", x.ang_residual);
    }
    if constexpr (requires { x.mode; }) {
      member("gap", x.gap), member("slip", x.slip), member("point", x.point);
      member("direction", x.direction), member("mode", x.mode);
    }
    if constexpr (requires { x.force; }) member("force", x.force);
    if constexpr (requires { x.torque; }) member("torque", x.torque);
    if constexpr (requires { x.z_dot; }) member("z", x.z), member("z_dot", x.z_dot);
  }
}
/// Calls visit(number) for all numbers: vectors x y z, matrices by rows, quaternions w x y z, planar rotations cos sin.
template <class T, class Visit>
void visit_numbers_of(T& x, const Visit& visit) {
  if constexpr (std::floating_point<std::remove_const_t<T>>) {
    visit(x);
  } else if constexpr (requires { x.cos; }) {
    visit(x.cos), visit(x.sin);
  } else {
    if constexpr (requires { x.w; }) visit_numbers_of(x.w, visit);
    visit_numbers_of(x.x, visit), visit_numbers_of(x.y, visit);
    if constexpr (requires { x.z; }) visit_numbers_of(x.z, visit);
  }
}

template <class T>
thing_record record_of_thing(kind what, std::string_view name, const T& x) {
  thing_record r{what, std::string(name), {}};
  visit_quantities(x, [&r](const char* quantity, const auto& value) {
    auto& numbers = r.values.emplace_back(quantity_record{quantity, {}}).values;
    visit_numbers_of(value, [&numbers](const auto& number) { numbers.push_back(number); });
  });
  return r;
}
/// The rule that the numbers of a quantity violate, or nullptr. Quaternions may have any length.
template <class T>
const char* broken_rule(const T& x) {
  const auto turns = [](const auto& matrix) {
    try {
      (void)to_quaternion(matrix);
      return true;
    } catch (const bad_argument&) {
      return false;
    }
  };
  if constexpr (requires { x.cos; }) {
    return turns(matrix(x)) ? nullptr : "be the cosine and sine of an angle";
  } else if constexpr (requires { x.w; }) {
    return turns(matrix_of_any_length(x)) ? nullptr : "be finite and not of length 0";
  } else if constexpr (requires { x.x.x; }) {
    return turns(x) ? nullptr : "be orthonormal and right-handed";
  } else {
    return nullptr;
  }
}
/// Stores the values of a record in an item; other values are unchanged. Throws `bad_file` for a quantity that the item
/// does not have, for a wrong count of numbers, and for matrices that are not rotations.
template <class T>
void assign_thing(T& x, const thing_record& r) {
  const auto fail = [&r](const quantity_record& v, const std::string& why) {
    raise<bad_file>("kte: " + to_string(v.place) + std::string(to_string(r.what)) + " '" + r.name + "' " + why);
  };
  for (const auto& v : r.values) {
    bool known = false;
    visit_quantities(x, [&](const char* quantity, auto& value) {
      if (v.name != quantity) return;
      known = true;
      std::size_t n = 0;
      visit_numbers_of(value, [&n](const auto&) { ++n; });
      if (v.values.size() != n)
        fail(v, "has " + std::to_string(v.values.size()) + " numbers as '" + v.name + "', not " + std::to_string(n));
      auto next = v.values.begin();
      visit_numbers_of(value,
                       [&next](auto& number) { number = static_cast<std::remove_cvref_t<decltype(number)>>(*next++); });
      if (const char* rule = broken_rule(value))
        fail(v, "has '" + numbers_to_text(v.values) + "' as '" + v.name + "', which must " + rule);
    });
    if (!known) fail(v, "has no '" + v.name + "'");
  }
  if constexpr (requires { update_angle(x); }) update_angle(x);
}

}  // namespace kte::detail
