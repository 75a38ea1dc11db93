#pragma once

#include <kte/integrators/motion_space.hpp>
#include <kte/kernels/joint_vector.hpp>

#include <functional>
#include <span>
#include <string>
#include <utility>

namespace kte {

namespace detail {
/// The placeholder for laws without their own states.
struct no_rates {};
template <class>
inline constexpr bool never = false;
/// Checks that law_rates of N states has returned N numbers.
template <int N, class Rates>
void check_law_rates(const Rates& c_dot) {
  static_assert(holds<Rates, N>, "kte: the number of rates of a law differs from the number of its states");
  if constexpr (requires { c_dot.size(); })
    if (std::cmp_not_equal(c_dot.size(), N)) [[unlikely]]
      raise<bad_argument>("kte: the rates of a law are " + std::to_string(c_dot.size()) + " numbers, the law has " +
                          std::to_string(N) + " states");
}
/// The numbers of a std::array, or of an Eigen vector of fixed size, as a vector.
template <class S, std::size_t N>
auto column_of(const std::array<S, N>& z) {
  return Eigen::Map<const Eigen::Matrix<S, static_cast<int>(N), 1>>(z.data());
}
template <class V>
const auto& column_of(const Eigen::MatrixBase<V>& z) {
  return z.derived();
}
template <class V>
inline constexpr int size_of_column = [] {
  constexpr int n = std::remove_cvref_t<V>::RowsAtCompileTime;
  static_assert(n != Eigen::Dynamic,
                "kte: the initial states of a law are an std::array or an Eigen vector of fixed size");
  return n;
}();
}  // namespace detail

/// A model whose inputs are set by a control law at every evaluation:
///
///   u = law(t, x)                                   (1)
///   u = law(t, x, c),   c' = law_rates(t, x, c)     (2)
///
///   kte::controlled arm(model, [&](double t, const auto& x) { return torques(t, x); });
///   kte::dormand_prince45 solver(std::ref(arm), 0.0, arm.make_x(q, v));
///
/// `moreau_jean` evaluates the law once a step unless it has the option `implicit_control`.
///
/// x is the state of the model. In (2) the law has states c, such as the integral of a PID controller. They start at
/// c0, a std::array or Eigen vector of fixed size. Integrators then see the state (x, c), with c as the last internal
/// states:
///
///   kte::controlled arm(model, torques, errors, std::array{0.0});
///
/// The law returns one number per input, and its rates one number per state c, as anything with operator[]; otherwise
/// an evaluation throws `bad_argument`.
///
/// `element_events(arm)` are the events of the elements under the law; `settled(arm, t, x)` sets the modes of friction.
///
/// The model is copied; `std::ref(model)` shares it, so that its inputs can be read there. The law sets all inputs at
/// every evaluation; inputs cannot be set in other ways. States are those of the model, also with rotations:
/// `displace`, `pull_back`, `magnitudes`, `rounding` are those of the model. Stiff methods compute its Jacobian by
/// differences.
template <class Model, class Law, class Rates = detail::no_rates, int N = 0>
class controlled {
  using shared = std::remove_reference_t<decltype(detail::unwrapped(std::declval<Model&>()))>;
  static_assert(!std::is_const_v<shared>,
                "kte: a law sets the inputs of its model: pass the model itself, which is copied, or std::ref of one "
                "that is not const");
  using model_type = detail::unwrapped_type<Model>;
  using model_state = typename model_type::state;
  using model_rate = typename model_type::rate;
  static constexpr int longer(int n) { return n == Eigen::Dynamic ? n : n + N; }

 public:
  using S = typename model_state::Scalar;
  using state = Eigen::Matrix<S, longer(model_state::RowsAtCompileTime), 1>;
  using rate = Eigen::Matrix<S, longer(model_rate::RowsAtCompileTime), 1>;
  using law_state = Eigen::Matrix<S, N, 1>;

  controlled(Model m, Law u) requires(N == 0) : model_(std::move(m)), law_(std::move(u)) {}
  template <class C>
  controlled(Model m, Law u, Rates law_rates, const C& c0)
      : model_(std::move(m)),
        law_(std::move(u)),
        law_rates_(std::move(law_rates)),
        start_(detail::column_of(c0).template cast<S>()),
        rate_(rate::Zero(rates())) {}

  shared& model() { return detail::unwrapped(model_); }
  [[nodiscard]] const model_type& model() const { return detail::unwrapped(model_); }
  /// The chain of the model.
  decltype(auto) chain() const { return model().chain(); }
  /// The control law.
  Law& law() { return law_; }
  Rates& law_rates() { return law_rates_; }

