#pragma once

#include <kte/contract/freedom.hpp>
#include <kte/contract/nearest_name.hpp>
#include <kte/contract/wiring_rules.hpp>
#include <kte/detail/compiled.hpp>
#include <kte/errors.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace kte {

class kte_element;
namespace detail {
/// For messages: "a coordinate", "an input".
inline std::string text_with_article(kind k) { return std::string(article(k)).append(to_string(k)); }
}  // namespace detail

/// The wiring of a runtime chain, built element by element: the counterpart of `detail::wiring`, with the same rules
/// and the same numbering of the degrees of freedom.
class topology {
 public:
  /// An item of a chain: a coordinate, frame, signal or internal state, of the kind `what`.
  struct thing {
    kind what{};
    int index = -1;         ///< among items of its kind; -1: none
    int writer = -1;        ///< the element that writes it, or -1: external
    bool declared = false;  ///< written by an element, or declared by base_gen, base_2D, base_3D
    bool moves = false;     ///< for coordinates: a joint moves by it, or its motion is prescribed
    explicit operator bool() const { return index >= 0; }
  };
  /// An `element` and its connections.
  struct connection {
    const kte_element* element = nullptr;
    std::vector<int> index;         ///< index of the item at each port
    std::string_view type;          ///< of the element
    std::span<const port> ports;    ///< of the element
    bool rigid = false;             ///< whether it is a joint or a link
    bool distributed_mass = false;  ///< whether it has a mass between several ports
    bool load = false;              ///< whether it is an external load
    bool closes = false;            ///< whether it closes a loop
    bool touches = false;           ///< whether it is a contact
    bool starts_in_place = false;   ///< whether its internal states follow from the position at the start of a motion
    int parameters = 0;             ///< number of its inertial parameters
  };

  std::array<std::vector<std::string>, kinds> names;  ///< names of all items, by kind
  std::vector<detail::freedom> free;                  ///< the coordinates that are degrees of freedom, in order
  int nq = 0, nv = 0;                                 ///< size of a configuration; number of degrees of freedom
  std::vector<std::size_t> quaternions;               ///< positions of quaternions in a configuration
  std::vector<detail::outside_signal> signals;        ///< signals that no element writes, in order
  int nu = 0;                                         ///< their total size
  std::vector<connection> elements;                   ///< in order
  bool has_derivatives = true;                        ///< whether all forces on coordinates alone have derivatives
  std::vector<int> keepers;                           ///< the elements with internal states, in order
  std::array<std::vector<int>, kinds> writers;        ///< for all items, by kind: an element, or -1

  /// Identity of the layout: equal for copies of a chain, new for every appended element.
  std::shared_ptr<const char> layout = std::make_shared<char>();

