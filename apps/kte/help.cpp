#include <kte/io/program.hpp>

#include "commands.hpp"

namespace kte_tool {

namespace {

/// The option of all commands.
const argument help_option{"--help", "", "shows this help"};

std::vector<argument> options_of(const command& c) {
  std::vector<argument> all;
  for (const auto& a : c.arguments)
    if (!a.positional) all.push_back(a);
  all.push_back(help_option);
  return all;
}
/// The names of an option, "-o" and "--output".
std::vector<std::string> names_of(const argument& a) {
  const auto comma = a.name.find(',');
  if (comma == a.name.npos) return {a.name};
  return {a.name.substr(0, comma), a.name.substr(comma + 1)};
}
std::string with_value(const argument& a) {
  const auto names = names_of(a);
  return names[0] + (names.size() > 1 ? ", " + names[1] : "") + (a.value.empty() ? "" : " " + a.value);
}

std::string usage_of(const command& c) {
  std::string s = "kte " + c.name;
  for (const auto& a : c.arguments)
    if (a.positional) s += a.needed ? " " + a.name : " [" + a.name + "]";
  return s + " [options]";
}

/// A text in lines of at most 100 characters, all but the first indented.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out;
  std::size_t column = indent;
  for (std::size_t i = 0; i < text.size();) {
    const auto end = std::min(text.find(' ', i), text.size());
    if (column > indent && column + 1 + end - i > 100) {
      out += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      out += ' ', ++column;
    }
    out += text.substr(i, end - i), column += end - i;
    i = end + 1;
  }
  return out + '\n';
}
std::string row(const std::string& left, const std::string& right) {
  constexpr std::size_t indent = 28;
  std::string s = "  " + left;
  s += s.size() + 1 < indent ? std::string(indent - s.size(), ' ') : '\n' + std::string(indent, ' ');
  return s + wrapped(right, indent);
}

std::string help_of_program(const command_line& line) {
  std::string s =
      "usage: kte COMMAND ...\n\nCommon tasks for a robot file: URDF, MJCF, SDF, or a model file of the library.\n\n";
  for (const auto& c : line.commands()) s += row(usage_of(*c).substr(4), c->summary);
  return s + row("--version", "the version of kte") +
         "\nkte help COMMAND shows the options of a command. Exit codes: 0 success, 1 the input is wrong or not "
         "supported, 2 the command line is wrong.\n";
}

/// Words as roff takes them.
std::string roff(const std::string& text) {
  std::string s;
  for (const char c : text) {
    if (c == '\\')
      s += "\\e";
    else if (c == '-')
      s += "\\-";
    else if ((c == '.' || c == '\'') && (s.empty() || s.back() == '\n'))
      s.append("\\&") += c;
    else
      s += c;
  }
  return s;
}
std::string man_page(const command_line& line) {
  std::string s = ".\\\" Written by: kte help --man\n.TH KTE 1 \"\" \"kte " KTE_VERSION
                  "\" \"User Commands\"\n.SH NAME\nkte \\- inspect, evaluate, simulate, show and convert robot "
                  "files\n.SH SYNOPSIS\n";
  for (const auto& c : line.commands()) s += ".B " + roff(usage_of(*c)) + "\n.br\n";
  s += ".SH DESCRIPTION\nFiles are URDF, MJCF, SDF, or model files of the library (JSON, XML, .kte). The content "
       "determines the format.\n";
  for (const auto& c : line.commands()) {
    s += ".SH " + roff("kte " + c->name) + "\n" + roff(c->description) + "\n";
    for (const auto& a : c->arguments)
      if (a.positional) s += ".TP\n.I " + roff(a.name) + "\n" + roff(a.help) + "\n";
    for (const auto& a : options_of(*c)) s += ".TP\n.B " + roff(with_value(a)) + "\n" + roff(a.help) + "\n";
  }
  return s +
         ".SH EXIT STATUS\n0: success. 1: the input is wrong or not supported. 2: the command line is wrong.\n.SH "
         "ENVIRONMENT\n.TP\n.B CXX\nThe compiler of " +
         roff("kte eval --static") +
         ", optionally with options.\n.TP\n.B XDG_CACHE_HOME\nThe folder of its program cache, if this is an absolute "
         "path; default ~/.cache.\n";
}

/// For the completion of shells: the names of commands, or the options of one, a line each.
std::string list_of(const command_line& line, const std::string& name) {
  std::string s;
  if (name.empty())
    for (const auto& c : line.commands()) s += c->name + '\n';
  else
    for (const auto& a : options_of(line.named(name)))
      for (const auto& n : names_of(a)) s += n + '\n';
  return s;
}

}  // namespace

std::string help_text(const command_line& line, const std::string& name) {
  if (name.empty()) return help_of_program(line);
  const auto& c = line.named(name);
  std::string s = "usage: " + usage_of(c) + "\n\n" + wrapped(c.description, 0) + '\n';
  for (const auto& a : c.arguments)
    if (a.positional) s += row(a.name, a.help);
  for (const auto& a : options_of(c)) s += row(with_value(a), a.help);
  return s;
}

void add_help(command_line& line) {
  struct options {
    std::string command;
    bool man = false, list = false;
  };
  const auto o = std::make_shared<options>();
  line.add("help", "lists commands, or the options of a command", "Lists all commands, or the options of one command.")
      .word("COMMAND", o->command, "a command", false)
      .flag("--list", o->list, "prints only the names of commands, or of the options of COMMAND; for shell completion")
      .flag("--man", o->man, "prints the man page")
      .runs([o, &line] {
        kte::detail::write_standard_output(o->man    ? man_page(line)
                                           : o->list ? list_of(line, o->command)
                                                     : help_text(line, o->command));
        return 0;
      });
}

}  // namespace kte_tool
