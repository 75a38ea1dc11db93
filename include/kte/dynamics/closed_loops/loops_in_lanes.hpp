#pragma once

#include <kte/dynamics/closed_loops/loop_dynamics.hpp>
#include <kte/dynamics/closed_loops/qr_in_lanes.hpp>

/// `accelerate_on_loops` for trees with closures in packs S of states in double: recursions over bodies in packs,
/// functions of closures state by state. The independent rows are those of the first state.
namespace kte::detail {

template <class S>
class loops_in_lanes {
  static constexpr std::size_t lanes = std::size_t{S::lanes};

 public:
  std::shared_ptr<const char> layout;

  loops_in_lanes(const chain_constraints& c, const basic_runtime_state<S>& s)
      : layout(c.layout()), places_(c, s), acceleration_(static_cast<std::size_t>(places_.rows)) {
    for (auto& x : gap_) x = 0;
  }
  /// Subtracts the change by the closures from the rates u D^-1 of axes, and from the forces on coordinates that move
  /// no joint (`loop_factor::subtract_change`); call `articulate_under` first. Returns false if the independent rows of
  /// the states differ; raises `bad_argument` for loops that are not assembled.
  bool subtract_change(const chain_constraints& c, basic_runtime_state<S>& s) {
    take_roots(s);
    std::fill(std::begin(gap_), std::end(gap_), 0.0);
    rates_.assign(root_.size(), S(0));
    bool agree = true;
    for (const auto& b : places_.blocks) agree &= solve(c, s, b);
    refuse_unassembled(c);
    if (!agree) return false;
    for (std::size_t k = 0; k < rates_.size(); ++k) {
      const int axis = places_.axis_of_place[k], row = places_.row_of_place[k];
      const S rate = rates_[k] * root_[k];
      if (axis >= 0)
        s.work.factors[static_cast<std::size_t>(axis)].rate -= rate;
      else
        s.work.forces[row] -= s.tree().own_mass[static_cast<std::size_t>(row)] * rate;
    }
    return true;
  }

