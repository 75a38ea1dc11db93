#pragma once

#include <kte/math/vec.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// The command line, without its parser: who declares a subcommand does not compile it.
namespace kte_tool {

/// A command that is invalid: exit code 2.
struct usage_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An argument in help, man page and completion.
struct argument {
  std::string name;   ///< "FILE", "--time"
  std::string value;  ///< what comes behind an option; empty for flags and files
  std::string help;
  bool positional = false, needed = false;
};

/// A subcommand: what it takes, what it says of itself, what it does.
class command {
 public:
  virtual ~command() = default;

  /// A name that comes without a dash.
  virtual command& word(const std::string& name, std::string& to, const std::string& help, bool needed = true) = 0;
  /// Any number of these, as the last.
  virtual command& words(const std::string& name, std::vector<std::string>& to, const std::string& help) = 0;
  virtual command& flag(const std::string& name, bool& to, const std::string& help) = 0;
  virtual command& text(const std::string& name, const std::string& value, std::string& to,
                        const std::string& help) = 0;
  /// May come several times.
  virtual command& texts(const std::string& name, const std::string& value, std::vector<std::string>& to,
                         const std::string& help) = 0;
  /// Finite; other numbers are refused.
  virtual command& number(const std::string& name, const std::string& value, double& to, const std::string& help) = 0;
  virtual command& number(const std::string& name, const std::string& value, std::optional<double>& to,
                          const std::string& help) = 0;
  virtual command& vector(const std::string& name, const std::string& value, std::optional<kte::vec3<>>& to,
                          const std::string& help) = 0;
  /// What it does; its exit code.
  virtual command& runs(std::function<int()> f) = 0;

  std::string name, summary, description;
  std::vector<argument> arguments;
};

class command_line {
 public:
  command_line();
  ~command_line();

  command& add(const std::string& name, const std::string& summary, const std::string& description);
  const std::vector<std::unique_ptr<command>>& commands() const;
  /// Throws `usage_error` for a name that no command has.
  const command& named(const std::string& name) const;
  /// Runs the subcommand of a command line; the exit code. Messages go to standard error.
  int run(int count, char** arguments);

 private:
  struct parser;
  std::unique_ptr<parser> parser_;
};

/// Help of a command; without one, of the program. Throws `usage_error` for one that there is not.
std::string help_text(const command_line& line, const std::string& command);

}  // namespace kte_tool
