#include "chain/registered.hpp"

#include "chain/gear.hpp"

#ifndef KTE_COMPILED  // which has it
template kte::element_registry kte::element_registry::standard<void>();
#endif

const kte::element_registry& models::registry() {
  static const auto all = [] {
    auto r = kte::element_registry::standard();
    r.add("gear_gen", [](const kte::record_reader& x) {
      return kte::connect(kte::test::gear{x.number("ratio")}, x.name("base"), x.name("end"));
    });
    return r;
  }();
  return all;
}
