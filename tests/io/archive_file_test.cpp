#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/io/archive_file.hpp>
#include <kte/io/model_file.hpp>
#include <kte/reak/mass_matrix_calc.hpp>

#include <cstring>
#include <locale>

#include "catch.hpp"
#include "chain/elements_page.hpp"
#include "chain/models.hpp"
#include "io/all_formats.hpp"
#include "robots/iiwa14.hpp"

namespace archive_file_test {

using namespace models;
using kte::test::contains_text, kte::test::in_all_formats, kte::test::scratch, kte::test::within;

const std::filesystem::path data =
    std::filesystem::path(__FILE__).lexically_normal().parent_path().parent_path() / "data";

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}
constexpr auto golden = pendulum.gravity(kte::along_y(-9.81));

/// Decimal commas, and points between thousands.
struct comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// The roots of the tutorial of the predecessor.
kte::archive tutorial(const kte::runtime_chain& c, const kte::runtime_state& s) {
  kte::archive a;
  a.add("joint_coord", "q", s.coordinate("q")).add("pendulum", c).add("end_frame", "tip", s.frame_2D("tip"));
  return a.add("mass_mat1", kte::mass_matrix_calc(c) << kte::all_inertias << kte::all_coordinates);
}

TEST_CASE("a coordinate, a chain, a frame and a calculator in one file share what they have in common") {
  kte::runtime_chain c;
  c << golden;
  auto s = c.make_state();
  s.coordinate("q").q = 0.1, s.coordinate("q").q_dot = -1.0 / 3, s.coordinate("q").q_ddot = 1e-300;
  c.doMotion(s), c.clearForce(s), c.doForce(s);
  in_all_formats(tutorial(c, s), [&](const kte::archive& b) {
    CHECK(b.names() == std::vector<std::string>{"joint_coord", "pendulum", "end_frame", "mass_mat1"});
    const auto d = b.chain("pendulum", models::registry());
    CHECK(record_of(d) == record_of(c));
    auto t = d.make_state();
    b.restore("joint_coord", t), b.restore("end_frame", t);
    CHECK(same_bits(t.coordinate("q"), s.coordinate("q")));
    CHECK(same_bits(t.frame_2D("tip"), s.frame_2D("tip")));
    // of this state, which the chain moves and the calculator reads
    d.doMotion(t), d.clearForce(t), d.doForce(t);
    CHECK(same_bits(t.frame_2D("tip"), s.frame_2D("tip")));
    const auto calculator = b.calculator("mass_mat1", d);
    CHECK(calculator.inertias() == std::vector<std::string>{"tip"});
    CHECK(calculator.mass_matrix(t)(0, 0) == kte::mass_matrix(c, s)(0, 0));
    CHECK(b.thing<kte::gen_coord<>>("joint_coord").q == 0.1);
    CHECK(b.name_of_thing("end_frame") == "tip");
    // into a static chain and its state
    const auto e = b.chain("pendulum", golden);
    auto u = kte::make_state(e);
    b.restore("joint_coord", u);
    CHECK(u[q].q_dot == -1.0 / 3);
    CHECK(u[q].sin == s.coordinate("q").sin);
  });
}

TEST_CASE("golden archives of version 2 can be read for ever") {
  kte::runtime_chain c;
  c << golden;
  auto s = c.make_state();
  s.coordinate("q").q = 0.1;
  c.doMotion(s), c.clearForce(s), c.doForce(s);
  auto limits = kte::unlimited(c);
  limits.upper[0] = 1.5, limits.effort[0] = 20;
  auto a = tutorial(c, s);
  a.add("robot", c, {"tip"}, limits).add("start", s).add("v", std::array{0.5L, 0.1L});
  CHECK(kte::load_archive(data / "tutorial.json").record() == a.record());
  CHECK(kte::load_archive(data / "tutorial.xml").record() == a.record());
  CHECK(kte::load_archive(data / "tutorial.kte").record() == a.record());
  CHECK(kte::to_json(a.record()) == kte::detail::read_file(data / "tutorial.json"));
  CHECK(kte::to_xml(a.record()) == kte::detail::read_file(data / "tutorial.xml"));
  CHECK(kte::to_binary(a.record()) == kte::detail::read_file(data / "tutorial.kte"));
  const std::locale before = std::locale::global(std::locale(std::locale(), new comma));
  const auto with_comma = kte::to_xml(a.record());
  const auto read_with_comma = kte::load_archive(data / "tutorial.json");
  std::locale::global(before);
  CHECK(with_comma == kte::to_xml(a.record()));
  CHECK(read_with_comma.record() == a.record());
  CHECK(kte::load_archive(data / "pendulum.xml").names() == std::vector<std::string>{"model"});
}

