#pragma once

#include <kte/io/quantities.hpp>
#include <kte/runtime_chain/topology.hpp>
#include <kte/static_chain/static_chain.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

/// Resolves names of quantities to positions in the state of a chain, once for all rows.
namespace kte::detail {

/// The names of a chain and the positions of its quantities in a state, by kind, in order of first appearance; equal
/// for static and runtime chains.
struct named_slot {
  std::string name;
  int slot;
  std::string shown{};  ///< in columns: "frame:elbow" if the name is shared with something else
};
using named_slots = std::array<std::vector<named_slot>, kinds>;

template <class Gravity, class... E>
named_slots slots_of(const static_chain<Gravity, E...>&) {
  using wiring = detail::wiring<E...>;
  named_slots r;
  std::size_t port = 0;
  const auto add = [&](std::string_view name) {
    auto& of_kind = r[static_cast<std::size_t>(wiring::table.what[port])];
    const int slot = wiring::table.slot[port++];
    if (std::none_of(of_kind.begin(), of_kind.end(), [&](const named_slot& x) { return x.slot == slot; }))
      of_kind.push_back({std::string(name), slot});
  };
  const auto element_names = [&]<class Core, class... Keys>(const element<Core, Keys...>*) { (add(Keys::name), ...); };
  const int done[]{(element_names(static_cast<const E*>(nullptr)), 0)..., 0};
  (void)done;
  return r;
}
named_slots slots_of(const topology& t);
template <class Chain>
requires requires(const Chain& c) { c.wiring().names; }
named_slots slots_of(const Chain& c) { return slots_of(c.wiring()); }

/// The energies of a chain, as names of columns.
inline constexpr std::array<std::string_view, 3> energy_names{"energy/kinetic", "energy/potential", "energy/total"};

/// Some of the numbers of one quantity.
struct recorded {
  kind what;
  int slot;
  std::size_t quantity;  ///< index in `quantities`, or of energies in `energy_names`
  std::size_t first, count;

  bool is_energy() const { return slot < 0; }
};
/// Whether energies can be recorded. They depend on the chain, not on its state alone.
enum class energy_columns { refused, allowed };

/// What to record, and the names of its columns.
struct recording {
  std::vector<recorded> cells;
  std::vector<std::string> columns{"t"};

  /// Without names: the default of `recorder`. Throws `unknown_name` for names that there are not, and `bad_argument`
  /// for two quantities whose columns have one name.
  recording(const named_slots& all, const std::vector<std::string>& names,
            energy_columns energies = energy_columns::refused);
};

/// Writes the numbers of these cells in a state, and leaves out energies.
template <class State>
void read_recorded(const std::vector<recorded>& cells, const State& s, double* out) {
  for (const auto& c : cells) {
    if (c.is_energy()) {
      ++out;
      continue;
    }
    with_kind(c.what, [&]<kind K>() {
      double numbers[4];
      quantities<K, typename State::scalar>[c.quantity].read(s.template get<K>(c.slot), numbers);
      out = std::copy_n(numbers + c.first, c.count, out);
    });
  }
}

}  // namespace kte::detail

#ifdef KTE_EXTERN
namespace kte {
template <class S>
class basic_runtime_state;
namespace detail {
KTE_EXTERN template void read_recorded(const std::vector<recorded>&, const basic_runtime_state<double>&, double*);
}
}  // namespace kte
#endif

#ifdef KTE_FUNCTION
namespace kte::detail {

KTE_FUNCTION named_slots slots_of(const topology& t) {
  named_slots r;
  for (std::size_t k = 0; k < kinds; ++k)
    for (const auto& name : t.names[k]) r[k].push_back({name, static_cast<int>(r[k].size())});
  return r;
}

/// Resolves names.
class recording_by_names {
 public:
  recording_by_names(recording& found, const named_slots& all, const std::vector<std::string>& names,
                     energy_columns energies)
      : all_(all), cells_(found.cells), columns_(found.columns), energies_(energies) {
    tell_apart();
    for (const auto& n : names)
      if (n != "t") add(n);
    for (const bool frames : {false, true})  // coordinates first, because they determine everything else
      each_slot([&]<kind K>(const named_slot& p) {
        if (names.empty() && is_frame(K) == frames) add_group<K>(p, is_frame(K) ? "q" : "qvaf");
      });
    check_columns();
  }

