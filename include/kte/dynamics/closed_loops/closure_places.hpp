#pragma once

#include <kte/dynamics/runtime/jacobian.hpp>

#include <numeric>

/// Where the closures of a runtime chain stand in its tree, worked out once for a state.
namespace kte::detail {

struct closure_place {
  int element = 0, loop = 0;  ///< its number in the chain; its name among loops
  closure_rows rows;
  int first = 0;                 ///< of its rows among all
  runtime_frame frame1, frame2;  ///< of a closure of frames
  std::vector<int> coordinates;  ///< of a closure of coordinates: slots, and rows of v
  std::vector<int> dofs;
  bool of_frames() const { return coordinates.empty(); }
};
/// Closures that share degrees of freedom, with those: a problem of its own.
struct loop_block {
  std::vector<int> closures;
  std::vector<int> places;  ///< degrees of freedom of its frames down to the base, those below first
  int rows = 0;
};

/// The closures of a chain, and the degrees of freedom by places: in an order with those below first, so that the mass
/// matrix has entries only between a place and those on its way to the base.
class closure_places {
 public:
  closure_places(const runtime_chain& c, const runtime_state& s) {
    const auto& t = s.tree();
    order_places(s);
    const auto& elements = c.wiring().elements;
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (elements[e].closes) add(c, s, static_cast<int>(e));
    std::vector<std::vector<int>> touched;
    for (const auto& x : closures) touched.push_back(places_of(s, x));
    make_blocks(touched);
    for (const auto& r : t.body_tree.nodes) length = (std::max)(length, size_of(r.position));
    for (const auto& of_kind : t.body_tree.frames)
      for (const auto& x : of_kind) length = (std::max)(length, size_of(x.at.position));
    if (!(length > 0)) length = 1;
  }

  std::vector<closure_place> closures;
  std::vector<loop_block> blocks;
  int rows = 0;
  double length = 0;               ///< of the largest link, m: a row in m is divided by it
  std::vector<int> row_of_place;   ///< in v
  std::vector<int> below;          ///< the next place on the way to the base, or -1
  std::vector<int> place_of_axis;  ///< -1: no degree of freedom
  std::vector<int> place_of_row;
  std::vector<int> column_of_place;  ///< in its block

  /// The name of row k, for messages: "pin[1]".
  std::string name_of_row(const runtime_chain& c, int k) const {
    const auto& x = closure_of_row(k);
    return name_of(c, x) + (x.rows.count() > 1 ? "[" + std::to_string(k - x.first + 1) + "]" : "");
  }
  static const std::string& name_of(const runtime_chain& c, const closure_place& x) {
    return c.wiring().names[static_cast<std::size_t>(kind::loop)][static_cast<std::size_t>(x.loop)];
  }
  const closure_place& closure_of_row(int k) const {
    std::size_t i = 0;
    while (i + 1 < closures.size() && closures[i + 1].first <= k) ++i;
    return closures[i];
  }
  /// What row k of a closure is multiplied by.
  double scale(const closure_place& x, int k) const { return k < x.rows.linear ? 1 / length : 1; }

 private:
  static double size_of(const vec3<>& x) { return std::sqrt(dot(x, x)); }

