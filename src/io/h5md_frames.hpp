#pragma once
// The groups /particles/trajectory and /observables of trajectory.h5md: one row per sample.

#include "io/growing_dataset.hpp"
#include "io/h5md_observables.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>

namespace carom::detail {

class H5mdFrames {
 public:
  /// Creates the groups, and writes what no sample changes: box, id, species, mass, radius. Throws Hdf5Error.
  H5mdFrames(hid_t file, const Scene& scene, const Disks& disks);

  /// Throws Hdf5Error, also where a disk has crossed the periodic edges more than 2^31 times. `positions` are those to write:
  /// the state's, or unwrapped ones.
  void set_effects(const Effects& acting) { observables_.set_effects(acting); }
  void append(std::uint64_t k, const Disks& disks, const State& state, const Totals& totals, const Eigen::Matrix2Xd& positions);
  void write();  ///< hands everything to HDF5
  void close();

  /// Saves or loads the lengths of all columns, for core/archive.hpp.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(step_, time_, position_, velocity_, image_, edges_, observables_);
  }

  [[nodiscard]] std::uint64_t written() const { return step_.written_rows(); }
  [[nodiscard]] std::size_t buffered_bytes() const;

 private:
  struct Groups;
  H5mdFrames(hid_t file, const Groups& groups, const Scene& scene, const Disks& disks);

  Box box_;
  GrowingDataset<std::int64_t> step_;
  GrowingDataset<double> time_;
  GrowingDataset<double> position_;
  GrowingDataset<double> velocity_;
  GrowingDataset<std::int32_t> image_;
  GrowingDataset<double> edges_;
  H5mdObservables observables_;
};

}  // namespace carom::detail