  decltype(auto) operator()(const S& t, const state& x) {
    return follow(t, x, [&](const model_state& own) -> decltype(auto) { return model()(t, own); });
  }
  /// x' under the law. Throws what the model throws, and `bad_argument` if the law returns a wrong number of inputs.
  decltype(auto) computeStateRate(const S& t, const state& x) {
    return follow(t, x, [&](const model_state& own) -> decltype(auto) { return model().computeStateRate(t, own); });
  }
  /// A state of the chain at x under the law, with all its frames, accelerations and forces.
  decltype(auto) state_at(const S& t, const state& x) {
    set_inputs(t, x);
    return model().state_at(t, own_part(x));
  }
  /// The output of the model under the law.
  auto computeOutput(const S& t, const state& x) {
    set_inputs(t, x);
    return model().computeOutput(t, own_part(x));
  }
  /// A copy of the model with another output, under the same law.
  template <class F>
  [[nodiscard]] auto with_output(const F& f) const {
    auto m = model().with_output(f);
    using other = controlled<decltype(m), Law, Rates, N>;
    if constexpr (N == 0) {
      return other(std::move(m), law_);
    } else {
      return other(std::move(m), law_, law_rates_, start_);
    }
  }

  /// Evaluates the law and sets the inputs of the model. Throws `bad_argument` for an x of wrong size, like all
  /// functions of x.
  void set_inputs(const S& t, const state& x) {
    check_state(x);
    if constexpr (N == 0) {
      model().setInput(law_(t, x));
    } else {
      const law_state c = x.template tail<N>();
      model().setInput(law_(t, own_part(x), c));
    }
  }
  /// Writes c' of (2) to `to`.
  template <class To>
  void put_law_rates(const S& t, const state& x, To&& to) requires(N > 0) {
    const law_state c = x.template tail<N>();
    const auto& c_dot = law_rates_(t, own_part(x), c);
    detail::check_law_rates<N>(c_dot);
    for (int i = 0; i < N; ++i) to[i] = S(c_dot[static_cast<std::size_t>(i)]);
  }
  /// The inputs of the last evaluation of the law.
  [[nodiscard]] const auto& input() const { return model().input(); }
  template <class T>
  void input(const T&) const {
    static_assert(detail::never<T>,
                  "kte: the law of a controlled model sets its inputs at every evaluation: set nothing here, but let "
                  "the law follow what you want to change");
  }
  /// Deleted by a static_assert: the law sets the inputs.
  template <class U>
  void setInput(const U& u) const {
    input(u);
  }
  /// Deleted: it has no time argument, so that a variational integrator would ignore the law.
  template <class V>
  void forces_at(const V&) const = delete;

  // ---- states: (q, v, z, c)
  /// The size of (x, c).
  [[nodiscard]] int state_size() const { return model().state_size() + N; }
  /// The size of (x', c').
  [[nodiscard]] int rates() const { return model().rates() + N; }
  /// The size of v.
  [[nodiscard]] int velocity_count() const { return model().velocity_count(); }
  /// The number of internal states, including those of the law.
  [[nodiscard]] int internals() const { return model().internals() + N; }
  /// The coordinates of the model, with their positions in q and v.
  [[nodiscard]] auto freedoms() const { return model().freedoms(); }

  /// The state at q and v, with z = 0 or as given, and with the law at its initial state.
  template <class... QVZ>
  [[nodiscard]] state make_x(const QVZ&... qvz) const {
    return with_law(model().make_x(qvz...), start_);
  }
  /// A state x of the model and a state c of the law as one state.
  [[nodiscard]] state with_law(const model_state& x, const law_state& c) const {
    state both(x.size() + N);
    both.head(x.size()) = x;
    both.template tail<N>() = c;
    return both;
  }
  /// The positions q of a state.
  [[nodiscard]] auto positions_of(const state& x) const {
    return check_state(x), x.head(Eigen::fix<size_of<0>>(at_velocities(x)));
  }
  /// The velocities v of a state.
  [[nodiscard]] auto velocities_of(const state& x) const {
    return check_state(x), x.segment(at_velocities(x), Eigen::fix<size_of<1>>(velocity_count()));
  }
  /// The internal states: z of the model, and c.
  [[nodiscard]] auto internals_of(const state& x) const {
    return check_state(x), x.tail(Eigen::fix<longer(size_of<2>)>(internals()));
  }
  /// The part (q, v, z) of the model; valid until the next call.
  [[nodiscard]] const model_state& own_part(const state& x) const {
    if constexpr (N == 0) {
      return x;
    } else {
      return part_ = x.head(Eigen::fix<model_state::RowsAtCompileTime>(static_cast<int>(x.size()) - N));
    }
  }
  /// The states c of the law.
  [[nodiscard]] auto law_states_of(const state& x) const { return check_state(x), x.template tail<N>(); }
  /// The state x of a state of the chain, with c at its start.
  template <class ChainState>
  [[nodiscard]] state getJointStates(const ChainState& s) const {
    return with_law(model().getJointStates(s), start_);
  }
  /// Stores x in a state of the chain.
  template <class ChainState>
  void setJointStates(const state& x, ChainState& s) const {
    model().setJointStates(own_part(x), s);
  }