  void order_places(const runtime_state& s) {
    const auto& t = s.tree();
    const auto& f = t.body_tree;
    const int n = s.dofs();
    place_of_axis.assign(f.row.size(), -1), place_of_row.assign(static_cast<std::size_t>(n), -1);
    const auto add = [&](int row, int on) {
      place_of_row[static_cast<std::size_t>(row)] = static_cast<int>(row_of_place.size());
      row_of_place.push_back(row), below.push_back(on);
    };
    if (t.plan.tree) {
      std::vector<int> last(f.slots(), -1);  // the last place on the way to a slot
      for (std::size_t i = 0; i < f.nodes.size(); ++i) {
        const auto& r = f.nodes[i];
        int on = last[static_cast<std::size_t>(r.parent)];
        for (int k = r.first; k < r.first + r.axes; ++k) {
          const int row = f.row[static_cast<std::size_t>(k)];
          if (row >= n) continue;
          place_of_axis[static_cast<std::size_t>(k)] = static_cast<int>(row_of_place.size());
          add(row, on);
          on = static_cast<int>(row_of_place.size()) - 1;
        }
        last[static_cast<std::size_t>(f.bases) + i] = on;
      }
    }
    for (int row = 0; row < n; ++row)  // coordinates that move no joint; all of them where M is dense
      if (place_of_row[static_cast<std::size_t>(row)] < 0)
        add(row, t.plan.tree ? -1 : static_cast<int>(row_of_place.size()) - 1);
  }
  void add(const runtime_chain& c, const runtime_state& s, int e) {
    const auto& connection = c.wiring().elements[static_cast<std::size_t>(e)];
    closure_place x;
    x.element = e, x.loop = connection.index.back(), x.rows = connection.element->rows(), x.first = rows;
    rows += x.rows.count();
    if (is_frame(connection.ports[0].what)) {
      x.frame1 = {connection.ports[0].what, connection.index[0]};
      x.frame2 = {connection.ports[1].what, connection.index[1]};
      for (const auto& frame : {x.frame1, x.frame2})
        if (s.tree().body_tree.frame(frame.what, frame.index).slot < 0)
          refuse(c, e, " is on a frame that follows others: closures take frames that joints and links move");
    } else {
      for (std::size_t p = 0; p + 1 < connection.index.size(); ++p) {
        const int row = s.tree().plan.row_of_gen[static_cast<std::size_t>(connection.index[p])];
        if (row >= s.dofs()) refuse(c, e, " couples a coordinate that is not a degree of freedom");
        x.coordinates.push_back(connection.index[p]), x.dofs.push_back(row);
      }
    }
    closures.push_back(std::move(x));
  }
  [[noreturn]] static void refuse(const runtime_chain& c, int e, const char* why) {
    throw bad_argument("kte: " + describe_element(runtime_elements{c}.element(e)) + why);
  }
  /// All places that the factor of a closure has entries at.
  std::vector<int> places_of(const runtime_state& s, const closure_place& x) const {
    std::vector<int> all;
    if (!s.tree().plan.tree) {
      all.resize(row_of_place.size());
      std::iota(all.begin(), all.end(), 0);
      return all;
    }
    const auto add_way = [&](int place) {
      for (; place >= 0; place = below[static_cast<std::size_t>(place)]) all.push_back(place);
    };
    for (const int row : x.dofs) add_way(place_of_row[static_cast<std::size_t>(row)]);
    if (x.of_frames()) {
      const auto& f = s.tree().body_tree;
      for (const auto& frame : {x.frame1, x.frame2})
        for (int slot = f.frame(frame.what, frame.index).slot; slot >= f.bases;) {
          const auto& r = f.nodes[static_cast<std::size_t>(slot - f.bases)];
          for (int k = r.first; k < r.first + r.axes; ++k)
            if (const int place = place_of_axis[static_cast<std::size_t>(k)]; place >= 0) all.push_back(place);
          slot = r.parent;
        }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }
  void make_blocks(const std::vector<std::vector<int>>& touched) {
    std::vector<int> owner(row_of_place.size(), -1);  // of a place: a closure
    std::vector<int> joined(closures.size());         // of a closure: another of its block
    std::iota(joined.begin(), joined.end(), 0);
    const auto first_of = [&joined](int i) {
      while (joined[static_cast<std::size_t>(i)] != i) i = joined[static_cast<std::size_t>(i)];
      return i;
    };
    for (std::size_t i = 0; i < closures.size(); ++i)
      for (const int place : touched[i]) {
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
      b.places.insert(b.places.end(), touched[i].begin(), touched[i].end());
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
