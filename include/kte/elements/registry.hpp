#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

// Who links the elements has no need to read them.
#if !defined(KTE_EXTERN) || defined(KTE_COMPILED_ELEMENTS) || \
    (defined(KTE_COMPILED_HERE) && !defined(KTE_COMPILED_LOOPS))
#  include <kte/elements/compiled_elements.hpp>
#  define KTE_ALL_ELEMENTS
#endif

#include <functional>
#include <map>

namespace kte {

namespace detail {
/// A record that makes no element, and where that was read.
struct bad_record : bad_file {
  file_place place;
  bad_record(const file_place& p, const std::string& why) : bad_file(why), place(p) {}
};
/// make(), whose errors then name the place of the element and `which` it is.
template <class Make>
auto placed(const element_record& r, const std::string& which, const Make& make) {
  const auto begin = "kte: " + to_string(r.place) + which;
  const auto rest = [](const error& e) {
    std::string_view text(e.what());
    if (text.starts_with("kte: ")) text.remove_prefix(5);
    return std::string(text);
  };
  try {
    return make();
  } catch (const bad_record& e) {
    throw bad_file("kte: " + to_string(e.place) + which + e.what());
  } catch (const bad_parameter& e) {
    throw bad_parameter(begin + rest(e));
  } catch (const bad_wiring& e) {
    throw bad_wiring(begin + rest(e));
  }
}
}  // namespace detail

/// Reads names and parameters of an element record by role and name. Throws `bad_file` if one is missing or has the
/// wrong size.
class record_reader {
 public:
  explicit record_reader(const element_record& r) : record_(r) {}

  const std::string& name(std::string_view role) const {
    for (const auto& c : record_.connections)
      if (c.role == role) return c.name;
    fail("has no connection '" + std::string(role) + "'");
  }
  /// A parameter that is one number.
  double number(std::string_view parameter) const { return values(parameter, 1)[0]; }
  /// The numbers of a parameter that is a list.
  const std::vector<double>& numbers(std::string_view parameter) const { return parameter_of(parameter).values; }
  /// Whether the record has an optional parameter.
  bool has(std::string_view parameter) const {
    return std::any_of(record_.parameters.begin(), record_.parameters.end(),
                       [&](const parameter_record& p) { return p.name == parameter; });
  }
  /// Whether a parameter is there and 1.
  bool flag(std::string_view parameter) const {
    const bool given = has(parameter);
    if (given && number(parameter) != 1) fail("has '" + std::string(parameter) + "' other than 1");
    return given;
  }
  /// A parameter of three numbers x, y, z.
  vec3<> vector(std::string_view parameter) const {
    const auto& v = values(parameter, 3);
    return {v[0], v[1], v[2]};
  }
  /// A parameter of two numbers x, y.
  vec2<> planar_vector(std::string_view parameter) const {
    check_finite(parameter);
    const auto v = vector(parameter);
    if (v.z != 0) fail("has a '" + std::string(parameter) + "' out of the plane");
    return {v.x, v.y};
  }
  /// A parameter of nine numbers, a matrix by rows.
  mat3<vec3<>> matrix(std::string_view parameter) const {
    const auto& v = values(parameter, 9);
    return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
  }
  /// A parameter that is a rotation matrix by rows.
  mat3<vec3<>> rotation(std::string_view parameter) const { return matrix(parameter); }
  /// A parameter of six numbers, a symmetric matrix: xx xy xz yy yz zz.
  sym3<> symmetric(std::string_view parameter) const {
    const auto& v = values(parameter, 6);
    return {v[0], v[1], v[2], v[3], v[4], v[5]};
  }
  /// A parameter that is a rotation about z.
  rotation_2D<> planar_rotation(std::string_view parameter) const {
    check_finite(parameter);
    const auto m = rotation(parameter);
    const rotation_2D<> r{m.x.x, m.y.x};
    if (m != as<double>(kte::matrix(r))) fail("has a '" + std::string(parameter) + "' out of the plane");
    return r;
  }
  /// The rigid body of the parameters mass, com and inertia.
  rigid_body<> body() const { return {number("mass"), vector("com"), symmetric("inertia"), flag("as_published")}; }
  /// The rigid body in the plane of the parameters; entries out of the plane must be zero.
  auto planar_body() const {
    check_finite("com"), check_finite("inertia");
    const auto b = body();
    const auto& i = b.inertia;
    if (b.com.z != 0 || i.xx != 0 || i.xy != 0 || i.xz != 0 || i.yy != 0 || i.yz != 0)
      fail("has inertia out of the plane");
    auto planar = kte::planar_body(b.mass, i.zz, vec3{b.com.x, b.com.y, zero});
    planar.published = b.published;
    return planar;
  }
  /// Connects a core to the names that the record has for the roles of its ports.
  template <class Core>
  auto connected(const Core& core) const {
    return [&]<std::size_t... P>(std::index_sequence<P...>) { return connect(core, name(Core::ports[P].role)...); }
    (std::make_index_sequence<port_count<Core>>{});
  }
  /// Calls f with a typed axis if the axis equals one, else with numbers, so that a joint read from a file has the type
  /// that was written.
  template <class F>
  auto with_axis(std::string_view parameter, const F& f) const {
    const auto v = vector(parameter);
    if (v == as<double>(axis::x)) return f(axis::x);
    if (v == as<double>(axis::y)) return f(axis::y);
    if (v == as<double>(axis::z)) return f(axis::z);
    return f(v);
  }
  /// An element as a part of a runtime chain: the result of functions that make elements of several types.
  template <class Core>
  static std::unique_ptr<kte_map> adapt(named_element<Core> e) {
    return std::make_unique<kte_map_adapter<Core>>(std::move(e));
  }
  /// Whether the record has a placement of the joint in its base.
  bool is_placed() const { return has("position") || has("rotation"); }
  /// The joint with the placement of its record, if any, as a part of a runtime chain.
  template <class Core>
  std::unique_ptr<kte_map> placed(const named_element<Core>& joint) const {
    if (!is_placed()) return adapt(joint);
    const bool has_position = has("position"), has_rotation = has("rotation");
    if constexpr (Core::ports.back().what == kind::frame_2D)
      return adapt(joint.at(has_position ? planar_vector("position") : vec2<>{},
                            has_rotation ? planar_rotation("rotation") : rotation_2D<>{1, 0}));
    else
      return adapt(joint.at(has_position ? vector("position") : vec3<>{},
                            has_rotation ? rotation("rotation") : as<double>(kte::matrix(no_rotation{}))));
  }
  /// Throws `bad_file` with the place and type of the element and the reason.
  [[noreturn]] void fail(const std::string& why) const { fail(why, record_.place); }

