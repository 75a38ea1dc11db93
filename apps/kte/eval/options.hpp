#pragma once

#include <kte/errors.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace evaluate {

/// The operations of `--ops`, which are printed for each state.
struct operations {
  bool id = true, fd = true, m = true, g = false, h = false, energy = true, com = true, did = false, dfd = false;
  bool asked = false;  ///< whether a table without the columns that they need is refused

  /// Of "id,fd,m", or of "" the usual ones; with derivatives also those. Throws `bad_argument` for other names.
  static operations of(std::string_view names, bool derivatives) {
    operations o;
    if (!names.empty()) {
      o.id = o.fd = o.m = o.energy = o.com = false, o.asked = true;
      while (!names.empty()) {
        const auto end = (std::min)(names.find(','), names.size());
        o.add(names.substr(0, end));
        names.remove_prefix((std::min)(end + 1, names.size()));
      }
    }
    if (derivatives) o.did = o.dfd = true;
    return o;
  }
  static constexpr std::string_view known = "id, fd, m, g, h, energy, com, did, dfd";

 private:
  void add(std::string_view name) {
    const std::pair<std::string_view, bool&> all[]{{"id", id},   {"fd", fd},   {"m", m},
                                                   {"g", g},     {"h", h},     {"energy", energy},
                                                   {"com", com}, {"did", did}, {"dfd", dfd}};
    for (const auto& [known_name, flag] : all)
      if (name == known_name) {
        flag = true;
        return;
      }
    throw kte::bad_argument("kte: there is no operation '" + std::string(name) + "', but " + std::string(known));
  }
};

struct options {
  std::filesystem::path states;
  std::vector<std::string> frames;
  std::string ops;  ///< names of operations; empty: the usual ones
  bool derivatives = false;
  bool loops = false;  ///< whether the robot has closed loops: then inverse dynamics is not among the usual operations
  int digits = 17;
};

}  // namespace evaluate
