#include "sweep_columns.hpp"

#include <kte/io/model_inputs.hpp>
#include <kte/runtime_chain/layout.hpp>

#include <algorithm>

#include "arrays.hpp"

namespace kte_python {

namespace {

Eigen::Index place_in(const std::vector<std::string>& names, std::string_view name) {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : at - names.begin();
}
/// Columns of tables have no blanks: `_` may stand for those in a name of the chain.
std::string with_blanks(const kte::runtime_chain& c, const std::string& column, const std::string& third) {
  std::string found = column;
  c.for_each_element([&](const kte::kte_element& e) {
    for (const auto& name : e.names()) {
      std::string plain(name);
      std::replace(plain.begin(), plain.end(), ' ', '_');
      if (plain == name) continue;
      for (const std::string& prefix : {std::string(), std::string("q/"), std::string("v/"), third + "/"})
        if (const auto whole = prefix + plain; column == whole || column.starts_with(whole + "/"))
          found = prefix + std::string(name) + column.substr(whole.size());
    }
  });
  return found;
}

}  // namespace

std::vector<std::string> names_of_numbers(const kte::runtime_chain& c, bool of_q) {
  std::vector<std::string> all;
  for (const auto& e : kte::layout(c)) {
    const int n = of_q ? e.nq : e.nv;
    for (int i = 0; i < n; ++i) all.push_back(n == 1 ? e.name : e.name + "/" + std::to_string(i));
  }
  return all;
}

std::vector<std::string> names_of_inputs(const kte::runtime_chain& c) {
  std::vector<std::string> all;
  kte::detail::for_each_input(c, [&](std::string_view name, int u, int n) {
    all.resize(std::max(all.size(), static_cast<std::size_t>(u + n)));
    for (int i = 0; i < n; ++i)
      all[static_cast<std::size_t>(u + i)] = std::string(name) + (n == 1 ? "" : i == 0 ? "/x" : i == 1 ? "/y" : "/z");
  });
  return all;
}
Eigen::VectorXd inputs_from(const kte::runtime_chain& c, py::handle inputs) {
  const auto names = names_of_inputs(c);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(names.size()));
  if (inputs.is_none()) return u;
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(inputs)) {
    const auto name = key.cast<std::string>();
    const auto one = place_in(names, name), three = place_in(names, name + "/x");
    if (one < 0 && three < 0) throw kte::unknown_name("kte: this chain has no input '" + name + "'");
    if (one >= 0)
      u[one] = vector_from(name.c_str(), value, 1)[0];
    else
      u.segment(three, 3) = vector_from(name.c_str(), value, 3);
  }
  return u;
}

sweep_columns::sweep_columns(const kte::runtime_chain& c, const std::vector<std::string>& columns,
                             const std::string& third) {
  const auto of_q = names_of_numbers(c, true), of_v = names_of_numbers(c, false), inputs = names_of_inputs(c);
  for (const auto& column : columns) {
    const auto name = with_blanks(c, column, third);
    const auto after = [&name](const std::string& prefix) { return kte::detail::after_name(name, prefix); };
    target t{what::parameter, -1};
    const auto seek = [&](what of, const std::vector<std::string>& names, std::string_view rest) {
      if (t.index >= 0 || rest.empty()) return;
      if (const auto at = place_in(names, rest); at >= 0) t = {of, at};
    };
    seek(what::q, of_q, after("q")), seek(what::v, of_v, after("v"));
    if (!third.empty()) seek(what::third, of_v, after(third));
    seek(what::input, inputs, name);
    if (t.index < 0) t.index = static_cast<Eigen::Index>(paths_.size()), paths_.push_back(name);
    targets_.push_back(t);
  }
  if (paths_.empty()) return;
  try {
    parameters_.emplace(c, paths_);
  } catch (const kte::unknown_name& e) {
    throw kte::unknown_name(std::string(e.what()) + "; columns may also be q/NAME and v/NAME" +
                            (third.empty() ? "" : " and " + third + "/NAME") + " of coordinates, and inputs");
  }
}

void sweep_columns::put(const std::vector<double>& values, case_numbers& x) const {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const auto [of, index] = targets_[i];
    if (of == what::parameter) continue;
    (of == what::q ? x.q : of == what::v ? x.v : of == what::third ? x.third : x.u)[index] = values[i];
  }
}

std::vector<double> sweep_columns::parameters(const std::vector<double>& values) const {
  std::vector<double> all(paths_.size());
  for (std::size_t i = 0; i < targets_.size(); ++i)
    if (targets_[i].of == what::parameter) all[static_cast<std::size_t>(targets_[i].index)] = values[i];
  return all;
}
std::optional<kte::runtime_chain> sweep_columns::chain_with(const std::vector<double>& values) const {
  if (!parameters_) return {};
  return parameters_->with(parameters(values));
}

}  // namespace kte_python
