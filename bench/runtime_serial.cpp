/// Runtime chains of 1, 2, 4, ... bodies.
#include "models.hpp"
#include "runtime_calls.hpp"

namespace bench {
namespace {

template <int N>
struct serial_at_run_time {
  static constexpr auto name = serial_name<N>.text;
  static runtime_subject& made() {
    static runtime_subject s{build(), "link" + std::to_string(N)};
    return s;
  }

 private:
  static kte::runtime_chain build() {
    kte::runtime_chain c;
    c.gravity(kte::along_z(-9.81));
    for (int i = 0; i < N; ++i) {
      const auto number = std::to_string(i + 1);
      const auto& b = serial_body(i);
      c << kte::rigid_link_3D(i == 0 ? "base" : "link" + std::to_string(i), "mount" + number, b.position, b.rotation)
        << kte::revolute_joint_3D("q" + number, "mount" + number, "link" + number, b.axis)
        << kte::inertia_3D("link" + number, b.body);
    }
    return c;
  }
};

const registered runtime_serial_benchmarks{[] {
  [&]<int... Power>(std::integer_sequence<int, Power...>) { (add_runtime<serial_at_run_time<(1 << Power)>>(), ...); }
  (std::make_integer_sequence<int, 11>{});
  add_further<further_runtime_calls<serial_at_run_time<8>>>("runtime", serial_name<8>.text);
  add_further<further_runtime_calls<serial_at_run_time<32>>>("runtime", serial_name<32>.text);
  add_further<further_runtime_calls<serial_at_run_time<128>>>("runtime", serial_name<128>.text);
}};

}  // namespace
}  // namespace bench
