#pragma once

#include <kte/dynamics/closed_loops/chain_constraints.hpp>
#include <kte/tree/loop_loads.hpp>

#include <numeric>

/// The places of the closures of a chain in its tree, computed once for a state. `Closures`: as
/// dynamics/closed_loops/chain_constraints.hpp; states as in dynamics/looped/inverse_dynamics.hpp, in double.
namespace kte::detail {

struct closure_place {
  int element = 0, loop = 0;  ///< its number in the chain; the number of its name among loops
  closure_rows rows;
  int first = 0;                 ///< its first row among all
  runtime_frame frame1, frame2;  ///< for a closure of frames
  std::vector<int> coordinates;  ///< for a closure of coordinates: slots, and rows of v
  std::vector<int> dofs;
  std::vector<int> axes;    ///< for a closure of coordinates: the axis of the joint there
  std::vector<int> places;  ///< degrees of freedom where its rows have entries, in order
  tree::load_way way;       ///< path of its forces, for trees
  /// By place in the path: for frame1, frame2 or coordinates; -1 on a base.
  std::vector<int> enters;
  bool of_frames() const { return coordinates.empty(); }
};
/// Where the frames of a closure or contact are if no joint moves them relative to each other; otherwise null.
template <class State>
const char* fixed_frames(const State& s, const closure_place& x) {
  const auto& f = s.tree().body_tree;
  const int a = f.frame(x.frame1.what, x.frame1.index).slot, b = f.frame(x.frame2.what, x.frame2.index).slot;
  if (a < f.bases && b < f.bases) return "both on bases";
  return a == b ? "on one body" : nullptr;
}
/// Closures that share degrees of freedom, and these degrees of freedom: a separate problem.
struct loop_block {
  std::vector<int> closures;
  std::vector<int> rows_among_all;  ///< by row
  std::vector<int> places;          ///< degrees of freedom of its frames down to the base, in order
  int rows = 0;
};

/// The closures of a chain, and the degrees of freedom by places; for a tree in the order of its axes.
class closure_places {
 public:
  template <class State>
  closure_places(const chain_constraints& c, const State& s) {
    const auto& t = s.tree();
    order_places(s);
    c.each_closure([&](int e) { add(c, s, e); });
    for (auto& x : closures) {
      if (t.plan.tree) find_way(s, x);
      x.places = places_of(s, x);
    }
    make_blocks();
    for (const auto& r : t.body_tree.nodes) length = (std::max)(length, size_of(r.position));
    for (const auto& of_kind : t.body_tree.frames)
      for (const auto& x : of_kind) length = (std::max)(length, size_of(x.at.position));
    for (const auto& x : closures)
      if (x.of_frames()) length = (std::max)(length, characteristic_length(c, x));
    if (!(length > 0)) length = 1;
  }

  std::vector<closure_place> closures;
  std::vector<loop_block> blocks;
  int rows = 0;
  double length = 0;               ///< of the largest link, rod or shape, m: a row in m is divided by it
  std::vector<int> row_of_place;   ///< by place: the row in v
  std::vector<int> axis_of_place;  ///< by place, for trees; -1: it moves no joint
  std::vector<int> place_of_axis;  ///< -1: not a degree of freedom
  std::vector<int> place_of_row;
  std::vector<int> column_of_place;  ///< by place: the column in its block

  /// The name of row k, for messages: "pin[1]".
  std::string name_of_row(const chain_constraints& c, int k) const {
    const auto& x = closure_of_row(k);
    std::string name(c.loop_name(x.loop));
    if (x.rows.count() > 1) name.append("[").append(std::to_string(k - x.first + 1)).append("]");
    return name;
  }
  /// The closures of a block, in a text: the first `most` of them, and how many others there are.
  std::string names_in(const chain_constraints& c, const loop_block& b, std::string_view quote,
                       std::size_t most = static_cast<std::size_t>(-1)) const {
    std::string names;
    for (std::size_t i = 0; i < b.closures.size(); ++i) {
      if (i == most) return names + " and " + std::to_string(b.closures.size() - most) + " others";
      names.append(names.empty() ? "" : ", ")
          .append(quote)
          .append(c.loop_name(closures[static_cast<std::size_t>(b.closures[i])].loop))
          .append(quote);
    }
    return names;
  }
  const closure_place& closure_of_row(int k) const {
    std::size_t i = 0;
    while (i + 1 < closures.size() && closures[i + 1].first <= k) ++i;
    return closures[i];
  }
  /// Row k of a block among all.
  static int row_of(const loop_block& b, int k) { return b.rows_among_all[static_cast<std::size_t>(k)]; }
  /// The factor of row k of a closure.
  double scale(const closure_place& x, int k) const { return k < x.rows.linear ? 1 / length : 1; }

