#pragma once
// The file under HDF5, as an HDF5 "virtual file driver" with two promises that the library's own driver does not make:
// - A run that is killed leaves a file that opens, as it was at the last flush. The file's index (object headers, chunk
//   trees) is held in memory until H5Fflush, and then written from its end to its beginning: new parts before the old ones
//   that point to them, the superblock last. No part of it that ever changes lies across two pages, so each is the old or the
//   new one. Sample data goes to the disk at once, into space that no old index names.
// - A full disk never reaches HDF5, which is known to crash or loop when its closing writes fail. The first failure is
//   kept in error(); from then on nothing more is written, and the file stays as it was at the last flush.

#include "io/hdf5_handle.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <set>

namespace carom::detail {

class Hdf5File {
 public:
  static constexpr std::size_t page_size = 4096;  ///< number of bytes that the system writes as a whole

  Hdf5File() = default;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Creates (or empties) the file and opens it in HDF5. This object must outlive the returned identifier and every
  /// identifier in it. Throws OutputError or Hdf5Error.
  [[nodiscard]] Hdf5Id create(const std::filesystem::path& path) { return access(path, true, 0); }
  /// Creates a file with a block of `bytes` (a power of two, 512 at least) in front, which HDF5 leaves free.
  [[nodiscard]] Hdf5Id create_behind(std::uint64_t bytes, const std::filesystem::path& path) { return access(path, true, bytes); }
  /// Writes where all parts of the index are and what they hold, as of the last flush. Requires nothing to have happened since.
  void save_index(std::ostream& out);
  /// Bytes of the file when save_index() was called.
  [[nodiscard]] static std::uint64_t saved_size(std::istream& saved);
  /// Makes a file what it was when save_index() was called, whatever was written there since, and opens it to be written on. Data
  /// that the index named then are as they were, since new data never take their place. Throws OutputError, also where
  /// the file is shorter than it was, or Hdf5Error.
  [[nodiscard]] Hdf5Id reopen(const std::filesystem::path& path, std::istream& saved);

  [[nodiscard]] int error() const { return error_; }  ///< errno of the first failure, else 0
  [[nodiscard]] std::size_t held_bytes() const;       ///< number of bytes of the index that wait for the next flush
  [[nodiscard]] std::uint64_t bytes_written() const { return bytes_written_; }

  // The functions that HDF5 calls. None of them throws.
  void open(const char* path, bool fresh) noexcept;
  void close() noexcept;
  void read(std::uint64_t address, std::size_t size, std::byte* out) noexcept;
  void write_data(std::uint64_t address, std::size_t size, const std::byte* data) noexcept;
  void hold_index(std::uint64_t address, std::size_t size, const std::byte* data) noexcept;
  void commit_index() noexcept;
  void resize(std::uint64_t size) noexcept;
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  using Page = std::array<std::byte, page_size>;

  [[nodiscard]] Hdf5Id access(const std::filesystem::path& path, bool fresh, std::uint64_t user_bytes);
  void write_through(std::uint64_t address, std::size_t size, const std::byte* data) noexcept;
  void read_through(std::uint64_t address, std::size_t size, std::byte* out) noexcept;

  int descriptor_ = -1;
  int error_ = 0;
  std::uint64_t size_ = 0;  ///< size of the file as HDF5 sees it
  std::uint64_t bytes_written_ = 0;
  std::map<std::uint64_t, Page> held_;  ///< by page number
  std::set<std::uint64_t> index_;       ///< numbers of all pages that have anything of the index
};

}  // namespace carom::detail
