#include "io/same_results.hpp"

#include "io/finished_run.hpp"
#include "io/hdf5_handle.hpp"
#include "io/run_directory.hpp"
#include "scene/observables_known.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <string_view>

namespace carom {

namespace fs = std::filesystem;
using detail::Hdf5Id;

namespace {

constexpr std::size_t most_per_file = 3;  // differences: where one bit goes another way, all that follow do

/// Keys that may differ between two equal runs.
constexpr std::array<std::string_view, 10> not_compared = {"carom",        "scene",   "wall_seconds", "collisions_per_second",
                                                           "loop_seconds", "cores",   "command_line", "resolved_scene",
                                                           "horizon",      "verified"};

/// The names of a run's observables that no scene can ask for: a program has measured them, and another run of the scene has not.
std::vector<std::string> observables_of_program(const fs::path& directory) {
  std::vector<std::string> names;
  const nlohmann::json summary = detail::summary_in(directory);
  if (const auto measured = summary.find("observables"); measured != summary.end())
    for (const auto& [name, results] : measured->items())
      if (detail::find_observable(name) == nullptr) names.push_back(name);
  return names;
}

void collect_datasets(hid_t file, const std::string& group, std::vector<std::string>& paths) {
  for (const std::string& name : detail::members_of(file, group.empty() ? "/" : group)) {
    const std::string path = fmt::format("{}/{}", group, name);
    const Hdf5Id object(H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose);
    if (H5Iget_type(object.get()) == H5I_DATASET) {
      paths.push_back(path);
    } else {
      collect_datasets(file, path, paths);
    }
  }
}

/// A dataset as it lies in the file, some rows at a time.
class RawDataset {
 public:
  RawDataset(hid_t file, const std::string& path)
      : set_(H5Dopen(file, path.c_str(), H5P_DEFAULT), H5Dclose),
        type_(H5Dget_type(set_.get()), H5Tclose),
        extents_(detail::extents_of(file, path)) {}

  [[nodiscard]] const std::vector<hsize_t>& extents() const { return extents_; }
  [[nodiscard]] bool is_of_type(const RawDataset& other) const { return H5Tequal(type_.get(), other.type_.get()) > 0; }
  [[nodiscard]] std::size_t row_bytes() const {
    std::size_t bytes = H5Tget_size(type_.get());
    for (std::size_t axis = 1; axis < extents_.size(); ++axis) bytes *= extents_[axis];
    return bytes;
  }
  [[nodiscard]] std::vector<char> rows(hsize_t first, hsize_t count) const {
    std::vector<hsize_t> start(extents_.size(), 0), block = extents_;
    start[0] = first;
    block[0] = count;
    const Hdf5Id in_file(H5Dget_space(set_.get()), H5Sclose);
    detail::checked(H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr));
    const Hdf5Id in_memory(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose);
    std::vector<char> bytes(row_bytes() * count);
    detail::checked(H5Dread(set_.get(), type_.get(), in_memory.get(), in_file.get(), H5P_DEFAULT, bytes.data()));
    return bytes;
  }

 private:
  Hdf5Id set_, type_;
  std::vector<hsize_t> extents_;
};

/// Returns the first row that differs, in words; empty where none does.
std::string first_difference(const RawDataset& one, const RawDataset& other) {
  if (!one.is_of_type(other)) return "numbers of another type";
  if (one.extents() != other.extents())
    return fmt::format("{} against {} rows", one.extents().empty() ? 1 : one.extents()[0],
                       other.extents().empty() ? 1 : other.extents()[0]);
  if (one.extents().empty()) return {};
  const hsize_t rows = one.extents()[0], bytes = std::max<hsize_t>(one.row_bytes(), 1);
  const hsize_t at_once = std::max<hsize_t>((hsize_t{1} << 24) / bytes, 1);
  for (hsize_t first = 0; first < rows; first += at_once) {
    const hsize_t count = std::min(at_once, rows - first);
    const std::vector<char> a = one.rows(first, count), b = other.rows(first, count);
    const auto at = std::mismatch(a.begin(), a.end(), b.begin()).first;
    if (at != a.end())
      return fmt::format("row {} is the first that differs", first + static_cast<hsize_t>(at - a.begin()) / bytes);
  }
  return {};
}

std::string compare_trajectories(const fs::path& one, const fs::path& other, const std::vector<std::string>& left_out,
                                 std::vector<std::string>& differences) {
  const detail::SilentHdf5 silent;
  const auto open = [](const fs::path& path) { return Hdf5Id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose); };
  const Hdf5Id a = open(one), b = open(other);
  std::vector<std::string> in_a, in_b;
  collect_datasets(a.get(), "", in_a);
  collect_datasets(b.get(), "", in_b);
  for (const std::string& observable : left_out)
    std::erase_if(in_a, [group = fmt::format("/measurements/{}/", observable)](const std::string& path) {
      return path.starts_with(group);
    });
  const std::string name = one.filename().string();
  if (in_a != in_b)
    differences.push_back(fmt::format("{}: {} against {} datasets, of other names", name, in_a.size(), in_b.size()));
  std::size_t found = 0;
  for (const std::string& path : in_a) {
    if (!std::binary_search(in_b.begin(), in_b.end(), path)) continue;
    const std::string difference = first_difference(RawDataset(a.get(), path), RawDataset(b.get(), path));
    if (!difference.empty() && found++ < most_per_file) differences.push_back(fmt::format("{}: {}: {}", name, path, difference));
  }
  if (found > most_per_file) differences.push_back(fmt::format("{}: {} more datasets differ", name, found - most_per_file));
  return fmt::format("{} ({} datasets)", name, in_a.size());
}

