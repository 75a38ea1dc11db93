#pragma once

#include <kte/contract/parameter_check.hpp>

namespace kte {

/// Base of element cores without parameters.
struct no_parameters {
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace kte
