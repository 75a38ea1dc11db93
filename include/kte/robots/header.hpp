#pragma once

#include <kte/elements/registry.hpp>
#include <kte/models/joint_limits.hpp>
#include <kte/robots/detail/factory_calls.hpp>
#include <kte/robots/detail/identifiers.hpp>

#include <map>
#include <set>

/// Robots as types: chains written as C++.
namespace kte {

namespace detail {

class header_writer {
 public:
  header_writer(const runtime_chain& chain, const std::string& name)
      : robot_(robot_identifier(name)), of_robot_(robot_.ends_with('_') ? robot_ : robot_ + '_') {
    chain.for_each_element([this](const kte_element& e) { add(e); });
    const vec3<>& g = chain.gravity();
    const std::array gravity{g.x, g.y, g.z};
    if (g != vec3<>{}) gravity_ = ".gravity(" + cpp_vector(gravity) + ")";
  }

  std::string text(const joint_limits<>* limits) const {
    std::string s = "#pragma once\n\n";
    if (limits) s += "#include <kte/models/joint_limits.hpp>\n";
    s += "#include <kte/static.hpp>\n\n// clang-format off\nnamespace robots {\n\nnamespace " + of_robot_ +
         "names {\n" + keys_ + "\nconstexpr auto assembled() {\n  return ::kte::chain(" + elements_ + ")" + gravity_ +
         ";\n}\n}  // namespace " + of_robot_ + "names\n\ninline constexpr auto " + robot_ + " = " + of_robot_ +
         "names::assembled();\n";
    if (limits) s += limits_text(*limits);
    return s + "\n}  // namespace robots\n";
  }

 private:
  void add(const kte_element& e) {
    const auto call = factory_calls().find(e.type());
    if (call == factory_calls().end())
      throw bad_argument("kte: no header can hold a " + std::string(e.type()) +
                         ": it is not an element of this library");
    if (e.ports().back().what == kind::loop)
      throw bad_argument("kte: no header can hold a " + std::string(e.type()) +
                         ": headers do not support closures of loops");
    const std::size_t ports = e.ports().size(), first = e.ports().back().what == kind::contact ? ports - 1 : 0;
    std::string names;  // the name of a contact comes first
    for (std::size_t i = 0; i < ports; ++i) {
      const std::size_t p = (first + i) % ports;
      names.append(i == 0 ? "" : ", ").append(key(e.ports()[p].what, e.names()[p]));
    }
    const auto record = e.record();
    const auto [arguments, place] = argument_writer(record).write(call->second);
    elements_.append(elements_.empty() ? "" : after_body_ ? ",\n" : ",").append("\n      ::kte::");
    elements_.append(e.type()).append("(" + names + arguments + ")" + place);
    after_body_ = record.type.starts_with("inertia_");
  }
  /// The identifier of a name, declared where it comes first.
  const std::string& key(kind k, const std::string& name) {
    auto& known = known_[{is_frame(k), name}];
    if (known.empty()) {
      known = identifiers_.make(name);
      static constexpr std::array<const char*, kinds> types{"coord",       "frame_2D", "frame_3D", "input",
                                                            "rotation_3D", "pose_2D",  "pose_3D",  "internal",
                                                            "vector",      "loop",     "contact"};
      keys_ += "inline constexpr struct " + known + "key final : ::kte::" + types[static_cast<std::size_t>(k)] +
               "_key<" + cpp_text(name) + "> {} " + known + ";\n";
    }
    return known;
  }
  std::string limits_text(const joint_limits<>& x) const {
    const auto text = [](double v) { return std::isinf(v) ? std::string(v < 0 ? "-none" : "none") : cpp_number(v); };
    std::string s = "\ninline constexpr auto " + of_robot_ + "limits = [] {\n" +
                    "  constexpr double none = ::kte::joint_limits<>::none;\n" +
                    "  return ::kte::joint_limits<::std::array<double, " + std::to_string(x.lower.size()) + ">>{";
    const auto list = [&](const char* name, const std::vector<double>& values, const char* after = ",") {
      s.append("\n      .").append(name).append(" = " + cpp_list(values, text)).append(after);
    };
    list("lower", x.lower), list("upper", x.upper), list("rate", x.rate), list("acceleration", x.acceleration);
    list("jerk", x.jerk), list("effort", x.effort, "};\n}();\n");
    return s;
  }

  std::string robot_, of_robot_, keys_, elements_, gravity_;
  bool after_body_ = false;
  identifier_list identifiers_;
  std::map<std::pair<bool, std::string>, std::string> known_;  ///< of frames, and of what else has a name
};

}  // namespace detail

/// A chain as a C++ header: keys in `robots::NAME_names`, the chain `robots::NAME`, constexpr, with typed constants
/// where its numbers are exact zeros, ones and quarter turns, and, if given, `robots::NAME_limits`. The header needs
/// only this library. Equal chains give equal texts. The key of a name is the name with a trailing underscore,
/// `elbow_`, so that it is neither a macro nor a keyword; characters other than letters and digits become underscores,
/// and of two equal names the second gets a number. Throws `bad_argument` for a chain with functions of the program,
/// closures of loops, or elements that are not of this library.
[[nodiscard]] inline std::string to_header(const runtime_chain& chain, const std::string& name) {
  return detail::header_writer(chain, name).text(nullptr);
}
/// A chain with its limits as a C++ header. Throws also `bad_parameter` for limits that do not fit the chain.
[[nodiscard]] inline std::string to_header(const runtime_chain& chain, const std::string& name,
                                           const joint_limits<>& limits) {
  check_limits(chain, limits);
  return detail::header_writer(chain, name).text(&limits);
}
template <class Gravity, class... E>
[[nodiscard]] std::string to_header(const static_chain<Gravity, E...>& chain, const std::string& name) {
  runtime_chain c;
  return to_header(c << chain, name);
}
[[nodiscard]] inline std::string to_header(const model_record& model, const std::string& name) {
  return to_header(to_chain(model), name);
}

}  // namespace kte
