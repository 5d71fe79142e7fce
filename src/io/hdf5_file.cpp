// Holding back the index and absorbing failures: see the header. The callbacks at the end are what HDF5's interface for
// file drivers asks for (H5FDpublic.h of HDF5 1.10).

#include "io/hdf5_file.hpp"

#include "core/archive.hpp"
#include "io/output_error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include <H5FDpublic.h>
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif
#include <fcntl.h>
#include <unistd.h>

namespace carom::detail {

std::size_t Hdf5File::held_bytes() const { return held_.size() * page_size; }

void Hdf5File::open(const char* path, bool fresh) noexcept {
  descriptor_ = ::open(path, O_RDWR | O_CLOEXEC | (fresh ? O_CREAT | O_TRUNC : 0), 0666);
  const off_t size = descriptor_ < 0 ? -1 : ::lseek(descriptor_, 0, SEEK_END);
  if (size < 0) error_ = errno;
  size_ = size < 0 ? 0 : static_cast<std::uint64_t>(size);
}

void Hdf5File::close() noexcept {
  if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0 && error_ == 0) error_ = errno;
}

void Hdf5File::write_through(std::uint64_t address, std::size_t size, const std::byte* data) noexcept {
  std::size_t done = 0;
  while (done < size && error_ == 0) {
    const ssize_t count = ::pwrite(descriptor_, data + done, size - done, static_cast<off_t>(address + done));
    if (count < 0 && errno != EINTR) error_ = errno;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  bytes_written_ += done;
}

void Hdf5File::read_through(std::uint64_t address, std::size_t size, std::byte* out) noexcept {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::pread(descriptor_, out + done, size - done, static_cast<off_t>(address + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && error_ == 0) error_ = errno;
    if (count <= 0) break;  // past the end, where HDF5 expects zeros
    done += static_cast<std::size_t>(count);
  }
  std::memset(out + done, 0, size - done);
}

void Hdf5File::read(std::uint64_t address, std::size_t size, std::byte* out) noexcept {
  read_through(address, size, out);
  for (auto page = held_.lower_bound(address / page_size); page != held_.end(); ++page) {
    const std::uint64_t begin = page->first * page_size;
    if (begin >= address + size) break;
    const std::uint64_t from = std::max(begin, address);
    const std::uint64_t to = std::min(begin + page_size, address + size);
    std::memcpy(out + (from - address), page->second.data() + (from - begin), to - from);
  }
}

void Hdf5File::write_data(std::uint64_t address, std::size_t size, const std::byte* data) noexcept {
  write_through(address, size, data);
  for (auto page = held_.lower_bound(address / page_size); page != held_.end(); ++page) {
    const std::uint64_t begin = page->first * page_size;
    if (begin >= address + size) break;
    const std::uint64_t from = std::max(begin, address);
    const std::uint64_t to = std::min(begin + page_size, address + size);
    std::memcpy(page->second.data() + (from - begin), data + (from - address), to - from);
  }
  size_ = std::max(size_, address + size);
}

void Hdf5File::hold_index(std::uint64_t address, std::size_t size, const std::byte* data) noexcept {
  size_ = std::max(size_, address + size);
  for (std::uint64_t number = address / page_size; number * page_size < address + size; ++number) {
    const std::uint64_t begin = number * page_size;
    auto page = held_.find(number);
    if (page == held_.end()) {
      try {
        page = held_.try_emplace(number).first;
        index_.insert(number);
      } catch (const std::bad_alloc&) {
        if (error_ == 0) error_ = ENOMEM;
        return;
      }
      read_through(begin, page_size, page->second.data());
    }
    const std::uint64_t from = std::max(begin, address);
    const std::uint64_t to = std::min(begin + page_size, address + size);
    std::memcpy(page->second.data() + (from - begin), data + (from - address), to - from);
  }
}

void Hdf5File::commit_index() noexcept {
  for (auto page = held_.rbegin(); page != held_.rend() && error_ == 0; ++page) {
    const std::uint64_t begin = page->first * page_size;
    if (begin < size_) write_through(begin, std::min<std::uint64_t>(page_size, size_ - begin), page->second.data());
  }
  if (error_ == 0) held_.clear();  // after a failure HDF5 must still read back what it believes to have written
}

void Hdf5File::save_index(std::ostream& out) {
  SavingArchive archive(out);
  archive(size_, static_cast<std::uint64_t>(index_.size()));
  for (const std::uint64_t number : index_) {
    Page page;
    read_through(number * page_size, page_size, page.data());
    archive(number, cereal::binary_data(page.data(), page_size));
  }
}

std::uint64_t Hdf5File::saved_size(std::istream& saved) {
  LoadingArchive archive(saved);
  std::uint64_t size = 0;
  archive(size);
  return size;
}

Hdf5Id Hdf5File::reopen(const std::filesystem::path& path, std::istream& saved) {
  LoadingArchive archive(saved);
  std::uint64_t size = 0, pages = 0;
  archive(size, pages);
  open(path.c_str(), false);
  if (error_ != 0) throw system_error(path, "open it", error_);
  if (size_ < size) throw cut_short(path, size_, size);
  resize(size);
  for (; pages > 0; --pages) {
    std::uint64_t number = 0;
    Page page;
    archive(number, cereal::binary_data(page.data(), page_size));
    index_.insert(number);
    write_through(number * page_size, std::min<std::uint64_t>(page_size, size - number * page_size), page.data());
  }
  close();
  if (error_ != 0) throw system_error(path, "bring it back to where the run is to go on", error_);
  return access(path, false, 0);
}

void Hdf5File::resize(std::uint64_t size) noexcept {
  if (error_ == 0 && ::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) error_ = errno;
  size_ = size;
}

namespace {

struct DriverFile {
  H5FD_t header;  // first, because HDF5 knows this struct by it
  Hdf5File* file;
  haddr_t end_of_allocated;
  haddr_t index_begin, index_end;  ///< the rest of the page that new parts of the index go into
};

DriverFile* driver_file(H5FD_t* file) { return reinterpret_cast<DriverFile*>(file); }
const DriverFile* driver_file(const H5FD_t* file) { return reinterpret_cast<const DriverFile*>(file); }

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t /*maximum*/) {
  const auto* info = static_cast<Hdf5File* const*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;
  auto* opened = new (std::nothrow) DriverFile{};
  if (opened == nullptr) return nullptr;
  opened->file = *info;
  opened->file->open(name, (flags & H5F_ACC_TRUNC) != 0);
  if (opened->file->error() == 0) return &opened->header;
  delete opened;
  return nullptr;
}

herr_t close_file(H5FD_t* file) {
  driver_file(file)->file->commit_index();  // HDF5 may write its superblock once more after its last flush
  driver_file(file)->file->close();
  delete driver_file(file);
  return 0;
}

herr_t query(const H5FD_t* /*file*/, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_allocated(const H5FD_t* file, H5FD_mem_t /*type*/) { return driver_file(file)->end_of_allocated; }

herr_t set_end_of_allocated(H5FD_t* file, H5FD_mem_t /*type*/, haddr_t address) {
  driver_file(file)->end_of_allocated = address;
  return 0;
}

/// A part of the index lies in one page, or begins one: a page is written as a whole or not at all, whenever the process is
/// killed.
haddr_t allocate(H5FD_t* file, H5FD_mem_t type, hid_t /*transfer*/, hsize_t size) {
  constexpr haddr_t page = Hdf5File::page_size;
  DriverFile* opened = driver_file(file);
  const auto extend = [&](haddr_t address, haddr_t by) {
    opened->end_of_allocated = address + by;
    return address;
  };
  if (type == H5FD_MEM_DRAW) return extend(opened->end_of_allocated, size);
  if (size > opened->index_end - opened->index_begin) {
    const haddr_t pages = (size + page - 1) / page;
    opened->index_begin = extend((opened->end_of_allocated + page - 1) / page * page, pages * page);
    opened->index_end = opened->end_of_allocated;
  }
  return std::exchange(opened->index_begin, opened->index_begin + size);
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t /*type*/) { return driver_file(file)->file->size(); }

herr_t read_file(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t address, size_t size, void* out) {
  driver_file(file)->file->read(address, size, static_cast<std::byte*>(out));
  return 0;
}

herr_t write_file(H5FD_t* file, H5FD_mem_t type, hid_t /*transfer*/, haddr_t address, size_t size, const void* data) {
  const auto* bytes = static_cast<const std::byte*>(data);
  if (type == H5FD_MEM_DRAW) {
    driver_file(file)->file->write_data(address, size, bytes);
  } else {
    driver_file(file)->file->hold_index(address, size, bytes);
  }
  return 0;
}

herr_t flush_file(H5FD_t* file, hid_t /*transfer*/, hbool_t /*closing*/) {
  driver_file(file)->file->commit_index();
  return 0;
}

herr_t truncate_file(H5FD_t* file, hid_t /*transfer*/, hbool_t /*closing*/) {
  DriverFile* opened = driver_file(file);
  if (opened->end_of_allocated != opened->file->size()) opened->file->resize(opened->end_of_allocated);
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
#if H5_VERSION_GE(1, 13, 0)
  driver.version = H5FD_CLASS_VERSION;
  driver.value = H5_VFD_RESERVED + 1;
#endif
  driver.name = "carom";
  driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<off_t>::max());
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(Hdf5File*);
  driver.open = open_file;
  driver.close = close_file;
  driver.query = query;
  driver.alloc = allocate;
  driver.get_eoa = end_of_allocated;
  driver.set_eoa = set_end_of_allocated;
  driver.get_eof = end_of_file;
  driver.read = read_file;
  driver.write = write_file;
  driver.flush = flush_file;
  driver.truncate = truncate_file;
  constexpr H5FD_mem_t one_list_for_data_one_for_the_rest[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(one_list_for_data_one_for_the_rest), std::end(one_list_for_data_one_for_the_rest), driver.fl_map);
  return driver;
}

/// Returns the driver that HDF5 keeps until the process ends. When HDF5 closes a file it frees the class of a driver without
/// other users, and then calls that class once more. A program may close the library in between, which drops all drivers.
hid_t driver() {
  static hid_t registered = H5I_INVALID_HID;
  if (H5Iget_type(registered) != H5I_VFL) {
    static const H5FD_class_t driver = driver_class();
    registered = checked(H5FDregister(&driver));
  }
  return registered;
}

}  // namespace

Hdf5Id Hdf5File::access(const std::filesystem::path& path, bool fresh, std::uint64_t user_bytes) {
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  Hdf5File* self = this;
  checked(H5Pset_driver(access.get(), driver(), &self));
  // The format of HDF5 1.8: compact, read by every library since 2008, and without the "open for writing" mark of later
  // formats, which would lock readers out of what a killed run leaves.
  checked(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18));
  const Hdf5Id creation = untimed(H5P_FILE_CREATE);
  checked(H5Pset_userblock(creation.get(), user_bytes));
  const hid_t file = fresh ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get())
                           : H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get());
  if (error_ != 0) {
    if (file >= 0) H5Fclose(file);
    throw system_error(path, fresh ? "create it" : "open it", error_);
  }
  return {file, H5Fclose};
}

}  // namespace carom::detail
