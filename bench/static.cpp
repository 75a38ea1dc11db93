/// Static chains: sines and cosines four at a time, or, in kte_bench_libm, one by one.
#include "models.hpp"
#include "static_calls.hpp"

namespace bench {
namespace {

#if defined(KTE_SCALAR_SINCOS)
constexpr auto static_way = "static_libm";
#else
constexpr auto static_way = "static";
#endif

template <class Model>
void add_model() {
  add(operation::passes, static_way, Model::name, static_calls<Model, double>::passes);
  add_algorithms<Model, double>(static_way);
}

const registered static_benchmarks{[] {
  add_model<pendulum>();
  add_model<iiwa14>();
  add_model<ur5>();
}};

}  // namespace
}  // namespace bench
