#pragma once
// A dataset that grows row by row (one row per sample or event) through a buffer of one chunk: memory does not depend on
// how many rows there are.

#include "io/hdf5_handle.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace carom::detail {

struct DatasetLayout {
  std::vector<hsize_t> row;    ///< the extents of one row; empty for a single number
  hsize_t rows_per_chunk = 1;  ///< number of rows that are buffered, written and read together
  bool compressed = false;     ///< where the library can
};

/// Returns the number of rows of `row_bytes` in a chunk: about 256 KiB, but at most 1024 rows and at most `expected_rows`.
[[nodiscard]] hsize_t rows_per_chunk(std::size_t row_bytes, std::uint64_t expected_rows);

/// Creates the empty dataset `name`, [0][row...], without a limit on its rows, or opens the one that is there. A chunk takes at
/// most 1 MiB.
[[nodiscard]] Hdf5Id create_growing(hid_t parent, const std::string& name, hid_t file_type, const DatasetLayout& layout);
[[nodiscard]] hsize_t rows_per_chunk_of(hid_t dataset);
/// Throws Hdf5Error where the dataset has not that many rows.
void require_rows(hid_t dataset, hsize_t rows);
/// Writes `count` rows after the first `present`.
void append_rows(hid_t dataset, hid_t memory_type, std::span<const hsize_t> row, hsize_t present, hsize_t count,
                 const void* values);

template <class Number>
struct Hdf5Type;
template <>
struct Hdf5Type<double> {
  static hid_t file() { return H5T_IEEE_F64LE; }
  static hid_t memory() { return H5T_NATIVE_DOUBLE; }
};
template <>
struct Hdf5Type<std::int32_t> {
  static hid_t file() { return H5T_STD_I32LE; }
  static hid_t memory() { return H5T_NATIVE_INT32; }
};
template <>
struct Hdf5Type<std::int64_t> {
  static hid_t file() { return H5T_STD_I64LE; }
  static hid_t memory() { return H5T_NATIVE_INT64; }
};

template <class Number>
class GrowingDataset {
 public:
  GrowingDataset(hid_t parent, const std::string& name, DatasetLayout layout)
      : layout_(std::move(layout)), dataset_(create_growing(parent, name, Hdf5Type<Number>::file(), layout_)) {
    for (const hsize_t extent : layout_.row) row_size_ *= extent;
    layout_.rows_per_chunk =
        rows_per_chunk_of(dataset_.get());  // of a file that is resumed, it may have been chosen for another end
  }

  /// Saves or loads the number of rows, and the rows that are not in the file yet, for core/archive.hpp. When it is loaded, the
  /// dataset must have those rows.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(written_rows_, buffered_rows_, buffer_);
    if constexpr (Archive::is_loading::value) require_rows(dataset_.get(), written_rows_);
  }

  /// Returns a new row of zeros at the end, for the caller to fill. It is valid until the next call of any function.
  [[nodiscard]] std::span<Number> add_row() {
    if (chunk_is_complete()) write();
    buffer_.resize(buffer_.size() + row_size_);
    ++buffered_rows_;
    return std::span(buffer_).last(row_size_);
  }
  void add(Number value) { add_row()[0] = value; }

  /// Hands all rows to HDF5, or only those of complete chunks: a chunk that is compressed must not be written twice, for
  /// its second place in the file could overwrite what a killed run needs.
  void write() {
    if (buffered_rows_ == 0 || (layout_.compressed && !closing_ && !chunk_is_complete())) return;
    append_rows(dataset_.get(), Hdf5Type<Number>::memory(), layout_.row, written_rows_, buffered_rows_, buffer_.data());
    written_rows_ += buffered_rows_;
    buffered_rows_ = 0;
    buffer_.clear();
  }

  void close() {
    closing_ = true;
    write();
    dataset_.close();
  }

  [[nodiscard]] hid_t id() const { return dataset_.get(); }
  [[nodiscard]] hsize_t rows() const { return written_rows_ + buffered_rows_; }
  [[nodiscard]] hsize_t written_rows() const { return written_rows_; }
  [[nodiscard]] std::size_t buffered_bytes() const { return buffer_.capacity() * sizeof(Number); }

 private:
  [[nodiscard]] bool chunk_is_complete() const { return buffered_rows_ > 0 && rows() % layout_.rows_per_chunk == 0; }

  DatasetLayout layout_;
  Hdf5Id dataset_;
  std::size_t row_size_ = 1;
  std::vector<Number> buffer_;
  hsize_t buffered_rows_ = 0;
  hsize_t written_rows_ = 0;
  bool closing_ = false;
};

}  // namespace carom::detail
