#include <kte/io/memory_table.hpp>
#include <kte/io/recorder.hpp>
#include <kte/view/scene_of.hpp>

#include "catch.hpp"
#include "chain/models.hpp"

namespace recording_test {

using namespace kte;
using kte::test::says;

constexpr auto pendulum = models::pendulum.gravity(along_y(-9.81));

template <class Chain>
void turn(const Chain& c, double q, auto& s) {
  set_positions(s, std::array{q});
  c.doMotion(s);
}

TEST_CASE("a recording has poses, coordinates and columns of each row") {
  scene_recording rec(pendulum, {.name = "by hand", .columns = {"tip/position", "q/v"}});
  auto s = make_state(pendulum);
  for (int i = 0; i < 4; ++i) {
    set_velocities(s, std::array{0.25 * i});
    turn(pendulum, 0.5 * i, s);
    rec.row(0.1 * i, s);
  }
  const auto& scene = rec.contents();
  const auto& r = scene.recordings.at(0);
  CHECK(r.name == "by hand");
  CHECK(r.t == std::vector{0.0, 0.1, 0.2, 0.1 * 3});
  CHECK(r.q == std::vector<float>{0, 0.5f, 1, 1.5f});
  CHECK(r.v == std::vector<float>{0, 0.25f, 0.5f, 0.75f});
  CHECK(r.signals.empty());
  REQUIRE(r.positions.size() == 4 * 2 * 3);
  REQUIRE(r.rotations.size() == 4 * 2 * 4);
  const double half = 0.75;  // of the last row, frame "joint"
  CHECK(r.rotations[3 * 8 + 4] == std::lround(32767 * std::cos(half)));
  CHECK(r.rotations[3 * 8 + 7] == std::lround(32767 * std::sin(half)));
  REQUIRE(r.columns.size() == 3);
  CHECK(r.plotted == std::vector<std::string>{"tip/position/x", "tip/position/y", "q/v"});
  CHECK((r.columns[0].name == "tip/position/x" && r.columns[0].unit == "m"));
  CHECK((r.columns[2].name == "q/v" && r.columns[2].unit == "rad/s"));
  CHECK(double{r.columns[1].data[1]} == within(0.5 * std::sin(0.5), 1e-7));
  CHECK(r.columns[2].data[3] == 0.75f);
}

TEST_CASE("rotations of a recording do not jump from q to -q") {
  scene_recording rec(pendulum);
  auto s = make_state(pendulum);
  for (int i = 0; i < 200; ++i) turn(pendulum, 0.1 * i, s), rec.row(i, s);
  const auto& r = rec.contents().recordings[0];
  for (std::size_t i = 1; i < 200; ++i) {
    const auto *a = r.rotations.data() + 8 * i - 4, *b = a + 8;
    CHECK(std::hypot(a[0] - b[0], a[3] - b[3]) < 0.06 * 32767);
  }
}

TEST_CASE("times of a recording do not decrease, and numbers that are not finite do not move it") {
  scene_recording rec(pendulum, {.columns = {"q"}});
  auto s = make_state(pendulum);
  turn(pendulum, 0.2, s);
  rec.row(1, s), rec.row(1, s);
  CHECK_THROWS_MATCHES(rec.row(0.5, s), bad_argument, says("row 3 is at 0.5, the row before at 1"));
  CHECK_THROWS_MATCHES(rec.row(NAN, s), bad_argument, says("times that do not decrease"));
  s[models::q].q = NAN;
  pendulum.doMotion(s);
  rec.row(2, s);
  rec.row(3, s);
  const auto& scene = rec.contents();
  CHECK(scene.recordings[0].q == std::vector<float>{0.2f, 0.2f, 0.2f, 0.2f});
  CHECK(std::isnan(scene.recordings[0].columns[0].data[2]));
  REQUIRE(scene.notes.size() == 1);
  CHECK_THAT(scene.notes[0], kte::test::contains_text("from t = 2 on"));
  scene_recording first(pendulum);
  CHECK_THROWS_MATCHES(first.row(0, s), bad_argument, says("the first row of a recording is not finite"));
}

TEST_CASE("states of other chains are refused, and columns that are not there") {
  runtime_chain a, b;
  a << pendulum;
  b << pendulum;
  scene_recording rec(a);
  CHECK_THROWS_MATCHES(rec.row(0, b.make_state()), bad_argument, says("made for another chain than the recording"));
  CHECK_THROWS_MATCHES(scene_recording(a, {.columns = {"tip/spin"}}), unknown_name, says("cannot record 'tip/spin'"));
}

TEST_CASE("a table with the coordinates by name moves a chain") {
  runtime_chain chain;
  chain << pendulum;
  table numbers{{"t", "energy", "q", "q/v"}, {{0, 1, 2}, {5, 6, NAN}, {0.1, 0.2, 0.3}, {1, 1, 1}}};
  for (const auto& s : {scene_of(pendulum, numbers), scene_of(chain, numbers)}) {
    const auto& r = s.recordings.at(0);
    CHECK(r.t == std::vector<double>{0, 1, 2});
    CHECK(r.q == std::vector<float>{0.1f, 0.2f, 0.3f});
    CHECK(r.v == std::vector<float>{1, 1, 1});
    CHECK(r.rotations[2 * 8 + 7] == std::lround(32767 * std::sin(0.15)));
    REQUIRE(r.columns.size() == 2);
    CHECK((r.columns[0].name == "energy" && r.columns[0].unit.empty() && r.columns[0].data[1] == 6));
    CHECK((r.columns[1].name == "q/v" && r.columns[1].unit == "rad/s"));
  }
  numbers.columns[3][1] = NAN;
  CHECK(scene_of(chain, numbers).recordings.at(0).v.empty());
  numbers.names[3] = "rate";
  CHECK(scene_of(chain, numbers).recordings.at(0).v.empty());
  numbers.names[3] = "q/v";
  numbers.names[2] = "Q";
  CHECK_THROWS_MATCHES(scene_of(chain, numbers), unknown_name,
                       says("no columns of coordinates by which the mechanism moves: 'q'"));
  numbers.names = {"time", "energy", "q", "q/v"};
  CHECK_THROWS_MATCHES(scene_of(chain, numbers), unknown_name, says("no column 't'"));
  numbers.names[0] = "t", numbers.columns[2][1] = INFINITY;
  CHECK_THROWS_MATCHES(scene_of(chain, numbers), bad_argument, says("column 'q' of the table is not finite in row 2"));
  CHECK_THROWS_MATCHES(scene_of(chain, table{{"t", "q"}, {{}, {}}}), bad_argument, says("needs a row"));
  CHECK_THROWS_MATCHES(scene_of(chain, table{{"t", "q"}, {{1}, {}}}), bad_argument,
                       says("column 'q' of the table has 0 rows, not 1"));
}

TEST_CASE("what a recorder recorded is a table that moves the chain, rotations and poses too") {
  runtime_chain chain;
  chain << free_joint_3D("trunk", "world", "body") << spherical_joint_3D("ball", "body", "hand")
        << inertia_3D("body", point_mass(1.0)) << revolute_joint_3D("body", "hand", "finger", axis::x);
  recorder rec(chain);
  scene_recording direct(chain);
  auto s = chain.make_state();
  for (int i = 0; i < 3; ++i) {
    s.pose_3D("trunk").position = {0.1 * i, 0.2, 0.3};
    s.pose_3D("trunk").rotation = normalized(1.0, 0.1 * i, 0.2, 0.0);
    s.rotation_3D("ball").rotation = normalized(1.0, 0.0, 0.3 * i, 0.1);
    s.coordinate("body").q = 0.7 * i;
    s.pose_3D("trunk").velocity = {0.1, 0.2 * i, 0.3}, s.pose_3D("trunk").ang_velocity = {0.4, 0.5, 0.6 * i};
    s.rotation_3D("ball").ang_velocity = {0.7 * i, 0.8, 0.9}, s.coordinate("body").q_dot = i;
    chain.doMotion(s);
    rec.row(i, s), direct.row(i, s);
  }
  const auto a = scene_of(chain, rec.contents()).recordings.at(0), b = direct.contents().recordings.at(0);
  CHECK(a.positions == b.positions);
  CHECK(a.rotations == b.rotations);
  CHECK(a.q == b.q);
  CHECK((a.v == b.v && a.v.size() == 3 * 10 && a.v.back() == 2));
  auto named = rec.contents();
  *std::find(named.names.begin(), named.names.end(), "coordinate:body") = "body";  // as in tables from elsewhere
  CHECK(scene_of(chain, named).recordings.at(0).rotations == b.rotations);
}

TEST_CASE("inputs and the time move what elements write by them") {
  runtime_chain chain;
  chain << base_3D("world") << position_control_3D("p", "v", "a", "world", "end");
  const table numbers{{"t", "p/x", "p/y", "p/z"}, {{0, 1}, {1, 2}, {0, 0}, {0, 5}}};
  const auto s = scene_of(chain, numbers);
  const auto& r = s.recordings.at(0);
  CHECK((r.positions[3 + 0] == 1 && r.positions[6 + 3 + 0] == 2 && r.positions[6 + 3 + 2] == 5));
  CHECK(r.columns.size() == 3);
  REQUIRE(r.signals.size() == 2 * 9);
  CHECK((r.signals[0] == 1 && r.signals[9] == 2 && r.signals[11] == 5));
  for (std::size_t i = 3; i < 9; ++i) CHECK(std::isnan(r.signals[i]));  // v and a are not in the table
}

TEST_CASE("a recording has inputs, vectors and internal states, by which a page knows forces") {
  runtime_chain chain;
  chain << revolute_joint_3D("q", "base", "arm", axis::y) << inertia_3D("arm", point_mass(1.0, along_x(1.0)))
        << external_force_3D("arm", "push", "turn") << driving_actuator_gen("q", "motor")
        << joint_lugre_gen("q", "bristles", {1e3, 10, 0.1, 0.5, 0.6, 0.1});
  auto s = chain.make_state();
  s.input("motor") = 3, s.vector("push") = {1, 2, 4}, s.vector("turn") = {5, 6, 7}, s.internal("bristles").z = 0.5;
  chain.doMotion(s);
  const auto of_state = scene_of(chain, s);
  CHECK(of_state.recordings[0].signals == std::vector<float>{3, 1, 2, 4, 5, 6, 7, 0.5f});
  CHECK(of_state.forces.at(0).element == 2);
  CHECK(of_state.forces.at(2).element == 4);
  recorder rec(chain, {"q", "motor"});
  rec.row(0, s);
  const auto of_table = scene_of(chain, rec.contents()).recordings[0];
  CHECK(of_table.signals[0] == 3);
  for (std::size_t i = 1; i < 8; ++i) CHECK(std::isnan(of_table.signals[i]));
}

}  // namespace recording_test
