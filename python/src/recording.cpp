#include "recording.hpp"

#include <cstring>
#include <pybind11/stl.h>
#include <type_traits>

#include "arrays.hpp"
#include "chain.hpp"

namespace kte_python {

namespace {

using event_state = std::tuple<std::string, double, array, array, std::string>;
using counts = std::array<long long, 5>;

array array_of(const std::vector<double>& x) { return array(static_cast<Py_ssize_t>(x.size()), x.data()); }
void read(py::handle from, std::vector<double>& to) {
  const auto x = vector_from("a pickle", from, -1);
  to.assign(x.data(), x.data() + x.size());
}

}  // namespace

py::tuple state_of(const recording_object& r) {
  using contact = kte::contact_state<>;
  static_assert(std::is_trivially_copyable_v<contact>);
  std::vector<event_state> events;
  for (const auto& e : r.events) events.emplace_back(e.name, e.time, to_array(e.before), to_array(e.after), e.what);
  const auto& s = r.statistics;
  return py::make_tuple(
      bytes_of(r.chain), r.drawn, r.nx, r.nu, array_of(r.t), array_of(r.x), array_of(r.u), array_of(r.accelerations),
      py::bytes(reinterpret_cast<const char*>(r.contacts.data()), r.contacts.size() * sizeof(contact)), events,
      r.reason, r.stopped_by, counts{s.steps, s.rejected, s.evaluations, s.jacobians, s.factorizations},
      py::bytes(r.asked.data(), r.asked.size()));
}

std::unique_ptr<recording_object> recording_from(const py::tuple& state) {
  auto made = std::make_unique<recording_object>();
  auto& r = *made;
  r.chain = chain_from_bytes(py::bytes(state[0])), r.drawn = state[1];
  r.nx = state[2].cast<std::size_t>(), r.nu = state[3].cast<std::size_t>();
  read(state[4], r.t), read(state[5], r.x), read(state[6], r.u), read(state[7], r.accelerations);
  const auto contacts = state[8].cast<std::string>();
  r.contacts.resize(contacts.size() / sizeof(kte::contact_state<>));
  if (!contacts.empty()) std::memcpy(static_cast<void*>(r.contacts.data()), contacts.data(), contacts.size());
  for (const auto& [name, time, before, after, what] : state[9].cast<std::vector<event_state>>())
    r.events.push_back({name, time, vector_from("a pickle", before, -1), vector_from("a pickle", after, -1), what});
  r.reason = state[10].cast<std::string>(), r.stopped_by = state[11].cast<std::string>();
  const auto n = state[12].cast<counts>();
  r.statistics = {n[0], n[1], n[2], n[3], n[4]};
  const auto asked = state[13].cast<std::string>();
  r.asked.assign(asked.begin(), asked.end());
  return made;
}

}  // namespace kte_python
