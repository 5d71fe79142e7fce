#pragma once
// Reads HDF5 files by the C interface alone, so that the tests do not lean on the code that they test.

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <string>
#include <vector>

namespace carom::test {

/// The group of a trajectory.
inline const std::string particles = "/particles/trajectory";

class H5Reader {
 public:
  explicit H5Reader(const std::filesystem::path& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  }
  H5Reader(const H5Reader&) = delete;
  H5Reader& operator=(const H5Reader&) = delete;
  ~H5Reader() {
    if (file_ >= 0) H5Fclose(file_);
  }

  [[nodiscard]] bool opens() const { return file_ >= 0; }
  [[nodiscard]] hid_t id() const { return file_; }

  [[nodiscard]] std::vector<hsize_t> extents(const std::string& name) const {
    const hid_t dataset = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (dataset < 0) {
      ADD_FAILURE() << "no dataset " << name;
      return {};
    }
    const hid_t space = H5Dget_space(dataset);
    std::vector<hsize_t> result(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, result.data(), nullptr);
    H5Sclose(space);
    H5Dclose(dataset);
    return result;
  }

  template <class Number>
  [[nodiscard]] std::vector<Number> read(const std::string& name, hid_t memory_type) const {
    std::size_t size = 1;
    for (const hsize_t extent : extents(name)) size *= extent;
    std::vector<Number> values(size);
    const hid_t dataset = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    EXPECT_GE(H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
    H5Dclose(dataset);
    return values;
  }
  [[nodiscard]] std::vector<double> doubles(const std::string& name) const { return read<double>(name, H5T_NATIVE_DOUBLE); }
  [[nodiscard]] std::vector<int> ints(const std::string& name) const { return read<int>(name, H5T_NATIVE_INT); }

  /// Is the type in the file exactly this one?
  [[nodiscard]] bool has_type(const std::string& name, hid_t type) const {
    const hid_t dataset = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    const hid_t present = H5Dget_type(dataset);
    const bool same = H5Tequal(present, type) > 0;
    H5Tclose(present);
    H5Dclose(dataset);
    return same;
  }

  [[nodiscard]] std::vector<hsize_t> chunk(const std::string& name) const {
    const hid_t dataset = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    const hid_t properties = H5Dget_create_plist(dataset);
    std::vector<hsize_t> result(8);
    result.resize(static_cast<std::size_t>(H5Pget_chunk(properties, 8, result.data())));
    H5Pclose(properties);
    H5Dclose(dataset);
    return result;
  }

  /// The strings of an attribute; they must be of variable length.
  [[nodiscard]] std::vector<std::string> strings(const std::string& object, const std::string& name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0) {
      ADD_FAILURE() << object << " has no attribute " << name;
      return {};
    }
    const hid_t type = H5Aget_type(attribute);
    const hid_t space = H5Aget_space(attribute);
    EXPECT_GT(H5Tis_variable_str(type), 0) << object << " " << name;
    std::vector<char*> texts(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Aread(attribute, type, static_cast<void*>(texts.data())), 0);
    std::vector<std::string> result(texts.begin(), texts.end());
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, static_cast<void*>(texts.data()));
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(attribute);
    return result;
  }
  [[nodiscard]] std::string text(const std::string& object, const std::string& name) const {
    const std::vector<std::string> all = strings(object, name);
    return all.size() == 1 ? all[0] : "not one string";
  }

  template <class Number>
  [[nodiscard]] std::vector<Number> numbers(const std::string& object, const std::string& name, hid_t memory_type) const {
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0) {
      ADD_FAILURE() << object << " has no attribute " << name;
      return {};
    }
    const hid_t space = H5Aget_space(attribute);
    std::vector<Number> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Aread(attribute, memory_type, values.data()), 0);
    H5Sclose(space);
    H5Aclose(attribute);
    return values;
  }

  /// Do the two names lead to one object?
  [[nodiscard]] bool same_object(const std::string& one, const std::string& other) const {
    H5O_info_t first;
    H5O_info_t second;
    return H5Oget_info_by_name(file_, one.c_str(), &first, H5P_DEFAULT) >= 0 &&
           H5Oget_info_by_name(file_, other.c_str(), &second, H5P_DEFAULT) >= 0 && first.addr == second.addr;
  }

  [[nodiscard]] std::vector<std::string> members(const std::string& group) const {
    std::vector<std::string> names;
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
      static_cast<std::vector<std::string>*>(list)->emplace_back(name);
      return 0;
    };
    H5Literate_by_name(file_, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names, H5P_DEFAULT);
    return names;
  }

 private:
  hid_t file_ = -1;
};

}  // namespace carom::test