 private:
  /// Of packs the largest of all lanes.
  template <class P>
  static double size_of(const vec3<P>& x) {
    return std::sqrt(static_cast<double>(largest_lane(P(dot(x, x)))));
  }

  /// The size of a contact; or the length that a closure keeps, as `distance` does: twice its largest residual in m
  /// where its frames coincide.
  static double characteristic_length(const chain_constraints& c, const closure_place& x) {
    if (c.touches(x.element)) return c.contact_size(x.element);
    const closing_motion<double> coincident{{}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}, {}, {}, {}};
    double residual[6]{}, most = 0;
    c.close_frames(x.element, coincident, closing::residual, residual);
    for (int r = 0; r < x.rows.linear; ++r)
      if (const double size = 2 * std::abs(residual[r]); size < 1e300) most = (std::max)(most, size);
    return most;
  }
  template <class State>
  void order_places(const State& s) {
    const auto& t = s.tree();
    const auto& f = t.body_tree;
    const int n = s.dofs();
    place_of_axis.assign(f.row.size(), -1), place_of_row.assign(static_cast<std::size_t>(n), -1);
    const auto add = [&](int row, int axis) {
      place_of_row[static_cast<std::size_t>(row)] = static_cast<int>(row_of_place.size());
      row_of_place.push_back(row), axis_of_place.push_back(axis);
    };
    if (t.plan.tree)
      for (const auto& r : f.nodes)
        for (int k = r.first; k < r.first + r.axes; ++k) {
          const int row = f.row[static_cast<std::size_t>(k)];
          if (row >= n) continue;
          place_of_axis[static_cast<std::size_t>(k)] = static_cast<int>(row_of_place.size());
          add(row, k);
        }
    for (int row = 0; row < n; ++row)  // coordinates that move no joint; all of them if M is dense
      if (place_of_row[static_cast<std::size_t>(row)] < 0) add(row, -1);
  }
  template <class State>
  void add(const chain_constraints& c, const State& s, int e) {
    const auto refuse = [&c, e](const std::string& why) { raise<bad_argument>("kte: " + c.describe(e) + why); };
    const auto ports = c.ports(e);
    closure_place x;
    x.element = e, x.loop = c.written(e), x.rows = c.rows(e), x.first = rows;
    rows += x.rows.count();
    if (is_frame(ports[0].what)) {
      x.frame1 = {ports[0].what, c.index(e, 0)}, x.frame2 = {ports[1].what, c.index(e, 1)};
      for (const auto& frame : {x.frame1, x.frame2})
        if (s.tree().body_tree.frame(frame.what, frame.index).slot < 0)
          refuse(" is on a frame that follows others: closures take frames that joints and links move");
      if (const char* where = fixed_frames(s, x); where != nullptr && !c.touches(e))
        refuse(std::string(" closes no loop: no joint moves its frames relative to each other: they are ") + where);
    } else {
      for (std::size_t p = 0; p + 1 < ports.size(); ++p) {
        const int row = s.tree().plan.row_of_gen[static_cast<std::size_t>(c.index(e, p))];
        if (row >= s.dofs())
          refuse(" has a " + std::string(ports[p].role) +
                 " that is not a degree of freedom: closures couple coordinates that no element or signal moves");
        if (std::find(x.dofs.begin(), x.dofs.end(), row) != x.dofs.end()) refuse(" couples a coordinate to itself");
        x.coordinates.push_back(c.index(e, p)), x.dofs.push_back(row);
      }
    }
    closures.push_back(std::move(x));
  }
  template <class State>
  static void find_way(const State& s, closure_place& x) {
    const auto& f = s.tree().body_tree;
    std::vector<int> ends;  // body nodes, or negative if there is none
    if (x.of_frames()) {
      for (const auto& frame : {x.frame1, x.frame2}) ends.push_back(f.frame(frame.what, frame.index).slot - f.bases);
    } else {
      for (const int row : x.dofs) {
        std::size_t axis = 0, node = 0;
        while (axis < f.row.size() && f.row[axis] != row) ++axis;
        while (node + 1 < f.nodes.size() && static_cast<std::size_t>(f.nodes[node + 1].first) <= axis) ++node;
        const bool moves = axis < f.row.size();
        ends.push_back(moves ? static_cast<int>(node) : -1);
        x.axes.push_back(moves ? static_cast<int>(axis) - f.nodes[node].first : 0);
      }
    }
    auto& nodes = x.way.nodes;
    for (int i : ends)
      for (; i >= 0; i = f.nodes[static_cast<std::size_t>(i)].parent - f.bases) nodes.push_back(i);
    std::sort(nodes.rbegin(), nodes.rend());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const auto place_of = [&nodes](int i) {
      const auto at = std::find(nodes.begin(), nodes.end(), i);
      return at == nodes.end() ? -1 : static_cast<int>(at - nodes.begin());
    };
    for (const int i : nodes) x.way.next.push_back(place_of(f.nodes[static_cast<std::size_t>(i)].parent - f.bases));
    for (const int i : ends) x.enters.push_back(place_of(i));
    x.way.loaded.assign(nodes.size(), 0);
    const auto load = [&x](int place) {
      if (place >= 0) x.way.loaded[static_cast<std::size_t>(place)] = 1;
    };
    if (x.of_frames()) std::for_each(x.enters.begin(), x.enters.end(), load);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (x.way.next[n] != static_cast<int>(n) + 1) load(x.way.next[n]);
  }
  /// All places where the factor of a closure has entries.
  template <class State>
  std::vector<int> places_of(const State& s, const closure_place& x) const {
    std::vector<int> all;
    if (!s.tree().plan.tree) {
      all.resize(row_of_place.size());
      std::iota(all.begin(), all.end(), 0);
      return all;
    }
    for (const int row : x.dofs) all.push_back(place_of_row[static_cast<std::size_t>(row)]);
    for (const int i : x.way.nodes) {
      const auto& r = s.tree().body_tree.nodes[static_cast<std::size_t>(i)];
      for (int k = r.first; k < r.first + r.axes; ++k)
        if (const int place = place_of_axis[static_cast<std::size_t>(k)]; place >= 0) all.push_back(place);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }
  void make_blocks() {
    std::vector<int> owner(row_of_place.size(), -1);  // by place: a closure
    std::vector<int> joined(closures.size());         // by closure: another one of its block
    std::iota(joined.begin(), joined.end(), 0);
    const auto first_of = [&joined](int i) {
      while (joined[static_cast<std::size_t>(i)] != i) i = joined[static_cast<std::size_t>(i)];
      return i;
    };
    for (std::size_t i = 0; i < closures.size(); ++i)
      for (const int place : closures[i].places) {
        int& at = owner[static_cast<std::size_t>(place)];
        if (at < 0) at = static_cast<int>(i);
        const int a = first_of(at), b = first_of(static_cast<int>(i));
        joined[static_cast<std::size_t>((std::max)(a, b))] = (std::min)(a, b);
      }
    std::vector<int> block_of(closures.size(), -1);
    for (std::size_t i = 0; i < closures.size(); ++i) {
      int& block = block_of[static_cast<std::size_t>(first_of(static_cast<int>(i)))];
      if (block < 0) block = static_cast<int>(blocks.size()), blocks.emplace_back();
      auto& b = blocks[static_cast<std::size_t>(block)];
      b.closures.push_back(static_cast<int>(i)), b.rows += closures[i].rows.count();
      for (int k = 0; k < closures[i].rows.count(); ++k) b.rows_among_all.push_back(closures[i].first + k);
      b.places.insert(b.places.end(), closures[i].places.begin(), closures[i].places.end());
    }
    column_of_place.assign(row_of_place.size(), -1);
    for (auto& b : blocks) {
      std::sort(b.places.begin(), b.places.end());
      b.places.erase(std::unique(b.places.begin(), b.places.end()), b.places.end());
      for (std::size_t i = 0; i < b.places.size(); ++i)
        column_of_place[static_cast<std::size_t>(b.places[i])] = static_cast<int>(i);
    }
  }
};

}  // namespace kte::detail
