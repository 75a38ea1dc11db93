#pragma once

#include <kte/io/binary_writer.hpp>
#include <kte/io/record_writer.hpp>

/// Records as binary model files (io/binary_layout.hpp). Does not need cereal.
namespace kte {

namespace detail {
inline std::string write_file(field_writer& out, const model_record& m) {
  record_writer(out).model_file(m);
  return out.finish();
}
inline std::string write_file(field_writer& out, const archive_record& all) {
  record_writer(out).archive_file(all);
  return out.finish();
}
}  // namespace detail

/// The bytes of a .kte file. Throws `bad_file` for a record that `from_binary` would reject.
template <class Record = model_record>
[[nodiscard]] std::string to_binary(const Record& r) {
  detail::binary_writer out;
  return detail::write_file(out, r);
}

}  // namespace kte
