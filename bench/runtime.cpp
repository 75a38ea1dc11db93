/// Runtime chains of the same elements as the static ones, appended one by one.
#include <boost/hana/for_each.hpp>

#include "models.hpp"
#include "panda_hyq.hpp"
#include "runtime_calls.hpp"

namespace bench {
namespace {

template <class Model>
struct at_run_time {
  static constexpr auto name = Model::name;
  static runtime_subject& made() {
    static runtime_subject s{build(), std::string(Model::tool.name), std::is_same_v<Model, pendulum>};
    return s;
  }

 private:
  static kte::runtime_chain build() {
    kte::runtime_chain c;
    c.gravity(Model::chain.gravity());
    boost::hana::for_each(Model::chain.elements(),
                          [&]<class Core, class... Keys>(const kte::element<Core, Keys...>& e) {
                            c << kte::connect(e.core, Keys::name...);
                          });
    return c;
  }
};

/// For robots with references for few operations.
template <class Model>
void add_dynamics() {
  namespace calls = runtime_calls;
  add(operation::inverse_dynamics, "runtime", Model::name, call_on<at_run_time<Model>, calls::inverse_dynamics>);
  add(operation::mass_matrix, "runtime", Model::name, call_on<at_run_time<Model>, calls::mass_matrix>);
  add(operation::forward_dynamics, "runtime", Model::name, call_on<at_run_time<Model>, calls::forward_dynamics>);
}

const registered runtime_benchmarks{[] {
  add_runtime<at_run_time<pendulum>>();
  add_runtime<at_run_time<iiwa14>>();
  add_runtime<at_run_time<ur5>>();
  add_runtime<at_run_time<solo12>>();
  add_dynamics<panda>();
  add_dynamics<hyq>();
  add_further<further_runtime_calls<at_run_time<iiwa14>>>("runtime", iiwa14::name);
  add_further<further_runtime_calls<at_run_time<ur5>>>("runtime", ur5::name);
  add(operation::regressor, "runtime", iiwa14::name, call_on<at_run_time<iiwa14>, runtime_calls::regressor>);
}};

}  // namespace
}  // namespace bench
