/// What `kte eval` prints, and what it says of bad tables.
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>

#include <sstream>

#include "catch.hpp"
#include "digits50.hpp"
#include "eval/fixed_bodies.hpp"
#include "eval/rows.hpp"
#include "eval/runtime_model.hpp"
#include "eval/static_main.hpp"
#include "io/scratch.hpp"

namespace eval_test {

struct state_file : kte::test::scratch {
  explicit state_file(const std::string& text) : scratch(".csv", text) {}
};

// clang-format off
inline constexpr struct q_    final : kte::coord_key<"q">       {} q;
inline constexpr struct base_ final : kte::frame_3D_key<"base"> {} base;
inline constexpr struct arm_  final : kte::frame_3D_key<"arm">  {} arm;
inline constexpr struct tip_  final : kte::frame_3D_key<"tip">  {} tip;
// clang-format on

/// A pendulum of 3 kg at 0.5 m, which turns about z; gravity is along -y.
kte::runtime_chain pendulum() {
  kte::runtime_chain c;
  c.gravity(kte::along_y(-10.0)) << kte::revolute_joint_3D("q", "base", "arm", kte::axis::z)
                                 << kte::rigid_link_3D("arm", "tip", kte::along_x(0.5))
                                 << kte::inertia_3D("tip", kte::point_mass(3.0));
  return c;
}

template <class S>
std::vector<std::string> table_of(const kte::runtime_chain& c, const std::string& states,
                                  const std::vector<std::string>& coordinates, const evaluate::options& o) {
  const state_file file(states);
  const evaluate::state_table table(file.path);
  evaluate::runtime_model<S> model(c, o.frames);
  std::istringstream text(evaluate::row_writer(model, table, coordinates, o).text());
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}
std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> x;
  std::istringstream cells(line);
  for (std::string cell; std::getline(cells, cell, ',');) x.push_back(std::stod(cell));
  return x;
}

TEST_CASE("a row has what the closed forms of a pendulum say") {
  evaluate::options o;
  o.frames = {"tip"}, o.derivatives = true;
  const auto lines = table_of<double>(pendulum(), "tau_0,a_0,v_0,q_0\n2,0.25,2,0.5\n", {"q"}, o);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] ==
        "id_0,fd_0,M_0_0,kinetic,potential,com_x,com_y,com_z,tip_x,tip_y,tip_z,tip_R_0_0,tip_R_0_1,tip_R_0_2,tip_R_1_0,"
        "tip_R_1_1,tip_R_1_2,tip_R_2_0,tip_R_2_1,tip_R_2_2,tip_J_0_0,tip_J_1_0,tip_J_2_0,tip_J_3_0,tip_J_4_0,tip_J_5_0,"
        "did_dq_0_0,did_dv_0_0,dfd_dq_0_0,dfd_dv_0_0");
  const double c = std::cos(0.5), s = std::sin(0.5), g = 15 * c;  // m g l cos q
  const std::vector<double> expected{0.75 * 0.25 + g,
                                     (2 - g) / 0.75,
                                     0.75,
                                     1.5,
                                     15 * s,
                                     0.5 * c,
                                     0.5 * s,
                                     0,
                                     0.5 * c,
                                     0.5 * s,
                                     0,
                                     c,
                                     -s,
                                     0,
                                     s,
                                     c,
                                     0,
                                     0,
                                     0,
                                     1,
                                     -0.5 * s,
                                     0.5 * c,
                                     0,
                                     0,
                                     0,
                                     1,
                                     -15 * s,
                                     0,
                                     20 * s,
                                     0};
  const auto row = numbers_of(lines[1]);
  REQUIRE(row.size() == expected.size());
  for (std::size_t i = 0; i < row.size(); ++i)
    CHECK(row[i] == within(expected[i], 4e-15 * (1 + std::abs(expected[i]))));
}

