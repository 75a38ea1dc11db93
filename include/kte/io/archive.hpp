#pragma once

#include <kte/elements/registry.hpp>
#include <kte/io/limit_records.hpp>
#include <kte/io/model_inputs.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/io/state_records.hpp>
#include <kte/reak/twist_shaping.hpp>
#include <kte/runtime_chain/from_record.hpp>

namespace kte {

/// Several items in one file, the roots, each with a name:
///
///   kte::archive a;
///   a.add("pendulum", chain).add("joint_coord", "q", s.coordinate("q")).add("end_frame", "tip", s.frame_2D("tip"));
///   a.add("mass_mat1", calculator).add("start", s).add("q0", q);
///   kte::save_archive("pendulum.xml", a);
///
///   const auto b = kte::load_archive("pendulum.xml");
///   const auto c = b.chain("pendulum");
///   auto t = c.make_state();
///   b.restore("joint_coord", t);
///
/// Roots share coordinates, frames and chains by their names: values are restored into the state by the names that the
/// chain uses. Numbers are restored bit for bit. An archive is a value.
class archive {
 public:
  archive() = default;
  explicit archive(archive_record r) : record_(std::move(r)) {}
  /// The archive as plain data.
  [[nodiscard]] const archive_record& record() const { return record_; }

  /// The names of all roots, in their order.
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& r : record_.roots) all.push_back(r.name);
    return all;
  }
  /// Whether there is a root of this name.
  [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }

  /// Adds a chain of either kind; a kinematics or dynamics model, with its tools and inputs; a manipulator, with its
  /// limits; a state of either kind; a `mass_matrix_calc` of a chain in the archive; or numbers, such as q and v.
  /// Throws `bad_argument` if the name is in use.
  template <class T>
  archive& add(const std::string& name, const T& x) {
    if constexpr (requires { x.inertias(), x.coordinates(); }) {
      return put(name, calculator_of(x));
    } else if constexpr (detail::any_state<T>) {
      return put(name, record_of(x));
    } else if constexpr (requires { record_of(x); }) {
      return put(name, detail::record_of_model(x));
    } else {
      static_assert(
          requires { x[x.size()]; }, "kte: an archive holds chains, models, states, calculators and numbers");
      numbers_record numbers;
      for (decltype(x.size()) i = 0; i < x.size(); ++i) numbers.push_back(x[i]);
      return put(name, std::move(numbers));
    }
  }
  /// Adds a chain or a model, with the limits of its coordinates.
  template <class Chain, class Numbers>
  archive& add(const std::string& name, const Chain& c, const joint_limits<Numbers>& limits) {
    auto m = detail::record_of_model(c);
    m.limits = limit_records(c, limits);
    return put(name, std::move(m));
  }
  /// Adds a chain with its tools and the limits of its coordinates.
  template <class Chain, class Numbers>
  archive& add(const std::string& name, const Chain& c, const std::vector<std::string>& tools,
               const joint_limits<Numbers>& limits) {
    auto m = detail::record_of_model(c);
    m.tools = tools, m.limits = limit_records(c, limits);
    return put(name, std::move(m));
  }
  /// Adds a coordinate, frame, input or internal state with its values, and the name that it has in chains, a text or a
  /// key.
  template <class Name, class T>
  requires(key_type<Name> || text_type<Name>) archive& add(const std::string& name, const Name& in_chain, const T& x) {
    constexpr kind k = detail::kind_of_thing<T>;
    if constexpr (key_type<Name>) {
      static_assert(k == Name::what, "kte: this is the key of another kind of thing");
      return put(name, detail::record_of_thing(k, Name::name, x));
    } else {
      return put(name, detail::record_of_thing(k, in_chain, x));
    }
  }

  // ---- the content of a root; throws `unknown_name`, and `bad_argument` if it is something else
  /// The record of a chain or a model.
  [[nodiscard]] const model_record& model(std::string_view name) const { return get<model_record>(name, "a chain"); }
  /// The runtime chain of a root, with elements of this library, or of a registry. Throws `unknown_name`, `bad_file`.
  template <class = void>
  [[nodiscard]] runtime_chain chain(std::string_view name) const {
    return to_chain(model(name));
  }
  [[nodiscard]] runtime_chain chain(std::string_view name, const element_registry& registry) const {
    return to_chain(model(name), registry);
  }
  /// The static chain of a root, of the type of `like`. Throws `bad_file`, naming the element that differs and the
  /// difference.
  template <class Gravity, class... E>
  static_chain<Gravity, E...> chain(std::string_view name, const static_chain<Gravity, E...>& like) const {
    return from_record(like, model(name));
  }
  /// The names of the tools of a model.
  [[nodiscard]] const std::vector<std::string>& tools(std::string_view name) const { return model(name).tools; }
  /// The limits of a root for the coordinates of the chain c; infinite if the file has none.
  template <class Chain>
  [[nodiscard]] auto limits(std::string_view name, const Chain& c) const {
    return limits_of(c, model(name));
  }
  /// The `mass_matrix_calc` of a root, for a chain from this archive (include kte/reak/mass_matrix_calc.hpp). It works
  /// on states of this chain. Throws `bad_argument` for another chain.
  template <class Calculator = mass_matrix_calc<runtime_chain>>
  [[nodiscard]] Calculator calculator(std::string_view name, const runtime_chain& c) const {
    const auto& r = get<calculator_record>(name, "a calculator of the mass matrix");
    if (!same_chain(record_of(c), model(r.chain)))
      throw bad_argument("kte: '" + std::string(name) + "' of the archive is of its chain '" + r.chain +
                         "', not of this one");
    if (!r.of_all) return Calculator(c, r.inertias, r.coordinates);
    return Calculator(c) << all_inertias << all_coordinates;
  }
  /// A coordinate, frame, input or internal state with its values, `thing<kte::gen_coord<>>("joint_coord")`. Values
  /// that the file does not have are zero, or the identity rotation.
  template <class T>
  [[nodiscard]] T thing(std::string_view name) const {
    const auto& r = get<thing_record>(name, "a thing");
    if (r.what != detail::kind_of_thing<T>) wrong(name, to_string(r.what), to_string(detail::kind_of_thing<T>));
    T x{};
    detail::assign_thing(x, r);
    return x;
  }
  /// The name of the item of a root in chains.
  [[nodiscard]] const std::string& name_of_thing(std::string_view name) const {
    return get<thing_record>(name, "a thing").name;
  }
  /// Restores an item or a state into a state of a chain, or the inputs of a model into a model. Values that the file
  /// does not have are unchanged. Strong exception guarantee; throws `unknown_name` for items that the state does not
  /// have.
  template <class T>
  void restore(std::string_view name, T& x) const {
    if constexpr (!detail::any_state<T>) {
      detail::restore_inputs(model(name), x);
    } else if (const auto* single = std::get_if<thing_record>(&content(name))) {
      kte::restore(state_record{{*single}}, x);
    } else {
      kte::restore(get<state_record>(name, "a state or a thing"), x);
    }
  }
  /// The numbers of a root.
  template <class S = double>
  [[nodiscard]] std::vector<S> numbers(std::string_view name) const {
    std::vector<S> all;
    for (const long double x : get<numbers_record>(name, "numbers")) all.push_back(static_cast<S>(x));
    return all;
  }

 private:
  static bool same_chain(const model_record& a, const model_record& b) {
    return a.gravity == b.gravity && a.elements == b.elements;
  }
  template <class Calculator>
  calculator_record calculator_of(const Calculator& c) const {
    const auto chain = record_of(c.chain());
    const auto all = Calculator(c.chain()) << all_inertias << all_coordinates;
    const bool of_all = c.inertias() == all.inertias() && c.coordinates() == all.coordinates();
    for (const auto& r : record_.roots)
      if (const auto* m = std::get_if<model_record>(&r.content); m && same_chain(*m, chain))
        return of_all ? calculator_record{r.name} : calculator_record{r.name, false, c.inertias(), c.coordinates()};
    throw bad_argument("kte: the chain of a mass_matrix_calc must be in the archive before it");
  }
  archive& put(const std::string& name, root_record::content_type content) {
    if (has(name)) throw bad_argument("kte: the archive has a '" + name + "' already");
    record_.roots.push_back({name, std::move(content)});
    return *this;
  }
  const root_record* find(std::string_view name) const {
    for (const auto& r : record_.roots)
      if (r.name == name) return &r;
    return nullptr;
  }
  const root_record::content_type& content(std::string_view name) const {
    if (const auto* r = find(name)) return r->content;
    std::string all;
    for (const auto& r : record_.roots) all += " '" + r.name + "'";
    throw unknown_name("kte: the archive has no '" + std::string(name) + "'; it has" +
                       (all.empty() ? " nothing" : all));
  }
  template <class T>
  const T& get(std::string_view name, std::string_view wanted) const {
    const auto& c = content(name);
    if (const T* x = std::get_if<T>(&c)) return *x;
    wrong(name, detail::content_fields[c.index()], wanted);
  }
  [[noreturn]] static void wrong(std::string_view name, std::string_view is, std::string_view wanted) {
    throw bad_argument("kte: '" + std::string(name) + "' of the archive is '" + std::string(is) + "', not " +
                       std::string(wanted));
  }

  archive_record record_;
};

/// Reads a file by its extension: .xml, .json or .kte. A file with a single chain (`save_model`) is an archive with the
/// root "model". Throws `bad_file`.
[[nodiscard]] inline archive load_archive(const std::filesystem::path& path, const read_options& options = {}) {
  return archive(detail::read_archive(path, options));
}

}  // namespace kte