TEST_CASE("every element and every kind of thing") {
  kte::archive a;
  kte::model_record all;
  for (const auto& [type, record] : elements_page::records()) all.elements.push_back(record);
  CHECK(all.elements.size() > 90);
  for (const auto& back :
       {kte::from_json(kte::to_json(all)), kte::from_xml(kte::to_xml(all)), kte::from_binary(kte::to_binary(all))})
    CHECK(back == all);

  kte::runtime_chain c;
  c << kte::base_3D("w") << kte::base_2D("p") << kte::free_joint_3D("x", "w", "body")
    << kte::free_joint_2D("y", "p", "disc") << kte::spherical_joint_3D("r", "body", "hand")
    << kte::joint_lugre_gen(
           "g", "z",
           {.sigma0 = 1e5, .sigma1 = 316, .sigma2 = 0.4, .coulomb = 1, .stiction = 1.5, .stribeck_velocity = 1e-3})
    << kte::driving_actuator_gen("g", "u") << kte::inertia_gen("g", 2.0) << kte::driving_actuator_3D("hand", "f", "t");
  auto s = c.make_state();
  double next = 0.1;
  kte::detail::for_each_thing(s, [&next](auto, auto, auto& x) {
    kte::detail::visit_quantities(x, [&next](auto, auto& value) {
      kte::detail::visit_numbers_of(value, [&next](double& number) { number = next *= -1.1; });
      if constexpr (requires { value.cos; }) {
        value = kte::rotation_by(next);
      } else if constexpr (requires { value.x.x; }) {
        value = matrix(kte::normalized(1.0, next, 0.3, -0.2));
      }
    });
  });
  s.coordinate("g").f = std::numeric_limits<double>::infinity(), s.coordinate("g").q_ddot = -0.0;
  s.internal("z").z = std::nan("");
  a.add("s", s).add("q", positions(s)).add("v", velocities(s)).add("hand", "hand", s.frame_3D("hand"));
  for (const char* extension : {".xml", ".json", ".kte"}) {
    const scratch file(extension);
    kte::save_archive(file.path, a);
    const auto b = kte::load_archive(file.path);
    auto t = c.make_state();
    b.restore("s", t);
    kte::detail::for_each_thing(s, [&t](kte::kind k, auto name, const auto& x) {
      kte::detail::for_each_thing(t, [&](kte::kind l, auto other, const auto& y) {
        if constexpr (std::is_same_v<decltype(x), decltype(y)>)
          if (k == l && name == other)
            CHECK(kte::to_json(kte::archive().add("x", std::string(name), x).record()) ==
                  kte::to_json(kte::archive().add("x", std::string(name), y).record()));
      });
    });
    CHECK(std::isnan(t.internal("z").z));
    CHECK(std::signbit(t.coordinate("g").q_ddot));
    CHECK(same_bits(t.frame_3D("hand"), s.frame_3D("hand")));
    t = c.make_state();
    set_positions(t, b.numbers("q")), set_velocities(t, b.numbers("v"));
    CHECK(positions(t) == positions(s));
    CHECK(velocities(t) == velocities(s));
  }
}

TEST_CASE("states of float and long double, bit for bit") {
  auto wide = kte::make_state<long double>(golden);
  wide[q].q = 0.1L, wide[q].q_dot = 1 / 3.0L, wide[q].q_ddot = -1e-4000L, wide[tip].position.x = 1e4000L;
  auto narrow = kte::make_state<float>(golden);
  narrow[q].q = 0.1f, narrow[q].q_dot = 1e-45f;
  in_all_formats(kte::archive().add("wide", wide).add("narrow", narrow), [&](const kte::archive& b) {
    auto w = kte::make_state<long double>(golden);
    b.restore("wide", w);
    CHECK((w[q].q == 0.1L && w[q].q_dot == 1 / 3.0L && w[q].q_ddot == -1e-4000L && w[tip].position.x == 1e4000L));
    auto n = kte::make_state<float>(golden);
    b.restore("narrow", n);
    CHECK((n[q].q == 0.1f && n[q].q_dot == 1e-45f));
  });
}

