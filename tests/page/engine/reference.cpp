/// What kte.wasm is to give: models as files, and what the same calls give here, as JSON on standard output.

#include <kte/elements/flexible_beam.hpp>
#include <kte/io/model_writer.hpp>
#include <kte/manipulators/iiwa14.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include <chrono>
#include <iostream>
#include <random>

#include "player.hpp"
#include "robots/solo12.hpp"

namespace {

using kte::page::player;

/// A text in JSON: the models are ASCII.
std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out + '"';
}
template <class Numbers>
std::string list(const Numbers& all) {
  std::string out;
  for (const double x : all) out += (out.empty() ? "[" : ",") + kte::detail::number(x);
  return out.empty() ? "[]" : out + ']';
}
template <class Texts>
std::string list_of_texts(const Texts& all) {
  std::string out;
  for (const auto& x : all) out += (out.empty() ? "[" : ",") + json_text(x);
  return out + ']';
}

/// A model on which calls are made, one after the other.
class reference {
 public:
  reference(const char* name, const kte::model_record& model, const std::vector<double>& q,
            const std::vector<double>& v)
      : text_(kte::to_json(model)), player_(text_), q_(q), v_(v) {
    std::vector<std::string> frames;
    for (const auto what : {kte::kind::frame_2D, kte::kind::frame_3D})
      for (const auto& frame : player_.shown().chain().wiring().names[static_cast<std::size_t>(what)])
        frames.push_back(frame);
    player_.track(frames);
    out_ = "{\"name\":" + json_text(name) + ",\"model\":" + json_text(text_) + ",\"frames\":" + list_of_texts(frames) +
           ",\"q\":" + list(q) + ",\"v\":" + list(v) + ",\"poses\":" + list(player_.shown().poses(q)) +
           ",\"accelerations\":" + list(player_.shown().accelerations(q, v)) +
           ",\"nanoseconds\":" + kte::detail::number(nanoseconds()) + ",\"calls\":[";
    player_.start(q, v);
  }
  /// Goes on to t.
  reference& to(double t) {
    player_.advance(t, [] { return true; });
    const auto& m = player_.shown().model();
    const Eigen::VectorXd x = player_.running().state();
    const auto e = player_.shown().energy_at(t, x);
    call("\"to\":" + kte::detail::number(t) + ",\"q\":" + list(m.positions_of(x)) +
         ",\"v\":" + list(m.velocities_of(x)) + ",\"energy\":" + list(std::array{e.kinetic, e.potential}) +
         ",\"stiff\":" + (player_.running().is_stiff() ? "true" : "false"));
    return *this;
  }
  reference& pull(const kte::page_pull& n) {
    player_.pull(n);
    call("\"pull\":" + json_text(n.frame) + ",\"point\":" + list(std::array{n.point.x, n.point.y, n.point.z}) +
         ",\"target\":" + list(std::array{n.target.x, n.target.y, n.target.z}) +
         ",\"stiffness\":" + kte::detail::number(n.stiffness) + ",\"damping\":" + kte::detail::number(n.damping));
    return *this;
  }
  reference& release() {
    player_.pull({});
    call("\"pull\":null");
    return *this;
  }
  reference& damp(double c) {
    player_.damp(c);
    call("\"damp\":" + kte::detail::number(c));
    return *this;
  }
  std::string text() const { return out_ + "]}"; }

 private:
  void call(const std::string& what) { out_ += (out_.back() == '[' ? "{" : ",{") + what + '}'; }
  /// Of forward dynamics.
  double nanoseconds() {
    using clock = std::chrono::steady_clock;
    double least = 1e9;
    for (int repeat = 0; repeat < 5; ++repeat) {
      const int calls = 200;
      const auto begin = clock::now();
      for (int i = 0; i < calls; ++i) player_.shown().accelerations(q_, v_);
      least = (std::min)(least, std::chrono::duration<double, std::nano>(clock::now() - begin).count() / calls);
    }
    return least;
  }

  std::string text_;
  player player_;
  std::vector<double> q_, v_;
  std::string out_;
};

template <class Chain>
kte::model_record record(const Chain& c) {
  return kte::record_of(c);
}

