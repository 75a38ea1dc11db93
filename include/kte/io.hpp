#pragma once

/// Files: models as XML and JSON (needs cereal), tables of results.
#include <kte/io/model_file.hpp>
#include <kte/io/table_reader.hpp>
#include <kte/io/table_writer.hpp>
