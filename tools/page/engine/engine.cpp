/// What a page calls: kte::page::player behind functions of numbers and bytes. Every function gives 0, or 1 where it
/// has failed; kte_message has the reason. Arguments and results lie in one buffer.

// What makes and connects elements, and they are many, is compiled to be small; the loops of algorithms to be fast.
#pragma clang attribute push(__attribute__((minsize)), apply_to = function)
#include <kte/contract/element.hpp>
#include <kte/contract/record.hpp>
#pragma clang attribute pop
#include <kte/dynamics/state_vectors.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#pragma clang attribute push(__attribute__((minsize)), apply_to = function)
#include <kte/elements/registry.hpp>
#include <kte/io/model_reader.hpp>
#pragma clang attribute pop

#include <cstring>

#include "player.hpp"

namespace {

using kte::page::player;

std::unique_ptr<player> playing;
std::string message;
std::vector<double> buffer;
std::vector<std::string> names;

template <class F>
int guarded(const F& f) {
  try {
    f();
    return 0;
  } catch (const std::bad_alloc&) {
    message.assign("kte: not enough memory");
  } catch (const std::exception& e) {
    message = e.what();
  }
  return 1;
}
player& loaded() {
  if (!playing) throw kte::bad_argument("kte: no model has been loaded");
  return *playing;
}
std::string_view text(std::size_t bytes) { return {reinterpret_cast<const char*>(buffer.data()), bytes}; }
std::span<const double> numbers(std::size_t begin, std::size_t count) { return {buffer.data() + begin, count}; }
/// Results, from the start of the buffer on.
template <class Numbers>
double* put(double* to, const Numbers& from) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(from.size()); ++i)
    *to++ = from[static_cast<decltype(from.size())>(i)];
  return to;
}

void put_loads(const kte::page::acting& a) {
  std::vector<double> all{static_cast<double>(a.loads().size())};
  const auto add = [&all](const auto& w) {
    all.insert(all.end(), {w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z});
  };
  for (const auto& e : a.loads()) {
    all.insert(all.end(), {static_cast<double>(e.element), e.on_frame ? 1.0 : 0.0, static_cast<double>(e.which)});
    add(e.load);
  }
  for (const auto& r : a.reactions()) add(r);
  all.insert(all.end(), a.accelerations().begin(), a.accelerations().end());
  buffer.resize((std::max)(buffer.size(), all.size()));
  put(buffer.data(), all);
}

}  // namespace

#define KTE_EXPORT(name) extern "C" __attribute__((export_name(#name)))

/// What it was made of.
KTE_EXPORT(kte_version) const char* version() { return KTE_PAGE_VERSION; }
KTE_EXPORT(kte_message) const char* reason() { return message.c_str(); }
/// Where `bytes` bytes have room, and what is there now stays; null if there is no memory.
KTE_EXPORT(kte_buffer) double* room(std::size_t bytes) {
  const std::size_t count = bytes / sizeof(double) + 1;
  if (buffer.size() < count && guarded([&] { buffer.resize(count); }) != 0) return nullptr;
  return buffer.data();
}

/// The text of a model file, of `bytes` bytes in the buffer.
KTE_EXPORT(kte_load) int load(std::size_t bytes) {
  return guarded([&] {
    auto fresh = std::make_unique<player>(text(bytes));
    playing = std::move(fresh);
  });
}
KTE_EXPORT(kte_nq) int nq() { return playing ? playing->shown().model().nq() : 0; }
KTE_EXPORT(kte_nv) int nv() { return playing ? playing->shown().model().dofs() : 0; }

/// One name after the other, then `kte_track`.
KTE_EXPORT(kte_name) int name(std::size_t bytes) {
  const int failed = guarded([&] { names.emplace_back(text(bytes)); });
  if (failed != 0) names = {};
  return failed;
}
KTE_EXPORT(kte_track) int track() {
  const auto all = std::exchange(names, {});
  return guarded([&] { loaded().track(all); });
}
/// From q, of `count` numbers, to poses.
KTE_EXPORT(kte_poses) int poses(std::size_t count) {
  return guarded([&] {
    const auto& all = loaded().shown().poses(numbers(0, count));
    buffer.resize((std::max)(buffer.size(), all.size()));
    put(buffer.data(), all);
  });
}

