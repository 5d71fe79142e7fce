// HDF5's attributes, small datasets and reasons for errors.

#include "io/hdf5_handle.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <utility>

namespace carom::detail {

namespace {

Hdf5Id string_type() {
  Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  checked(H5Tset_size(type.get(), H5T_VARIABLE));
  checked(H5Tset_cset(type.get(), H5T_CSET_UTF8));
  return type;
}

Hdf5Id list_space(std::size_t count) {
  const hsize_t extent = count;
  return {H5Screate_simple(1, &extent, nullptr), H5Sclose};
}

Hdf5Id scalar_space() { return {H5Screate(H5S_SCALAR), H5Sclose}; }

void write_attribute(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type, const Hdf5Id& space,
                     const void* values) {
  if (checked(H5Aexists(object, name.c_str())) > 0) checked(H5Adelete(object, name.c_str()));
  const Hdf5Id attribute(H5Acreate2(object, name.c_str(), file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute.get(), memory_type, values));
}

/// Every group on the way must be asked for by itself.
bool exists(hid_t file, const std::string& path) {
  for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1)) {
    if (H5Lexists(file, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return path == "/" || H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0;
}

void write_fixed(hid_t parent, const std::string& name, hid_t file_type, hid_t memory_type, const Hdf5Id& space,
                 const void* values) {
  if (exists(parent, name)) return;
  const Hdf5Id properties = untimed(H5P_DATASET_CREATE);
  const Hdf5Id dataset(H5Dcreate2(parent, name.c_str(), file_type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                       H5Dclose);
  checked(H5Dwrite(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
}

void write_column(hid_t parent, const std::string& name, hid_t file_type, hid_t memory_type, std::size_t count,
                  const void* values) {
  write_fixed(parent, name, file_type, memory_type, list_space(count), values);
}

Hdf5Id open_attribute(hid_t file, const std::string& object, const std::string& name) {
  if (!exists(file, object) || H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) <= 0) return {};
  return {H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
}

herr_t append_name(hid_t /*group*/, const char* name, const H5L_info_t* /*link*/, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

herr_t innermost_reason(unsigned /*depth*/, const H5E_error2_t* error, void* reason) {
  if (error->desc != nullptr) *static_cast<std::string*>(reason) = error->desc;
  return 1;  // the first one is enough
}

}  // namespace

void throw_hdf5_error() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost_reason, &reason);
  reason.erase(std::min(reason.find('\n'), reason.size()));  // what follows is for those who write HDF5
  throw Hdf5Error(reason.empty() ? "HDF5 gives no reason" : reason);
}

void close_nothing_at_exit() { H5dont_atexit(); }

SilentHdf5::SilentHdf5() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

SilentHdf5::~SilentHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

Hdf5Id untimed(hid_t object_class) {
  Hdf5Id properties(H5Pcreate(object_class), H5Pclose);
  checked(H5Pset_obj_track_times(properties.get(), false));
  return properties;
}

Hdf5Id create_group(hid_t parent, const std::string& path) {
  if (exists(parent, path)) return {H5Gopen2(parent, path.c_str(), H5P_DEFAULT), H5Gclose};
  return {H5Gcreate2(parent, path.c_str(), H5P_DEFAULT, untimed(H5P_GROUP_CREATE).get(), H5P_DEFAULT), H5Gclose};
}

void link_hard(hid_t parent, const std::string& existing, const std::string& name) {
  if (exists(parent, name)) return;
  checked(H5Lcreate_hard(parent, existing.c_str(), parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
}

void write_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Hdf5Id type = string_type();
  const char* text = value.c_str();
  write_attribute(object, name, type.get(), type.get(), scalar_space(), static_cast<const void*>(&text));
}

void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& values) {
  const Hdf5Id type = string_type();
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  write_attribute(object, name, type.get(), type.get(), list_space(texts.size()), static_cast<const void*>(texts.data()));
}

void write_attribute(hid_t object, const std::string& name, std::span<const double> values) {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, list_space(values.size()), values.data());
}

void write_attribute(hid_t object, const std::string& name, std::span<const std::int64_t> values) {
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, list_space(values.size()), values.data());
}

void write_attribute(hid_t object, const std::string& name, std::int64_t value) {
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, scalar_space(), &value);
}

void write_attribute(hid_t object, const std::string& name, std::uint64_t value) {
  write_attribute(object, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, scalar_space(), &value);
}

void write_attribute(hid_t object, const std::string& name, double value) {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, scalar_space(), &value);
}

void write_fixed(hid_t parent, const std::string& name, std::span<const double> values) {
  write_fixed(parent, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, list_space(values.size()), values.data());
}

void write_fixed(hid_t parent, const std::string& name, std::span<const std::int32_t> values) {
  write_fixed(parent, name, H5T_STD_I32LE, H5T_NATIVE_INT32, list_space(values.size()), values.data());
}

