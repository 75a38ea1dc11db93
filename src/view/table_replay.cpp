#include <kte/contract/nearest_name.hpp>
#include <kte/view/recorded_scene.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "quantity_units.hpp"

namespace kte {

namespace {
using detail::chain_parts;
using numbers_of_column = std::vector<double>;

/// Takes columns of a table for things of a chain.
class column_taker {
 public:
  explicit column_taker(const table& numbers) : numbers_(numbers) {
    for (std::size_t j = 0; j < numbers.names.size(); ++j) places_.emplace(numbers.names[j], j);
  }

  const numbers_of_column* find(std::string_view name) {
    const auto at = places_.find(name);
    return at == places_.end() ? nullptr : (taken_.insert(at->second), &numbers_.columns[at->second]);
  }
  const std::set<std::size_t>& taken() const { return taken_; }

  /// The columns of a thing by the names that a recorder gives them, finite numbers; none if one is missing. Where a
  /// frame has the name of a coordinate as well, that may stand alone.
  std::vector<const numbers_of_column*> columns(std::span<const std::string> names) {
    std::vector<const numbers_of_column*> found;
    for (const auto& n : names) {
      const auto* const c = column(n);
      if (c == nullptr) {
        missing_.push_back(n);
        continue;
      }
      check_finite(n, *c);
      found.push_back(c);
    }
    return found.size() == names.size() ? found : std::vector<const numbers_of_column*>();
  }
  /// `columns`; none also if a number is not finite.
  std::vector<const numbers_of_column*> finite_columns(std::span<const std::string> names) {
    for (const auto& n : names)
      if (const auto* const c = column(n);
          c != nullptr && !std::all_of(c->begin(), c->end(), [](double x) { return std::isfinite(x); }))
        return {};
    return columns(names);
  }
  /// Throws `unknown_name` with what was missing, if anything was.
  void check_complete() const {
    if (missing_.empty()) return;
    std::string text;
    for (std::size_t i = 0; i < missing_.size() && i < 8; ++i)
      text += (i == 0 ? "'" : ", '") + missing_[i] + "'" + detail::did_you_mean(missing_[i], numbers_.names);
    if (missing_.size() > 8) text += " and " + std::to_string(missing_.size() - 8) + " more";
    detail::raise<unknown_name>("kte: the table has no columns of coordinates by which the mechanism moves: " + text +
                                " (" + detail::list_of_names(numbers_.names) + ")");
  }

 private:
  const numbers_of_column* column(std::string_view n) {
    const auto* const c = find(n);
    return c == nullptr && n.starts_with("coordinate:") && n != "coordinate:t" ? find(n.substr(11)) : c;
  }
  static void check_finite(const std::string& name, const numbers_of_column& c) {
    for (std::size_t i = 0; i < c.size(); ++i)
      if (!std::isfinite(c[i]))
        detail::raise<bad_argument>("kte: column '" + name + "' of the table is not finite in row " +
                                    std::to_string(i + 1) + ", and the mechanism stands by it");
  }

  const table& numbers_;
  std::unordered_map<std::string_view, std::size_t> places_;
  std::set<std::size_t> taken_;
  std::vector<std::string> missing_;
};

/// The names that a recorder has for where things are, one thing after the other.
std::vector<std::string> recorded_names(const chain_parts& chain, const std::vector<std::string>& things) {
  if (things.empty()) return {};
  auto all = detail::recording(chain.slots, things).columns;
  all.erase(all.begin());  // t
  return all;
}
void check_rows(const table& numbers) {
  if (numbers.columns.size() != numbers.names.size() || numbers.rows() == 0)
    detail::raise<bad_argument>("kte: a recording in a table needs a row");
  for (std::size_t j = 0; j < numbers.columns.size(); ++j)
    if (numbers.columns[j].size() != numbers.rows())
      detail::raise<bad_argument>("kte: column '" + numbers.names[j] + "' of the table has " +
                                  std::to_string(numbers.columns[j].size()) + " rows, not " +
                                  std::to_string(numbers.rows()));
}
}  // namespace

detail::replay_plan recorded_scene::replay(const chain_parts& chain, const table& numbers) {
  check_rows(numbers);
  column_taker taker(numbers);
  detail::replay_plan plan{{}, taker.find("t")};
  if (plan.time == nullptr)
    detail::raise<unknown_name>("kte: the table has no column 't', the time, s (" +
                                detail::list_of_names(numbers.names) + ")");
  std::vector<std::string> things;
  for (const auto& e : chain.layout) things.push_back("coordinate:" + e.name);
  const auto of_q = recorded_names(chain, things);
  for (std::size_t i = 0; i < freedoms_.size(); ++i) {
    const auto& e = chain.layout[i];
    const std::span names(of_q.data() + e.q, static_cast<std::size_t>(e.nq));
    plan.sources.push_back({freedoms_[i].what, freedoms_[i].slot, taker.columns(names)});
  }
  taker.check_complete();
  const auto of_coordinates = taker.taken();
  for (auto& x : things) x += "/v";
  const auto of_v = recorded_names(chain, things);
  knows_v_ = true;
  const std::size_t positions = plan.sources.size();
  for (std::size_t i = 0; i < freedoms_.size() && knows_v_; ++i) {
    const auto& e = chain.layout[i];
    auto columns = taker.finite_columns({of_v.data() + e.v, static_cast<std::size_t>(e.nv)});
    knows_v_ = !columns.empty();
    plan.sources.push_back({freedoms_[i].what, freedoms_[i].slot, std::move(columns), true});
  }
  if (!knows_v_) plan.sources.resize(positions);
  std::size_t signal = 0;
  for (const kind k : {kind::input, kind::vector, kind::internal})
    for (const auto& slot : chain.slots[static_cast<std::size_t>(k)]) {
      const std::size_t first = signal;
      signal += k == kind::vector ? 3 : 1;
      if (detail::is_time(k, slot.name)) {
        plan.sources.push_back({k, slot.slot, {}});
        continue;
      }
      auto columns = taker.columns(recorded_names(chain, {"signal:" + slot.name}));
      for (std::size_t i = first; i < signal; ++i) unknown_signals_[i] = columns.empty();
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
