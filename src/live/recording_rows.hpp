#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace kte::live {

/// Rows of numbers in blocks that do not move, so that a copy can be read while rows are added.
class recording_rows {
 public:
  recording_rows(std::size_t columns, std::size_t bytes)
      : columns_(columns), most_(std::max<std::size_t>(bytes / (columns * sizeof(double)), 1)) {}

  std::size_t rows() const { return rows_; }
  bool full() const { return rows_ >= most_; }
  void clear() { blocks_.clear(), rows_ = 0; }
  /// Of t and the other numbers; not when it is full.
  void add(double t, std::span<const double> numbers) {
    if (rows_ % rows_of_block == 0)
      blocks_.push_back(std::shared_ptr<double[]>(new double[std::min(rows_of_block, most_ - rows_) * columns_]));
    double* const row = blocks_.back().get() + rows_ % rows_of_block * columns_;
    row[0] = t;
    std::copy(numbers.begin(), numbers.end(), row + 1);
    ++rows_;
  }
  std::span<const double> row(std::size_t i) const {
    return {blocks_[i / rows_of_block].get() + i % rows_of_block * columns_, columns_};
  }

 private:
  static constexpr std::size_t rows_of_block = 4096;
  std::size_t columns_, most_, rows_ = 0;
  std::vector<std::shared_ptr<double[]>> blocks_;
};

}  // namespace kte::live
