#include "recorded_state.hpp"

#include <kte/io/quantities.hpp>
#include <kte/io/utf8.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace kte_tool {

std::string table_name(const std::string& name) {
  std::string out;
  std::string_view rest = name;
  while (!rest.empty()) {
    const auto length = std::max<std::size_t>(kte::detail::utf8_length(rest), 1);
    const bool refused = kte::detail::begins_with_control(rest) ||
                         std::string_view(" \t\r\n\v\f,'\"\\").find(rest[0]) != std::string_view::npos;
    refused ? out += '_' : out += rest.substr(0, length);
    rest.remove_prefix(length);
  }
  return out.empty() ? "_" : out;
}

namespace {
/// The quantities that are always recorded.
std::vector<std::string> usual_names(const kte::runtime_chain& c) {
  std::vector<std::string> all;
  const auto& names = c.wiring().names;
  for (std::size_t k = 0; k < kte::kinds; ++k) {
    const auto what = static_cast<kte::kind>(k);
    if (kte::is_frame(what)) continue;
    for (const auto& name : names[k]) {
      if (!kte::is_coordinate(what)) {
        all.push_back("signal:" + name);
        continue;
      }
      for (const char* const part : {"", "/v", "/a", "/f"}) all.push_back("coordinate:" + name + part);
    }
  }
  return all;
}
}  // namespace

recorded_state::recorded_state(const kte::runtime_chain& c, const std::vector<std::string>& more) {
  auto names = usual_names(c);
  names.insert(names.end(), more.begin(), more.end());
  // Without names a recorder has everything.
  const auto all =
      names.empty() ? kte::detail::recording({}, {}) : kte::detail::recording(kte::detail::slots_of(c), names);
  std::map<std::pair<kte::kind, int>, kte::detail::freedom> free;
  for (const auto& f : c.wiring().free) free[{f.what, f.slot}] = f;
  cells_ = all.cells;
  std::set<std::string> taken{"t"};
  const auto name_of = [&](const std::string& wanted) {
    const auto first = table_name(wanted);
    auto text = first;
    for (int i = 2; !taken.insert(text).second; ++i) text = first + "_" + std::to_string(i);
    return text;
  };
  for (const auto& cell : all.cells) {
    // Where the numbers of this quantity begin among those of q or v: behind those of the quantities before it.
    char group = ' ';
    int before = 0;
    kte::detail::with_kind(cell.what, [&]<kte::kind K>() {
      const auto& list = kte::detail::quantities<K, double>;
      group = list[cell.quantity].group;
      for (std::size_t i = 0; i < cell.quantity; ++i)
        if (list[i].group == group) before += static_cast<int>(list[i].size());
    });
    const auto f = free.find({cell.what, cell.slot});
    const bool is_state = f != free.end() && (group == 'q' || group == 'v');
    for (std::size_t i = 0; i < cell.count; ++i) {
      const auto& whole = all.columns[columns_.size() + 1];
      recorded_column x{name_of(whole), whole};
      if (is_state) {
        x.is = group == 'q' ? recorded_column::part::q : recorded_column::part::v;
        x.index = (group == 'q' ? f->second.q : f->second.v) + before + static_cast<int>(cell.first + i);
      }
      columns_.push_back(std::move(x));
    }
  }
}

void recorded_state::read(const kte::runtime_state& s, double* out) const {
  for (const auto& cell : cells_)
    kte::detail::with_kind(cell.what, [&]<kte::kind K>() {
      double numbers[4];
      kte::detail::quantities<K, double>[cell.quantity].read(s.get<K>(cell.slot), numbers);
      out = std::copy_n(numbers + cell.first, cell.count, out);
    });
}

}  // namespace kte_tool
