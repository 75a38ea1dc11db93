#pragma once

#include <kte/contract/record.hpp>

#include <string>

namespace kte::view {

/// A model file in JSON, as `kte::to_json` writes it, without cereal. Throws `bad_file` for what cannot be read again.
std::string model_json(const model_record& m);

}  // namespace kte::view
