// Chunked datasets without an end.

#include "io/growing_dataset.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace carom::detail {

namespace {
// One chunk is read whole even for one number of it, and HDF5 caches 1 MiB of chunks per dataset.
constexpr std::size_t usual_chunk_bytes = std::size_t{1} << 18;
constexpr std::size_t largest_chunk_bytes = std::size_t{1} << 20;
constexpr hsize_t most_rows_per_chunk = 1024;
}  // namespace

hsize_t rows_per_chunk(std::size_t row_bytes, std::uint64_t expected_rows) {
  const hsize_t rows = usual_chunk_bytes / std::max<std::size_t>(row_bytes, 1);
  return std::max<hsize_t>(1, std::min({rows, most_rows_per_chunk, static_cast<hsize_t>(expected_rows)}));
}

Hdf5Id create_growing(hid_t parent, const std::string& name, hid_t file_type, const DatasetLayout& layout) {
  if (checked(H5Lexists(parent, name.c_str(), H5P_DEFAULT)) > 0) return {H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose};
  std::vector<hsize_t> extents = {0};
  std::vector<hsize_t> limits = {H5S_UNLIMITED};
  std::vector<hsize_t> chunk = {layout.rows_per_chunk};
  std::size_t bytes = H5Tget_size(file_type) * layout.rows_per_chunk;
  for (const hsize_t extent : layout.row) {
    extents.push_back(extent);
    limits.push_back(extent);
    chunk.push_back(std::max<hsize_t>(1, extent));  // a chunk may not be empty, where a row of no disks is
    bytes *= std::max<hsize_t>(1, extent);
  }
  // A row of very many disks is cut along the disks, never along x, y, z.
  if (chunk.size() > 1 && bytes > largest_chunk_bytes) {
    const std::size_t bytes_per_entry = bytes / chunk[1];
    chunk[1] = std::max<hsize_t>(1, largest_chunk_bytes / bytes_per_entry);
  }

  const Hdf5Id properties = untimed(H5P_DATASET_CREATE);
  checked(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()));
  if (layout.compressed && H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    checked(H5Pset_shuffle(properties.get()));
    checked(H5Pset_deflate(properties.get(), 1));  // higher levels take several times as long for a few percent
  }
  const Hdf5Id space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), limits.data()), H5Sclose);
  return {H5Dcreate2(parent, name.c_str(), file_type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT), H5Dclose};
}

void append_rows(hid_t dataset, hid_t memory_type, std::span<const hsize_t> row, hsize_t present, hsize_t count,
                 const void* values) {
  std::vector<hsize_t> start(row.size() + 1, 0);
  std::vector<hsize_t> extents = {present + count};
  extents.insert(extents.end(), row.begin(), row.end());
  checked(H5Dset_extent(dataset, extents.data()));
  if (std::find(row.begin(), row.end(), hsize_t{0}) != row.end()) return;  // rows of no disks
  start[0] = present;
  extents[0] = count;
  const Hdf5Id space(H5Dget_space(dataset), H5Sclose);
  checked(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, extents.data(), nullptr));
  const Hdf5Id memory(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose);
  checked(H5Dwrite(dataset, memory_type, memory.get(), space.get(), H5P_DEFAULT, values));
}

hsize_t rows_per_chunk_of(hid_t dataset) {
  const Hdf5Id properties(H5Dget_create_plist(dataset), H5Pclose);
  std::array<hsize_t, H5S_MAX_RANK> chunk{};
  checked(H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()));
  return chunk[0];
}

void require_rows(hid_t dataset, hsize_t rows) {
  const Hdf5Id space(H5Dget_space(dataset), H5Sclose);
  std::array<hsize_t, H5S_MAX_RANK> present{};
  checked(H5Sget_simple_extent_dims(space.get(), present.data(), nullptr));
  if (present[0] != rows) throw Hdf5Error(fmt::format("a dataset has {} rows in place of {}", present[0], rows));
}

}  // namespace carom::detail
