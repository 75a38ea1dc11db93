#pragma once

/// Model files, tables, recordings.
#include <kte/io/model_reader.hpp>
#include <kte/io/recording.hpp>
#include <kte/io/table_writer.hpp>
