#pragma once

#include <kte/contract/element.hpp>
#include <kte/contract/freedom.hpp>
#include <kte/contract/nearest_name.hpp>

#include <array>
#include <bit>
#include <tuple>

/// The connections of a chain, resolved once at compile time. This file contains all bookkeeping; all others read its
/// table.
namespace kte::detail {

/// One port of one element, with its name as a number.
struct port_use {
  kind what{};
  access how{};
  std::uint64_t key{};   ///< equal numbers are equal names
  std::uint64_t text{};  ///< the same number is the same text
};

/// The result. P ports and E elements are counted over the whole chain. A thing is a coordinate, frame, signal or
/// internal state.
///   slot[p]       index of the thing at port p, among things of its kind
///   count[k]      number of things of kind k
///   writer[k][s]  the element that writes thing s of kind k, or -1 if it is external
///   free          the coordinates that are degrees of freedom, in order of first appearance; they come first among
///                 the things of their kind. nq and nv: sizes of q and v
///   signal        the external signals; nu: their total size
///   reader[k][s]  the last port through which a load acts on thing s of kind k, or -1; previous[p] is the one before
///   element[p], load[p]   the element of port p, and the index of its load among the loads of that element
template <std::size_t P, std::size_t E>
struct wiring_table {
  std::array<int, P + 1> slot{};
  std::array<kind, P + 1> what{};
  std::array<int, kinds> count{};
  std::array<std::array<int, P + 1>, kinds> writer{};
  std::array<std::array<std::uint64_t, P + 1>, kinds> key{};
  std::array<std::array<int, P + 1>, kinds> reader{};
  std::array<int, P + 1> previous{}, element{}, load{};
  std::array<bool, P + 1> angle{};  ///< for generalized coordinates: whether an element needs sine and cosine
  std::array<freedom, P + 1> free{};
  int freedoms{}, nq{}, nv{};
  std::array<outside_signal, P + 1> signal{};  ///< external signals, in order of first appearance
  int signals{}, nu{};
  problem error = problem::none;  ///< the first error: of element bad_element, at its port bad_port
  std::size_t bad_element = E;
  std::size_t bad_port{};
};

/// Resolves names. `first[e]` is the first port of element e, first[E] = P.
template <std::size_t P, std::size_t E>
constexpr auto resolve(const std::array<port_use, P + 1>& use, const std::array<int, E + 1>& first) {
  wiring_table<P, E> t;
  constexpr int n = static_cast<int>(P);
  std::array<int, P + 1> name{}, writer{}, rank{};  // name[p]: first port with the same name
  auto& element = t.element;
  const auto report = [&](int p, problem x) {
    if (t.error != problem::none) return;
    t.error = x;
    t.bad_element = static_cast<std::size_t>(element[p]);
    t.bad_port = static_cast<std::size_t>(p - first[t.bad_element]);
  };
  for (std::size_t e = 0; e < E; ++e)
    for (int p = first[e]; p < first[e + 1]; ++p) element[p] = static_cast<int>(e);
  // Equal texts are found by a hash table; pairwise comparison is too slow for compilers beyond 200 elements.
  constexpr std::size_t buckets = std::bit_ceil(2 * P + 2);
  std::array<int, buckets> bucket{};  // a first port plus one, or 0
  for (int p = 0; p < n; ++p) {
    std::size_t b = use[p].text % buckets;
    while (bucket[b] != 0 && use[bucket[b] - 1].text != use[p].text) b = (b + 1) % buckets;
    if (bucket[b] == 0) bucket[b] = p + 1;
    name[p] = bucket[b] - 1;
  }
  // Checks the rules, port by port. The first port identifies a name. A port that reads a name before it is written is
  // at fault.
  std::array<bool, P + 1> moves{};
  for (int p = 0; p < n; ++p) writer[p] = -1;
  const auto written_later = [&](int p) {
    for (int later = p + 1; later < n; ++later)
      if (name[later] == name[p] && port::declares(use[later].how)) return true;
    return false;
  };
  wiring_rules rules;
  for (int p = 0; p < n; ++p) {
    const int before = name[p];
    const bool same = use[before].key == use[p].key && use[before].what == use[p].what;
    problem broken = rules.broken_by(use[p].what, use[p].how, {before < p, same, writer[before] >= 0});
    int reader = before;
    if (broken == problem::unknown && written_later(p)) broken = problem::read_before_written;
    if (broken == problem::unknown)  // this element may write what was taken for the base
      for (int q = p + 1; q < first[static_cast<std::size_t>(element[p]) + 1]; ++q)
        if (port::declares(use[q].how) && use[name[q]].what == use[q].what && name[q] < first[element[p]] &&
            writer[name[q]] < 0)
          reader = name[q], broken = problem::read_before_written;
    if (broken != problem::none) report(broken == problem::read_before_written ? reader : p, broken);
    if (port::declares(use[p].how) && writer[before] < 0) writer[before] = p;
    moves[before] |= wiring_rules::moves(use[p].how);
  }
  for (int p = 0; p < n; ++p)
    if (is_coordinate(use[p].what) && writer[name[p]] < 0 && !moves[name[p]]) report(p, problem::moves_nothing);
  // Slots: degrees of freedom first, then other coordinates in order of appearance.
  for (int round = 0; round < 2; ++round)
    for (int p = 0; p < n; ++p) {
      if (name[p] != p) continue;
      const bool free_coordinate = is_coordinate(use[p].what) && writer[p] < 0;
      if (free_coordinate != (round == 0)) continue;
      const auto k = static_cast<std::size_t>(use[p].what);
      rank[p] = t.count[k]++;
      const bool given = writer[p] < 0 || use[writer[p]].how == access::base;
      t.writer[k][rank[p]] = given ? -1 : element[writer[p]];
      t.key[k][rank[p]] = use[p].key;
      if (nu_of(use[p].what) > 0 && writer[p] < 0) {
        const bool time = use[p].what == kind::input && use[p].text == id_of_text<chain_time_>;
        t.signal[static_cast<std::size_t>(t.signals++)] = {use[p].what, rank[p], time ? -1 : t.nu};
        if (!time) t.nu += nu_of(use[p].what);
      }
      if (round == 1) continue;
      t.free[static_cast<std::size_t>(t.freedoms++)] = {use[p].what, rank[p], t.nq, t.nv};
      t.nq += nq_of(use[p].what);
      t.nv += nv_of(use[p].what);
    }
  for (auto& of_kind : t.reader)
    for (auto& r : of_kind) r = -1;
  for (int p = 0; p < n; ++p) {
    const int s = t.slot[p] = rank[name[p]];
    t.what[p] = use[p].what;
    if (use[p].how == access::angle && use[p].what == kind::gen) t.angle[s] = true;
    if (use[p].how == access::out || use[p].how == access::base || is_signal(use[p].what)) continue;
    t.load[p] = 0;
    for (int before = first[element[p]]; before < p; ++before) t.load[p] += !is_signal(use[before].what);
    auto& last = t.reader[static_cast<std::size_t>(use[p].what)][s];
    t.previous[p] = last;
    last = p;
  }
  return t;
}

/// The wiring of a chain of elements E..., each an `element<Core, Keys...>`.
template <class... E>
struct wiring;

template <class E>
struct uses_of;
template <class E, std::size_t Port>
struct key_at;
template <class Core, class... Keys, std::size_t Port>
struct key_at<element<Core, Keys...>, Port> : std::tuple_element<Port, std::tuple<Keys...>> {};
template <class E, std::size_t Port>
using key_of = typename key_at<E, Port>::type;
template <class Core, class... Keys>
struct uses_of<element<Core, Keys...>> {
  static constexpr int count = static_cast<int>(sizeof...(Keys));
  static constexpr std::array<port_use, sizeof...(Keys)> make() {
    std::array<port_use, sizeof...(Keys)> u{};
    const std::uint64_t keys[]{id_of_key<Keys>...}, texts[]{id_of_text<Keys>...};
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = {Core::ports[i].what, Core::ports[i].how, keys[i], texts[i]};
    return u;
  }
};

template <class... E>
struct wiring {
  static constexpr std::size_t elements = sizeof...(E);
  static constexpr std::array<int, elements + 1> first = [] {
    std::array<int, elements + 1> f{};
    const int counts[]{uses_of<E>::count..., 0};
    for (std::size_t e = 0; e < elements; ++e) f[e + 1] = f[e] + counts[e];
    return f;
  }();
  static constexpr std::size_t ports = static_cast<std::size_t>(first[elements]);
  static constexpr auto table = [] {
    std::array<port_use, ports + 1> all{};
    std::size_t p = 0;
    [[maybe_unused]] const auto append = [&](const auto& some) {
      for (const auto& u : some) all[p++] = u;
      return 0;
    };
    const int done[]{append(uses_of<E>::make())..., 0};
    (void)done;
    return resolve<ports, elements>(all, first);
  }();

