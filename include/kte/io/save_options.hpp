#pragma once

namespace kte {

/// Options of writing a file: `save_model(path, chain, {.sync = true})`.
struct save_options {
  /// Returns only after the file and its name are on the disk, where they survive a power failure. Needs POSIX (fsync);
  /// on other systems throws `bad_file`.
  bool sync = false;
};

}  // namespace kte
