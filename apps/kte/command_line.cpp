#include "command_line.hpp"

#include <kte/contract/nearest_name.hpp>
#include <kte/io/program.hpp>
#include <kte/io/table_number.hpp>

#include <CLI/CLI.hpp>

#include "message.hpp"

namespace kte_tool {

namespace {

double finite_number(const std::string& option, const std::string& text) {
  double x{};
  if (!kte::detail::read_number(std::string_view(text).substr(text.starts_with('+')), x))
    throw usage_error(option + ": '" + text + "' is not a number");
  if (!std::isfinite(x)) throw usage_error(option + ": '" + text + "' is not finite");
  return x;
}

/// The text of an option, which the variable of a script may have left empty.
const std::string& not_empty(const std::string& option, const std::string& text) {
  if (text.empty()) throw usage_error(option.substr(option.rfind(',') + 1) + " is empty");
  return text;
}

/// A subcommand as CLI11 has it.
class parsed_command final : public command {
 public:
  explicit parsed_command(CLI::App& app) : app_(app) {}

  command& word(const std::string& n, std::string& to, const std::string& help, bool needed) override {
    arguments.push_back({n, "", help, true, needed});
    auto* const o = app_.add_option_function<std::string>(n, [&to](const std::string& text) { to = text; });
    if (needed) o->required();
    return *this;
  }
  command& words(const std::string& n, std::vector<std::string>& to, const std::string& help) override {
    arguments.push_back({n + "...", "", help, true, false});
    app_.add_option(n, to);
    return *this;
  }
  command& flag(const std::string& n, bool& to, const std::string& help) override {
    arguments.push_back({n, "", help});
    app_.add_flag_callback(n, [&to] { to = true; });
    return *this;
  }
  command& text(const std::string& n, const std::string& value, std::string& to, const std::string& help) override {
    arguments.push_back({n, value, help});
    app_.add_option_function<std::string>(n, [n, &to](const std::string& text) { to = not_empty(n, text); });
    return *this;
  }
  command& texts(const std::string& n, const std::string& value, std::vector<std::string>& to,
                 const std::string& help) override {
    arguments.push_back({n, value, help});
    const auto take = [n, &to](const std::vector<std::string>& all) {
      for (const auto& text : all) to.push_back(not_empty(n, text));
    };
    app_.add_option_function<std::vector<std::string>>(n, take)->expected(1)->multi_option_policy(
        CLI::MultiOptionPolicy::TakeAll);
    return *this;
  }
  command& number(const std::string& n, const std::string& value, double& to, const std::string& help) override {
    return of_numbers(n, value, help, 1, [&to](const std::vector<double>& x) { to = x[0]; });
  }
  command& number(const std::string& n, const std::string& value, std::optional<double>& to,
                  const std::string& help) override {
    return of_numbers(n, value, help, 1, [&to](const std::vector<double>& x) { to = x[0]; });
  }
  command& vector(const std::string& n, const std::string& value, std::optional<kte::vec3<>>& to,
                  const std::string& help) override {
    return of_numbers(n, value, help, 3, [&to](const std::vector<double>& x) { to = kte::vec3<>{x[0], x[1], x[2]}; });
  }
  command& runs(std::function<int()> f) override {
    run = std::move(f);
    return *this;
  }

  std::function<int()> run;
  bool is_chosen() const { return app_.parsed(); }

 private:
  template <class Take>
  command& of_numbers(const std::string& n, const std::string& value, const std::string& help, int count,
                      const Take& take) {
    arguments.push_back({n, value, help});
    app_.add_option_function<std::vector<std::string>>(n,
                                                       [n, take](const std::vector<std::string>& texts) {
                                                         std::vector<double> x;
                                                         for (const auto& t : texts) x.push_back(finite_number(n, t));
                                                         take(x);
                                                       })
        ->expected(count);
    return *this;
  }

  CLI::App& app_;
};

}  // namespace

struct command_line::parser {
  CLI::App app{"", "kte"};
  std::vector<std::unique_ptr<command>> commands;

  const parsed_command* chosen() const {
    for (const auto& c : commands)
      if (const auto& p = static_cast<const parsed_command&>(*c); p.is_chosen()) return &p;
    return nullptr;
  }
};

command_line::command_line() : parser_(std::make_unique<parser>()) {
  parser_->app.require_subcommand(1);
  parser_->app.set_version_flag("--version", "kte " KTE_VERSION);
}
command_line::~command_line() = default;

command& command_line::add(const std::string& name, const std::string& summary, const std::string& description) {
  auto& c = parser_->commands.emplace_back(std::make_unique<parsed_command>(*parser_->app.add_subcommand(name)));
  c->name = name, c->summary = summary, c->description = description;
  return *c;
}
const std::vector<std::unique_ptr<command>>& command_line::commands() const { return parser_->commands; }
const command& command_line::named(const std::string& name) const {
  std::vector<std::string> known;
  for (const auto& c : commands()) {
    if (c->name == name) return *c;
    known.push_back(c->name);
  }
  throw usage_error("there is no command '" + name + "'" + kte::detail::did_you_mean(name, known));
}

int command_line::run(int count, char** arguments) {
  const auto wrong_use = [&](const std::string& why) {
    const auto* const c = parser_->chosen();
    const std::string name = c ? " " + c->name : "";
    say((c ? c->name + ": " : "") + why + " (see kte help" + name + ")");
    return 2;
  };
  try {
    if (count > 1 && arguments[1][0] != '-') named(arguments[1]);
    parser_->app.parse(count, arguments);
    return exit_code_of([&] { return parser_->chosen()->run(); });
  } catch (const CLI::CallForHelp&) {
    const auto* const c = parser_->chosen();
    return exit_code_of([&] {
      kte::detail::write_standard_output(help_text(*this, c ? c->name : ""));
      return 0;
    });
  } catch (const CLI::CallForVersion& e) {
    return exit_code_of([&] {
      kte::detail::write_standard_output(std::string(e.what()) + '\n');
      return 0;
    });
  } catch (const CLI::ParseError& e) {
    return wrong_use(e.what());
  } catch (const usage_error& e) {
    return wrong_use(e.what());
  }
}

}  // namespace kte_tool