TEST_CASE("calculators come back with their contents") {
  kte::runtime_chain c;
  c << robots::iiwa14;
  kte::mass_matrix_calc calc(c);
  const auto& frames = c.wiring().names[static_cast<std::size_t>(kte::kind::frame_3D)];
  const auto& joints = c.wiring().names[static_cast<std::size_t>(kte::kind::gen)];
  const auto masses = kte::mass_matrix_calc(c) << kte::all_inertias << kte::all_coordinates;
  std::vector<std::string> on;
  for (const auto& f : frames)
    if (on.size() < 2) try {
        calc << kte::inertia_on(f);
        on.push_back(f);
      } catch (const kte::bad_argument&) {
      }
  calc << kte::moved_by(joints.at(3)) << kte::moved_by(joints.at(1));
  auto s = c.make_state();
  const std::vector<double> q{0.1, -0.4, 0.3, 1.2, 0.2, -0.6, 0.5};
  const auto m = calc.mass_matrix(s, q);
  CHECK_THROWS_WITH(kte::archive().add("calc", calc), contains_text("must be in the archive before"));
  in_all_formats(kte::archive().add("arm", robots::iiwa14).add("calc", calc), [&](const kte::archive& b) {
    const auto d = b.chain("arm", models::registry());
    const auto again = b.calculator("calc", d);
    CHECK(again.inertias() == on);
    CHECK(again.columns() == calc.columns());
    auto t = d.make_state();
    CHECK(again.mass_matrix(t, q) == m);
    // and the arm itself is bit for bit what it was
    s = c.make_state();
    CHECK(record_of(d) == record_of(c));
    CHECK(inverse_dynamics(d, t, q, q, q) == inverse_dynamics(c, s, q, q, q));
    CHECK(mass_matrix(d, t, q) == mass_matrix(c, s, q));
  });
}

TEST_CASE("what is not there, or something else, is said by name") {
  const auto message = [](const auto& f) { return kte::test::message_of<kte::error>(f); };
  kte::runtime_chain c;
  c << golden;
  auto s = c.make_state();
  kte::archive a = tutorial(c, s);
  CHECK(message([&] { (void)a.chain("arm", models::registry()); }) ==
        "kte: the archive has no 'arm'; it has 'joint_coord' 'pendulum' 'end_frame' 'mass_mat1'");
  CHECK(message([&] { (void)a.chain("end_frame", models::registry()); }) ==
        "kte: 'end_frame' of the archive is 'thing', not a chain");
  CHECK(message([&] { a.add("pendulum", c); }) == "kte: the archive has a 'pendulum' already");
  CHECK(message([&] { (void)a.thing<kte::gen_coord<>>("end_frame"); }) ==
        "kte: 'end_frame' of the archive is '2D frame', not coordinate");
  kte::runtime_chain longer;
  longer << golden << kte::damper_gen("q", "w", 1.0);
  CHECK(message([&] { (void)a.calculator("mass_mat1", longer); }) ==
        "kte: 'mass_mat1' of the archive is of its chain 'pendulum', not of this one");
  auto heavier = c;
  heavier.gravity(kte::along_y(-9.82));
  CHECK(message([&] {
          (void)a.calculator("mass_mat1", heavier);
        }).ends_with("is of its chain 'pendulum', not of this one"));
  CHECK(message([&] { a.add("of another", kte::mass_matrix_calc(heavier) << kte::all_inertias); }) ==
        "kte: the chain of a mass_matrix_calc must be in the archive before it");
  kte::archive b;
  b.add("x", "elbow", kte::gen_coord<>{.q = 1});
  s.coordinate("q").q = 3;
  CHECK(message([&] { b.restore("x", s); }) == "kte: the chain has no coordinate 'elbow'");
  const auto restored = [&](const std::string& values) {
    return message([&] {
      kte::archive x(kte::detail::read_archive(
          R"({"kte_archive":{"version":2,"roots":[{"name":"x","thing":{"type":"coordinate","name":"q","values":{)" +
              values + "}}}]}}",
          "m", kte::model_format::json, {}));
      x.restore("x", s);
    });
  };
  CHECK(restored("\"q\":1,\"dq\":2").ends_with("coordinate 'q' has no 'dq'"));
  CHECK(restored("\"q_dot\":[1,2]").ends_with("coordinate 'q' has 2 numbers as 'q_dot', not 1"));
  CHECK(restored("\"q_dot\":[]").ends_with("coordinate 'q' has 0 numbers as 'q_dot', not 1"));
  CHECK(s.coordinate("q").q == 3);
  CHECK(restored("\"q_dot\":4").empty());
  CHECK((s.coordinate("q").q == 3 && s.coordinate("q").q_dot == 4));

  // frames live apart from what else has a name
  const kte::thing_record one{kte::kind::gen, "q", {}}, other{kte::kind::frame_2D, "q", {}};
  in_all_formats(kte::archive({{{"s", kte::state_record{{one, other}}}}}), [](const auto&) {});
  for (const auto& x : {one, other})
    CHECK(message([&] {
            (void)kte::to_binary(kte::archive_record{{{"s", kte::state_record{{x, x}}}}});
          }) == "kte: root 's': it has two things 'q'");

  const scratch file(".json");
  kte::save_archive(file.path, kte::archive().add("one", golden).add("two", golden));
  CHECK(message([&] {
          (void)kte::load_model(file.path);
        }).ends_with("an archive of several chains, for load_archive: 'one' 'two'"));
  kte::save_archive(file.path, kte::archive().add("one", golden).add("q", std::array{1.0}));
  CHECK(kte::load_model(file.path) == record_of(golden));
}

