// expect: error: .*kte: the law of a controlled model sets its inputs at every evaluation: set nothing here
#include <kte/models/controlled.hpp>

#include <array>

struct model {
  using state = Eigen::Matrix<double, 1, 1>;
  using rate = state;
  state positions_of(const state& x) const { return x; }
  state velocities_of(const state& x) const { return x; }
  state internals_of(const state& x) const { return x; }
};
void brake() {
  kte::controlled braked(model{}, [](double, const auto&) { return std::array{0.0}; });
  braked.setInput(std::array{1.0});
}
