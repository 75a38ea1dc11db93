#pragma once

#include <kte/runtime_chain.hpp>
#include <kte/static_chain/static_chain.hpp>

#include <boost/hana/for_each.hpp>

#include <map>

/// Chains as graphs in the language of Graphviz.
namespace kte {

namespace detail {

/// A text in quotes, for labels. Graphviz interprets backslashes and ampersands as escapes.
inline std::string dot_text(std::string_view text) {
  std::string s = "\"";
  for (const char c : text) {
    if (c == '"')
      s += "\\\"";
    else if (c == '\\')
      s += "\\\\";
    else if (c == '&')
      s += "&amp;";
    else if (c == '\n')
      s += "\\n";
    else
      s += c;
  }
  return s + '"';
}

/// The graph of a chain: e0, e1 ... are elements, n0, n1 ... the coordinates, frames and signals that they connect.
class dot_graph {
 public:
  template <class Names>
  void add(std::string_view type, std::span<const port> ports, const Names& names) {
    const std::string element = "e" + std::to_string(elements_++);
    line(element + " [shape=box, label=" + dot_text(type) + "]");
    for (std::size_t p = 0; p < ports.size(); ++p) {
      const std::string thing = node(ports[p].what, std::string(names[p]));
      const bool writes = ports[p].writes();
      line((writes ? element : thing) + " -> " + (writes ? thing : element) + " [label=" + dot_text(ports[p].role) +
           style(ports[p].how) + "]");
    }
  }
  std::string text() const { return "digraph kte {\n  rankdir=LR\n" + lines_ + "}\n"; }

 private:
  void line(const std::string& x) { lines_ += "  " + x + "\n"; }
  /// Frames and other names are separate.
  std::string node(kind k, const std::string& name) {
    const auto [known, fresh] = nodes_.emplace(std::pair(is_frame(k), name), nodes_.size());
    std::string id = "n" + std::to_string(known->second);
    const char* shape = is_frame(k) ? "ellipse" : is_coordinate(k) ? "circle" : "diamond";
    if (fresh) line(id + " [shape=" + shape + ", label=" + dot_text(name) + "]");
    return id;
  }
  static const char* style(access how) {
    return how == access::on ? ", style=dashed, dir=back" : how == access::keep ? ", dir=both" : "";
  }

  std::size_t elements_ = 0;
  std::map<std::pair<bool, std::string>, std::size_t> nodes_;
  std::string lines_;
};

}  // namespace detail

/// The graph of a static chain for Graphviz, `dot -Tsvg`: elements are boxes, coordinates circles, frames ellipses,
/// signals and internal states diamonds. Arrows lead from the inputs of an element to it, and from it to its outputs;
/// dashed arrows to coordinates and frames on which it acts by a force. They are labelled by the roles of ports.
template <class Gravity, class... E>
[[nodiscard]] std::string to_dot(const static_chain<Gravity, E...>& chain) {
  detail::dot_graph graph;
  boost::hana::for_each(chain.elements(), [&graph]<class Core, class... Keys>(const element<Core, Keys...>&) {
    graph.add(Core::type, Core::ports, std::array<std::string_view, sizeof...(Keys)>{Keys::name...});
  });
  return graph.text();
}
/// The graph of a runtime chain for Graphviz; a part that is neither an element nor a chain is shown by its elements.
[[nodiscard]] inline std::string to_dot(const runtime_chain& chain) {
  detail::dot_graph graph;
  chain.for_each_element([&graph](const kte_element& e) { graph.add(e.type(), e.ports(), e.names()); });
  return graph.text();
}

}  // namespace kte
