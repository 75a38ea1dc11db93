#pragma once

#include <kte/models/variational.hpp>

#include "mechanism.hpp"

namespace work_precision {

template <class Mechanism, class X>
void add_variational(problem& p, const task<X>& t) {
  const entrants<mechanism<Mechanism>, X> those(p, the<Mechanism>, t);
  those.template add<kte::variational2>("variational2", 4);
  those.template add<kte::variational4>("variational4");
}

}  // namespace work_precision
