#pragma once

#include <kte/detail/macros_aside.hpp>

/// Files: models and archives in XML, JSON and a binary format (needs cereal), tables of results and recorders,
/// progress.
#include <kte/io/archive_file.hpp>
#include <kte/io/memory_table.hpp>
#include <kte/io/model_file.hpp>
#include <kte/io/progress_bar.hpp>
#include <kte/io/recorder.hpp>
#include <kte/io/table_reader.hpp>
#include <kte/io/table_writer.hpp>

#include <kte/detail/macros_back.hpp>
