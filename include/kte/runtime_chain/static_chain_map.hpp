#pragma once

#include <kte/runtime_chain/kte_map_adapter.hpp>
#include <kte/static_chain/static_chain.hpp>

#include <boost/hana/for_each.hpp>

#include <vector>

namespace kte {

namespace detail {
template <class Core, class... Keys>
named_element<Core> with_texts(const element<Core, Keys...>& e) {
  return {e.core, {std::string(Keys::name)...}};
}
}  // namespace detail

/// The record of a static chain.
template <class Gravity, class... E>
[[nodiscard]] model_record record_of(const static_chain<Gravity, E...>& c) {
  model_record r;
  r.gravity.clear();
  detail::append_numbers(r.gravity, c.gravity());
  boost::hana::for_each(c.elements(), [&r](const auto& e) {
    const auto named = detail::with_texts(e);
    r.elements.push_back(record_of(named.core, named.names));
  });
  return r;
}

/// A static chain as one element of a runtime chain. Its passes run unrolled, on items of the runtime state.
template <class Chain>
class static_chain_map final : public kte_map {
 public:
  explicit static_chain_map(const Chain& c) : chain_(c) {
    boost::hana::for_each(c.elements(),
                          [this](const auto& e) { elements_.push_back(detail::adapted(detail::with_texts(e))); });
  }
  static_chain_map(const static_chain_map& o) : static_chain_map(o.chain_) {}
  ~static_chain_map() override = default;

  void doMotion(runtime_state& s) const override {
    mapped_state m{s, index_};
    chain_.doMotion(m);
  }
  void clearForce(runtime_state& s) const override {
    mapped_state m{s, index_};
    chain_.clearForce(m);
  }
  void doForce(runtime_state& s) const override {
    mapped_state m{s, index_};
    chain_.doForce(m);
  }
  std::unique_ptr<kte_map> clone() const override { return std::make_unique<static_chain_map>(*this); }
  vec3<> gravity() const override { return as<double>(chain_.gravity()); }
  void for_each_element(const std::function<void(const kte_element&)>& visit) const override {
    for (const auto& e : elements_) visit(*e);
  }
  const kte_map* unrecorded() const override { return nullptr; }
  void connect(topology& t) override {
    for (auto& of_kind : index_) of_kind.clear();
    const std::size_t first = t.elements.size();
    for (const auto& e : elements_) e->connect(t);
    for (std::size_t e = 0; e < Chain::size; ++e) {
      const auto& c = t.elements[first + e];
      for (std::size_t p = 0; p < c.index.size(); ++p) {
        auto& of_kind = index_[static_cast<std::size_t>(Chain::wiring::what(e, p))];
        const auto slot = static_cast<std::size_t>(Chain::wiring::slot(e, p));
        if (of_kind.size() <= slot) of_kind.resize(slot + 1);
        of_kind[slot] = c.index[p];
      }
    }
  }

 private:
  /// The state of the runtime chain, accessed by the indices of the static chain.
  struct mapped_state {
    using scalar = runtime_state::scalar;
    runtime_state& s;
    const std::array<std::vector<int>, kinds>& index;
    template <kind K>
    auto& get(int i) const {
      return s.get<K>(index[static_cast<std::size_t>(K)][static_cast<std::size_t>(i)]);
    }
  };

  Chain chain_;
  std::vector<std::unique_ptr<kte_element>> elements_;
  std::array<std::vector<int>, kinds> index_;  ///< by kind: index in the runtime chain of each item of the static chain
};

}  // namespace kte