 private:
  void refuse_unassembled(const chain_constraints& c) const {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!(gap_[lane] > unassembled_above)) [[likely]]
        continue;
      const auto& x = places_.closure_of_row(widest_[lane]);
      const bool linear = widest_[lane] - x.first < x.rows.linear;
      raise<bad_argument>("kte: forward_dynamics: '" + c.loop_name(x.loop) + "' is open by " +
                          number(gap_[lane] / places_.scale(x, widest_[lane] - x.first)) + (linear ? " m" : " rad") +
                          assemble_first);
    }
  }
  void note_gap(std::size_t lane, int row, double gap) {
    if (gap > gap_[lane]) gap_[lane] = gap, widest_[lane] = row;
  }
  /// D^-1/2 by place.
  void take_roots(const basic_runtime_state<S>& s) {
    root_.resize(places_.row_of_place.size());
    for (std::size_t k = 0; k < root_.size(); ++k) {
      const int axis = places_.axis_of_place[k];
      root_[k] = axis >= 0 ? sqrt(s.work.factors[static_cast<std::size_t>(axis)].inverse)
                           : S(1 / sqrt(s.tree().own_mass[static_cast<std::size_t>(places_.row_of_place[k])]));
    }
  }
  bool solve(const chain_constraints& c, basic_runtime_state<S>& s, const loop_block& b) {
    const auto rows = static_cast<std::size_t>(b.rows), columns = b.places.size();
    all_.resize(columns, rows);
    std::size_t first = 0;
    for (const int k : b.closures) {
      const auto& x = places_.closures[static_cast<std::size_t>(k)];
      x.of_frames() ? close_frames(c, s, x, first) : close_coordinates(c, s, x, first);
      first += static_cast<std::size_t>(x.rows.count());
    }
    S most(0), least, zero;
    for (const int place : b.places) most = max(most, root_[static_cast<std::size_t>(place)]);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      least.set(lane, gap_[lane] < 1e-8 ? (std::max)(least_pivot, 100 * gap_[lane]) : least_pivot);
    zero = 1e-13 * most * (std::min)(1.0, 1 / places_.length);
    choose(rows, columns, least[0], zero[0]);
    if (!factorize(rows, columns, least, zero)) return false;
    const std::size_t rank = first_.chosen.size();
    chosen_.resize(rank), half_.resize(columns);
    for (std::size_t k = 0; k < rank; ++k)
      chosen_[k] = acceleration_[static_cast<std::size_t>(places_.row_of(b, first_.chosen[k]))];
    qr_.least(chosen_.data(), half_.data());
    for (std::size_t k = 0; k < columns; ++k) rates_[static_cast<std::size_t>(b.places[k])] = half_[k];
    return true;
  }
  /// Selects the independent rows of the first state.
  void choose(std::size_t rows, std::size_t columns, double least, double zero) {
    auto m = first_.matrix(static_cast<Eigen::Index>(columns), static_cast<Eigen::Index>(rows));
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i)
        m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = all_.column(j)[i][0];
    first_.choose(least, zero);
  }
  /// Factorizes with these rows first and the others after them. Returns false if they are not clearly the independent
  /// rows of all states.
  bool factorize(std::size_t rows, std::size_t columns, const S& least, const S& zero) {
    const std::size_t rank = first_.chosen.size();
    qr_.resize(columns, rows);
    is_chosen_.assign(rows, 0);
    std::size_t to = 0;
    const auto take = [&](std::size_t j) { std::copy_n(all_.column(j), columns, qr_.column(to++)); };
    for (const int j : first_.chosen) take(static_cast<std::size_t>(j)), is_chosen_[static_cast<std::size_t>(j)] = 1;
    for (std::size_t j = 0; j < rows; ++j)
      if (!is_chosen_[j]) take(j);
    qr_.factorize(rank);
    S largest(0);
    for (std::size_t k = 0; k < rank; ++k) largest = max(largest, qr_.pivot(k));
    const S smallest = (std::max)(0.01 * first_.smallest / (std::max)(first_.largest, 1e-300), 0.0) * largest;
    bool agree = true;
    for (std::size_t k = 0; k < rank; ++k)
      agree &= all(qr_.pivot(k) > least * largest) && all(qr_.pivot(k) > zero) && all(qr_.pivot(k) >= smallest);
    for (std::size_t j = rank; j < rows && agree; ++j) agree &= all(qr_.left(j) <= max(S(least * largest), zero));
    return agree;
  }
  /// Computes residuals, accelerations and L^-T J^T of a closure of frames, for its rows from `first` on.
  void close_frames(const chain_constraints& c, basic_runtime_state<S>& s, const closure_place& x, std::size_t first) {
    const closing_motion<S> m = loop_equations::biased_motion_between(s, x);
    const int count = x.rows.count();
    S units[6][6];
    closing_motion<double> motions[lanes];
    double rows[lanes * all_rows_of_closing];
    for (std::size_t lane = 0; lane < lanes; ++lane) motions[lane] = lane_of(m, lane);
    c.element(x.element).close_frames(motions, rows);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double *g = rows + lane * all_rows_of_closing, *accelerations = g + closing_stride,
                   *wrenches = accelerations + closing_stride;
      for (int r = 0; r < count; ++r) {
        const double scale = places_.scale(x, r);
        note_gap(lane, x.first + r, std::abs(scale * g[r]));
        acceleration_[static_cast<std::size_t>(x.first + r)].set(lane, scale * accelerations[r]);
        for (int i = 0; i < 6; ++i) units[r][i].set(lane, scale * wrenches[i * closing_stride + r]);
      }
    }
    for (int r = 0; r < count; ++r) {
      const load on2{{units[r][0], units[r][1], units[r][2]}, {units[r][3], units[r][4], units[r][5]}};
      tree::load_powers<S> sum;
      loop_equations::send_load<true>(
          s, x, m, on2, loads_, [&](int axis, const S& e) { put(axis, e, first + static_cast<std::size_t>(r)); }, sum);
      acceleration_[static_cast<std::size_t>(x.first + r)] += sum.sum;
    }
  }
  void close_coordinates(const chain_constraints& c, basic_runtime_state<S>& s, const closure_place& x,
                         std::size_t first) {
    S by[4]{};
    S& acceleration = acceleration_[static_cast<std::size_t>(x.first)];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      double q[4]{}, v[4]{}, gradient[4]{};
      for (std::size_t n = 0; n < x.coordinates.size(); ++n) {
        const auto& at = s.template get<kind::gen>(x.coordinates[n]);
        q[n] = at.q[lane], v[n] = at.q_dot[lane];
      }
      const auto [g, curvature] = c.element(x.element).lane(lane).close_coordinates(q, v, gradient);
      note_gap(lane, x.first, std::abs(g));
      acceleration.set(lane, curvature);
      for (std::size_t n = 0; n < x.coordinates.size(); ++n) by[n].set(lane, gradient[n]);
    }
    loads_.assign(x.way.nodes.size(), load{}), forces_.assign(tree::most_axes * x.way.nodes.size(), S(0));
    for (std::size_t n = 0; n < x.dofs.size(); ++n) {
      const auto place = static_cast<std::size_t>(places_.place_of_row[static_cast<std::size_t>(x.dofs[n])]);
      if (x.enters[n] >= 0) {
        forces_[tree::most_axes * static_cast<std::size_t>(x.enters[n]) + static_cast<std::size_t>(x.axes[n])] += by[n];
        continue;
      }
      all_.column(first)[places_.column_of_place[place]] += root_[place] * by[n];
      acceleration += by[n] * s.work.forces[x.dofs[n]] / s.tree().own_mass[static_cast<std::size_t>(x.dofs[n])];
    }
    tree::load_powers<S> sum;
    tree::send_to_bases(
        s.tree().body_tree, s.work, x.way, loads_.data(), forces_.data(),
        [&](int axis, const S& e) { put(axis, e, first); }, sum);
    acceleration += sum.sum;
  }
  /// The effect e on an axis, in row `row` of the block.
  void put(int axis, const S& e, std::size_t row) {
    const auto place = static_cast<std::size_t>(places_.place_of_axis[static_cast<std::size_t>(axis)]);
    all_.column(row)[places_.column_of_place[place]] += root_[place] * e;
  }

  using load = tree::simd_wrench<S>;
  closure_places places_;
  double gap_[lanes];            ///< the largest residual of each state
  int widest_[lanes]{};          ///< and its row
  std::vector<S> acceleration_;  ///< of all rows
  std::vector<S> root_, rates_;  ///< by place
  qr_in_lanes<S> all_, qr_;      ///< of a block: all rows; independent rows first
  pivoted_qr first_;             ///< of the first state
  std::vector<char> is_chosen_;
  std::vector<S> chosen_, half_, forces_;
  std::vector<load> loads_;
};

