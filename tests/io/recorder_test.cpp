#include <kte/elements/external_force.hpp>
#include <kte/io/recorder.hpp>
#include <kte/io/table_reader.hpp>

#include "catch.hpp"
#include "chain/models.hpp"
#include "random.hpp"
#include "scratch.hpp"

namespace recorder_test {

using namespace kte;
using kte::test::contains_text;
using kte::test::scratch;
using name_list = std::vector<std::string>;

// clang-format off
inline constexpr struct trunk_ final : pose_3D_key<"trunk">    {} trunk;
inline constexpr struct ball_  final : rotation_3D_key<"ball"> {} ball;
inline constexpr struct puck_  final : pose_2D_key<"puck">     {} puck;
inline constexpr struct q_     final : coord_key<"arm/q">      {} q;
inline constexpr struct wall_  final : coord_key<"wall">       {} wall;
inline constexpr struct motor_ final : input_key<"motor">      {} motor;
inline constexpr struct world_ final : frame_3D_key<"world">   {} world;
inline constexpr struct body_  final : frame_3D_key<"body">    {} body;
inline constexpr struct hand_  final : frame_3D_key<"hand">    {} hand;
inline constexpr struct tip_   final : frame_3D_key<"arm/tip"> {} tip;
inline constexpr struct table_ final : frame_2D_key<"table">   {} ground;
inline constexpr struct disc_  final : frame_2D_key<"disc">    {} disc;
// clang-format on

/// One of every kind. The first coordinate that appears is no degree of freedom, so states of static and of runtime
/// chains hold the two in different orders.
constexpr auto zoo =
    chain(base_gen(wall), base_2D(ground), free_joint_3D(trunk, world, body), inertia_3D(body, point_mass(1.0)),
          spherical_joint_3D(ball, body, hand), revolute_joint_3D(q, hand, tip, axis::x),
          driving_actuator_gen(q, motor), spring_gen(wall, q, 0.0, 1.0), inertia_3D(tip, point_mass(1.0)),
          free_joint_2D(puck, ground, disc), inertia_2D(disc, point_mass(1.0)));

/// Different numbers everywhere.
template <class State>
void scatter(State& s) {
  random_numbers random(1);
  const auto draw = [&](auto&... x) { ((x = random(1)), ...); };
  const auto draw3 = [&](auto&... v) { (draw(v.x, v.y, v.z), ...); };
  const auto draw2 = [&](auto&... v) { (draw(v.x, v.y), ...); };
  const auto rotation = [&] { return normalized(0.5 + random(0.5), random(1), random(1), random(1)); };
  for (auto* c : {&s[q], &s[wall]}) draw(c->q, c->q_dot, c->q_ddot, c->f);
  draw(s[motor]);
  for (auto* f : {&s[world], &s[body], &s[hand], &s[tip]}) {
    draw3(f->position, f->velocity, f->ang_velocity, f->acceleration, f->ang_acceleration, f->force, f->torque);
    f->rotation = matrix(rotation());
  }
  for (auto* f : {&s[ground], &s[disc]}) {
    draw2(f->position, f->velocity, f->acceleration, f->force);
    draw(f->ang_velocity, f->ang_acceleration, f->torque);
    f->rotation = rotation_by(3 * random(1));
  }
  auto& p = s[trunk];
  draw3(p.position, p.velocity, p.ang_velocity, p.acceleration, p.ang_acceleration, p.force, p.torque);
  draw3(s[ball].ang_velocity, s[ball].ang_acceleration, s[ball].torque);
  draw(p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z);
  draw(s[ball].rotation.w, s[ball].rotation.x, s[ball].rotation.y, s[ball].rotation.z);
  draw2(s[puck].position, s[puck].velocity, s[puck].acceleration, s[puck].force);
  draw(s[puck].angle, s[puck].ang_velocity, s[puck].ang_acceleration, s[puck].torque);
}
/// Copies these items to the state of a runtime chain.
template <class State, class... Key>
void copy(const State& s, runtime_state& r, const Key&... key) {
  ((r.get<Key::what>(r.made_for()->find(Key::name, Key::what)) = s[key]), ...);
}

/// Records one row in memory.
template <class Chain, class State>
table row_of(const Chain& c, const State& s, const name_list& names) {
  recorder rec(c, names);
  rec.row(0.25, s);
  return rec.contents();
}
name_list columns_of(const name_list& names) { return row_of(zoo, make_state(zoo), names).names; }

TEST_CASE("columns are named after what they hold, vectors by components") {
  CHECK(columns_of({"arm/q"}) == name_list{"t", "arm/q"});
  CHECK(columns_of({"arm/q/v", "arm/q/a", "arm/q/f"}) == name_list{"t", "arm/q/v", "arm/q/a", "arm/q/f"});
  CHECK(columns_of({"motor", "wall"}) == name_list{"t", "motor", "wall"});
  CHECK(columns_of({"arm/tip/position/z", "arm/tip/position/x"}) ==
        name_list{"t", "arm/tip/position/z", "arm/tip/position/x"});
  CHECK(columns_of({"arm/tip/rotation", "disc/angle"}) == name_list{"t", "arm/tip/rotation/w", "arm/tip/rotation/x",
                                                                    "arm/tip/rotation/y", "arm/tip/rotation/z",
                                                                    "disc/angle"});
  CHECK(columns_of({"disc"}) == name_list{"t", "disc/position/x", "disc/position/y", "disc/angle"});
  CHECK(columns_of({"puck/v"}) == name_list{"t", "puck/velocity/x", "puck/velocity/y", "puck/ang_velocity"});
  CHECK(columns_of({"ball", "ball/f"}) == name_list{"t", "ball/rotation/w", "ball/rotation/x", "ball/rotation/y",
                                                    "ball/rotation/z", "ball/torque/x", "ball/torque/y",
                                                    "ball/torque/z"});
  CHECK(columns_of({"trunk/ang_acceleration/y"}) == name_list{"t", "trunk/ang_acceleration/y"});
}

TEST_CASE("every quantity is the number of the state that it is named after") {
  auto s = make_state(zoo);
  scatter(s);
  const auto numbers = [&](const std::string& name) {
    const table t = row_of(zoo, s, {name});
    std::vector<double> r;
    for (const auto& c : t.columns) r.push_back(c.at(0));
    CHECK(r.at(0) == 0.25);
    r.erase(r.begin());
    return r;
  };
  using list = std::vector<double>;
  const auto v3 = [](const vec3<>& v) { return list{v.x, v.y, v.z}; };
  const auto v2 = [](const vec2<>& v) { return list{v.x, v.y}; };
  const auto w4 = [](const unit_quaternion<>& r) { return list{r.w, r.x, r.y, r.z}; };
  CHECK(numbers("arm/q") == list{s[q].q});
  CHECK(numbers("arm/q/v") == list{s[q].q_dot});
  CHECK(numbers("arm/q/a") == list{s[q].q_ddot});
  CHECK(numbers("arm/q/f") == list{s[q].f});
  CHECK(numbers("wall") == list{s[wall].q});
  CHECK(numbers("motor") == list{s[motor]});
  const auto in_space = [&](const std::string& name, const auto& x) {
    CHECK(numbers(name + "/position") == v3(x.position));
    CHECK(numbers(name + "/position/y") == list{x.position.y});
    CHECK(numbers(name + "/velocity") == v3(x.velocity));
    CHECK(numbers(name + "/ang_velocity") == v3(x.ang_velocity));
    CHECK(numbers(name + "/acceleration") == v3(x.acceleration));
    CHECK(numbers(name + "/ang_acceleration") == v3(x.ang_acceleration));
    CHECK(numbers(name + "/force") == v3(x.force));
    CHECK(numbers(name + "/torque") == v3(x.torque));
    CHECK(numbers(name + "/torque/z") == list{x.torque.z});
  };
  in_space("body", s[body]);
  in_space("arm/tip", s[tip]);
  in_space("trunk", s[trunk]);
  CHECK(numbers("arm/tip/rotation") == w4(to_quaternion(s[tip].rotation)));
  CHECK(numbers("arm/tip/rotation/y") == list{to_quaternion(s[tip].rotation).y});
  CHECK(numbers("trunk/rotation") == w4(s[trunk].rotation));
  CHECK(numbers("ball/rotation") == w4(s[ball].rotation));
  CHECK(numbers("ball/v") == v3(s[ball].ang_velocity));
  CHECK(numbers("ball/a") == v3(s[ball].ang_acceleration));
  CHECK(numbers("ball/f") == v3(s[ball].torque));
  const auto in_plane = [&](const std::string& name, const auto& x) {
    CHECK(numbers(name + "/position") == v2(x.position));
    CHECK(numbers(name + "/velocity") == v2(x.velocity));
    CHECK(numbers(name + "/ang_velocity") == list{x.ang_velocity});
    CHECK(numbers(name + "/acceleration") == v2(x.acceleration));
    CHECK(numbers(name + "/ang_acceleration") == list{x.ang_acceleration});
    CHECK(numbers(name + "/force") == v2(x.force));
    CHECK(numbers(name + "/torque") == list{x.torque});
  };
  in_plane("disc", s[disc]);
  in_plane("puck", s[puck]);
  CHECK(numbers("disc/angle") == list{angle(s[disc].rotation)});
  CHECK(numbers("puck/angle") == list{s[puck].angle});
}

TEST_CASE("without names all coordinates, inputs and places of frames are recorded, the same for both kinds of chain") {
  auto s = make_state(zoo);
  scatter(s);
  const auto runtime = models::element_by_element(zoo);
  auto r = runtime.make_state();
  copy(s, r, trunk, ball, puck, q, wall, motor, world, body, hand, tip, ground, disc);
  for (const auto& extension : test::table_extensions) {
    scratch one(extension), other(extension);
    recorder of_static(one.path, zoo);
    recorder of_runtime(other.path, runtime);
    for (const double t : {0.0, 0.1}) of_static.row(t, s), of_runtime.row(t, r);
    of_static.close(), of_runtime.close();
    CHECK(one.text() == other.text());
    const table read = read_table(one.path);
    CHECK(read.names.size() == 1 + 2 * 4 + 1 + (4 + 3 * 3) + 3 * 3 + 3 + (7 + 3 * 6) + 4 * 7 + 2 * 3);
    CHECK(read["t"] == std::vector<double>{0, 0.1});
    CHECK(read["arm/tip/position/z"] == std::vector<double>(2, s[tip].position.z));
    CHECK(read["wall/f"] == std::vector<double>(2, s[wall].f));
  }
  const name_list names = columns_of({});
  CHECK(name_list(names.begin(), names.begin() + 11) == name_list{"t", "wall", "wall/v", "wall/a", "wall/f", "arm/q",
                                                                  "arm/q/v", "arm/q/a", "arm/q/f", "motor",
                                                                  "ball/rotation/w"});
  CHECK(names.back() == "arm/tip/rotation/z");
}

TEST_CASE("a pendulum that moves is recorded as it is at each row") {
  scratch file(".csv");
  auto s = make_state(models::pendulum);
  recorder rec(file.path, models::pendulum, {"q", "q/v", "tip/position", "tip/angle"});
  rec.flush_every(1);
  for (int i = 0; i < 10; ++i) {
    s[models::q].q = 0.1 * i, s[models::q].q_dot = 0.5;
    models::pendulum.doMotion(s);
    rec.row(0.2 * i, s);
  }
  CHECK(read_table(file.path).rows() == 10);
  rec.flush(), rec.close();
  const table t = read_table(file.path);
  for (std::size_t i = 0; i < 10; ++i) {
    const double a = 0.1 * static_cast<double>(i);
    CHECK(t["q"][i] == a);
    CHECK(t["q/v"][i] == 0.5);
    // sine and cosine err by 1.1e-16 at most
    CHECK(t["tip/position/x"][i] == within(0.5 * std::cos(a), 1.2e-16));
    CHECK(t["tip/position/y"][i] == within(0.5 * std::sin(a), 1.2e-16));
    CHECK(t["tip/angle"][i] == within(a, 2.3e-16));
  }
}

TEST_CASE("states of other scalars are recorded as doubles, in the format that is requested") {
  scratch file(".dat");
  auto s = make_state<float>(models::pendulum);
  s[models::q].q = 0.1f;
  recorder rec(file.path, models::pendulum, {"q"}, table_format::tsv);
  rec.row(0.5f, s);
  rec.close();
  CHECK(read_table(file.path, table_format::tsv)["q"] == std::vector<double>{double{0.1f}});
}

TEST_CASE("unknown names are errors that say what there is") {
  scratch file(".csv", "untouched");
  const auto message = [&](const name_list& names) {
    return test::message_of<unknown_name>([&] { recorder(file.path, models::pendulum, names); });
  };
  CHECK(message({"q", "tpi"}) ==
        "kte: cannot record 'tpi': the chain has coordinate 'q', 2D frame 'base', 2D frame 'joint', 2D frame 'tip'");
  CHECK(message({"ti"}).starts_with("kte: cannot record 'ti': "));
  CHECK(message({""}).starts_with("kte: cannot record '': "));
  const std::string parts =
      ": the 2D frame 'tip' has tip/position/x, tip/position/y, tip/angle, tip/velocity/x, tip/velocity/y, "
      "tip/ang_velocity, tip/acceleration/x, tip/acceleration/y, tip/ang_acceleration, tip/force/x, tip/force/y, "
      "tip/torque";
  for (const std::string name : {"tip/", "tip/pos", "tip/position/", "tip/position/z", "tip/position/xy",
                                 "tip/positionx", "tip/angle/x", "tip/q", "tip/rotation", "tip/b"})
    CHECK(message({name}) == "kte: cannot record '" + name + "'" + parts);
  CHECK(message({"q/x"}) == "kte: cannot record 'q/x': the coordinate 'q' has q/v, q/a, q/f");
  CHECK(test::message_of<unknown_name>([] { recorder(zoo, {"motor/v"}); }) ==
        "kte: cannot record 'motor/v': the input 'motor' has no parts");
  CHECK(test::message_of<bad_argument>([] {
          recorder(zoo, {"body/position", "body/position/x"});
        }) == "kte: two columns are named 'body/position/x'");
  CHECK_THROWS_AS(recorder("x.dat", models::pendulum), bad_argument);
  CHECK(file.text() == "untouched");
}

TEST_CASE("where names of things begin alike, the longest counts") {
  runtime_chain c;
  c << revolute_joint_3D("arm/position", "base", "arm", axis::z) << inertia_3D("arm", point_mass(1.0));
  CHECK(row_of(c, c.make_state(), {"arm/position"}).names == name_list{"t", "arm/position"});
  CHECK(row_of(c, c.make_state(), {"arm/velocity/x"}).names == name_list{"t", "arm/velocity/x"});
  CHECK_THROWS_WITH(recorder(c, {"arm/position/x"}), contains_text("the coordinate 'arm/position' has"));
}

TEST_CASE("every name of a column selects it, also of signals that are vectors") {
  runtime_chain c;
  c << revolute_joint_3D("arm", "base", "body", axis::z) << inertia_3D("body", point_mass(1.0))
    << external_force_3D("body", "thrust", "rotor/torque");
  const auto all = row_of(c, c.make_state(), {}).names;
  for (const auto& name : all) {
    INFO(name);
    CHECK(row_of(c, c.make_state(), {name}).names == (name == "t" ? name_list{"t"} : name_list{"t", name}));
  }
  CHECK(row_of(c, c.make_state(), {"thrust", "t"}).names == name_list{"t", "thrust/x", "thrust/y", "thrust/z"});
  CHECK(row_of(c, c.make_state(), {"rotor/torque/y"}).names == name_list{"t", "rotor/torque/y"});
  CHECK_THROWS_WITH(recorder(c, {"thrust/w"}), contains_text("'thrust' has thrust/x, thrust/y, thrust/z"));
}

TEST_CASE("what is called like the time or an energy has its kind in its columns") {
  runtime_chain c;
  c << revolute_joint_3D("t", "base", "energy", axis::z) << inertia_3D("energy", point_mass(1.0))
    << driving_actuator_gen("t", "energy/total");
  auto s = c.make_state();
  s.coordinate("t").q = 2;
  recorder rec(c, {"t", "coordinate:t", "t/v", "energy/position/x", "signal:energy/total"});
  rec.row(5, s);
  CHECK(rec.contents().names ==
        name_list{"t", "coordinate:t", "coordinate:t/v", "energy/position/x", "signal:energy/total"});
  CHECK(rec.contents()["t"] == std::vector<double>{5});
  CHECK(rec.contents()["coordinate:t"] == std::vector<double>{2});
  CHECK(row_of(c, s, {}).names[1] == "coordinate:t");
  CHECK_THROWS_WITH(recorder(c, {"energy/total"}), contains_text("compute kte::energy of the chain"));
}

TEST_CASE("two quantities whose columns would have one name are refused") {
  runtime_chain c;
  c << revolute_joint_3D("a", "base", "body", axis::z) << revolute_joint_3D("a/v", "body", "hand", axis::z)
    << inertia_3D("hand", point_mass(1.0));
  CHECK_THROWS_WITH(recorder(c), contains_text("two quantities have the column 'a/v', of the coordinate 'a' and of the "
                                               "coordinate 'a/v': one of them needs another name"));
  CHECK(row_of(c, c.make_state(), {"a", "a/v"}).names == name_list{"t", "a", "a/v"});
}

TEST_CASE("a state of another runtime chain is rejected") {
  auto c = models::element_by_element(models::pendulum);
  recorder rec(c, {"q"});
  const auto s = c.make_state();
  rec.row(0, s);
  c << inertia_2D("tip", point_mass(1.0));
  CHECK_THROWS_WITH(rec.row(1, c.make_state()), contains_text("made for another chain"));
  rec.row(1, s);
  CHECK(rec.contents()["t"] == std::vector<double>{0, 1});
}

}  // namespace recorder_test
