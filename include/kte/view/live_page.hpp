#pragma once

#include <kte/view/live_server.hpp>
#include <kte/view/pull.hpp>
#include <kte/view/scene_of.hpp>

/// A page that shows a simulation while it runs (docs/view.md). Needs the library kte::live.
namespace kte {

namespace detail {
/// A scene with one row, whose rows are sent to a page.
template <class Chain>
class live_rows : public scene_recording<Chain> {
  using base = scene_recording<Chain>;

 public:
  live_rows(const Chain& chain, const std::vector<std::string>& more)
      : base(chain, {.name = "live", .columns = names(chain, more)}) {
    auto s = first_state(chain);
    chain_in(chain).doMotion(s);
    base::row(0.0, s);
  }
  template <class State>
  const scene_row& read(const State& s) {
    return base::numbers_of(s);
  }

 private:
  /// The names of the columns: q and v of coordinates, and more.
  static std::vector<std::string> names(const Chain& chain, const std::vector<std::string>& more) {
    std::vector<std::string> all;
    for (const auto& e : layout(chain_in(chain)))
      for (const char* const part : {"", "/v"}) all.push_back("coordinate:" + std::string(e.name) + part);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};
}  // namespace detail

/// Shows a mechanism in the browser while the program simulates it:
///
///   kte::live_page page(arm, {.title = "Our arm"});
///   page.slider("torque", -5, 5, 0, "N m");
///   std::printf("%s\n", page.url().c_str());
///   while (page.wait(solver.time())) {
///     if (page.reset()) solver.restart(0.0, x0);
///     model.input(motor) = page.value("torque");
///     solver.integrate(solver.time() + 0.01);
///     page.show(solver.time(), model.state_at(solver.time(), solver.state()));
///   }
///
/// For static chains, runtime chains and robots; `show` is called in one thread.
template <drawable Chain>
class live_page : public live_server {
 public:
  /// A page of a chain or robot. Throws `unknown_name` for a column that the chain does not have, `bad_argument` for a
  /// port that is not available.
  explicit live_page(const Chain& chain, const live_options& options = {})
      : live_page(detail::live_rows<Chain>(chain, options.columns), options) {}

  /// Shows the frames of the last `doMotion` of the state, at time t, s. Never waits. Throws `bad_argument` for a state
  /// of another chain.
  template <class T, class State>
  void show(const T& t, const State& s) {
    publish(static_cast<double>(t), rows_.read(s));
  }

 private:
  live_page(detail::live_rows<Chain> rows, const live_options& options)
      : live_server(rows.contents(), options), rows_(std::move(rows)) {}

  detail::live_rows<Chain> rows_;
};

}  // namespace kte
