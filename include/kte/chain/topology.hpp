#pragma once

#include <kte/chain/port.hpp>
#include <kte/errors.hpp>

#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace kte {

class kte_element;

/// Who is connected to what in a runtime chain: the counterpart of `detail::wiring`, worked out as elements come, with
/// the same rules and the same numbering of the degrees of freedom.
class topology {
 public:
  struct thing {
    kind what;
    int index;      ///< among things of its kind
    int writer;     ///< the element that writes it, or -1: given from outside
    bool declared;  ///< written by an element, or declared by base_gen, base_2D, base_3D
    bool moves;     ///< for coordinates: an element moves by it, or it is given
  };
  struct connection {
    const kte_element* element = nullptr;
    std::vector<int> index;  ///< of what each port is connected to
    int coordinate = -1;     ///< of a joint
    bool stiff = false;      ///< whether it is a joint or a link
    int below = -1;          ///< the element that writes the base of a joint or link, -1 for a base of the chain
  };

  std::array<std::vector<std::string>, 4> names;  ///< of all things, by kind
  std::vector<int> dofs;                          ///< the coordinates that are degrees of freedom
  std::vector<connection> elements;               ///< in order
  std::array<std::vector<int>, 4> writers;        ///< of all things, by kind: an element, or -1

  /// Equal for chains with the same things in the same order: a new one for every element, the same for copies.
  std::shared_ptr<const char> layout = std::make_shared<char>();

  /// Connects one more element. Throws `bad_wiring`, and then nothing has changed.
  void connect(const kte_element* e, std::string_view type, std::span<const port> ports,
               std::span<const std::string> to) {
    check(type, ports, to);
    connection c;
    c.element = e;
    for (std::size_t p = 0; p < ports.size(); ++p) c.index.push_back(add(ports[p], to[p]));
    elements.push_back(std::move(c));
    layout = std::make_shared<char>();
  }
  /// Throws `bad_wiring` where a coordinate is acted upon but moves nothing.
  void check_complete() const {
    for (const auto& [name, t] : things_)
      if (t.what == kind::gen && !t.moves)
        throw bad_wiring("kte: a force acts on coordinate '" + name + "', which no element moves by: is it misspelt?");
  }
  /// What a name is; throws `unknown_name`.
  kind kind_of(std::string_view name) const {
    const auto it = things_.find(name);
    if (it == things_.end()) throw unknown_name("kte: this chain has nothing of the name '" + std::string(name) + "'");
    return it->second.what;
  }
  /// Index of a name; throws `unknown_name`.
  int find(std::string_view name, kind k) const {
    const auto it = things_.find(name);
    if (it == things_.end())
      throw unknown_name("kte: this chain has no " + std::string(to_string(k)) + " '" + std::string(name) + "'");
    if (it->second.what != k)
      throw unknown_name("kte: '" + std::string(name) + "' is a " + std::string(to_string(it->second.what)) +
                         ", not a " + std::string(to_string(k)));
    return it->second.index;
  }

 private:
  [[noreturn]] static void fail(std::string_view type, std::span<const port> ports, std::span<const std::string> to,
                                const std::string& why) {
    std::vector<std::string_view> views(to.begin(), to.end());
    throw bad_wiring("kte: " + describe_element(type, ports, views) + ": " + why);
  }
  void check(std::string_view type, std::span<const port> ports, std::span<const std::string> to) const {
    bool base_taken = base_known_;
    std::map<std::string, const port*, std::less<>> fresh;  // names that this element brings
    for (std::size_t p = 0; p < ports.size(); ++p) {
      const port& x = ports[p];
      const std::string quoted = "'" + to[p] + "'";
      if (to[p].empty()) fail(type, ports, to, "its " + std::string(x.role) + " has no name");
      const auto known = things_.find(to[p]);
      const auto here = fresh.find(to[p]);
      if (known != things_.end() || here != fresh.end()) {
        const kind k = known != things_.end() ? known->second.what : here->second->what;
        if (k != x.what)
          fail(type, ports, to,
               quoted + " is a " + std::string(to_string(k)) + ", not a " + std::string(to_string(x.what)));
        const bool declared = known != things_.end() ? known->second.declared : here->second->writes();
        if (x.writes())
          fail(type, ports, to,
               "it writes " + quoted +
                   (declared ? ", which is then written twice" : ", which is read before it is written"));
        continue;
      }
      fresh.emplace(to[p], &x);
      const bool frame = x.what == kind::frame_2D || x.what == kind::frame_3D;
      if (frame && !x.writes()) {
        if (base_taken)
          fail(type, ports, to,
               "it reads " + quoted +
                   ", which no element before it writes: misspelt, written later, or another base? "
                   "(a further base is declared by base_2D or base_3D)");
        base_taken = true;
      }
    }
  }
  int add(const port& x, const std::string& name) {
    const auto k = static_cast<std::size_t>(x.what);
    const int writer = x.how == access::out ? static_cast<int>(elements.size()) : -1;
    const bool moves = x.how != access::on;
    const auto [it, fresh] =
        things_.try_emplace(name, thing{x.what, static_cast<int>(names[k].size()), writer, x.writes(), moves});
    it->second.moves |= moves;
    if (fresh) {
      names[k].push_back(name);
      writers[k].push_back(writer);
      if (x.what == kind::gen && !x.writes()) dofs.push_back(it->second.index);
      if ((x.what == kind::frame_2D || x.what == kind::frame_3D) && !x.writes()) base_known_ = true;
    }
    return it->second.index;
  }

  std::map<std::string, thing, std::less<>> things_;
  bool base_known_ = false;
};

}  // namespace kte
