#pragma once

#include <kte/io/archive_file.hpp>

#include "catch.hpp"
#include "io/scratch.hpp"

namespace kte::test {

/// Through a file of each format.
template <class Check>
void in_all_formats(const archive& a, const Check& check) {
  for (const char* extension : {".xml", ".json", ".kte"}) {
    CAPTURE(extension);
    const scratch file(extension);
    save_archive(file.path, a);
    const auto b = load_archive(file.path);
    CHECK(b.record() == a.record());
    check(b);
  }
}

}  // namespace kte::test
