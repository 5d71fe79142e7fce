#pragma once
// HDF5's C interface with handles that close themselves, errors that are exceptions, and no printing.

#include <Eigen/Core>

#include <hdf5.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom::detail {

/// HDF5 refused. what() is the innermost reason that it gives.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns what to do about a file that HDF5 cannot read.
[[nodiscard]] std::string_view advice_on(const Hdf5Error& error);

/// Throws Hdf5Error where `result` is negative, which is how every HDF5 function says that it failed.
template <class Result>
Result checked(Result result);

/// Owns one HDF5 identifier.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Id() = default;
  Hdf5Id(hid_t id, Close closer) : id_(checked(id)), close_(closer) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    reset();
    id_ = std::exchange(other.id_, H5I_INVALID_HID);
    close_ = other.close_;
    return *this;
  }
  ~Hdf5Id() { reset(); }

  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] explicit operator bool() const { return id_ >= 0; }
  void reset() {
    if (id_ >= 0) close_(std::exchange(id_, H5I_INVALID_HID));
  }
  /// Closes, and throws Hdf5Error where that fails.
  void close() {
    if (id_ >= 0) checked(close_(std::exchange(id_, H5I_INVALID_HID)));
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// HDF5 1.10 loses track of what it has opened in some damaged files, and complains on stderr when the process ends. For programs
/// that close what they open, before anything else is asked of HDF5: later on it is without effect.
void close_nothing_at_exit();

/// While it lives, HDF5 prints nothing on stderr in this thread.
class SilentHdf5 {
 public:
  SilentHdf5();
  ~SilentHdf5();
  SilentHdf5(const SilentHdf5&) = delete;
  SilentHdf5& operator=(const SilentHdf5&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

[[noreturn]] void throw_hdf5_error();

template <class Result>
Result checked(Result result) {
  if (result < 0) throw_hdf5_error();
  return result;
}

// Files of runs that are resumed are opened by the functions that create them: what is there already is taken as it is, but for
// attributes, which are written anew.

/// Properties of a file, group or dataset that is to be created, without the time of day: the same contents are the same bytes.
[[nodiscard]] Hdf5Id untimed(hid_t object_class);

[[nodiscard]] Hdf5Id create_group(hid_t parent, const std::string& path);
void link_hard(hid_t parent, const std::string& existing, const std::string& name);

/// Strings are stored with variable length and as UTF-8: h5py gives them back as str, which MDAnalysis needs.
void write_attribute(hid_t object, const std::string& name, const std::string& value);
void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& values);
void write_attribute(hid_t object, const std::string& name, std::span<const double> values);
void write_attribute(hid_t object, const std::string& name, std::span<const std::int64_t> values);
void write_attribute(hid_t object, const std::string& name, std::int64_t value);
void write_attribute(hid_t object, const std::string& name, std::uint64_t value);
void write_attribute(hid_t object, const std::string& name, double value);

/// A dataset of one value per disk, which never changes; one that is there already is left as it is.
void write_fixed(hid_t parent, const std::string& name, std::span<const double> values);
void write_fixed(hid_t parent, const std::string& name, std::span<const std::int32_t> values);
/// [N][2], a column for each row.
void write_fixed(hid_t parent, const std::string& name, const Eigen::Matrix2Xd& values);

/// A column of a table.
void write_column(hid_t parent, const std::string& name, std::span<const double> values);
void write_column(hid_t parent, const std::string& name, std::span<const std::int64_t> values);
void write_column(hid_t parent, const std::string& name, const std::vector<std::string>& values);

/// Empty where there is no such attribute, or it is no single string.
[[nodiscard]] std::string read_string_attribute(hid_t file, const std::string& object, const std::string& name);
/// Returns every element of a list of strings; empty where there is no such attribute, or it holds something else.
[[nodiscard]] std::vector<std::string> read_strings_attribute(hid_t file, const std::string& object, const std::string& name);
/// Returns every element of an attribute of numbers; empty where there is none, or it holds something else.
[[nodiscard]] std::vector<double> read_numbers_attribute(hid_t file, const std::string& object, const std::string& name);
[[nodiscard]] std::uint64_t read_unsigned_attribute(hid_t file, const std::string& object, const std::string& name);
/// Returns the names in a group, in alphabetical order; empty where there is none.
[[nodiscard]] std::vector<std::string> members_of(hid_t file, const std::string& group);

/// The datasets of a file, each opened when it is first asked for and kept open: to open one anew for each row reads a whole
/// chunk of the file each time. The file must outlive it.
class Hdf5Datasets {
 public:
  explicit Hdf5Datasets(hid_t file) : file_(file) {}

  /// Returns the extents of a dataset; empty where there is none.
  [[nodiscard]] std::vector<hsize_t> extents(const std::string& name);
  /// Returns rows [first, first + count) of a dataset, as doubles. Throws Hdf5Error.
  [[nodiscard]] std::vector<double> rows(const std::string& name, hsize_t first, hsize_t count);

 private:
  struct Dataset {
    Hdf5Id id;
    std::vector<hsize_t> extents;
  };
  const Dataset& opened(const std::string& name);

  hid_t file_;
  std::map<std::string, Dataset> opened_;
  std::mutex opening_;
};

/// Returns the extents of a dataset; empty where there is none.
[[nodiscard]] std::vector<hsize_t> extents_of(hid_t file, const std::string& dataset);
/// Rows [first, first + count) of a dataset, as doubles. Throws Hdf5Error.
[[nodiscard]] std::vector<double> read_rows(hid_t file, const std::string& dataset, hsize_t first, hsize_t count);

}  // namespace carom::detail