void write_fixed(hid_t parent, const std::string& name, const Eigen::Matrix2Xd& values) {
  const std::array<hsize_t, 2> extents = {static_cast<hsize_t>(values.cols()), 2};
  const Hdf5Id space(H5Screate_simple(2, extents.data(), nullptr), H5Sclose);
  write_fixed(parent, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, values.data());
}

void write_column(hid_t parent, const std::string& name, std::span<const double> values) {
  write_column(parent, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), values.data());
}

void write_column(hid_t parent, const std::string& name, std::span<const std::int64_t> values) {
  write_column(parent, name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.size(), values.data());
}

void write_column(hid_t parent, const std::string& name, const std::vector<std::string>& values) {
  const Hdf5Id type = string_type();
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  write_column(parent, name, type.get(), type.get(), texts.size(), static_cast<const void*>(texts.data()));
}

std::vector<std::string> read_strings_attribute(hid_t file, const std::string& object, const std::string& name) {
  const Hdf5Id attribute = open_attribute(file, object, name);
  if (!attribute) return {};
  const Hdf5Id type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Id space(H5Aget_space(attribute.get()), H5Sclose);
  if (H5Tis_variable_str(type.get()) <= 0) return {};
  std::vector<char*> texts(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space.get()))), nullptr);
  checked(H5Aread(attribute.get(), type.get(), static_cast<void*>(texts.data())));
  std::vector<std::string> result;
  for (const char* text : texts) result.emplace_back(text == nullptr ? "" : text);
  checked(H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, static_cast<void*>(texts.data())));
  return result;
}

std::string read_string_attribute(hid_t file, const std::string& object, const std::string& name) {
  const std::vector<std::string> texts = read_strings_attribute(file, object, name);
  return texts.size() == 1 ? texts.front() : std::string();
}

std::vector<double> read_numbers_attribute(hid_t file, const std::string& object, const std::string& name) {
  const Hdf5Id attribute = open_attribute(file, object, name);
  if (!attribute) return {};
  const Hdf5Id type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Id space(H5Aget_space(attribute.get()), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return {};
  std::vector<double> values(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space.get()))));
  checked(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, values.data()));
  return values;
}

std::uint64_t read_unsigned_attribute(hid_t file, const std::string& object, const std::string& name) {
  if (read_numbers_attribute(file, object, name).size() != 1) throw Hdf5Error(object + " has no number " + name);
  std::uint64_t value = 0;
  checked(H5Aread(open_attribute(file, object, name).get(), H5T_NATIVE_UINT64, &value));
  return value;
}

std::vector<std::string> members_of(hid_t file, const std::string& group) {
  std::vector<std::string> names;
  if (exists(file, group))
    checked(H5Literate_by_name(file, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, append_name, &names, H5P_DEFAULT));
  return names;
}

std::string_view advice_on(const Hdf5Error& error) {
  if (std::string_view(error.what()).find("unable to lock file") != std::string_view::npos)
    return "another program has it open to write, which has to close it; where the file system has no locks, set the environment "
           "variable HDF5_USE_FILE_LOCKING=FALSE";
  return "it is damaged or cut short, copy it anew or run again";
}

const Hdf5Datasets::Dataset& Hdf5Datasets::opened(const std::string& name) {
  const std::lock_guard lock(opening_);
  if (const auto found = opened_.find(name); found != opened_.end()) return found->second;
  Dataset dataset;
  if (exists(file_, name)) {
    dataset.id = Hdf5Id(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Id space(H5Dget_space(dataset.id.get()), H5Sclose);
    dataset.extents.resize(static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space.get()))));
    checked(H5Sget_simple_extent_dims(space.get(), dataset.extents.data(), nullptr));
  }
  return opened_.emplace(name, std::move(dataset)).first->second;  // only what could be opened: else the next to ask is told too
}

std::vector<hsize_t> Hdf5Datasets::extents(const std::string& name) { return opened(name).extents; }

std::vector<double> Hdf5Datasets::rows(const std::string& name, hsize_t first, hsize_t count) {
  const Dataset& dataset = opened(name);
  if (dataset.extents.empty()) throw Hdf5Error(name + " is missing");
  std::vector<hsize_t> extents = dataset.extents, start(extents.size(), 0);
  start[0] = first;
  extents[0] = count;
  const Hdf5Id space(H5Dget_space(dataset.id.get()), H5Sclose);
  checked(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, extents.data(), nullptr));
  const Hdf5Id memory(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose);
  std::vector<double> values(std::accumulate(extents.begin(), extents.end(), hsize_t{1}, std::multiplies<>()));
  checked(H5Dread(dataset.id.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, values.data()));
  return values;
}

std::vector<hsize_t> extents_of(hid_t file, const std::string& dataset) { return Hdf5Datasets(file).extents(dataset); }

std::vector<double> read_rows(hid_t file, const std::string& dataset, hsize_t first, hsize_t count) {
  return Hdf5Datasets(file).rows(dataset, first, count);
}

}  // namespace carom::detail