  /// Connects an element. Throws `bad_wiring` without changes; if memory runs out, call `cut`.
  void connect(const kte_element* e, std::string_view type, std::span<const port> ports,
               std::span<const std::string> to);
  /// Sizes of all lists, for `cut`: names, free, quaternions, signals, elements, keepers, row, nq, nv, nu,
  /// has_derivatives, base_known, layout.
  struct extent {
    std::array<std::size_t, kinds> names{};
    std::size_t free = 0, quaternions = 0, signals = 0, elements = 0, keepers = 0, row = 0;
    int nq = 0, nv = 0, nu = 0;
    bool has_derivatives = true, base_known = false;
    std::shared_ptr<const char> layout;
  };
  /// The sizes of all lists.
  extent size() const;
  /// Removes the elements connected since these sizes, including a partly connected one. Allocates nothing.
  void cut(const extent& before) noexcept;
  /// Throws `bad_wiring`, naming the element, if forces act on a coordinate by which nothing moves.
  void check_complete() const;
  /// An element in a message: "revolute_joint_3D (coordinate 'q', base 'a', end 'b')".
  std::string describe(const connection& c) const;
  /// The number of items of a kind.
  int count(kind k) const { return static_cast<int>(names[static_cast<std::size_t>(k)].size()); }
  /// The kind of the item with this name. Throws `unknown_name`, also if a frame and another item have it.
  kind kind_of(std::string_view name) const {
    const auto& x = named(name);
    if (x[0] && x[1])
      throw unknown_name("kte: '" + std::string(name) + "' is " + detail::text_with_article(x[0].what) + " and " +
                         detail::text_with_article(x[1].what) + ": which of them is meant?");
    return (x[0] ? x[0] : x[1]).what;
  }
  /// The kind of the item with this name: a frame, or something else if `frame` is false. If only one of them exists,
  /// its kind.
  kind kind_of(std::string_view name, bool frame) const {
    const auto& x = named(name);
    return (x[frame] ? x[frame] : x[!frame]).what;
  }
  /// Kind and index of a frame; throws `unknown_name`.
  std::pair<kind, int> frame(std::string_view name) const {
    const thing& x = named(name)[1];
    if (!x) return {kind::frame_3D, find(name, kind::frame_3D)};  // throws, naming the kind of the item
    return {x.what, x.index};
  }
  /// Index of a name; throws `unknown_name`.
  int find(std::string_view name, kind k) const {
    const auto it = things_.find(name);
    if (it == things_.end())
      throw unknown_name("kte: this chain has no " + text(k) + " '" + std::string(name) + "'" + instead(name, k));
    const auto& x = it->second[is_frame(k)] ? it->second[is_frame(k)] : it->second[!is_frame(k)];
    if (x.what != k)
      throw unknown_name("kte: '" + std::string(name) + "' is " + detail::text_with_article(x.what) + ", not " +
                         detail::text_with_article(k));
    return x.index;
  }

 private:
  [[noreturn]] static void fail(std::string_view type, std::span<const port> ports, std::span<const std::string> to,
                                const std::string& why);
  void check(std::string_view type, std::span<const port> ports, std::span<const std::string> to) const;
  int add(const port& x, const std::string& name);
  static std::string text(kind k) { return std::string(to_string(k)); }
  /// A suggestion for a misspelt name (contract/nearest_name.hpp).
  std::string instead(std::string_view name, kind k) const {
    const auto& known = names[static_cast<std::size_t>(k)];
    return detail::did_you_mean(name, known) + " (" + detail::list_of_names(known) + ")";
  }
  std::string did_you_mean(std::string_view name) const;

  /// The items with a name: index 1 a frame, index 0 another item; one look-up finds both.
  using namesakes = std::array<thing, 2>;
  const namesakes& named(std::string_view name) const {
    const auto it = things_.find(name);
    if (it == things_.end())
      throw unknown_name("kte: this chain has nothing named '" + std::string(name) + "'" + did_you_mean(name));
    return it->second;
  }
  struct hash_of_text {
    using is_transparent = void;
    std::size_t operator()(std::string_view s) const { return std::hash<std::string_view>{}(s); }
  };
  std::unordered_map<std::string, namesakes, hash_of_text, std::equal_to<>> things_;
  bool base_known_ = false;
  std::size_t row_ = 0;  ///< first index of the last row of generalized coordinates in `free`
};

