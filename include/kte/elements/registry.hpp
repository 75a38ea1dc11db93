#pragma once

#include <kte/contract/number_reader.hpp>
#include <kte/contract/parameter_info.hpp>
#include <kte/detail/compiled.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>

// Who links the elements has no need to read them.
#ifdef KTE_FUNCTION
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

namespace detail {
/// A joint as files place it.
template <class Joint>
using placed_in_files =
    std::conditional_t<Joint::ports.back().what == kind::frame_2D, core::placed_2D<Joint>, core::placed_3D<Joint>>;
/// The core type in files: for a joint the placed joint, otherwise the core itself.
template <class Core>
struct with_placement : std::type_identity<Core> {};
template <class Core>
requires(is_transmission<Core> && (port_count<Core> > 2) && !is_placed_joint<Core>) struct with_placement<Core>
    : std::type_identity<placed_in_files<Core>> {
};
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
  /// Connects a core to the names that the record has for the roles of its ports.
  template <class Core>
  [[gnu::cold]] auto connected(const Core& core) const {
    return [&]<std::size_t... P>(std::index_sequence<P...>) { return connect(core, name(Core::ports[P].role)...); }
    (std::make_index_sequence<port_count<Core>>{});
  }
  /// An element as a part of a runtime chain: the result of functions that make elements of several types.
  template <class Core>
  [[gnu::cold]] static std::unique_ptr<kte_map> adapt(named_element<Core> e) {
    return detail::adapted(std::move(e));
  }
  /// Sets the parameters of a core to those of the record.
  template <class Core>
  [[gnu::cold]] void read(Core& core) const {
    const auto all = parameter_infos<Core>();
    const detail::record_place place{record_.type};
    auto p = all.begin();
    Core::parameters(core, [&](const char*, auto& value) {
      if (const auto numbers = numbers_of(*p++); !numbers.empty()) detail::number_reader(numbers, place)(value);
    });
  }
  /// An element of a core type, as a part of a runtime chain.
  template <class Core>
  [[gnu::cold]] std::unique_ptr<kte_map> make() const {
    Core core{};
    read(core);
    return adapt(connected(core));
  }
  /// A joint with the placement of its record, if any, as a part of a runtime chain.
  template <class Core>
  [[gnu::cold]] std::unique_ptr<kte_map> placed(const named_element<Core>& joint) const {
    if (!has("position") && !has("rotation")) return adapt(joint);
    detail::placed_in_files<Core> core(joint.core);
    read(core);
    return adapt(connected(core));
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
  /// The numbers of a parameter, checked; nothing if it is left out.
  std::span<const double> numbers_of(const parameter_info& p) const;
  const std::vector<double>& values(std::string_view parameter, std::size_t count) const {
    const auto& p = parameter_of(parameter);
    if (p.values.size() != count)
      fail("has " + std::to_string(p.values.size()) + " numbers as '" + p.name + "', not " + std::to_string(count),
           p.place);
    return p.values;
  }
  const element_record& record_;
};

/// Makes elements from records by the name of their type. A program adds its own cores by
///
///   registry.add<my_core<kte::kind::frame_2D>, my_core<kte::kind::frame_3D>>();
class element_registry {
 public:
  using factory = std::function<std::unique_ptr<kte_map>(const record_reader&)>;