 private:
  [[noreturn]] void fail(const std::string& why, const file_place& place) const {
    throw detail::bad_record(place, record_.type + " " + why);
  }
  const parameter_record& parameter_of(std::string_view parameter) const {
    for (const auto& p : record_.parameters)
      if (p.name == parameter) return p;
    fail("has no parameter '" + std::string(parameter) + "'");
  }
  /// Before what no number is not, as in the plane.
  void check_finite(std::string_view parameter) const {
    for (const double x : parameter_of(parameter).values)
      if (!std::isfinite(x))
        throw bad_parameter("kte: " + record_.type + ": " + std::string(parameter) + " must be finite, got " +
                            detail::number(x));
  }
  const std::vector<double>& values(std::string_view parameter, std::size_t count) const {
    const auto& p = parameter_of(parameter);
    if (p.values.size() != count)
      fail("has " + std::to_string(p.values.size()) + " numbers as '" + p.name + "', not " + std::to_string(count),
           p.place);
    return p.values;
  }
  const element_record& record_;
};

/// Makes elements from records by the name of their type. A program adds its own by
///
///   registry.add("my_element", [](const record_reader& r) { return my_element(r.name("frame"), r.number("c")); });
class element_registry {
 public:
  using factory = std::function<std::unique_ptr<kte_map>(const record_reader&)>;

  /// Throws `bad_argument` if the type is known.
  template <class Make>
  void add(std::string_view type, Make make) {
    if constexpr (std::is_empty_v<Make> && std::is_default_constructible_v<Make>)  // of one type for all such
      put(
          type, +[](const record_reader& r) { return adapt(Make{}(r)); });
    else
      put(type, [make](const record_reader& r) { return adapt(make(r)); });
  }
  /// The names of all types, in alphabetical order.
  std::vector<std::string> types() const {
    std::vector<std::string> all;
    for (const auto& f : factories_) all.push_back(f.first);
    return all;
  }
  /// Throws `bad_file` for an unknown type, a wrong version, missing names or parameters; `bad_parameter` for bad ones.
  std::unique_ptr<kte_map> make(const element_record& r) const {
    return detail::placed(r, "", [&] { return make_unplaced(r); });
  }

