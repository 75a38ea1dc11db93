#pragma once

#include <kte/runtime_chain/runtime_chain.hpp>

#include <array>
#include <memory>
#include <pybind11/pybind11.h>
#include <vector>

#include "compiled.hpp"

namespace kte_python {

namespace py = pybind11;

/// What a call works in: a state of the chain, and its arguments.
struct workspace {
  kte::runtime_state state;
  std::array<Eigen::VectorXd, 4> x;
};

/// kte.Chain: a runtime chain with states to work in, one for each call that runs at a time. Its members are used with
/// the GIL.
class chain_object {
 public:
  chain_object() = default;
  explicit chain_object(kte::runtime_chain c) : chain_(std::move(c)) {}
  chain_object(const chain_object& o) : chain_(o.chain_), compiled_(o.compiled_) {}

  const kte::runtime_chain& chain() const { return chain_; }
  /// Becomes equal to another one, with its compiled functions. Throws as `edit`.
  void become(const chain_object& o) { edit() = o.chain_, compiled_ = o.compiled_; }
  /// The chain, to change it. Throws `bad_argument` while another thread computes with it.
  kte::runtime_chain& edit();
  /// Whether packs of states can be computed (kte/dynamics/batch.hpp).
  bool has_packs() const;
  /// Its functions as a type; null unless it is compiled.
  const compiled_functions* compiled() const { return compiled_.get(); }
  void compiled(std::shared_ptr<const compiled_functions> f) { compiled_ = std::move(f); }

 private:
  friend class lease;
  kte::runtime_chain chain_;
  std::shared_ptr<const compiled_functions> compiled_;
  mutable std::vector<std::unique_ptr<workspace>> free_;
  mutable int used_ = 0;
  mutable int has_packs_ = -1;  ///< -1: unknown
};

/// A workspace of a chain during a call. Made and destroyed with the GIL.
class lease {
 public:
  explicit lease(const chain_object& c);
  ~lease();
  lease(const lease&) = delete;
  lease& operator=(const lease&) = delete;
  workspace& operator*() const { return *work_; }
  workspace* operator->() const { return work_.get(); }
  /// Inputs are other than zero: the state is not used again.
  void spoil() { spoilt_ = true; }

 private:
  const chain_object& chain_;
  std::unique_ptr<workspace> work_;
  bool spoilt_ = false;
};

/// The bytes of a chain for pickles, and the chain.
py::bytes bytes_of(const kte::runtime_chain& c);
kte::runtime_chain chain_from_bytes(const py::bytes& b);
/// The chain of an argument: a kte.Chain, or what has one as its member `chain`, such as a kte.Robot.
const chain_object& chain_of(py::handle x);
/// The size of a chain, by which it is judged whether a call takes long.
inline std::size_t size_of(const kte::runtime_chain& c) { return c.wiring().elements.size(); }
/// A dict, or what is made one, as any mapping is. Throws TypeError: `what` must be a dict from `of`.
py::dict dict_from(const char* what, const char* of, py::handle x);
/// Puts inputs, a dict from names to numbers or three numbers, into a state.
void put_inputs(const kte::runtime_chain& c, kte::runtime_state& s, py::handle inputs);
/// From names to numbers, in the order of a sequence of names.
std::vector<std::string> names_from(py::handle names);

}  // namespace kte_python