  /// Adds core types; joints also with a placement. Roles of connections and names of parameters are those of `ports`
  /// and `parameters`. If several cores have one type name, a record becomes the first that it fits: they differ in
  /// numbers that their types fix, and in optional parameters. Throws `bad_argument` if the name is known.
  template <class... Core>
  requires(sizeof...(Core) > 0) void add() {
    std::vector<std::string_view> added;
    (put_core<Core>(added), ...);
    (put_placed<Core>(added), ...);
  }
  /// Adds a type whose elements a function makes from a `record_reader`. Throws `bad_argument` if the type is known.
  template <class Make>
  void add(std::string_view type, Make make) {
    known_core& k = put(type);
    k.by_function = [make](const record_reader& r) { return adapt(make(r)); };
  }
  /// The names of all types, in alphabetical order.
  std::vector<std::string> types() const {
    std::vector<std::string> all;
    for (const auto& f : known_) all.push_back(f.first);
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
  struct known_core {
    std::vector<parameter_info> (*parameters)() = nullptr;
    std::unique_ptr<kte_map> (*make)(const record_reader&) = nullptr;
    factory by_function{};  ///< instead of both
    bool fits(const element_record& r) const;
  };
  friend runtime_chain to_chain(const model_record& m, const element_registry& registry);
  /// A new type, or one more core of a type that is among those `added` just now.
  known_core& put(std::string_view type, std::vector<std::string_view>* added = nullptr);
  template <class Core>
  static std::unique_ptr<kte_map> make_core(const record_reader& r) {
    return r.make<Core>();
  }
  template <class Core>
  void put_core(std::vector<std::string_view>& added) {
    known_core& k = put(Core::type, &added);
    k.parameters = parameter_infos<Core>, k.make = make_core<Core>;
  }
  template <class Core>
  void put_placed(std::vector<std::string_view>& added) {
    using placed = typename detail::with_placement<Core>::type;
    if constexpr (!std::is_same_v<placed, Core>) put_core<placed>(added);
  }
  std::unique_ptr<kte_map> make_unplaced(const element_record& r) const;
  template <class Core>
  static std::unique_ptr<kte_map> adapt(named_element<Core> e) {
    return record_reader::adapt(std::move(e));
  }
  static std::unique_ptr<kte_map> adapt(std::unique_ptr<kte_map> e) { return e; }
  std::map<std::string, std::vector<known_core>, std::less<>> known_;
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
KTE_FUNCTION std::span<const double> record_reader::numbers_of(const parameter_info& p) const {
  const std::string name(p.name);
  if (!has(name)) {
    if (!p.optional) fail("has no parameter '" + name + "'");
    return {};
  }
  if (p.count < 0) return numbers(name);
  const std::span<const double> given = values(name, static_cast<std::size_t>(p.count));
  if (!p.has_fixed()) return given;
  if (p.what == "flag") return flag(name) ? given : std::span<const double>{};
  for (const double x : given)
    if (!std::isfinite(x))
      throw bad_parameter("kte: " + record_.type + ": " + name + " must be finite, got " + detail::number(x));
  const bool turned = p.what == "rotation" && (given[0] != given[4] || given[1] != -given[3]);
  if (p.fits(given) && !turned) return given;
  if (p.what != "vector" || !p.is_fixed()) fail("has a '" + name + "' out of the plane");
  std::string axis;
  for (const signed char n : std::span(p.numbers).first(3)) axis += (axis.empty() ? "" : ", ") + std::to_string(n);
  fail("has a '" + name + "' other than (" + axis + ")");
}
KTE_FUNCTION bool element_registry::known_core::fits(const element_record& r) const {
  if (!parameters) return true;
  const auto all = parameters();
  return std::all_of(r.parameters.begin(), r.parameters.end(), [&](const parameter_record& p) {
    const auto own = std::find_if(all.begin(), all.end(), [&](const parameter_info& i) { return i.name == p.name; });
    return own != all.end() && own->fits(p.values);
  });
}
KTE_FUNCTION element_registry::known_core& element_registry::put(std::string_view type,
                                                                 std::vector<std::string_view>* added) {
  auto& known = known_[std::string(type)];
  if (!known.empty() && (!added || std::find(added->begin(), added->end(), type) == added->end()))
    throw bad_argument("kte: the registry has a '" + std::string(type) + "' already");
  if (added) added->push_back(type);
  return known.emplace_back();
}
KTE_FUNCTION std::unique_ptr<kte_map> element_registry::make_unplaced(const element_record& r) const {
  const auto f = known_.find(r.type);
  if (f == known_.end()) throw detail::bad_record(r.place, "there is no element type '" + r.type + "'");
  if (r.version != 1)
    throw detail::bad_record(r.place,
                             r.type + " has version " + std::to_string(r.version) + ", this library reads version 1");
  const auto& cores = f->second;
  auto core = std::find_if(cores.begin(), cores.end(), [&](const known_core& c) { return c.fits(r); });
  if (core == cores.end()) --core;  // which says what does not fit
  const record_reader reader(r);
  auto e = core->by_function ? core->by_function(reader) : core->make(reader);
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
  [&]<class... Core>(detail::core_list<void, Core...>) {
    std::vector<std::string_view> added;
    (r.put_core<Core>(added), ...);
  }(detail::all_cores{});
  return r;
}
#  undef KTE_ALL_ELEMENTS
#endif
#ifdef KTE_EXTERN
KTE_EXTERN template element_registry element_registry::standard<void>();
#endif

}  // namespace kte