TEST_CASE("a robot that is a type has the same rows") {
  constexpr auto chain =
      kte::chain(kte::revolute_joint_3D(q, base, arm, kte::axis::z), kte::rigid_link_3D(arm, tip, kte::along_x(0.5)),
                 kte::inertia_3D(tip, kte::point_mass(3.0)))
          .gravity(kte::along_y(-10.0));
  using frame = decltype(evaluate::frame_named<"tip">(chain));
  STATIC_REQUIRE(std::is_same_v<frame, tip_>);
  evaluate::options o;
  o.frames = {"tip"}, o.derivatives = true;
  const std::string states = "tau_0,a_0,v_0,q_0\n2,0.25,2,0.5\n";
  const auto expected = table_of<double>(pendulum(), states, {"q"}, o);
  const state_file file(states);
  const evaluate::state_table table(file.path);
  evaluate::static_model<double, decltype(chain), frame> model(chain);
  const auto text = evaluate::row_writer(model, table, {"q"}, o).text();
  CHECK(text.starts_with(expected[0] + "\n"));
  const auto row = numbers_of(text.substr(expected[0].size() + 1)), same = numbers_of(expected[1]);
  REQUIRE(row.size() == same.size());
  for (std::size_t i = 0; i < row.size(); ++i) CHECK(row[i] == within(same[i], 4e-15 * (1 + std::abs(same[i]))));
}

TEST_CASE("operations are chosen by name") {
  evaluate::options o;
  o.ops = "g,com,h,did";
  const auto lines = table_of<double>(pendulum(), "q_0,v_0,a_0\n0.5,2,1\n", {"q"}, o);
  CHECK(lines.at(0) == "g_0,h_0,com_x,com_y,com_z,did_dq_0_0,did_dv_0_0");
  const auto row = numbers_of(lines.at(1));
  CHECK(row[0] == within(15 * std::cos(0.5), 1e-14));
  CHECK(row[1] == row[0]);
  CHECK(row[5] == within(-15 * std::sin(0.5), 1e-14));
  o.ops = "fd";
  CHECK_THROWS_MATCHES(table_of<double>(pendulum(), "q_0,v_0\n0.5,2\n", {"q"}, o), kte::bad_file,
                       kte::test::says("missing columns: tau_0"));
  o.ops = "m,fdd";
  CHECK_THROWS_MATCHES(table_of<double>(pendulum(), "q_0,v_0\n", {"q"}, o), kte::bad_argument,
                       kte::test::says("there is no operation 'fdd', but id, fd, m, g, h, energy, com, did, dfd"));
}

TEST_CASE("what needs columns that are not there is left out, and there may be no rows") {
  evaluate::options o;
  const auto lines = table_of<double>(pendulum(), "q_0,v_0,time\r\n", {"q"}, o);
  CHECK(lines == std::vector<std::string>{"M_0_0,kinetic,potential,com_x,com_y,com_z"});
}

TEST_CASE("names and numbers of columns may be in quotes, with commas and quotes within") {
  const state_file file("\"time, \"\"s\"\"\" , \"q_0\",\"a,b\",v_0,\n\"1\",2, \" 3 \" ,+4,5\r\n");
  const evaluate::state_table table(file.path);
  REQUIRE(table.rows() == 1);
  CHECK(table.at(0, table.columns("q_", 1, true)[0]) == 2);
  CHECK(table.at(0, table.columns("v_", 1, true)[0]) == 4);
}

TEST_CASE("names that are printed are read again, whatever is in them") {
  evaluate::output<double> out(17);
  out.put("a,\"b\"_x", 1), out.put("q_0", 2);
  out.end_row();
  CHECK(out.text() == "\"a,\"\"b\"\"_x\",q_0\n1,2\n");
  const state_file file(out.text());
  const evaluate::state_table table(file.path);
  CHECK(table.at(0, table.columns("q_", 1, true)[0]) == 2);
}

