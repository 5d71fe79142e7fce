#pragma once
// A dataset of bytes as a C++ stream, so that what can be written to a stream can be kept in an HDF5 file, in as much memory as a
// buffer takes.

#include "io/hdf5_handle.hpp"

#include <cstddef>
#include <istream>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

namespace carom::detail {

/// Writes the dataset `name`, which is complete after close().
class Hdf5OutputStream final : private std::streambuf, public std::ostream {
 public:
  Hdf5OutputStream(hid_t parent, const std::string& name);
  /// Writes what is left. Throws Hdf5Error, also for what went wrong before.
  void close();

 private:
  std::streambuf::int_type overflow(std::streambuf::int_type byte) override;
  int sync() override;
  void write();
  void write_whole();

  std::vector<char> buffer_;
  hid_t parent_;
  std::string name_;
  Hdf5Id dataset_;  ///< once there is more than the buffer holds
  hsize_t written_ = 0;
};

/// Reads the dataset `name`. What HDF5 cannot read ends the stream.
class Hdf5InputStream final : private std::streambuf, public std::istream {
 public:
  Hdf5InputStream(hid_t parent, const std::string& name);

 private:
  std::streambuf::int_type underflow() override;

  std::vector<char> buffer_;
  Hdf5Id dataset_;
  hsize_t size_ = 0, read_ = 0;
};

}  // namespace carom::detail
