#pragma once

#include <kte/events/events.hpp>
#include <kte/integrators/detail/lane_view.hpp>
#include <kte/sweep/detail/sweep_rows.hpp>
#include <kte/sweep/sweep_case.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace kte {
template <class X>
struct simulation_end;
}

namespace kte::detail {

/// The list in what a function of events returns: the list, or a pair whose second part is the list.
template <class E>
auto& list_of_events(E& events) {
  if constexpr (requires { events.settings; }) {
    return events;
  } else {
    return events.second;
  }
}

/// The result of a case: its kept numbers, or the reason why there are none.
struct lane_result {
  std::vector<double> kept{};
  std::string failure{};
};

/// A simulation of many cases in the lanes of packs P. A lane that ends, or fails, gets the next case. Because the
/// right-hand side of a pack has the parameters of its lanes, it is made again for a new case, with the same parameters
/// in the other lanes. `Simulation`: a `final_state_of`.
template <class P, class Simulation>
class lane_queue {
  static constexpr std::size_t width = std::size_t{P::lanes};
  using solver = decltype(std::declval<const Simulation&>().start(std::declval<const sweep_case<P>&>()));
  using stepper = lane_stepper<solver>;
  using S = typename stepper::S;
  using lane_state = typename stepper::lane_state;
  using view = lane_view<stepper>;
  using one_case = sweep_case<double>;

  /// The events of a lane.
  template <bool HasEvents, class Dummy = void>
  struct watched {
    watched(const Simulation&, const one_case&, view&, const S&) {}
  };
  template <class Dummy>
  struct watched<true, Dummy> {
    decltype(std::declval<const Simulation&>().events(std::declval<const one_case&>())) events;
    using list = std::remove_cvref_t<decltype(list_of_events(events))>;
    event_loop<view, list, no_observer> loop;

    watched(const Simulation& s, const one_case& c, view& v, const S& t_end)
        : events(s.events(c)), loop(v, t_end, list_of_events(events), no_observer{}) {
      loop.start();
    }
  };
  /// A case in a lane.
  struct run {
    std::uint64_t index;
    view solver;
    S t_end;
    std::optional<watched<Simulation::has_events>> events{};

    run(std::uint64_t i, stepper& all, std::size_t lane, const S& t, const lane_state& x, const S& end)
        : index(i), solver(all, lane, t, x), t_end(end) {}
  };

 public:
  lane_queue(const Simulation& simulation, const sweep_cases& cases, std::size_t columns)
      : simulation_(simulation), cases_(cases), columns_(columns) {}

  /// The results of the cases from `begin` to `end`, exclusive.
  std::vector<lane_result> operator()(std::uint64_t begin, std::uint64_t end) {
    results_.assign(static_cast<std::size_t>(end - begin), {});
    first_ = next_ = begin, end_ = end;
    is_alone_ = false;
    work_off();
    is_alone_ = true;
    for (const std::uint64_t i : std::exchange(alone_, {})) {
      next_ = i, end_ = i + 1;
      all_.reset(), solver_.reset();
      work_off();
    }
    return std::move(results_);
  }

 private:
  void work_off() {
    for (auto& x : lanes_) x.reset();
    refill();
    while (open_ > 0) {
      if (!step()) give_up();
      if (idle_ >= 2 * width || open_ == 0) refill();
    }
  }
  lane_result& result(std::uint64_t index) { return results_[static_cast<std::size_t>(index - first_)]; }

  /// Puts the next cases into idle lanes, as far as they can start.
  void refill() {
    idle_ = 0;
    while (next_ < end_ && open_ < width) {
      std::array<std::uint64_t, width> now = index_;
      std::array<bool, width> fresh{};
      for (std::size_t i = 0; i < width; ++i)
        if (!lanes_[i] && next_ < end_) now[i] = next_++, fresh[i] = true;
      for (std::size_t i = 0; i < width; ++i)
        if (!lanes_[i] && !fresh[i]) now[i] = now[first_of(fresh)];
      or_failed(
          [&] {
            start(now, fresh);
            index_ = now;
          },
          now, fresh);
    }
  }
  static std::size_t first_of(const std::array<bool, width>& x) {
    return static_cast<std::size_t>(std::find(x.begin(), x.end(), true) - x.begin());
  }
  void start(const std::array<std::uint64_t, width>& now, const std::array<bool, width>& fresh) {
    std::unique_ptr<solver> made(new solver(simulation_.start(sweep_case<P>(cases_, now))));
    if (!all_) all_.emplace(*made);
    lane_state x;
    const auto& x0 = made->state();
    solver_ = std::move(made);
    for (std::size_t i = 0; i < width; ++i) {
      if (!fresh[i] || (is_alone_ && i > 0)) continue;
      x.resize(x0.size());
      for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = x0[k][i];
      open(i, now[i], solver_->time(), x);
    }
  }
  void open(std::size_t i, std::uint64_t index, const S& t, const lane_state& x) {
    const one_case c(cases_, index, index);
    try {
      auto lane = std::make_unique<run>(index, *all_, i, t, x, static_cast<S>(simulation_.end_time(c)));
      check_finite(lane->t_end, "end time");
      lane->solver.begin(lane->t_end);
      lane->events.emplace(simulation_, c, lane->solver, lane->t_end);
      lane->solver.has_moved();
      all_->place(i, lane->solver.time(), lane->solver.state(), true);
      lanes_[i] = std::move(lane);
      ++open_;
      finish_if_done(i);
    } catch (const std::exception& e) {
      result(index).failure = e.what();
    }
  }
  /// If body() throws, the fresh cases are to be computed alone, or have failed.
  template <class Body>
  void or_failed(const Body& body, const std::array<std::uint64_t, width>& now, const std::array<bool, width>& fresh) {
    try {
      body();
    } catch (const std::exception& e) {
      for (std::size_t i = 0; i < width; ++i)
        if (fresh[i]) put_aside(now[i], e.what());
    } catch (...) {
      for (std::size_t i = 0; i < width; ++i)
        if (fresh[i]) put_aside(now[i], "an exception of unknown type");
    }
  }
  void put_aside(std::uint64_t index, const char* reason) {
    if (is_alone_)
      result(index).failure = reason;
    else
      alone_.push_back(index);
  }
  void close(std::size_t i) {
    all_->leave(i);
    lanes_[i].reset();
    --open_;
  }

