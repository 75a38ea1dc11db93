#pragma once

#include <kte/integrators/integrator.hpp>
#include <kte/integrators/tolerances.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Which integrator gets how close for what time, on problems whose solution is known.
namespace work_precision {

/// The errors of the final state of an integration; NaN for errors that a problem does not have.
struct judgement {
  double error;     ///< distance from the reference, in the measure of the problem
  double energy;    ///< that was gained, J
  double momentum;  ///< that was gained, as a fraction
  double norm;      ///< farthest distance of a quaternion's length from 1
};

/// An integrator on a problem.
class contender {
 public:
  contender(std::string name, double ratio) : method(std::move(name)), step_ratio(ratio) {}
  virtual ~contender() = default;

  /// Integrates from start to end, with a step or tolerance `setting`. This is timed.
  virtual void integrate(double setting) = 0;
  virtual judgement judge() const = 0;

  std::string method;
  double step_ratio;  ///< from one step to try to the next one; 0 for methods that choose their steps
  kte::step_statistics cost;
};

struct problem {
  std::string name;
  double t_end;        ///< s
  double steps;        ///< fewest to try of methods with a fixed step
  double longest = 0;  ///< integrations that would take more CPU time are left out, s; 0: as usual
  std::vector<std::unique_ptr<contender>> contenders{};
};

/// Where integrators begin, how far they go, and how the end is judged.
template <class X>
struct task {
  X start;
  double t_end;
  std::function<judgement(const X&)> judge;
  /// Tolerances are a fraction of the state and of these, which are numbers of each of its components; of 1 if empty.
  Eigen::VectorXd sizes{};
};

// One file each
void add_planar(std::vector<problem>&);
void add_bodies(std::vector<problem>&);
void add_spherical(std::vector<problem>&);
void add_robots(std::vector<problem>&);
void add_stars(std::vector<problem>&);
void add_reactions(std::vector<problem>&);
void add_governor(std::vector<problem>&);
void add_closed_loops(std::vector<problem>&);

}  // namespace work_precision
