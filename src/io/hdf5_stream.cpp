#include "io/hdf5_stream.hpp"

#include "io/growing_dataset.hpp"

#include <algorithm>

namespace carom::detail {

namespace {
constexpr std::size_t buffer_bytes = std::size_t{1} << 20;  // and a chunk of the dataset

hsize_t extent_of(hid_t dataset) {
  const Hdf5Id space(H5Dget_space(dataset), H5Sclose);
  hsize_t extent = 0;
  checked(H5Sget_simple_extent_dims(space.get(), &extent, nullptr));
  return extent;
}
}  // namespace

Hdf5OutputStream::Hdf5OutputStream(hid_t parent, const std::string& name)
    : std::ostream(static_cast<std::streambuf*>(this)), buffer_(buffer_bytes), parent_(parent), name_(name) {
  exceptions(badbit | failbit);
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

void Hdf5OutputStream::write() {
  const auto count = static_cast<hsize_t>(pptr() - pbase());
  if (!dataset_)
    dataset_ = create_growing(parent_, name_, H5T_STD_U8LE, {.row = {}, .rows_per_chunk = buffer_bytes, .compressed = false});
  if (count > 0) append_rows(dataset_.get(), H5T_NATIVE_UINT8, {}, written_, count, buffer_.data());
  written_ += count;
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

std::streambuf::int_type Hdf5OutputStream::overflow(std::streambuf::int_type byte) {
  write();
  if (std::streambuf::traits_type::eq_int_type(byte, std::streambuf::traits_type::eof()))
    return std::streambuf::traits_type::not_eof(byte);
  return sputc(std::streambuf::traits_type::to_char_type(byte));
}

int Hdf5OutputStream::sync() {
  write();
  return 0;
}

void Hdf5OutputStream::close() {
  if (!dataset_) return write_whole();
  write();
  dataset_.close();
}

/// Data that fit the buffer take no more room than they need.
void Hdf5OutputStream::write_whole() {
  const auto count = static_cast<hsize_t>(pptr() - pbase());
  const Hdf5Id space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Hdf5Id properties = untimed(H5P_DATASET_CREATE);
  Hdf5Id dataset(H5Dcreate2(parent_, name_.c_str(), H5T_STD_U8LE, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                 H5Dclose);
  checked(H5Dwrite(dataset.get(), H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer_.data()));
  dataset.close();
}

Hdf5InputStream::Hdf5InputStream(hid_t parent, const std::string& name)
    : std::istream(static_cast<std::streambuf*>(this)),
      buffer_(buffer_bytes),
      dataset_(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose),
      size_(extent_of(dataset_.get())) {
  exceptions(badbit | failbit);
}

std::streambuf::int_type Hdf5InputStream::underflow() {
  const hsize_t count = std::min<hsize_t>(buffer_.size(), size_ - read_);
  if (count == 0) return std::streambuf::traits_type::eof();
  const Hdf5Id space(H5Dget_space(dataset_.get()), H5Sclose);
  checked(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &read_, nullptr, &count, nullptr));
  const Hdf5Id memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
  checked(H5Dread(dataset_.get(), H5T_NATIVE_UINT8, memory.get(), space.get(), H5P_DEFAULT, buffer_.data()));
  read_ += count;
  setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
  return std::streambuf::traits_type::to_int_type(*gptr());
}

}  // namespace carom::detail
