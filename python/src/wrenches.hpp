#pragma once

#include <kte/dynamics/external_wrenches.hpp>

#include <list>
#include <vector>

#include "arrays.hpp"
#include "chain.hpp"

namespace kte_python {

/// Wrenches on frames, from a dict of frames to 3 numbers, a force, or 6, a force and a torque.
struct wrenches_argument {
  std::list<std::string> names;
  std::vector<kte::external_wrench> all;  ///< refer to the names

  explicit wrenches_argument(py::handle wrenches) {
    for (const auto& [frame, load] : dict_from("wrenches", "frames to 3 or 6 numbers", wrenches)) {
      const auto x = vector_from("a wrench", load, -1);
      if (x.size() != 3 && x.size() != 6)
        throw kte::bad_argument("kte: a wrench has " + std::to_string(x.size()) +
                                " numbers, expected 3, a force, or 6, a force and a torque");
      all.emplace_back(names.emplace_back(frame.cast<std::string>()), kte::vec3<>{x[0], x[1], x[2]},
                       x.size() == 6 ? kte::vec3<>{x[3], x[4], x[5]} : kte::vec3<>{});
    }
  }
  wrenches_argument(const wrenches_argument&) = delete;
  wrenches_argument& operator=(const wrenches_argument&) = delete;
};

}  // namespace kte_python
