/// The static chain of a robot that floats.
#include "models.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

const registered static_solo12_benchmarks{[] {
  add(operation::passes, "static", solo12::name, static_calls<solo12, double>::passes);
  add_algorithms<solo12, double>("static");
}};

}  // namespace
}  // namespace bench
