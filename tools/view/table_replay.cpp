#include <kte/contract/nearest_name.hpp>
#include <kte/view/recorded_scene.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include "quantity_units.hpp"

namespace kte {

namespace {
using detail::chain_parts;
using numbers_of_column = std::vector<double>;

/// Takes columns of a table for things of a chain.
class column_taker {
 public:
  column_taker(const chain_parts& chain, const table& numbers) : chain_(chain), numbers_(numbers) {}

  const numbers_of_column* find(std::string_view name) {
    for (std::size_t j = 0; j < numbers_.names.size(); ++j)
      if (numbers_.names[j] == name) return taken_.insert(j), &numbers_.columns[j];
    return nullptr;
  }
  const std::set<std::size_t>& taken() const { return taken_; }

  /// The names of columns of where a thing is, as a recorder has them.
  std::vector<std::string> names(kind k, const std::string& name) const {
    const char* const prefix = is_coordinate(k) ? "coordinate:" : "signal:";
    auto all = detail::recording(chain_.slots, {prefix + name}).columns;
    all.erase(all.begin());  // t
    return all;
  }
  /// The columns of a thing, or none if one is missing, which is then in the list. Where a frame has the name as well,
  /// it may stand alone.
  std::vector<const numbers_of_column*> columns(const std::vector<std::string>& names, std::string& missing) {
    std::vector<const numbers_of_column*> found;
    for (const auto& n : names) {
      const auto* c = find(n);
      if (c == nullptr && n.starts_with("coordinate:")) c = find(std::string_view(n).substr(11));
      if (c != nullptr)
        found.push_back(c);
      else
        missing += (missing.empty() ? "'" : ", '") + n + "'" + detail::did_you_mean(n, numbers_.names);
    }
    return found.size() == names.size() ? found : std::vector<const numbers_of_column*>();
  }

 private:
  const chain_parts& chain_;
  const table& numbers_;
  std::set<std::size_t> taken_;
};

void check_rows(const table& numbers) {
  if (numbers.columns.size() != numbers.names.size() || numbers.rows() == 0)
    detail::raise<bad_argument>("kte: a recording in a table needs a row");
  for (std::size_t j = 0; j < numbers.columns.size(); ++j)
    if (numbers.columns[j].size() != numbers.rows())
      detail::raise<bad_argument>("kte: column '" + numbers.names[j] + "' of the table has " +
                                  std::to_string(numbers.columns[j].size()) + " rows, not " +
                                  std::to_string(numbers.rows()));
}
void check_finite(const std::string& name, const numbers_of_column& c) {
  for (std::size_t i = 0; i < c.size(); ++i)
    if (!std::isfinite(c[i]))
      detail::raise<bad_argument>("kte: column '" + name + "' of the table is not finite in row " +
                                  std::to_string(i + 1) + ", and the mechanism stands by it");
}
}  // namespace

detail::replay_plan recorded_scene::replay(const chain_parts& chain, const table& numbers) {
  check_rows(numbers);
  column_taker taker(chain, numbers);
  detail::replay_plan plan{{}, taker.find("t")};
  if (plan.time == nullptr)
    detail::raise<unknown_name>("kte: the table has no column 't', the time, s" +
                                detail::did_you_mean("t", numbers.names) + " (" + detail::list_of_names(numbers.names) +
                                ")");
  check_finite("t", *plan.time);
  std::string missing;
  for (const auto& e : chain.layout) {
    const auto& f = freedoms_[static_cast<std::size_t>(&e - chain.layout.data())];
    const auto names = taker.names(e.what, e.name);
    auto columns = taker.columns(names, missing);
    for (std::size_t k = 0; k < columns.size(); ++k) check_finite(names[k], *columns[k]);
    plan.sources.push_back({f.what, f.slot, std::move(columns)});
  }
  if (!missing.empty())
    detail::raise<unknown_name>("kte: the table has no columns of coordinates by which the mechanism moves: " +
                                missing + " (" + detail::list_of_names(numbers.names) + ")");
  const auto of_coordinates = taker.taken();
  for (const kind k : {kind::input, kind::vector, kind::internal})
    for (const auto& slot : chain.slots[static_cast<std::size_t>(k)]) {
      if (detail::is_time(k, slot.name)) {
        plan.sources.push_back({k, slot.slot, {}});
        continue;
      }
      std::string absent;
      const auto names = taker.names(k, slot.name);
      auto columns = taker.columns(names, absent);
      for (std::size_t i = 0; i < columns.size(); ++i) check_finite(names[i], *columns[i]);
      if (!columns.empty()) plan.sources.push_back({k, slot.slot, std::move(columns)});
    }
  auto& r = scene_.recordings.front();
  for (std::size_t j = 0; j < numbers.names.size(); ++j)
    if (!of_coordinates.contains(j))
      r.columns.push_back({numbers.names[j],
                           view::unit_of_column(chain, scene_, numbers.names[j]),
                           {numbers.columns[j].begin(), numbers.columns[j].end()}});
  return plan;
}

}  // namespace kte