  /// Kind and index of the thing at port `port` of element e.
  static constexpr kind what(std::size_t e, std::size_t port) {
    return table.what[static_cast<std::size_t>(first[e]) + port];
  }
  static constexpr int slot(std::size_t e, std::size_t port) {
    return table.slot[static_cast<std::size_t>(first[e]) + port];
  }
  static constexpr int count(kind k) { return table.count[static_cast<std::size_t>(k)]; }
  static constexpr int writer(kind k, int s) {
    return table.writer[static_cast<std::size_t>(k)][static_cast<std::size_t>(s)];
  }
  /// The number of degrees of freedom, and the size of a configuration.
  static constexpr int dofs = table.nv;
  static constexpr int nq = table.nq;
  static constexpr std::size_t freedoms = static_cast<std::size_t>(table.freedoms);
  template <std::size_t I>
  static constexpr freedom free = table.free[I];
  /// The freedom of thing s of kind k; at.what is `input` if it is not a degree of freedom.
  static constexpr freedom freedom_of(kind k, int s) {
    for (std::size_t i = 0; i < freedoms; ++i)
      if (table.free[i].what == k && table.free[i].slot == s) return table.free[i];
    return {kind::input, 0, 0, 0};
  }
  template <kind K, int Slot>
  static constexpr freedom at = freedom_of(K, Slot);
  template <kind K, int Slot>
  static constexpr bool is_free = at<K, Slot>.what == K&& is_coordinate(K);
  /// The size of u, and the first index of a signal in it; -1: an element writes it, or it is the time.
  static constexpr int nu = table.nu;
  static constexpr int input_place(kind k, int s) {
    for (int i = 0; i < table.signals; ++i)
      if (const auto& x = table.signal[static_cast<std::size_t>(i)]; x.what == k && x.slot == s) return x.u;
    return -1;
  }
  /// The number of generalized coordinates that are degrees of freedom.
  static constexpr int gen_dofs = [] {
    int n = 0;
    for (std::size_t i = 0; i < freedoms; ++i) n += table.free[i].what == kind::gen;
    return n;
  }();
  /// Whether the sine and cosine of generalized coordinate s are needed.
  static constexpr bool angle(int s) { return table.angle[static_cast<std::size_t>(s)]; }
  /// Index of a key among things of its kind, or -1.
  template <class Key>
  static constexpr int find() {
    const auto k = static_cast<std::size_t>(Key::what);
    for (int s = 0; s < table.count[k]; ++s)
      if (table.key[k][static_cast<std::size_t>(s)] == id_of_key<Key>) return s;
    return -1;
  }
};

/// The first wiring error of a chain, if any: the element, and the name in question.
template <class Wiring, bool Bad, class... E>
struct problem_of {
  using type = check_wiring<void, problem::none, void>;
};
template <class Wiring, class... E>
struct problem_of<Wiring, true, E...> {
  template <std::size_t I>
  using element_type = std::tuple_element_t<I, std::tuple<E...>>;
  static constexpr auto& table = Wiring::table;
  using bad = element_type<table.bad_element>;
  using key = key_of<bad, table.bad_port>;
  /// The port with a similar key of this kind, which may be the intended one; `ports` if there is none.
  static constexpr std::size_t meant = [] {
    std::array<std::string_view, Wiring::ports> names{};
    std::size_t p = 0;
    const auto put = [&]<class Core, class... Keys>(const element<Core, Keys...>*) {
      ((names[p++] = Keys::what == key::what && Keys::name != key::name ? Keys::name : std::string_view()), ...);
    };
    (put(static_cast<const E*>(nullptr)), ...);
    constexpr bool asks = (table.error == problem::unknown || table.error == problem::moves_nothing) &&
                          Wiring::ports < 200;  // clang fails beyond that
    return asks ? nearest_name(key::name, names) : names.size();
  }();
  template <std::size_t P, class Written>
  struct name {
    static constexpr auto e = static_cast<std::size_t>(table.element[P]);
    using type = did_you_mean_key<Written, key_of<element_type<e>, P - static_cast<std::size_t>(Wiring::first[e])>>;
  };
  template <class Written>
  struct name<Wiring::ports, Written> {
    using type = Written;
  };
  using type = check_wiring<bad, table.error, typename name<meant, key>::type>;
};
template <class... E>
using first_problem = typename problem_of<wiring<E...>, (wiring<E...>::table.error != problem::none), E...>::type;

}  // namespace kte::detail