  /// All elements of this library. It is a template, so that only programs that call it compile them.
  template <class = void>
  static element_registry standard();

 private:
  friend runtime_chain to_chain(const model_record& m, const element_registry& registry);
  void put(std::string_view type, factory make) {
    const bool fresh = factories_.emplace(type, std::move(make)).second;
    if (!fresh) throw bad_argument("kte: the registry has a '" + std::string(type) + "' already");
  }
  std::unique_ptr<kte_map> make_unplaced(const element_record& r) const;
  template <class Core>
  static std::unique_ptr<kte_map> adapt(named_element<Core> e) {
    return record_reader::adapt(std::move(e));
  }
  static std::unique_ptr<kte_map> adapt(std::unique_ptr<kte_map> e) { return e; }
  std::map<std::string, factory, std::less<>> factories_;
};

/// A runtime chain from a record. Throws `bad_file`, `bad_parameter` or `bad_wiring`, each naming the element.
[[nodiscard]] runtime_chain to_chain(const model_record& m, const element_registry& registry);
/// A runtime chain from a record, with the elements of this library. Throws `bad_file`, `bad_parameter` or
/// `bad_wiring`; each names the element.
template <class = void>
[[nodiscard]] runtime_chain to_chain(const model_record& m) {
  return to_chain(m, element_registry::standard());
}

#ifdef KTE_FUNCTION
namespace detail {
/// Unknown parameters are errors.
KTE_FUNCTION void check_complete(const element_record& made, const element_record& r) {
  for (const auto& p : r.parameters)
    if (std::none_of(made.parameters.begin(), made.parameters.end(), [&](const auto& o) { return o.name == p.name; }))
      throw detail::bad_record(p.place, r.type + " has no parameter '" + p.name + "'");
  for (const auto& c : r.connections)
    if (std::none_of(made.connections.begin(), made.connections.end(), [&](const auto& o) { return o.role == c.role; }))
      throw detail::bad_record(c.place, r.type + " has no connection '" + c.role + "'");
}
}  // namespace detail
KTE_FUNCTION std::unique_ptr<kte_map> element_registry::make_unplaced(const element_record& r) const {
  const auto f = factories_.find(r.type);
  if (f == factories_.end()) throw detail::bad_record(r.place, "there is no element type '" + r.type + "'");
  if (r.version != 1)
    throw detail::bad_record(r.place,
                             r.type + " has version " + std::to_string(r.version) + ", this library reads version 1");
  auto e = f->second(record_reader(r));
  if (const auto* single = dynamic_cast<const kte_element*>(e.get())) detail::check_complete(single->record(), r);
  return e;
}
KTE_FUNCTION runtime_chain to_chain(const model_record& m, const element_registry& registry) {
  runtime_chain c;
  if (m.gravity.size() != 3) throw bad_file("kte: the model's gravity must have three numbers");
  if (const vec3 g{m.gravity[0], m.gravity[1], m.gravity[2]}; g != vec3<>{}) c.gravity(g);  // zero says nothing
  for (std::size_t i = 0; i < m.elements.size(); ++i) {
    const auto& r = m.elements[i];
    detail::placed(r, "element " + std::to_string(i + 1) + ": ", [&] { c.append(registry.make_unplaced(r)); });
  }
  return c;
}
#endif

#ifdef KTE_ALL_ELEMENTS
template <class>
element_registry element_registry::standard() {
  element_registry r;
  const auto add = [&r](const char* type, const auto& make, const char* = "") { r.add(type, make); };
  [&]<class... Family>(detail::families<Family...>) { (Family::add_to(add), ...); }(detail::all_families{});
  return r;
}
#  undef KTE_ALL_ELEMENTS
#endif
#ifdef KTE_EXTERN
KTE_EXTERN_ELEMENTS template element_registry element_registry::standard<void>();
#endif

}  // namespace kte