#ifdef KTE_FUNCTION
KTE_FUNCTION void topology::connect(const kte_element* e, std::string_view type, std::span<const port> ports,
                                    std::span<const std::string> to) {
  check(type, ports, to);
  connection c;
  c.element = e;
  c.type = type, c.ports = ports;
  for (std::size_t p = 0; p < ports.size(); ++p) c.index.push_back(add(ports[p], to[p]));
  elements.push_back(std::move(c));
  layout = std::make_shared<char>();
}
KTE_FUNCTION topology::extent topology::size() const {
  extent e;
  for (std::size_t k = 0; k < kinds; ++k) e.names[k] = names[k].size();
  e.free = free.size(), e.quaternions = quaternions.size(), e.signals = signals.size(), e.elements = elements.size();
  e.keepers = keepers.size(), e.row = row_, e.nq = nq, e.nv = nv, e.nu = nu;
  e.has_derivatives = has_derivatives, e.base_known = base_known_, e.layout = layout;
  return e;
}
KTE_FUNCTION void topology::cut(const extent& before) noexcept {
  const auto shorten = [](auto& list, std::size_t size) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>((std::min)(size, list.size())), list.end());
  };
  for (auto x = things_.begin(); x != things_.end();) {
    for (thing& t : x->second) {
      if (t && static_cast<std::size_t>(t.index) >= before.names[static_cast<std::size_t>(t.what)]) t = {};
      t.moves = t.declared;
    }
    x = x->second[0] || x->second[1] ? std::next(x) : things_.erase(x);
  }
  for (std::size_t k = 0; k < kinds; ++k) shorten(names[k], before.names[k]), shorten(writers[k], before.names[k]);
  shorten(free, before.free), shorten(quaternions, before.quaternions), shorten(signals, before.signals);
  shorten(elements, before.elements), shorten(keepers, before.keepers);
  nq = before.nq, nv = before.nv, nu = before.nu, row_ = before.row;
  if (!free.empty()) free[row_].in_row = static_cast<int>(free.size() - row_);
  has_derivatives = before.has_derivatives, base_known_ = before.base_known, layout = before.layout;
  for (const auto& c : elements)
    for (std::size_t p = 0; p < c.ports.size(); ++p) {
      const auto k = static_cast<std::size_t>(c.ports[p].what);
      if (detail::wiring_rules::moves(c.ports[p].how))
        things_.find(names[k][static_cast<std::size_t>(c.index[p])])->second[is_frame(c.ports[p].what)].moves = true;
    }
}
KTE_FUNCTION void topology::check_complete() const {
  for (const auto& c : elements)
    for (std::size_t p = 0; p < c.ports.size(); ++p) {
      if (!is_coordinate(c.ports[p].what)) continue;
      const auto& known = names[static_cast<std::size_t>(c.ports[p].what)];
      const auto& name = known[static_cast<std::size_t>(c.index[p])];
      if (things_.find(name)->second[0].moves) continue;
      std::vector<std::string> moving;
      for (const auto& other : known)
        if (things_.find(other)->second[0].moves) moving.push_back(other);
      const auto meant = detail::did_you_mean(name, moving);
      throw bad_wiring("kte: " + describe(c) + ": nothing moves by '" + name + "'" +
                       (meant.empty() ? ": is it misspelt?" : meant));
    }
}
KTE_FUNCTION std::string topology::describe(const connection& c) const {
  std::vector<std::string_view> to;
  for (std::size_t p = 0; p < c.ports.size(); ++p)
    to.push_back(names[static_cast<std::size_t>(c.ports[p].what)][static_cast<std::size_t>(c.index[p])]);
  return describe_element(c.type, c.ports, to);
}
KTE_FUNCTION std::string topology::did_you_mean(std::string_view name) const {
  std::vector<std::string> all;
  for (const auto& of_kind : names) all.insert(all.end(), of_kind.begin(), of_kind.end());
  return detail::did_you_mean(name, all);
}
KTE_FUNCTION void topology::check(std::string_view type, std::span<const port> ports,
                                  std::span<const std::string> to) const {
  const auto refuse = [&](const std::string& why) { fail(type, ports, to, why); };
  // Names the element that reads an item before this element writes it.
  const auto diagnose_reader = [&](const port& writes, const std::string& name) {
    const auto it = things_.find(name);
    const thing known = it == things_.end() ? thing{} : it->second[is_frame(writes.what)];
    if (!writes.declares() || !known || known.declared || known.what != writes.what) return;
    std::vector<std::string_view> names_here;
    for (const auto& text : to) names_here.emplace_back(text);
    for (const auto& c : elements)
      for (std::size_t q = 0; q < c.ports.size(); ++q)
        if (c.ports[q].what == known.what && c.index[q] == known.index)
          throw bad_wiring("kte: " + describe(c) + ": it reads '" + name + "' before it is written, by " +
                           describe_element(type, ports, names_here) + ": append it behind that");
  };
  detail::wiring_rules rules(base_known_);
  for (std::size_t p = 0; p < ports.size(); ++p) {
    const port& x = ports[p];
    const std::string& name = to[p];
    if (name.empty()) refuse("its " + std::string(x.role) + " has no name");
    const auto of_name = things_.find(name);
    const thing known = of_name == things_.end() ? thing{} : of_name->second[is_frame(x.what)];
    std::size_t here = 0;  // the first port of the element with this name
    while (to[here] != name || is_frame(ports[here].what) != is_frame(x.what)) ++here;
    const bool used = known || here < p;
    const kind k = known ? known.what : ports[here].what;
    const bool declared = known ? known.declared : ports[here].declares();
    switch (rules.broken_by(x.what, x.how, {used, k == x.what, used && declared})) {
      case detail::problem::none:
      case detail::problem::moves_nothing:
        break;
      case detail::problem::same_text:
        refuse("'" + name + "' is " + detail::text_with_article(k) + ", not " + detail::text_with_article(x.what));
        break;
      case detail::problem::written_twice:
        refuse("it writes '" + name + "', which is then written twice");
        break;
      case detail::problem::read_before_written:
        diagnose_reader(x, name);
        refuse("it writes '" + name + "', which is read before it is written");
        break;
      case detail::problem::unknown:
        if (x.what == kind::internal)
          refuse("it reads the internal state '" + name + "', which no element before it keeps");
        for (std::size_t q = p + 1; q < ports.size(); ++q)
          diagnose_reader(ports[q], to[q]);  // it was taken for the base
        if (of_name != things_.end())
          refuse("'" + name + "' is " + detail::text_with_article(of_name->second[0].what) + ", not " +
                 detail::text_with_article(x.what) + ", and no element before it writes a frame of this name");
        const auto& frames = names[static_cast<std::size_t>(x.what)];
        const auto meant = detail::did_you_mean(name, frames);
        refuse("it reads '" + name + "', which no element before it writes" +
               (meant.empty() ? ": misspelt, written later, or another base?" : meant) + " (" +
               detail::list_of_names(frames) + "; a further base is declared by base_2D or base_3D)");
    }
  }
  const bool constrains = !ports.empty() && (ports.back().what == kind::loop || ports.back().what == kind::contact);
  if (constrains && ports.size() == 3 && to[0] == to[1])
    refuse("both its ends are '" + to[0] + "', which does not move relative to itself");
}
KTE_FUNCTION int topology::add(const port& x, const std::string& name) {
  const auto k = static_cast<std::size_t>(x.what);
  const int writer = x.how == access::out ? static_cast<int>(elements.size()) : -1;
  const bool moves = detail::wiring_rules::moves(x.how) || x.declares();
  auto& known = things_[name][is_frame(x.what)];
  const bool fresh = !known;
  if (fresh) known = thing{x.what, static_cast<int>(names[k].size()), writer, x.declares(), moves};
  known.moves |= moves;
  if (x.how == access::keep && x.what == kind::internal) keepers.push_back(static_cast<int>(elements.size()));
  if (fresh) {
    names[k].push_back(name);
    writers[k].push_back(writer);
    if (nu_of(x.what) > 0 && !x.writes()) {
      const bool time = detail::is_time(x.what, name);
      signals.push_back({x.what, known.index, time ? -1 : nu});
      if (!time) nu += nu_of(x.what);
    }
    if (is_coordinate(x.what) && !x.writes()) {
      free.push_back({x.what, known.index, nq, nv});
      const std::size_t i = free.size() - 1;
      if (i == 0 || !detail::stand_in_row(free[i - 1], free[i])) row_ = i;
      free[row_].in_row = static_cast<int>(i - row_) + 1;
      nq += nq_of(x.what), nv += nv_of(x.what);
      if (nq_of(x.what) != nv_of(x.what)) quaternions.push_back(static_cast<std::size_t>(nq - 4));
    }
    if (is_frame(x.what) && !x.writes()) base_known_ = true;
  }
  return known.index;
}
KTE_FUNCTION void topology::fail(std::string_view type, std::span<const port> ports, std::span<const std::string> to,
                                 const std::string& why) {
  std::vector<std::string_view> views(to.begin(), to.end());
  throw bad_wiring("kte: " + describe_element(type, ports, views) + ": " + why);
}
#endif

}  // namespace kte
