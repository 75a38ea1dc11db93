#pragma once

#include <kte/io/recording.hpp>
#include <kte/runtime_chain.hpp>

#include <string>
#include <vector>

namespace kte_tool {

/// What a column of a recording is: number `index` of q or v, or something else of the chain.
struct recorded_column {
  enum class part { q, v, other };
  std::string name;   ///< as in tables: without blanks, commas, quotes
  std::string whole;  ///< as recorders of the library call it
  part is = part::other;
  int index = -1;
};

/// The numbers of a state of a chain that a recording has.
class recorded_state {
 public:
  /// Those of coordinates, inputs and internal states, and more by the names of `kte::recorder`. Throws `unknown_name`.
  explicit recorded_state(const kte::runtime_chain& c, const std::vector<std::string>& more = {});

  /// But for t.
  const std::vector<recorded_column>& columns() const { return columns_; }
  /// A number a column, of a state of the chain.
  void read(const kte::runtime_state& s, double* out) const;

 private:
  std::vector<kte::detail::recorded> cells_;
  std::vector<recorded_column> columns_;
};

/// A name as tables take it.
std::string table_name(const std::string& name);

}  // namespace kte_tool