/// Forward dynamics of a tree with closures in packs. Returns false if states differ in their independent rows.
template <class S>
bool accelerate_on_loops_in_lanes(const runtime_chain& c, basic_runtime_state<S>& s, const tree::given_forces<S>& tau) {
  const auto make = [&] { return loops_in_lanes<S>(closures_of(c), s); };
  auto& loops = s.loops.template get<loops_in_lanes<S>>(make);
  if (loops.layout != c.wiring().layout) loops = make();
  const auto biases = articulate_under(runtime_elements{c}, s, tau, {});
  if (!loops.subtract_change(closures_of(c), s)) return false;
  accelerate_after(s, biases);
  return true;
}
/// Under the forces `kept` in the working memory. Throws `no_solution` if states differ in their independent rows.
template <class S>
const runtime_vector<S>& accelerations_on_loops_of_packs(const runtime_chain& c, basic_runtime_state<S>& s) {
  if (!s.tree().plan.tree)
    throw bad_argument("kte: forward dynamics in packs of chains with closures: joints must not share coordinates");
  check_loops(closures_of(c), s);
  if (!accelerate_on_loops_in_lanes(c, s, tree::given_forces<S>(s.work.kept.data())))
    throw no_solution("kte: these states differ in the independent rows of their closures");
  check_result(s, [&s] { diagnose("an acceleration", s); });
  return s.work.forces;
}
/// Makes `forward_dynamics` on packs S available for chains with closures.
template <class S>
void enable_loops_in_lanes() {
  if constexpr (has_lanes_of_double<S>) {
    static const bool done = (accelerations_on_loops_in_lanes<S> = &accelerations_on_loops_of_packs<S>, true);
    (void)done;
  }
}

}  // namespace kte::detail
