#pragma once

#include <kte/contract/nearest_name.hpp>
#include <kte/io/table.hpp>
#include <kte/view/svg/plot/options.hpp>

/// The columns of a table that are plotted, and their panels.
namespace kte::detail::svg {

struct plot_column {
  std::string name;
  const std::vector<double>* numbers;
  column_meaning meaning;
};
struct plot_panel {
  column_meaning meaning;
  std::vector<plot_column> columns;
};

/// Finds columns by name.
class plot_columns {
 public:
  plot_columns(const table& t, const plot_options& o) : table_(t), options_(o) {
    if (t.names.empty() || t.names.size() != t.columns.size())
      raise<bad_argument>("kte: a plot needs a table with columns and a name for each");
    for (std::size_t j = 0; j < t.columns.size(); ++j)
      if (t.columns[j].size() != t.rows())
        raise<bad_argument>("kte: the column '" + t.names[j] + "' of the table to plot has another length than '" +
                            t.names[0] + "'");
  }
  plot_column against() const { return column(options_.against.empty() ? 0 : place(options_.against)); }

  /// The panels of columns with these names; without names, of all columns except that of the horizontal axis. The name
  /// of a vector, "tool/position", stands for its components.
  std::vector<plot_panel> panels_of(const std::vector<std::string>& names) const {
    std::vector<std::size_t> wanted;
    for (const auto& n : names) add(wanted, n);
    const std::string x = against().name;
    if (names.empty())
      for (std::size_t j = 0; j < table_.names.size(); ++j)
        if (table_.names[j] != x) wanted.push_back(j);
    if (wanted.empty()) raise<bad_argument>("kte: the table to plot has no column other than '" + x + "'");
    std::vector<plot_panel> all;
    for (const auto j : wanted) {
      auto c = column(j);
      auto p = all.begin();
      while (p != all.end() && !belongs(*p, c)) ++p;
      if (p == all.end()) p = all.insert(p, {c.meaning, {}});
      if (p->meaning != c.meaning) p->meaning = {p->meaning.unit == c.meaning.unit ? c.meaning.unit : "", ""};
      p->columns.push_back(std::move(c));
    }
    return all;
  }

 private:
  bool belongs(const plot_panel& p, const plot_column& c) const {
    return options_.share == panels::together || (options_.share == panels::by_unit && p.meaning == c.meaning);
  }
  plot_column column(std::size_t j) const {
    return {table_.names[j], &table_.columns[j], meaning_of_column(table_.names[j], options_.units)};
  }
  std::size_t find(std::string_view name) const {
    return static_cast<std::size_t>(std::find(table_.names.begin(), table_.names.end(), name) - table_.names.begin());
  }
  std::size_t place(const std::string& name) const {
    const auto j = find(name);
    if (j == table_.names.size())
      raise<unknown_name>("kte: cannot plot '" + name + "': there is no such column" +
                          (nearest_name(name, table_.names) < table_.names.size()
                               ? did_you_mean(name, table_.names)
                               : ": " + list_of_names(table_.names)));
    return j;
  }
  void add(std::vector<std::size_t>& wanted, const std::string& name) const {
    const auto add_once = [&wanted](std::size_t j) {
      if (std::find(wanted.begin(), wanted.end(), j) == wanted.end()) wanted.push_back(j);
    };
    bool any = false;
    if (find(name) == table_.names.size())
      for (std::size_t j = 0; j < table_.names.size(); ++j) {
        const std::string& n = table_.names[j];
        if (n.size() == name.size() + 2 && n.starts_with(name) && n[name.size()] == '/' &&
            std::string_view("wxyz").find(n.back()) != std::string_view::npos)
          add_once(j), any = true;
      }
    if (!any) add_once(place(name));
  }

  const table& table_;
  const plot_options& options_;
};

}  // namespace kte::detail::svg