  /// A step in all lanes. Returns false if the right-hand side has thrown.
  bool step() {
    std::array<S, width> goal{};
    for (std::size_t i = 0; i < width; ++i) {
      if (!lanes_[i]) continue;
      run& x = *lanes_[i];
      if constexpr (Simulation::has_events) x.events->loop.begin_step();
      if (x.solver.is_placed()) all_->begin(i, x.solver.goal());
      goal[i] = x.solver.goal();
    }
    std::array<bool, width> moved{};
    try {
      auto f = [&](const P& t, const auto& x) -> typename stepper::X { return slope(t, x); };
      all_->advance(f, goal, [&](std::size_t i, const std::exception& e) { fail(i, e.what()); });
    } catch (const std::exception& e) {
      reason_ = e.what();
      return false;
    } catch (...) {
      reason_ = "an exception of unknown type";
      return false;
    }
    for (std::size_t i = 0; i < width; ++i) {
      if (!lanes_[i]) {
        ++idle_;
        continue;
      }
      if (all_->has_stepped(i)) moved[i] = arrive(i);
    }
    all_->commit(moved);
    for (std::size_t i = 0; i < width; ++i)
      if (lanes_[i]) finish_if_done(i);
    return true;
  }
  /// The slopes; alone, NaN where they cannot be computed, which shorter steps may avoid.
  typename stepper::X slope(const P& t, const typename stepper::X& x) {
    auto& f = right_hand_side::of(*solver_);
    if (!is_alone_) return f(t, x);
    try {
      return f(t, x);
    } catch (const bad_argument& e) {
      reason_ = e.what();
    } catch (const singular_mass_matrix& e) {
      reason_ = e.what();
    }
    return stepper::X::Constant(x.size(), P(std::numeric_limits<S>::quiet_NaN()));
  }
  /// A lane has made a step. Returns whether it goes on from its end.
  bool arrive(std::size_t i) {
    run& x = *lanes_[i];
    x.solver.take_step();
    if constexpr (Simulation::has_events) {
      try {
        x.events->loop.after_step();
      } catch (const std::exception& e) {
        fail(i, e.what());
        return false;
      }
      if (x.solver.has_moved()) {
        all_->place(i, x.solver.time(), x.solver.state(), false);
        return false;
      }
    }
    return true;
  }
  void finish_if_done(std::size_t i) {
    run& x = *lanes_[i];
    simulation_end<lane_state> end;
    if constexpr (Simulation::has_events) {
      if (x.events->loop.goes_on()) return;
      const auto& report = x.events->loop.report();
      end.events = report.count, end.reason = report.reason, end.stopped_by = report.stopped_by_name;
    } else {
      if (x.solver.time() != x.t_end) return;
    }
    end.time = x.solver.time(), end.state = x.solver.state();
    lane_result& r = result(x.index);
    try {
      const auto& kept = simulation_.kept(end);
      for (decltype(kept.size()) k = 0; k < kept.size(); ++k) r.kept.push_back(static_cast<double>(kept[k]));
      if (r.kept.size() != columns_) check_kept_size(r.kept.size(), columns_);
    } catch (const std::exception& e) {
      r.failure = e.what();
    }
    close(i);
  }
  void fail(std::size_t i, std::string why) {
    if (is_alone_ && !reason_.empty()) why += ": " + reason_;
    result(lanes_[i]->index).failure = std::move(why);
    close(i);
  }
  /// The cases in flight are to be computed alone, or have failed.
  void give_up() {
    for (std::size_t i = 0; i < width; ++i)
      if (lanes_[i]) {
        put_aside(lanes_[i]->index, reason_.c_str());
        close(i);
      }
  }

  const Simulation& simulation_;
  const sweep_cases& cases_;
  std::size_t columns_;
  std::unique_ptr<solver> solver_;
  std::optional<stepper> all_;
  std::array<std::unique_ptr<run>, width> lanes_{};
  std::array<std::uint64_t, width> index_{};
  std::size_t open_ = 0, idle_ = 0;  ///< lanes with a case; steps of lanes without one since the last refill
  std::uint64_t first_ = 0, next_ = 0, end_ = 0;
  bool is_alone_ = false;
  std::string reason_;
  std::vector<std::uint64_t> alone_;
  std::vector<lane_result> results_;
};

}  // namespace kte::detail
