/// The static chain of a robot that floats: the inverse of its mass matrix, and derivatives.
#include "models.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered static_solo12_derivatives_benchmarks{[] { add_derivatives<solo12, double>("static"); }};

}  // namespace
}  // namespace bench