 private:
  template <class Visit>
  void each_slot(const Visit& visit) const {
    [&]<std::size_t... K>(std::index_sequence<K...>) {
      (std::for_each(all_[K].begin(), all_[K].end(),
                     [&](const named_slot& p) { visit.template operator()<static_cast<kind>(K)>(p); }),
       ...);
    }
    (std::make_index_sequence<kinds>{});
  }

  /// The name with its kind, which is required if the name is shared.
  template <kind K>
  static std::string full_name(const named_slot& p) {
    return std::string(is_frame(K) ? "frame:" : is_coordinate(K) ? "coordinate:" : "signal:") + p.name;
  }
  void tell_apart() {
    std::unordered_map<std::string_view, std::array<bool, 2>>
        of_name;  // whether a frame has the name; whether something else has it
    each_slot([&]<kind K>(const named_slot& p) { of_name[p.name][is_frame(K)] = true; });
    [&]<std::size_t... K>(std::index_sequence<K...>) {
      const auto show = [&of_name]<kind What>(std::vector<named_slot>& of_kind) {
        for (auto& p : of_kind) {
          const auto& x = of_name[p.name];
          p.shown = (x[0] && x[1]) || p.name == "t" || is_energy(p.name) ? full_name<What>(p) : p.name;
        }
      };
      (show.template operator()<static_cast<kind>(K)>(all_[K]), ...);
    }
    (std::make_index_sequence<kinds>{});
  }
  static bool is_energy(std::string_view name) {
    return std::find(energy_names.begin(), energy_names.end(), name) != energy_names.end();
  }
  /// Names may contain slashes: a coordinate 'a/v' has the column of the rate of 'a'.
  void check_columns() const {
    std::unordered_map<std::string_view, std::size_t> cell_of;
    std::size_t column = 1;
    for (std::size_t i = 0; i < cells_.size(); ++i)
      for (std::size_t k = 0; k < cells_[i].count; ++k, ++column) {
        const auto& c = cells_[i];
        const auto& other = cells_[cell_of.try_emplace(columns_[column], i).first->second];
        if (c.what != other.what || c.slot != other.slot || c.quantity != other.quantity)
          raise<bad_argument>("kte: two quantities have the column '" + columns_[column] + "', of the " + owner(other) +
                              " and of the " + owner(c) + ": one of them needs another name");
      }
  }
  std::string owner(const recorded& c) const {
    const auto& of_kind = all_[static_cast<std::size_t>(c.what)];
    const auto p = std::find_if(of_kind.begin(), of_kind.end(), [&c](const named_slot& x) { return x.slot == c.slot; });
    return std::string(to_string(c.what)) + " '" + p->name + "'";
  }
  void add_energy(const std::string& wanted) {
    if (energies_ == energy_columns::refused)
      raise<unknown_name>("kte: cannot record '" + wanted + "' of a state: compute kte::energy of the chain");
    const auto place = std::find(energy_names.begin(), energy_names.end(), wanted) - energy_names.begin();
    cells_.push_back({kind::gen, -1, static_cast<std::size_t>(place), 0, 1});
    columns_.push_back(wanted);
  }
  /// The length of the name at the beginning of `wanted`: all of it, or up to a slash.
  static std::size_t length_in(const std::string& wanted, const std::string& name) {
    const bool begins = wanted.starts_with(name) && (wanted.size() == name.size() || wanted[name.size()] == '/');
    return begins ? name.size() : 0;
  }
  template <kind K>
  static std::size_t length_in(const std::string& wanted, const named_slot& p) {
    return (std::max)(length_in(wanted, p.name), length_in(wanted, full_name<K>(p)));
  }
  /// Adds the item with the longest name at the beginning of `wanted`, because names may contain slashes. If two items
  /// have this name, the one with the quantity.
  void add(const std::string& wanted) {
    if (is_energy(wanted)) return add_energy(wanted);
    std::size_t longest = 0;
    each_slot([&]<kind K>(const named_slot& p) { longest = (std::max)(longest, length_in<K>(wanted, p)); });
    if (longest == 0) unknown(wanted);
    std::string fitting, having;
    int count = 0;
    each_slot([&]<kind K>(const named_slot& p) {
      if (length_in<K>(wanted, p) != longest) return;
      fitting.append(fitting.empty() ? "" : "; ").append(has<K>(p));
      if (!add_of<K>(p, wanted, longest)) return;
      ++count, having.append(having.empty() ? "'" : " or '").append(full_name<K>(p)).append(wanted, longest) += "'";
    });
    if (count == 0) raise<unknown_name>("kte: cannot record '" + wanted + "': " + fitting);
    if (count > 1) raise<unknown_name>("kte: cannot record '" + wanted + "', which is ambiguous: ask for " + having);
  }
  /// Adds the quantity if the item has it; returns whether it does.
  template <kind K>
  bool add_of(const named_slot& p, const std::string& wanted, std::size_t name) {
    if (wanted.size() == name) return add_group<K>(p, "q");
    const std::string_view rest = std::string_view(wanted).substr(name + 1);
    const auto& list = quantities<K, double>;
    for (std::size_t i = 0; i < std::size(list); ++i) {
      const auto& q = list[i];
      if (rest == q.name) return add_cell<K>(p, i, 0, q.size());
      const std::string before = q.name.empty() ? "" : std::string(q.name) + '/';  // thrust/x, tip/position/x
      if (q.components.empty() || !rest.starts_with(before) || rest.size() != before.size() + 1) continue;
      const auto c = q.components.find(rest.back());
      if (c != q.components.npos) return add_cell<K>(p, i, c, 1);
    }
    return rest.size() == 1 && rest != "q" && add_group<K>(p, rest);
  }
  /// Adds all quantities of some groups; returns whether there are any.
  template <kind K>
  bool add_group(const named_slot& p, std::string_view groups) {
    bool any = false;
    const auto& list = quantities<K, double>;
    for (std::size_t i = 0; i < std::size(list); ++i)
      if (groups.find(list[i].group) != groups.npos) add_cell<K>(p, i, 0, list[i].size()), any = true;
    return any;
  }
  template <kind K>
  bool add_cell(const named_slot& p, std::size_t quantity, std::size_t first, std::size_t count) {
    cells_.push_back({K, p.slot, quantity, first, count});
    for (std::size_t c = first; c < first + count; ++c)
      columns_.push_back(name_of(p, quantities<K, double>[quantity], c));
    return true;
  }
  template <class Thing>
  static std::string name_of(const named_slot& p, const quantity<Thing>& q, std::size_t component) {
    std::string s = p.shown;
    if (!q.name.empty()) s.append("/").append(q.name);
    if (!q.components.empty()) s.append("/") += q.components[component];
    return s;
  }

  [[noreturn]] void unknown(const std::string& wanted) const {
    std::string known;
    each_slot([&]<kind K>(const named_slot& p) {
      known.append(known.empty() ? "" : ", ").append(to_string(K)).append(" '").append(p.name).append("'");
    });
    raise<unknown_name>("kte: cannot record '" + wanted + "': the chain has " + known);
  }
  /// "the 3D frame 'tip' has tip/position/x, ..."
  template <kind K>
  static std::string has(const named_slot& p) {
    std::string known;
    for (const auto& q : quantities<K, double>)
      for (std::size_t c = 0; c < q.size() && !(q.name.empty() && q.components.empty()); ++c)
        known.append(known.empty() ? "" : ", ").append(name_of(p, q, c));
    return "the " + std::string(to_string(K)) + " '" + p.name + "' has " + (known.empty() ? "no parts" : known);
  }

  named_slots all_;
  std::vector<recorded>& cells_;
  std::vector<std::string>& columns_;
  energy_columns energies_;
};

KTE_FUNCTION recording::recording(const named_slots& all, const std::vector<std::string>& names,
                                  energy_columns energies) {
  recording_by_names(*this, all, names, energies);
}

}  // namespace kte::detail
#endif