TEST_CASE("fifty digits are right digits") {
  evaluate::options o;
  o.digits = 50;
  const auto lines = table_of<kte::test::digits50>(pendulum(), "q_0,v_0\n0.5,2\n", {"q"}, o);
  // 15 sin(1/2)
  CHECK_THAT(lines.at(1), kte::test::contains_text(",7.1913830790630450040993190282335708212270505191090e+00,"));
  CHECK(lines.at(1).starts_with("7.5000000000000000000000000000000000000000000000000e-01,1.5"));
}

TEST_CASE("columns go in the order of the file, quaternions with w last") {
  kte::runtime_chain c;
  c << kte::revolute_joint_3D("a", "world", "x") << kte::free_joint_3D("b", "world", "y");
  const evaluate::column_order order(kte::layout(c), {"b", "a"});
  CHECK(order.q == std::vector<int>{1, 2, 3, 5, 6, 7, 4, 0});
  CHECK(order.v == std::vector<int>{1, 2, 3, 4, 5, 6, 0});
}

TEST_CASE("bodies that do not move are left out") {
  auto c = pendulum();
  c << kte::inertia_3D("base", kte::point_mass(1.0)) << kte::rigid_link_3D("base", "foot", kte::along_z(1.0))
    << kte::inertia_3D("foot", kte::point_mass(1.0));
  const auto moving = evaluate::without_fixed_bodies(c);
  CHECK(record_of(moving).elements.size() == 4);
  CHECK(moving.gravity() == c.gravity());
  auto s = moving.make_state();
  CHECK(kte::centre_of_mass(moving, s).mass == 3.0);
}

TEST_CASE("bad tables are refused with file, line and column, or the names of columns") {
  const auto says = [](const std::string& text, const std::string& message) {
    const state_file file(text);
    evaluate::options o;
    const auto c = pendulum();
    evaluate::runtime_model<double> model(c, o.frames);
    CHECK_THROWS_MATCHES(
        (evaluate::row_writer<evaluate::runtime_model<double>>(model, evaluate::state_table(file.path), {"q"}, o)),
        kte::bad_file, kte::test::says(file.path.string() + message));
  };
  says("q_0,v_0\n1,2\n\n 3 , abc\n", ":4:6: 'abc' is not a number");
  says("q_0,v_0\n1,inf\n", ":2:3: 'inf' is not finite");
  says("q_0,v_0\n1,\n", ":2:3: '' is not a number");
  says("q_0,v_0\n1,2,3\n", ":2:5: more numbers than the 2 columns");
  says("q_0,v_0\n1\n", ":2:2: 1 numbers for 2 columns");
  says("q_0,q_0\n", ":1:5: a second column 'q_0'");
  says("q_0\n", ":1: missing columns: v_0");
  says("q_0,v_0,v_1\n", ":1: a column v_1, but there are 1 of them, from v_0");
  says("", ": has no line of column names");
  says("q_0,v_0\n1,2\n1,\"2\"3\n", ":3:3: '2' does not end at its closing quote");
  says("q_0,v_0\n\"1,2\n", ":2:1: '1,2' does not end at its closing quote");
  // Columns are characters, whatever their bytes, also behind the mark of UTF-8.
  says("\xEF\xBB\xBFq_0,v_0,\"\xC3\xA9,\xE2\x82\xAC\",q_0\n", ":1:15: a second column 'q_0'");
  says("q_0,v_0\n\xF0\x9F\x98\x80,2\n", ":2:1: '\xF0\x9F\x98\x80' is not a number");
  says("q_0,v_0,\xC3\xA9\n\"1\",2,\xC3\xA9\n", ":2:7: '\xC3\xA9' is not a number");
  says("q_0,\xC3\xA9,v_0\n1\xC2\xB0,2,3\n", ":2:1: '1\xC2\xB0' is not a number");
  says("q_0,v_0,t\n1,2\n", ":2:4: 2 numbers for 3 columns");
}

}  // namespace eval_test
