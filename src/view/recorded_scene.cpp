#include <kte/math/quaternion.hpp>
#include <kte/view/recorded_scene.hpp>

#include "quantity_units.hpp"
#include "scene_builder.hpp"
#include "scene_size.hpp"

namespace kte {

namespace {
using detail::chain_parts;

/// A quaternion in 16 bits a number, the nearer one of q and -q to the one before.
void append_rotation(std::vector<std::int16_t>& to, const double* rows, const std::int16_t* before) {
  auto q = to_quaternion(
      mat3<vec3<>>{{rows[0], rows[1], rows[2]}, {rows[3], rows[4], rows[5]}, {rows[6], rows[7], rows[8]}});
  if (before != nullptr && q.w * before[0] + q.x * before[1] + q.y * before[2] + q.z * before[3] < 0)
    q = {-q.w, -q.x, -q.y, -q.z};
  for (const double x : {q.w, q.x, q.y, q.z}) to.push_back(static_cast<std::int16_t>(std::lround(32767 * x)));
}
bool all_finite(const double* x, std::size_t n) {
  return std::all_of(x, x + n, [](double number) { return std::isfinite(number); });
}
}  // namespace

recorded_scene::recorded_scene(const chain_parts& chain, const recording_options& options) {
  auto built = view::build_scene(chain);
  scene_ = std::move(built.picture), tracked_ = std::move(built.tracked), freedoms_ = std::move(built.freedoms);
  auto& r = scene_.recordings.emplace_back();
  r.name = options.name;
  std::size_t numbers = 0;
  if (!options.columns.empty()) {
    const detail::recording wanted(chain.slots, options.columns);
    cells_ = wanted.cells, r.plotted.assign(wanted.columns.begin() + 1, wanted.columns.end());
    for (const auto& c : cells_)
      for (std::size_t k = 0; k < c.count; ++k, ++numbers)
        r.columns.push_back({wanted.columns[numbers + 1], view::unit_of_quantity(chain, scene_, c), {}});
  }
  std::size_t nq = 0, nv = 0;
  for (const auto& f : freedoms_)
    nq += static_cast<std::size_t>(nq_of(f.what)), nv += static_cast<std::size_t>(nv_of(f.what));
  std::size_t ns = 0;
  for (const kind k : {kind::input, kind::vector, kind::internal})
    for (const auto& x : chain.slots[static_cast<std::size_t>(k)])
      signals_.push_back({k, x.slot}), ns += k == kind::vector ? 3 : 1;
  row_ = {std::vector<double>(12 * tracked_.size()), std::vector<double>(nq), std::vector<double>(nv),
          std::vector<double>(ns), std::vector<double>(numbers)};
  unknown_signals_.resize(ns);
}

void recorded_scene::add_column(const std::string& name, const std::string& unit, const std::vector<double>& numbers) {
  auto& r = scene_.recordings.front();
  if (numbers.size() != r.t.size())
    detail::raise<bad_argument>("kte: column '" + name + "' has " + std::to_string(numbers.size()) +
                                " numbers, the recording " + std::to_string(r.t.size()) + " rows");
  r.columns.push_back({name, unit, {numbers.begin(), numbers.end()}});
}

void recorded_scene::add(double t) {
  auto& r = scene_.recordings.front();
  const std::size_t rows = r.t.size(), tracks = tracked_.size();
  if (!std::isfinite(t) || (rows > 0 && t < r.t.back()))
    detail::raise<bad_argument>("kte: a recording has times that do not decrease: row " + std::to_string(rows + 1) +
                                " is at " + detail::number(t) +
                                (rows > 0 ? ", the row before at " + detail::number(r.t.back()) : ""));
  const bool drawn = all_finite(row_.poses.data(), row_.poses.size()) && all_finite(row_.q.data(), row_.q.size());
  if (!drawn && rows == 0) detail::raise<bad_argument>("kte: the first row of a recording is not finite");
  if (!drawn && !broken_) {
    broken_ = true;
    scene_.notes.push_back("from t = " + detail::number(t) + " on rows of the recording" +
                           (r.name.empty() ? "" : " '" + r.name + "'") +
                           " are not finite: there the mechanism is drawn where it was last");
  }
  r.t.push_back(t);
  for (std::size_t k = 0; k < tracks; ++k) {
    const double* const pose = row_.poses.data() + 12 * k;
    if (!drawn) {
      for (std::size_t i = 0; i < 3; ++i) r.positions.push_back(r.positions[r.positions.size() - 3 * tracks]);
      for (std::size_t i = 0; i < 4; ++i) r.rotations.push_back(r.rotations[r.rotations.size() - 4 * tracks]);
      continue;
    }
    const std::int16_t* const before = rows > 0 ? r.rotations.data() + r.rotations.size() - 4 * tracks : nullptr;
    for (std::size_t i = 0; i < 3; ++i) r.positions.push_back(static_cast<float>(pose[i]));
    append_rotation(r.rotations, pose + 3, before);
  }
  const std::size_t nq = row_.q.size();
  for (std::size_t i = 0; i < nq; ++i) r.q.push_back(drawn ? static_cast<float>(row_.q[i]) : r.q[r.q.size() - nq]);
  if (knows_v_)
    for (const double x : row_.v) r.v.push_back(static_cast<float>(x));
  for (std::size_t i = 0; i < row_.signals.size(); ++i)
    r.signals.push_back(unknown_signals_[i] ? std::numeric_limits<float>::quiet_NaN()
                                            : static_cast<float>(row_.signals[i]));
  for (std::size_t i = 0; i < row_.cells.size(); ++i) r.columns[i].data.push_back(static_cast<float>(row_.cells[i]));
  if (rows > 0) return;
  scene_.q = row_.q, scene_.v = row_.v;
  scene_.size = view::size_of(scene_);
}

}  // namespace kte
