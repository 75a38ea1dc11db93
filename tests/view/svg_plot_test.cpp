#include <kte/view/svg/plot.hpp>

#include "catch.hpp"
#include "io/scratch.hpp"
#include "view/svg_document.hpp"

namespace svg_plot_test {

using namespace kte;
using test::message_of;
using test::read_svg;

constexpr double gap = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

table run() {
  table t{{"t", "elbow", "elbow/v", "tool/position/x", "tool/position/y", "tool/torque/z", "motor"}, {}};
  t.columns.resize(t.names.size());
  for (int i = 0; i <= 100; ++i) {
    const double x = i / 10.0;
    const double row[]{x, std::sin(x), std::cos(x), 0.4, 0.1 * x, x * x, -x};
    for (std::size_t j = 0; j < t.columns.size(); ++j) t.columns[j].push_back(row[j]);
  }
  return t;
}
table two_columns(std::vector<double> y) {
  table t{{"t", "y"}, {{}, std::move(y)}};
  for (std::size_t i = 0; i < t.columns[1].size(); ++i) t.columns[0].push_back(static_cast<double>(i));
  return t;
}
bool has(const std::vector<std::string>& all, const std::string& x) {
  return std::find(all.begin(), all.end(), x) != all.end();
}
/// The curves: groups with the name of a column as title.
std::vector<const test::svg_element*> curves(const test::svg_element& root) { return root.all("g"); }
std::vector<std::string> texts(const std::string& svg) { return read_svg(svg).texts("text"); }

TEST_CASE("each quantity has a panel, with its name or that of the column, and its unit") {
  const auto svg = plot(run(), {"elbow", "elbow/v", "tool/position", "tool/torque/z", "motor"},
                        {.title = "A run", .units = {{"elbow", "rad"}, {"motor", "N m"}}});
  const auto root = read_svg(svg);
  CHECK(root["width"] == "170mm");
  CHECK(root.children[0].text == "A run");
  CHECK(root.children[1].text.find("elbow/v is between -0.99") != std::string::npos);
  const auto all = root.texts("text");
  for (const char* x : {"A run", "elbow (rad)", "elbow/v (rad/s)", "position (m)", "tool/position/x", "tool/position/y",
                        "tool/torque/z (N m)", "motor (N m)", "t (s)"})
    CHECK(has(all, x));
  CHECK(curves(root).size() == 6);
  CHECK(curves(root)[2]->children[0].text == "tool/position/x");
}

TEST_CASE("units that are not known are left out, and rates of unknown coordinates are apart from them") {
  const auto all = texts(plot(run(), {"elbow", "motor", "elbow/v"}));
  CHECK(has(all, "elbow"));  // in the legend, with the motor
  CHECK(has(all, "motor"));
  CHECK(has(all, "elbow/v"));
  CHECK_FALSE(has(all, "elbow/v (rad/s)"));
  CHECK(has(texts(plot(run(), {"elbow/v"}, {.units = {{"elbow", "m"}}})), "elbow/v (m/s)"));
  CHECK(has(texts(plot(run(), {"elbow/v"}, {.units = {{"elbow/v", "rpm"}}})), "elbow/v (rpm)"));
  CHECK(detail::svg::meaning_of_column("base:joint/ang_acceleration/y", {}) ==
        detail::svg::column_meaning{"rad/s²", "angular acceleration"});
  CHECK(detail::svg::meaning_of_column("coordinate:q/f", {{"q", "m"}}) == detail::svg::column_meaning{"N", "force"});
  CHECK(detail::svg::meaning_of_column("pull/x", {{"pull", "N"}}) == detail::svg::column_meaning{"N", ""});
  CHECK(detail::svg::meaning_of_column("tip/rotation/w", {}) == detail::svg::column_meaning{"", "quaternion"});
  CHECK(detail::svg::meaning_of_column("energy/total", {}) == detail::svg::column_meaning{"J", "energy"});
  CHECK(detail::svg::meaning_of_column("tool/velocity/x", {{"tool/velocity/x", "m/s^2"}}) ==
        detail::svg::column_meaning{"m/s²", "velocity"});
  CHECK(detail::svg::meaning_of_column("velocity", {}) == detail::svg::column_meaning{});
}

TEST_CASE("one panel for all, one for each, all columns, another column across") {
  CHECK(texts(plot(run(), {}, {.share = panels::together})).size() > 6);
  CHECK(has(texts(plot(run(), {}, {.label = "value", .share = panels::together})), "value"));
  const auto each = texts(plot(run(), {"tool/position"}, {.share = panels::each}));
  CHECK(has(each, "tool/position/x (m)"));
  CHECK(has(each, "tool/position/y (m)"));
  const auto phase = texts(plot(run(), {"elbow/v"}, {.against = "elbow"}));
  CHECK(has(phase, "elbow"));
  CHECK_FALSE(has(phase, "t (s)"));
  CHECK(curves(read_svg(plot(run()))).size() == 6);
  CHECK(curves(read_svg(plot(run(), {"elbow", "elbow"}))).size() == 1);
}

TEST_CASE("columns that are not there are refused by name") {
  const auto t = run();
  CHECK(message_of<unknown_name>([&] { (void)plot(t, {"elbwo"}); }) ==
        "kte: cannot plot 'elbwo': there is no such column, did you mean 'elbow'?");
  CHECK(message_of<unknown_name>([&] { (void)plot(t, {"wheel"}, {.against = "time"}); }) ==
        "kte: cannot plot 'time': there is no such column: there are 't', 'elbow', 'elbow/v', 'tool/position/x', "
        "'tool/position/y', 'tool/torque/z', 'motor'");
  CHECK(message_of<unknown_name>([&] { (void)plot(t, {"tool/positio"}); }) != "");
  CHECK(message_of<bad_argument>([] { (void)plot({}); }) ==
        "kte: a plot needs a table with columns and a name for each");
  CHECK(message_of<bad_argument>([] {
          (void)plot({{"t"}, {{1}}});
        }) == "kte: the table to plot has no column other than 't'");
  CHECK(message_of<bad_argument>([] {
          (void)plot({{"t", "a"}, {{1}, {}}});
        }) == "kte: the column 'a' of the table to plot has another length than 't'");
}

TEST_CASE("sizes that give no picture are refused") {
  const auto t = run();
  CHECK(message_of<bad_argument>([&] { (void)plot(t, {}, {.width = 5}); }) ==
        "kte: a plot is 20 to 2000 mm wide, not 5");
  CHECK(message_of<bad_argument>([&] { (void)plot(t, {}, {.width = gap}); }) != "");
  CHECK(message_of<bad_argument>([&] { (void)plot(t, {}, {.height = -1}); }) != "");
  CHECK(message_of<bad_argument>([&] { (void)plot(t, {}, {.font_size = 100}); }) ==
        "kte: a plot of 170 mm has letters of 1 to 21.25 points, not 100");
  CHECK(message_of<bad_argument>([&] { (void)plot(t, {}, {.from = 2, .to = 1}); }) ==
        "kte: a plot goes from the smaller number to the larger, not from 2 to 1");
  CHECK(message_of<bad_argument>([&] { (void)plot(t, {}, {.height = 30, .share = panels::each}); }) ==
        "kte: a plot of 6 panels needs a height of 76 mm, not 30");
  CHECK(read_svg(plot(t, {}, {.height = 76, .share = panels::each}))["height"] == "76mm");
}

TEST_CASE("NaN is a gap, and a point between gaps is a dot") {
  const auto root = read_svg(plot(two_columns({1, 2, gap, 3, gap, 4, 5})));
  const auto* curve = curves(root).at(0);
  REQUIRE(curve->all("path").size() == 1);
  const auto d = (*curve->all("path")[0])["d"];
  CHECK(std::count(d.begin(), d.end(), 'M') == 2);
  CHECK(curve->all("circle").size() == 1);
}

TEST_CASE("numbers that an axis cannot show are counted in the picture") {
  CHECK(has(texts(plot(two_columns({1, inf, -inf, 2}))), "2 infinite numbers not shown"));
  CHECK(has(texts(plot(two_columns({1, -1, 0, 10, inf}), {}, {.log_y = true})),
            "2 not positive numbers not shown, 1 infinite number not shown"));
  CHECK(has(texts(plot(two_columns({-1, -2}), {}, {.log_y = true})), "2 not positive numbers not shown"));
  CHECK(has(texts(plot(two_columns({gap, gap}))), "no numbers"));
  CHECK(has(texts(plot(two_columns({}))), "no numbers"));
  CHECK(plot(two_columns({gap})).find("y has no numbers to show.") != std::string::npos);
}

TEST_CASE("hard numbers are drawn within the panel") {
  constexpr double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  for (const auto& y : std::vector<std::vector<double>>{{7, 7, 7},
                                                        {0, 0},
                                                        {1e-300, 2e-300},
                                                        {1e300, -1e300},
                                                        {most, -most},
                                                        {least, 0},
                                                        {5},
                                                        {1, 1 + 1e-15},
                                                        {most, least}}) {
    for (const bool logarithmic : {false, true}) {
      const auto root = read_svg(plot(two_columns(y), {}, {.log_y = logarithmic}));
      const double width = std::stod(root["width"]), height = std::stod(root["height"]);
      for (const auto* e : root.all("circle")) {
        CHECK(e->number("cx") < width);
        CHECK(e->number("cy") < height);
        CHECK(e->number("cy") > 0);
      }
      for (const auto* e : root.all("text")) {
        if ((*e)["y"].empty()) continue;
        CHECK(e->number("y") > 0);
        CHECK(e->number("y") <= height);
        CHECK(e->number("x") <= width);
      }
    }
  }
}

TEST_CASE("long recordings are thinned to what shows, and keep their spikes") {
  table t{{"t", "y"}, {{}, {}}};
  for (int i = 0; i < 1000000; ++i) {
    t.columns[0].push_back(i * 1e-3);
    t.columns[1].push_back(i == 654321 ? 5.0 : std::sin(i * 1e-2));
  }
  const auto text = plot(t, {}, {.width = 85, .height = 60});
  CHECK(text.size() < 60000);
  const auto root = read_svg(text);
  // The spike is the highest: its place is 4 % of the range below the top of the panel.
  const auto* curve = curves(root).at(0);
  const std::string d = (*curve->all("path")[0])["d"];
  double x = 0, y = 0, top = 1e9, at = 0;
  const char* p = d.c_str();
  char command = 0;
  while (*p != 0) {
    if (std::isalpha(static_cast<unsigned char>(*p)) != 0) command = *p++;
    char* end{};
    const double a = std::strtod(p, &end), b = std::strtod(end, &end);
    p = end;
    while (*p == ' ') ++p;
    x = command == 'M' ? a : x + a, y = command == 'M' ? b : y + b;
    if (y < top) top = y, at = x;
  }
  const auto frame = root.all("path").back();  // the axes are drawn behind the curves
  double left = 0, high = 0, low = 0, right = 0;
  REQUIRE(std::sscanf((*frame)["d"].c_str(), "M%lf %lfV%lfH%lf", &left, &high, &low, &right) == 4);
  CHECK(top == within(high + 0.04 / 1.08 * (low - high), 0.04));
  CHECK(at == within(left + 0.654321 * (right - left), 0.1));
}

TEST_CASE("many rounds of a limit cycle, and many gaps, take little more than one") {
  table t{{"t", "x", "y", "every_third"}, {{}, {}, {}, {}}};
  for (int i = 0; i < 300000; ++i) {
    t.columns[0].push_back(i * 1e-3), t.columns[1].push_back(std::cos(0.05 * i));
    t.columns[2].push_back(std::sin(0.05 * i) + 1e-4 * std::sin(0.01 * i)),
        t.columns[3].push_back(i % 3 == 0 ? 1 : gap);
  }
  CHECK(plot(t, {"y"}, {.width = 85, .against = "x"}).size() < 300000);
  const auto dots = read_svg(plot(t, {"every_third"}, {.width = 85})).all("circle").size();
  CHECK(dots > 300);
  CHECK(dots < 900);
}

TEST_CASE("only rows of a part of the horizontal axis are drawn, with an axis for them") {
  const auto all = texts(plot(run(), {"tool/position/y"}, {.from = 2, .to = 4}));
  CHECK(has(all, "4.0"));
  CHECK_FALSE(has(all, "5"));
  CHECK_FALSE(has(all, "0"));
}

TEST_CASE("hostile names do no harm") {
  const std::string names[]{"</svg><script>alert(1)</script>",
                            "a\"b'c&d;&lt;",
                            std::string("nul\0x", 5),
                            "\x01\x02\x1b[0m",
                            "\xFF\xFE\xC0\x80",
                            "\xED\xA0\x80",
                            "\xEF\xBF\xBF",
                            "]]>",
                            "<!--",
                            std::string(10000, 'x'),
                            "\xE2\x80\xAE"
                            "flip",
                            "日本語の名前",
                            "",
                            " ",
                            "\n"};
  table t{{"t\"<>&"}, {{0, 1, 2}}};
  for (const auto& n : names) t.names.push_back(n), t.columns.push_back({1, 2, 3});
  for (const auto share : {panels::together, panels::each}) {
    const auto text = plot(t, {},
                           {.font = "\"><x",
                            .title = names[0] + names[4],
                            .label = names[1],
                            .units = {{names[1], "<m&\x03>"}},
                            .share = share});
    const auto root = read_svg(text);
    CHECK(root.all("script").empty());
    CHECK(curves(root).size() == std::size(names));
    CHECK(curves(root)[0]->children[0].text == names[0]);
    CHECK(text.size() < 60000);
  }
}

TEST_CASE("seventeen curves and more differ, by colours and dashes or by colours alone") {
  table t{{"t"}, {{0, 1}}};
  for (int i = 0; i < 40; ++i) t.names.push_back("joint_" + std::to_string(i)), t.columns.push_back({i * 1.0, 2.0 * i});
  const auto root = read_svg(plot(t));
  std::map<std::string, int> styles;
  for (const auto* c : curves(root)) {
    const auto& p = *c->all("path").at(0);
    ++styles[p["stroke"] + p["stroke-dasharray"] + p["stroke-width"]];
  }
  CHECK(styles.size() == 40);
  CHECK(plot(t, {}, {.dashed = false}).find("dasharray") == std::string::npos);
}

TEST_CASE("a plot is written into a file, of the size of a column of a journal") {
  const test::scratch file(".svg");
  const table t = run();
  write_plot(file.path, t, {"elbow"}, {.width = 85});
  CHECK(file.text() == plot(t, {"elbow"}, {.width = 85}));
  CHECK(read_svg(file.text())["width"] == "85mm");
  CHECK(message_of<bad_file>([&] { write_plot(file.path / "x.svg", t); }) != "");
}

}  // namespace svg_plot_test
