#pragma once

#include <kte/manipulators/detail/raw_answers.hpp>

namespace kte::detail {

/// The two binary choices of each of `lanes` combinations of the four, starting at `way`: 0 or 1.
template <class L, class S>
struct packed_ways {
  static constexpr std::size_t lanes = answer_pack<S>::count;
  std::array<unsigned, lanes> first, second;

  explicit packed_ways(unsigned way) {
    for (unsigned l = 0; l < lanes; ++l) first[l] = (way + l) >> 1 & 1u, second[l] = (way + l) & 1u;
  }
  static truth<L> is_set(const std::array<unsigned, lanes>& choice) {
    std::array<S, lanes> x;
    for (std::size_t l = 0; l < lanes; ++l) x[l] = S(static_cast<int>(choice[l]));
    return L(0.5) < load_pack(x.data());
  }
};

/// Solutions with three binary choices, in the order of their branches; `first`, `second`, `third` are the bits of the
/// choices. `begin(f)` computes what depends on the first choice, taking the second alternative where f holds.
/// `end(begun, s)` returns both alternatives of the third choice for this and the second choice. As many combinations
/// at a time as fit into registers.
template <class S, class Begin, class End>
raw_answers<S> eight_answers(std::size_t joints, branch_bit first, branch_bit second, branch_bit third,
                             const Begin& begin, const End& end) {
  using L = typename answer_pack<S>::type;
  constexpr std::size_t lanes = answer_pack<S>::count;
  raw_answers<S> out;
  out.size = 8;
  const auto add = [&](const packed_ways<L, S>& way, const std::array<raw_answer<L>, 2>& both) {
    for (const std::size_t b : {0u, 1u}) {
      std::array<std::size_t, lanes> name;
      for (std::size_t l = 0; l < lanes; ++l) {
        name[l] = (way.first[l] * first) | (way.second[l] * second) | (b == 0 ? 0u : third);
        out.branch[name[l]] = static_cast<unsigned>(name[l]);
      }
      const auto put = [&](const L& x, auto& row) {
        std::array<S, lanes> y;
        store_pack(x, y.data());
        for (std::size_t l = 0; l < lanes; ++l) row[name[l]] = y[l];
      };
      for (std::size_t k = 0; k < joints; ++k)
        put(both[b].turn.sine[k], out.sine[k]), put(both[b].turn.cosine[k], out.cosine[k]);
      put(both[b].slide, out.slide), put(both[b].free, out.free);
    }
  };
  constexpr unsigned together = lanes == 1 ? 2 : 4;  // combinations that share one beginning
  for (unsigned way = 0; way < 4; way += together) {
    const packed_ways<L, S> one(way);
    const auto begun = begin(one.is_set(one.first));
    for (unsigned k = way; k < way + together; k += lanes) {
      const packed_ways<L, S> both(k);
      add(both, end(begun, both.is_set(both.second)));
    }
  }
  return out;
}

}  // namespace kte::detail
