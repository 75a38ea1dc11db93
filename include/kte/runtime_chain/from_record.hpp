#pragma once

#include <kte/runtime_chain/static_chain_map.hpp>

#include <span>

/// Converts plain data to a static chain type.
namespace kte {

namespace detail {

/// The origin of a value, for messages.
struct record_place {
  std::string text;
  [[noreturn]] void fail(const std::string& why) const { throw bad_file("kte: " + text + ": " + why); }
};

/// Stores numbers in a parameter. Its typed constants must equal the corresponding numbers.
class number_reader {
 public:
  number_reader(std::span<const double> values, const record_place& place) : values_(values), place_(place) {}

  template <int N>
  void operator()(constant<N>&) {
    const double x = next();
    if (x != N) place_.fail("holds " + number(x) + ", but the static chain has " + std::to_string(N) + " by its type");
  }
  void operator()(bool& x) {
    if (!(x = next() == 1)) place_.fail("must be 1 where it is given");
  }
  template <variable T>
  void operator()(T& x) {
    x = T(next());
  }
  template <std::size_t N>
  void operator()(std::array<double, N>& list) {
    for (double& x : list) x = next();
  }
  void operator()(std::vector<double>& list) {
    list.assign(values_.begin(), values_.end());
    values_ = {};
  }
  template <class X, class Y, class Z>
  void operator()(vec3<X, Y, Z>& v) {
    (*this)(v.x), (*this)(v.y), (*this)(v.z);
  }
  template <class... R>
  void operator()(mat3<R...>& m) {
    (*this)(m.x), (*this)(m.y), (*this)(m.z);
  }
  template <class... T>
  void operator()(sym3<T...>& m) {
    (*this)(m.xx), (*this)(m.xy), (*this)(m.xz), (*this)(m.yy), (*this)(m.yz), (*this)(m.zz);
  }
  void operator()(no_rotation&) {
    auto m = matrix(no_rotation{});
    (*this)(m);
  }
  template <class C, class S>
  void operator()(rotation_2D<C, S>& r) {
    const auto m = dense_matrix();
    if (m != as<double>(matrix(rotation_2D{m.x.x, m.y.x}))) place_.fail("holds a rotation out of the plane");
    number_reader({&m.x.x, 1}, place_)(r.cos);
    number_reader({&m.y.x, 1}, place_)(r.sin);
  }
  template <class S>
  void operator()(unit_quaternion<S>& q) {
    q = as<S>(to_quaternion(dense_matrix()));
  }
  /// Throws unless all numbers have been used.
  void finish() const {
    if (!values_.empty()) place_.fail("holds " + std::to_string(values_.size()) + " numbers too many");
  }

 private:
  double next() {
    if (values_.empty()) place_.fail("holds too few numbers");
    const double x = values_.front();
    values_ = values_.subspan(1);
    return x;
  }
  mat3<vec3<>> dense_matrix() {
    mat3<vec3<>> m{};
    (*this)(m);
    return m;
  }
  std::span<const double> values_;
  const record_place& place_;
};

template <class Core, class... Keys>
void assign(element<Core, Keys...>& e, const element_record& r, std::size_t number) {
  const std::string which = "element " + std::to_string(number) + " (" + r.type + ")";
  const record_place at{to_string(r.place) + which};
  const auto own = record_of(e.core, std::array<std::string_view, sizeof...(Keys)>{Keys::name...});
  if (r.type != own.type) at.fail("the static chain has a " + own.type + " here");
  if (r.version != own.version)
    at.fail("has version " + std::to_string(r.version) + ", not " + std::to_string(own.version));
  if (r.connections != own.connections) {
    std::string names;
    for (const auto& c : own.connections) names += " " + c.role + " '" + c.name + "'";
    at.fail("is not connected as in the static chain:" + names);
  }
  std::size_t n = 0;
  Core::parameters(e.core, [&](const char* name, auto& value) {
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(value)>, bool>) {
      value = n < r.parameters.size() && r.parameters[n].name == name;
      if (!value) return;
    }
    if (n == r.parameters.size()) at.fail("does not have the parameters of its type");
    const auto& p = r.parameters[n++];
    if (p.name != name) at.fail("has a parameter '" + p.name + "' instead of '" + name + "'");
    const record_place here{to_string(p.place) + which + ", " + name};
    number_reader reader(p.values, here);
    reader(value);
    reader.finish();
  });
  if (n != r.parameters.size()) at.fail("does not have the parameters of its type");
  const std::array<std::string_view, sizeof...(Keys)> names{Keys::name...};
  parameter_check::breach broken;
  const parameter_check where{Core::type, Core::ports, names, broken};
  e.core.check(where);
  const auto text = [&] { return "kte: " + at.text + ": " + where().substr(5); };
  require<bad_parameter>(!broken.rule, text, broken.rule, broken.value);
}

}  // namespace detail

/// A static chain of the type of `like` with the numbers of a record. Elements, connections and typed constants must
/// equal those of the type. Throws `bad_file`, which says what differs, or `bad_parameter`.
template <class Gravity, class... E>
[[nodiscard]] static_chain<Gravity, E...> from_record(const static_chain<Gravity, E...>& like, const model_record& r) {
  auto elements = like.elements();
  if (r.elements.size() != sizeof...(E))
    throw bad_file("kte: the model has " + std::to_string(r.elements.size()) + " elements, the static chain " +
                   std::to_string(sizeof...(E)));
  std::size_t i = 0;
  boost::hana::for_each(elements, [&](auto& e) {
    detail::assign(e, r.elements[i], i + 1);
    ++i;
  });
  Gravity g = like.gravity();
  const detail::record_place place{"gravity"};
  detail::number_reader reader(r.gravity, place);
  reader(g);
  reader.finish();
  detail::check_gravity(g);
  return {elements, g};
}

}  // namespace kte
