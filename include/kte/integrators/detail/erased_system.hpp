#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/integrators/motion_space.hpp>

#include <memory>
#include <utility>

namespace kte::detail {

/// A right-hand side for states of dynamic size behind virtual functions. Explicit methods for such states then have
/// one type for all right-hand sides, which kte::compiled contains. A call takes about 5 ns more.
template <bool OnGroup>
class erased_system {
 public:
  using vector = Eigen::VectorXd;
  using rate = vector;

  template <class F>
  requires(!std::is_same_v<F, erased_system>) erased_system(F f)  // NOLINT(google-explicit-constructor)
      : system_(std::make_unique<held<F>>(std::move(f))) {}
  erased_system(const erased_system& x) : system_(x.system_->copy()) {}
  erased_system(erased_system&&) noexcept = default;
  erased_system& operator=(const erased_system& x) { return system_ = x.system_->copy(), *this; }
  erased_system& operator=(erased_system&&) noexcept = default;
  ~erased_system() = default;

  /// Valid until the next call.
  const vector& operator()(double t, const vector& x) const { return system_->rate_at(t, x); }

  // ---- motion on the group
  Eigen::Index rates() const requires OnGroup { return system_->rates(); }
  void displace(const vector& x, const vector& d, vector& out) const requires OnGroup { system_->displace(x, d, out); }
  void pull_back(const vector& d, vector& r) const requires OnGroup { system_->pull_back(d, r); }
  void magnitudes(const vector& x, vector& m) const requires OnGroup { system_->magnitudes(x, m); }
  /// Zero if the system does not define it.
  void rounding(const vector& x, const vector& d, const vector& out, vector& rest) const requires OnGroup {
    system_->rounding(x, d, out, rest);
  }
  /// Does nothing if the system does not define it.
  void settle_at(double t) const requires OnGroup { system_->settle_at(t); }
  void begin_step(const vector& x) const requires OnGroup { system_->begin_step(x); }
  void settle(const vector& x, vector& d, vector& out) const requires OnGroup { system_->settle(x, d, out); }
  void tangential(const vector& x, vector& e) const requires OnGroup { system_->tangential(x, e); }
  void check_end(const vector& x, const vector& next) const requires OnGroup { system_->check_end(x, next); }

 private:
  struct callable {
    virtual ~callable() = default;
    virtual std::unique_ptr<callable> copy() const = 0;
    virtual const vector& rate_at(double t, const vector& x) = 0;
    virtual Eigen::Index rates() const = 0;
    virtual void displace(const vector& x, const vector& d, vector& out) const = 0;
    virtual void pull_back(const vector& d, vector& r) const = 0;
    virtual void magnitudes(const vector& x, vector& m) const = 0;
    virtual void rounding(const vector& x, const vector& d, const vector& out, vector& rest) const = 0;
    virtual void settle_at(double t) const = 0;
    virtual void begin_step(const vector& x) const = 0;
    virtual void settle(const vector& x, vector& d, vector& out) const = 0;
    virtual void tangential(const vector& x, vector& e) const = 0;
    virtual void check_end(const vector& x, const vector& next) const = 0;
  };
  template <class F>
  class held final : public callable {
   public:
    explicit held(F f) : f_(std::move(f)) {}
    std::unique_ptr<callable> copy() const override { return std::make_unique<held>(f_); }
    const vector& rate_at(double t, const vector& x) override {
      if constexpr (std::is_same_v<decltype(f_(t, x)), const vector&> || std::is_same_v<decltype(f_(t, x)), vector&>) {
        return f_(t, x);
      } else {
        return rate_ = f_(t, x);
      }
    }
    Eigen::Index rates() const override {
      if constexpr (OnGroup) return unwrapped(f_).rates();
      return 0;
    }
    void displace(const vector& x, const vector& d, vector& out) const override {
      if constexpr (OnGroup) unwrapped(f_).displace(x, d, out);
    }
    void pull_back(const vector& d, vector& r) const override {
      if constexpr (OnGroup) unwrapped(f_).pull_back(d, r);
    }
    void magnitudes(const vector& x, vector& m) const override {
      if constexpr (OnGroup) unwrapped(f_).magnitudes(x, m);
    }
    void rounding(const vector& x, const vector& d, const vector& out, vector& rest) const override {
      if constexpr (requires { unwrapped(f_).rounding(x, d, out, rest); }) {
        unwrapped(f_).rounding(x, d, out, rest);
      } else {
        rest.setZero();
      }
    }
    void settle_at(double t) const override {
      if constexpr (requires { unwrapped(f_).settle_at(t); }) unwrapped(f_).settle_at(t);
    }
    void begin_step(const vector& x) const override {
      if constexpr (settles_states<unwrapped_type<const F>, vector>) unwrapped(f_).begin_step(x);
    }
    void settle(const vector& x, vector& d, vector& out) const override {
      if constexpr (settles_states<unwrapped_type<const F>, vector>) unwrapped(f_).settle(x, d, out);
    }
    void check_end(const vector& x, const vector& next) const override {
      if constexpr (requires { unwrapped(f_).check_end(x, next); }) unwrapped(f_).check_end(x, next);
    }
    void tangential(const vector& x, vector& e) const override {
      if constexpr (settles_states<unwrapped_type<const F>, vector>) unwrapped(f_).tangential(x, e);
    }

   private:
    F f_;
    vector rate_;
  };

  std::unique_ptr<callable> system_;
};
/// Whether F is a right-hand side of states X that can be stored as an erased_system.
template <class F, class X>
inline constexpr bool is_erased = false;
template <class F>
requires(std::is_same_v<rate_of<F, Eigen::VectorXd>, Eigen::VectorXd>&& std::is_copy_constructible_v<F> &&
         !settles_vectors<unwrapped_type<F>, Eigen::VectorXd> &&
         std::invocable<F&, const double&,
                        const Eigen::VectorXd&>) inline constexpr bool is_erased<F, Eigen::VectorXd> = true;

/// The type in which explicit methods store a right-hand side F of states X.
template <class F, class X>
struct kept_system {
  using type = F;
};
template <class F, class X>
requires is_erased<F, X>
struct kept_system<F, X> {
  using type = erased_system<moves_on_group<unwrapped_type<F>, X>>;
};
template <class F, class X>
using system_of = typename kept_system<F, X>::type;

}  // namespace kte::detail