TEST_CASE("rotations that are none are refused by name, and the state is as before") {
  kte::runtime_chain c;
  c << kte::base_2D("plane") << kte::base_3D("space") << kte::spherical_joint_3D("ball", "space", "hand")
    << kte::free_joint_3D("free", "space", "body");
  auto s = c.make_state();
  s.frame_2D("plane").position.x = 3, s.frame_2D("plane").rotation = kte::rotation_by(0.1);
  const auto before = record_of(s);
  const auto restored = [&](const std::string& type, const std::string& name, const std::string& rotation) {
    const kte::archive a(
        kte::detail::read_archive(R"({"kte_archive":{"version":2,"roots":[{"name":"x","state":[{"type":")" + type +
                                      R"(","name":")" + name + R"(","values":{"rotation":")" + rotation + "\"}}]}]}}",
                                  "m", kte::model_format::json, {}));
    return kte::test::message_of<kte::bad_file>([&] { a.restore("x", s); });
  };
  for (const std::string none : {"0 0", "2 0", "1 0.01", "nan nan", "inf 0", "0 -inf", "nan 1"})
    CHECK(restored("frame_2D", "plane", none)
              .ends_with("2D frame 'plane' has '" + none +
                         "' as 'rotation', which must be the cosine and sine of an angle"));
  for (const std::string none : {"0 0 0 0 0 0 0 0 0", "2 0 0 0 2 0 0 0 2", "1 0 0 0 1 0 0 0 -1", "1 0 0 0 1 0 0 1 0",
                                 "1 0 0 0 1 0 0 0 nan", "1 0.01 0 0 1 0 0 0 1"})
    CHECK(restored("frame_3D", "space", none)
              .ends_with("3D frame 'space' has '" + none +
                         "' as 'rotation', which must be orthonormal and right-handed"));
  for (const std::string none : {"0 0 0 0", "nan 0 0 0", "1 0 0 inf"}) {
    CHECK(restored("rotation_3D", "ball", none).ends_with("which must be finite and not of length 0"));
    CHECK(restored("pose_3D", "free", none).ends_with("which must be finite and not of length 0"));
  }
  CHECK(record_of(s) == before);
  CHECK(restored("frame_2D", "plane", "0.6 -0.8").empty());
  CHECK(restored("frame_3D", "space", "0 -1 0 1 0 0 0 0 1").empty());
  CHECK(restored("rotation_3D", "ball", "3 0 0 -4").empty());  // of any length
  CHECK(s.frame_2D("plane").rotation == kte::rotation_2D{0.6, -0.8});
  CHECK(s.frame_2D("plane").position.x == 3);
  CHECK(s.rotation_3D("ball").matrix.x.x == within(-0.28, 1e-15));
}

TEST_CASE("of a coordinate with several limits some may be none") {
  kte::runtime_chain c;
  c << kte::free_joint_3D("x", "w", "body") << kte::revolute_joint_3D("q", "body", "arm", kte::axis::z);
  auto limits = kte::unlimited(c);
  limits.upper[1] = 2.5, limits.effort[5] = 20;
  in_all_formats(kte::archive().add("arm", c, limits), [&](const kte::archive& b) {
    CHECK(b.limits("arm", c) == limits);
    CHECK(b.model("arm").limits.size() == 1);
  });
}

}  // namespace archive_file_test