std::string compare_texts(const fs::path& one, const fs::path& other, const std::vector<std::string>& /*left_out*/,
                          std::vector<std::string>& differences) {
  std::ifstream a(one, std::ios::binary), b(other, std::ios::binary);
  std::string in_a, in_b;
  std::size_t line = 0;
  for (;;) {
    const bool more_a = static_cast<bool>(std::getline(a, in_a)), more_b = static_cast<bool>(std::getline(b, in_b));
    ++line;
    if (!more_a && !more_b) break;
    if (more_a == more_b && in_a == in_b) continue;
    differences.push_back(fmt::format("{}: line {} is the first that differs", one.filename().string(), line));
    break;
  }
  return fmt::format("{} ({} lines)", one.filename().string(), line - 1);
}

std::string compare_summaries(const fs::path& one, const fs::path& other, const std::vector<std::string>& left_out,
                              std::vector<std::string>& differences) {
  nlohmann::json a = detail::summary_in(one.parent_path()), b = detail::summary_in(other.parent_path());
  const bool several_cores = a.contains("cores") || b.contains("cores");  // each domain counts what it has by itself
  for (const std::string_view key : not_compared) {
    a.erase(std::string(key));
    b.erase(std::string(key));
  }
  if (several_cores)
    for (nlohmann::json* summary : {&a, &b})
      if (const auto numerics = summary->find("numerics"); numerics != summary->end()) numerics->erase("simultaneous");
  if (!left_out.empty() && !a["observables"].is_object()) throw detail::no_summary(one.parent_path());
  for (const std::string& observable : left_out) a["observables"].erase(observable);
  if (!left_out.empty() && a["observables"].empty()) a.erase("observables");
  const nlohmann::json patch = nlohmann::json::diff(a, b);
  for (std::size_t k = 0; k < std::min(patch.size(), most_per_file); ++k) {
    const std::string path = patch[k].at("path");
    const auto value = [&](const nlohmann::json& of) {
      const nlohmann::json::json_pointer pointer(path);
      return of.contains(pointer) ? of.at(pointer).dump() : std::string("nothing");
    };
    differences.push_back(fmt::format("summary.json: {} is {} against {}", path, value(a), value(b)));
  }
  if (patch.size() > most_per_file)
    differences.push_back(fmt::format("summary.json: {} more values differ", patch.size() - most_per_file));
  if (left_out.empty()) return "summary.json";
  return fmt::format("summary.json (without {}, which the scene does not ask for)", fmt::join(left_out, ", "));
}

}  // namespace

SameResults compare_results(const fs::path& one, const fs::path& other) {
  SameResults found;
  const std::vector<std::string> left_out = observables_of_program(one);
  for (const std::string_view product : run_products) {
    const fs::path a = one / product, b = other / product;
    if (a.extension() == ".html" || a.extension() == ".h5") continue;  // pages and checkpoints are no results
    std::error_code error;
    const bool there_a = fs::exists(a, error), there_b = fs::exists(b, error);
    if (!there_a && !there_b) continue;
    if (there_a != there_b) {
      found.differences.push_back(fmt::format("{}: only one of the two has this file", product));
      continue;
    }
    const auto compare = a.extension() == ".h5md"   ? compare_trajectories
                         : a.extension() == ".json" ? compare_summaries
                                                    : compare_texts;
    detail::reading_hdf5(a, [&] { found.files.push_back(compare(a, b, left_out, found.differences)); });
  }
  return found;
}

}  // namespace carom
