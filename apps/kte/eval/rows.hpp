#pragma once

#include <kte/io/program.hpp>

#include <cstdio>
#include <limits>
#include <sstream>
#include <type_traits>

#include "eval/columns.hpp"
#include "eval/options.hpp"

namespace evaluate {

/// The table that is printed: names come with the numbers of the first row.
template <class S>
class output {
 public:
  explicit output(int digits) { number_ << std::scientific, number_.precision(digits - 1); }

  void put(const std::string& name, const S& x) {
    if (!has_names_) names_.append(names_.empty() ? "" : ",").append(cell(name));
    if (!row_.empty()) row_ += ',';
    if constexpr (std::is_same_v<S, double>) {
      char digits[40];
      row_.append(digits, static_cast<std::size_t>(std::snprintf(digits, sizeof digits, "%.17g", x)));
    } else {
      number_.str({});
      number_ << x;
      row_ += number_.str();
    }
  }
  void end_row(bool keep = true) {
    if (keep) rows_ += row_ + '\n';
    row_.clear(), has_names_ = true;
  }
  std::string text() const { return names_ + '\n' + rows_; }

 private:
  /// In quotes, with its quotes doubled, where it has commas or quotes.
  static std::string cell(const std::string& name) {
    if (name.find_first_of(",\"\n") == name.npos) return name;
    std::string s = "\"";
    for (const char c : name) s.append(c == '"' ? 2 : 1, c);
    return s + '"';
  }

  std::ostringstream number_;
  std::string names_, row_, rows_;
  bool has_names_ = false;
};

/// Prints the results for each state, by a model of a robot (runtime_model.hpp, static_model.hpp).
template <class Model>
class row_writer {
  using S = typename Model::scalar;
  using vector = std::vector<S>;

 public:
  row_writer(Model& model, const state_table& table, const std::vector<std::string>& coordinates, const options& o)
      : model_(model),
        table_(table),
        order_(model.layout(), coordinates),
        ops_(operations::of(o.ops, o.derivatives)),
        columns_(table, order_, ops_.asked && (ops_.id || ops_.did), ops_.asked && (ops_.fd || ops_.dfd)),
        out_(o.digits) {
    if (o.loops) ops_.id = false;
  }

  /// All rows, or nothing: throws with the line of the state at fault.
  std::string text() {
    say_what_is_left_out();
    if (table_.rows() == 0) {  // for the names
      vector q(order_.q.size()), v(order_.v.size());
      for (const auto& e : model_.layout())
        if (e.nq > e.nv) q[static_cast<std::size_t>(e.q + e.nq - 4)] = S(1);  // w of a quaternion
      row(q, v, v, v);
      out_.end_row(false);
    }
    for (std::size_t i = 0; i < table_.rows(); ++i) {
      try {
        row(columns_.q<S>(i), columns_.v<S>(i), columns_.a<S>(i), columns_.tau<S>(i));
      } catch (const kte::error& e) {
        throw kte::bad_file("kte: " + table_.place(i) + std::string(e.what()).substr(5));
      }
      out_.end_row();
    }
    return out_.text();
  }

 private:
  void say_what_is_left_out() const {
    if (ops_.asked) return;
    if (!columns_.has_a()) std::fprintf(stderr, "kte: no columns a_0 ..., so inverse dynamics is left out\n");
    if (!columns_.has_tau()) std::fprintf(stderr, "kte: no columns tau_0 ..., so forward dynamics is left out\n");
  }
  static std::string index(std::size_t i) { return "_" + std::to_string(i); }
  template <class X>
  void put_vector(const std::string& name, const X& x) {
    for (std::size_t i = 0; i < order_.v.size(); ++i) out_.put(name + index(i), x[order_.v[i]]);
  }
  template <class M>
  void put_matrix(const std::string& name, const M& m, bool upper = false) {
    for (std::size_t i = 0; i < order_.v.size(); ++i)
      for (std::size_t j = upper ? i : 0; j < order_.v.size(); ++j)
        out_.put(name + index(i) + index(j), m(order_.v[i], order_.v[j]));
  }
  void row(const vector& q, const vector& v, const vector& a, const vector& tau) {
    const vector rest(v.size(), S(0));
    if (ops_.id && columns_.has_a()) put_vector("id", model_.inverse_dynamics(q, v, a));
    if (ops_.fd && columns_.has_tau()) put_vector("fd", model_.forward_dynamics(q, v, tau));
    if (ops_.m) put_matrix("M", model_.mass_matrix(q), true);
    if (ops_.g) put_vector("g", model_.inverse_dynamics(q, rest, rest));
    if (ops_.h) put_vector("h", model_.inverse_dynamics(q, v, rest));
    if (ops_.energy) {
      const auto energy = model_.energy(q, v);
      out_.put("kinetic", energy.kinetic), out_.put("potential", energy.potential);
    }
    if (ops_.com) {
      const auto com = model_.centre_of_mass(q).position;
      out_.put("com_x", com.x), out_.put("com_y", com.y), out_.put("com_z", com.z);
    }
    model_.for_each_frame(q, [this](const std::string& name, const auto& pose, const auto& jacobian) {
      const auto& [R, p] = pose;
      out_.put(name + "_x", p.x), out_.put(name + "_y", p.y), out_.put(name + "_z", p.z);
      std::size_t i = 0;
      for (const auto& r : {R.x, R.y, R.z}) {
        const std::string line = name + "_R" + index(i++);
        out_.put(line + "_0", r.x), out_.put(line + "_1", r.y), out_.put(line + "_2", r.z);
      }
      for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t j = 0; j < order_.v.size(); ++j)
          out_.put(name + "_J" + index(k) + index(j), jacobian(static_cast<int>(k), order_.v[j]));
    });
    if (ops_.did && columns_.has_a()) {
      const auto& d = model_.inverse_derivatives(q, v, a);
      put_matrix("did_dq", d.by_q), put_matrix("did_dv", d.by_v);
    }
    if (ops_.dfd && columns_.has_tau()) {
      const auto& d = model_.forward_derivatives(q, v, tau);
      put_matrix("dfd_dq", d.by_q), put_matrix("dfd_dv", d.by_v);
    }
  }

  Model& model_;
  const state_table& table_;
  column_order order_;
  operations ops_;
  state_columns columns_;
  output<S> out_;
};

/// The table of a model. Nothing is printed but at the end, all at once.
template <class Model>
void print_rows(Model& model, const state_table& table, const std::vector<std::string>& coordinates, const options& o) {
  kte::detail::write_standard_output(row_writer<Model>(model, table, coordinates, o).text());
}

}  // namespace evaluate