std::string iiwa14() {
  return reference("iiwa14", record(kte::iiwa14_chain()), {0.3, -0.7, 0.4, 1.1, -0.5, 0.8, 0.2},
                   {0.1, 0.2, -0.3, 0.4, -0.5, 0.6, -0.7})
      .to(0.25)
      .damp(0.5)
      .pull({"tool", {0, 0, 0.1}, {0.4, 0.3, 0.8}, 800, 40})
      .to(0.5)
      .release()
      .to(0.75)
      .text();
}
/// In flight, its legs pulled.
std::string solo12() {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<double> q{0.1, -0.2, 0.5, 0.9, 0.1, -0.3, 0.3}, v(18);
  while (q.size() < 19) q.push_back(any(random));
  for (double& x : v) x = any(random);
  return reference("solo12", record(robots::solo12), q, v)
      .to(0.2)
      .pull({"FL_FOOT", {0, 0, 0}, {0.5, 0.5, 0.5}, 50, 1})
      .to(0.4)
      .damp(0.05)
      .to(0.6)
      .text();
}
std::string pendulum() {
  using namespace kte;
  runtime_chain c;
  c.gravity(along_y(-9.81));
  c << revolute_joint_2D("q", "base", "joint") << rigid_link_2D("joint", "tip", along_x(0.5))
    << inertia_2D("tip", point_mass(1.0));
  return reference("pendulum", record_of(c), {0.4}, {-0.3})
      .to(1)
      .pull({"tip", {}, {0.4, 0.4, 0}, 100, 10})
      .to(2)
      .text();
}
/// A body that hangs on a beam, a spring and a damper, and a spring that is stiff.
std::string elastic() {
  using namespace kte;
  const rigid_body body{0.5, vec3<>{0.02, 0, 0}, diagonal(0.001, 0.002, 0.0015)};
  runtime_chain c;
  c.gravity(vec3<>{0, 0, -9.81});
  c << base_3D("wall") << free_joint_3D("pose", "wall", "body") << inertia_3D("body", body)
    << flexible_beam_3D("wall", "body", 0.5, beam_section{.EA = 2000, .EI_y = 0.8, .EI_z = 0.7, .GJ = 0.5})
    << rigid_link_3D("wall", "hook", vec3<>{0.5, 0, 0.4}) << spring_3D("hook", "body", 0.3, 40.0)
    << damper_3D("hook", "body", 2.0) << torsion_damper_3D("wall", "body", 0.02)
    << revolute_joint_3D("q", "body", "arm", axis::y) << inertia_3D("arm", point_mass(0.2, along_x(0.2)))
    << rigid_link_gen("q", "turned", 0.1) << joint_damping_gen("q", 0.01);
  return reference("elastic", record_of(c), {0.5, 0.01, -0.02, 1, 0.05, 0.02, -0.03, 0.3}, {0, 0, 0.1, 0, 0, 0, -0.2})
      .to(0.3)
      .text();
}
/// A coordinate so well damped that explicit methods creep.
std::string stiff() {
  using namespace kte;
  runtime_chain c;
  c.gravity(vec3<>{0, -9.81, 0});
  c << revolute_joint_2D("q1", "base", "a") << rigid_link_2D("a", "b", along_x(0.5)) << inertia_2D("b", point_mass(1.0))
    << joint_damping_gen("q1", 5e4) << revolute_joint_2D("q2", "b", "c") << rigid_link_2D("c", "d", along_x(0.5))
    << inertia_2D("d", point_mass(1.0));
  return reference("stiff", record_of(c), {0.2, 0.3}, {0, 0}).to(0.5).to(2).text();
}
/// A pendulum that comes to rest by friction, one that meets its stop, one with bristles: elements that switch and have
/// their own states.
std::string switching() {
  using namespace kte;
  runtime_chain c;
  c.gravity(vec3<>{0, -9.81, 0});
  for (const std::string i : {"1", "2", "3"})
    c << revolute_joint_2D("q" + i, "base", "a" + i) << rigid_link_2D("a" + i, "b" + i, along_x(0.5))
      << inertia_2D("b" + i, point_mass(1.0));
  c << joint_stiction_gen("q1", "mode", {.coulomb = 2, .stiction = 3, .stribeck_velocity = 0.1})
    << joint_limit_gen("q2", {.lower = -1.0, .upper = 1.0, .stiffness = 1e3, .damping = 3})
    << joint_lugre_gen("q3", "bristles", {1e3, 10, 0.1, 0.5, 0.6, 0.1});
  return reference("switching", record_of(c), {-0.5, 0.3, 0.2}, {0, 0, 0}).to(0.5).to(1).text();
}
/// A motor whose input is 3 Nm in the file.
std::string inputs() {
  using namespace kte;
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "arm") << inertia_2D("arm", planar_body(1.0, 0.5))
    << driving_actuator_gen("q", "motor");
  page::dynamics_model m(c);
  m.input("motor") = 3;
  return reference("inputs", detail::record_of_model(m), {0}, {0}).to(1).text();
}

/// What acts has formulas; the second pendulum is held by friction.
std::string acting() {
  using namespace kte;
  runtime_chain c;
  c.gravity(vec3<>{0, -9.81, 0});
  c << revolute_joint_2D("q", "base", "joint") << rigid_link_2D("joint", "tip", along_x(0.5))
    << inertia_2D("tip", point_mass(1.0)) << rigid_link_2D("base", "hook", vec2{1.0, 1.0})
    << spring_2D("hook", "tip", 0.3, 40.0) << damper_2D("hook", "tip", 2.0) << driving_actuator_gen("q", "motor")
    << joint_limit_gen("q", {.upper = 0.3, .stiffness = 100, .damping = 3}) << revolute_joint_2D("h", "base", "arm")
    << rigid_link_2D("arm", "end", along_x(0.5)) << inertia_2D("end", point_mass(2.0))
    << joint_stiction_gen("h", "mode", {.coulomb = 20, .stiction = 30, .stribeck_velocity = 0.1});
  page::dynamics_model m(c);
  m.input("motor") = 3;
  return reference("acting", detail::record_of_model(m), {0.4, 0.2}, {0.7, 0}).to(0.1).text();
}

}  // namespace

int main() {
  std::cout << "{\"elements\":" << list_of_texts(kte::element_registry::standard().types()) << ",\"cases\":[\n"
            << iiwa14();
  for (const auto& one : {solo12(), pendulum(), elastic(), stiff(), switching(), inputs(), acting()})
    std::cout << ",\n" << one;
  std::cout << "]}\n";
}
