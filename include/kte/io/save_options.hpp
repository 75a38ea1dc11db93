#pragma once

namespace kte {

/// Options of writing a file: `save_model(path, chain, {.sync = true})`.
struct save_options {
  /// Returns only when the file and its name are on the disk, where they outlive a loss of power. Needs POSIX (fsync);
  /// elsewhere `bad_file` says that there is none.
  bool sync = false;
};

}  // namespace kte