  // ---- motion on the group, by the model
  static constexpr bool on_group = moves_on_group<model_type, model_state>;  ///< whether there are rotations
  void displace(const state& x, const rate& d, state& out) const requires(on_group) {
    out.resize(x.size());
    model().displace(own_part(x), own_rate(d), moved_);
    out.head(moved_.size()) = moved_;
    out.template tail<N>() = x.template tail<N>() + d.template tail<N>();
  }
  void pull_back(const rate& d, rate& r) const requires(on_group) {
    changed_ = r.head(own_rate(d).size());
    model().pull_back(rate_part_, changed_);
    r.head(changed_.size()) = changed_;
  }
  void magnitudes(const state& x, rate& m) const requires(on_group) {
    changed_.resize(model().rates());
    model().magnitudes(own_part(x), changed_);
    m.head(changed_.size()) = changed_;
    m.template tail<N>() = x.template tail<N>();
  }
  void rounding(const state& x, const rate& d, const state& out, rate& rest) const requires(on_group) {
    changed_.resize(model().rates());
    moved_ = out.head(own_part(x).size());
    model().rounding(own_part(x), own_rate(d), moved_, changed_);
    rest.head(changed_.size()) = changed_;
    rest.template tail<N>() = d.template tail<N>() - (out.template tail<N>() - x.template tail<N>());
  }

  /// Whether the model has closed loops, whose states integrators project onto the constraints.
  static constexpr bool settles = detail::settles_states<model_type, model_state>;
  /// Whether the chain of the model has closures of loops.
  [[nodiscard]] bool has_loops() const requires(settles) { return model().has_loops(); }
  /// The number of rigid contacts.
  [[nodiscard]] int contacts() const requires(settles) { return model().contacts(); }
  /// The time of the next calls of `begin_step` and `settle`.
  void settle_at(const S& t) const requires(settles) {
    if constexpr (requires { model().settle_at(t); }) model().settle_at(t);
  }
  /// Called at the start of a step from x.
  void begin_step(const state& x) const requires(settles) { model().begin_step(own_part(x)); }
  /// Projects the state `out` = x (+) d onto the constraints.
  void settle(const state& x, rate& d, state& out) const requires(settles) {
    changed_ = own_rate(d);
    moved_ = out.head(own_part(x).size());
    model().settle(own_part(x), changed_, moved_);
    d.head(changed_.size()) = changed_, out.head(moved_.size()) = moved_;
  }
  /// Throws where a step of another length should end elsewhere than at `next`.
  void check_end(const state& x, const state& next) const requires(settles) {
    model().check_end(own_part(x), own_part(next));
  }
  /// The relative distance of x, where a step begins, from singular configurations of the loops.
  [[nodiscard]] double singular_distance(const state& x) const requires(settles) {
    return model().singular_distance(own_part(x));
  }
  /// Removes from e the part normal to the constraints at x.
  void tangential(const state& x, rate& e) const requires(settles) {
    changed_ = own_rate(e);
    model().tangential(own_part(x), changed_);
    e.head(changed_.size()) = changed_;
  }

 private:
  /// The sizes of q, v and z of the model.
  template <int Part>
  static constexpr int size_of = [] {
    using m = const model_type&;
    using x = const model_state&;
    if constexpr (Part == 0) return decltype(std::declval<m>().positions_of(std::declval<x>()))::RowsAtCompileTime;
    if constexpr (Part == 1) return decltype(std::declval<m>().velocities_of(std::declval<x>()))::RowsAtCompileTime;
    if constexpr (Part == 2) return decltype(std::declval<m>().internals_of(std::declval<x>()))::RowsAtCompileTime;
  }();

  template <class V>
  static V blank() {
    return V::Zero(V::RowsAtCompileTime == Eigen::Dynamic ? 0 : V::RowsAtCompileTime);
  }
  void check_state(const state& x) const {
    if constexpr (state::RowsAtCompileTime == Eigen::Dynamic)
      check_size(static_cast<std::size_t>(state_size()), x, "x", "numbers of a state");
  }
  int at_velocities(const state& x) const { return static_cast<int>(x.size()) - velocity_count() - internals(); }
  const model_rate& own_rate(const rate& d) const {
    return rate_part_ = d.head(Eigen::fix<model_rate::RowsAtCompileTime>(model().rates()));
  }

  template <class Evaluate>
  decltype(auto) follow(const S& t, const state& x, const Evaluate& evaluate) {
    set_inputs(t, x);
    if constexpr (N == 0) {
      return evaluate(x);
    } else {
      rate_.head(rate_.size() - N) = evaluate(own_part(x));
      put_law_rates(t, x, rate_.template tail<N>());
      return (static_cast<const rate&>(rate_));
    }
  }

  Model model_;
  Law law_;
  [[no_unique_address]] Rates law_rates_{};
  law_state start_;
  rate rate_ = blank<rate>();
  // Working memory.
  mutable model_state part_ = blank<model_state>(), moved_ = part_;
  mutable model_rate rate_part_ = blank<model_rate>(), changed_ = rate_part_;
};
template <class Model, class Law>
controlled(Model, Law) -> controlled<Model, Law>;
template <class Model, class Law, class Rates, class C>
controlled(Model, Law, Rates, const C& c0)
    -> controlled<Model, Law, Rates, detail::size_of_column<decltype(detail::column_of(c0))>>;

}  // namespace kte