/// From q and v, of nq and nv numbers, to accelerations.
KTE_EXPORT(kte_accelerations) int accelerations(std::size_t nq, std::size_t nv) {
  return guarded([&] { put(buffer.data(), loaded().shown().accelerations(numbers(0, nq), numbers(nq, nv))); });
}
/// Starts the simulation.
KTE_EXPORT(kte_start) int start(std::size_t nq, std::size_t nv) {
  return guarded([&] { loaded().start(numbers(0, nq), numbers(nq, nv)); });
}
/// Towards a time by one stretch of steps.
KTE_EXPORT(kte_step) int step(double t_end) {
  return guarded([&] {
    bool first = true;
    loaded().advance(t_end, [&first] { return std::exchange(first, false); });
  });
}
/// t, kinetic and potential energy, whether it is stiff, how many signals there are, q, v and signals.
KTE_EXPORT(kte_state) int state() {
  return guarded([&] {
    auto& p = loaded();
    const auto& s = p.running();
    const auto& x = s.state();
    const auto e = p.shown().energy_at(s.time(), x);
    const auto& m = p.shown().model();
    const auto signals = kte::page::acting::signals_of(m, s.time(), x);
    buffer.resize((std::max)(buffer.size(), 5 + static_cast<std::size_t>(x.size()) + signals.size()));
    double* to = put(buffer.data(), std::array{s.time(), e.kinetic, e.potential, s.is_stiff() ? 1.0 : 0.0,
                                               static_cast<double>(signals.size())});
    put(put(to, x.head(m.nq() + m.dofs())), signals);
  });
}
/// From q, v and signals, with their sizes, at a time to the loads in the mechanism: their number; of each the
/// element, 1 on a frame and 0 on a coordinate, which of these, a force and a torque; of each track the reaction, a
/// force and a torque; the accelerations. Without v and signals: at rest. Not free: where something else acted too.
KTE_EXPORT(kte_loads) int loads(std::size_t nq, std::size_t nv, std::size_t signals, double t, int free) {
  return guarded([&] {
    auto& p = loaded();
    put_loads(nv + signals == 0 && p.shown().model().dofs() > 0
                  ? p.loads_at_rest(numbers(0, nq))
                  : p.loads(t, numbers(0, nq), numbers(nq, nv), numbers(nq + nv, signals), free != 0));
  });
}
/// `kte_loads` for the present state of the simulation.
KTE_EXPORT(kte_loads_now) int loads_now() {
  return guarded([] { put_loads(loaded().loads_now()); });
}
/// The time of the simulation, s.
KTE_EXPORT(kte_time) double time_reached() { return playing && playing->is_running() ? playing->running().time() : 0; }

/// The name of the frame is that of the last `kte_name`, or empty.
KTE_EXPORT(kte_pull)
int pull(double px, double py, double pz, double tx, double ty, double tz, double stiffness, double damping) {
  auto all = std::exchange(names, {});
  return guarded([&] {
    loaded().pull(
        {all.empty() ? std::string() : std::move(all.back()), {px, py, pz}, {tx, ty, tz}, stiffness, damping});
  });
}
KTE_EXPORT(kte_damping) int damping(double c) {
  return guarded([&] { loaded().damp(c); });
}
/// The elements that models may have, their names apart by blanks, in the buffer; gives how many bytes.
KTE_EXPORT(kte_elements) std::size_t elements() {
  std::string all;
  const int failed = guarded([&] {
    for (const auto& type : kte::element_registry::standard().types()) all += type + ' ';
    buffer.resize((std::max)(buffer.size(), all.size() / sizeof(double) + 1));
  });
  std::memcpy(buffer.data(), all.data(), all.size());
  return failed != 0 ? 0 : all.size();
}
