#pragma once

#include <kte/contract/parameter_info.hpp>
#include <kte/elements/compiled_elements.hpp>
#include <kte/robots/detail/cpp_numbers.hpp>

#include <map>
#include <set>

namespace kte::detail {

/// How the factory of an element is called: with what its ports are connected to, then with its parameters in the order
/// of files, or as `arguments` of the core tells, with names of parameters where their values come: {a, b} is a struct
/// of numbers, body a rigid body.
struct factory_call {
  const char* arguments = nullptr;
  std::vector<parameter_info> parameters;
};

/// Those of this library, by the type of the element.
inline const std::map<std::string, factory_call, std::less<>>& factory_calls() {
  static const auto all = [] {
    std::map<std::string, factory_call, std::less<>> calls;
    const auto add = [&calls]<class Core>(const Core*) {
      auto& call = calls[std::string(std::string_view(Core::type))];  // the last has numbers where others have types
      call.parameters = parameter_infos<Core>();
      if constexpr (requires { Core::arguments; }) call.arguments = Core::arguments;
    };
    [&]<class... Core>(core_list<void, Core...>) { (add(static_cast<const Core*>(nullptr)), ...); }(all_cores{});
    return calls;
  }();
  return all;
}

/// The parameters of one element as arguments of its factory.
class argument_writer {
 public:
  explicit argument_writer(const element_record& e) : e_(e), in_plane_(e.type.ends_with("_2D")) {}

  /// ", ::kte::along_z(0.36), ::kte::quarter_turn_x", what is left out being left out; then ".at(...)" of joints.
  /// Throws `bad_argument` where the element has parameters that no argument takes.
  std::pair<std::string, std::string> write(const factory_call& call) {
    std::string all = call.arguments ? by_pattern(call.arguments) : in_order(call.parameters);
    constexpr std::string_view none = ", ::kte::no_rotation{}";
    if (all.ends_with(none)) all.resize(all.size() - none.size());
    const auto* const position = take("position");
    const auto* const rotation = take("rotation");
    std::string place;
    if (position || rotation) {
      place = ".at(" + (position ? value(*position, 0) : "::kte::zero3{}");
      const std::string turn = rotation ? value(*rotation, 0) : "::kte::no_rotation{}";
      place += (turn == "::kte::no_rotation{}" ? "" : ", " + turn) + ")";
    }
    const auto is_fixed = [&call](const parameter_record& p) {
      return std::any_of(call.parameters.begin(), call.parameters.end(),
                         [&](const parameter_info& i) { return i.name == p.name && i.is_fixed(); });
    };
    for (const auto& p : e_.parameters)
      if (!taken_.contains(p.name) && !is_fixed(p))
        throw bad_argument("kte: no header can hold the parameter '" + p.name + "' of " + e_.type);
    return {all, place};
  }

 private:
  const parameter_record* take(std::string_view name) {
    for (const auto& p : e_.parameters)
      if (p.name == name && taken_.insert(p.name).second) return &p;
    return nullptr;
  }
  const parameter_record& required(std::string_view name) {
    const auto* const p = take(name);
    if (!p) throw bad_argument("kte: " + e_.type + " has no parameter '" + std::string(name) + "'");
    return *p;
  }
  std::string in_order(const std::vector<parameter_info>& parameters) {
    std::string all;
    for (const auto& i : parameters) {
      if (i.optional && (i.name == "position" || i.name == "rotation")) continue;
      const auto* const p = take(i.name);
      if (!p || i.is_fixed()) continue;
      const bool last_only = i.what == "symmetric matrix" && i.has_fixed();  // of a body in the plane
      all += ", " + (i.count < 0 ? "::std::array" + cpp_list(p->values, cpp_number)
                     : last_only ? cpp_entry(p->values.at(5))
                                 : value(*p, 0));
    }
    return all;
  }
  std::string by_pattern(std::string_view pattern) {
    std::string all;
    int depth = 0;
    for (std::size_t i = 0; i < pattern.size();) {
      const char c = pattern[i];
      const std::size_t end = (std::min)(pattern.find_first_of("{}, ", i), pattern.size());
      if (end > i) {
        all += token(pattern.substr(i, end - i), depth), i = end;
        continue;
      }
      depth += (c == '{') - (c == '}');
      all += c, ++i;
    }
    return all.empty() ? all : ", " + all;
  }
  std::string token(std::string_view name, int depth) {
    if (name == "body") {
      const bool published = take("as_published");
      return cpp_body(required("mass").values.at(0), required("com").values, required("inertia").values, in_plane_) +
             (published ? ".as_published()" : "");
    }
    return value(required(name), depth);
  }
  /// Within braces plain numbers, elsewhere typed constants where they are exact.
  std::string value(const parameter_record& p, int depth) const {
    const std::span<const double> v(p.values);
    if (v.size() == 1) return depth > 0 || v[0] != 0 || p.name == "mass" ? cpp_number(v[0]) : "::kte::zero";
    if (depth > 0 && v.size() == 9)
      return "{" + cpp_list(v.first(3), cpp_number) + ", " + cpp_list(v.subspan(3, 3), cpp_number) + ", " +
             cpp_list(v.last(3), cpp_number) + "}";
    if (depth > 0) return cpp_list(v, cpp_number);
    if (v.size() == 9) return in_plane_ ? cpp_plane_rotation(v) : cpp_rotation(v);
    return v.size() == 6 ? cpp_symmetric(v) : cpp_vector(v);
  }

  const element_record& e_;
  bool in_plane_;
  std::set<std::string> taken_;
};

}  // namespace kte::detail
