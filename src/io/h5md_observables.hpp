#pragma once
// The group /observables of trajectory.h5md: one row per sample of everything that is no position or velocity. Energy,
// temperature, and collisions with their virial up to the sample are always there, the others where an effect of the scene makes
// them worth having.

#include "io/growing_dataset.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace carom::detail {

class H5mdObservables {
 public:
  /// Requires particles/trajectory/position/step and time to be in the file. Throws Hdf5Error, as every function here.
  H5mdObservables(hid_t file, const Scene& scene, const Disks& disks);

  /// Says which effects act from now on: those of the scene have all that its changes bring, and are for the choice of columns.
  void set_effects(const Effects& acting) { effects_ = acting; }
  void append(const Disks& disks, const State& state, const Totals& totals);  ///< requires positions inside the box
  void write();                                                               ///< hands everything to HDF5
  void close();

  /// Saves or loads the lengths of all columns, for core/archive.hpp.
  template <class Archive>
  void serialize(Archive& archive) {
    for (Column& column : columns_) archive(column.values);
  }

  [[nodiscard]] std::size_t buffered_bytes() const;

 private:
  /// The data of one row.
  struct Sample {
    const Box& box;
    const Effects& effects;
    const Disks& disks;
    const State& state;
    const Totals& totals;
  };
  /// Fills a row of zeros.
  using Measure = void (*)(const Sample& sample, std::span<double> row);
  struct Column {
    Measure measure;
    GrowingDataset<double> values;
  };

  Box box_;
  Effects effects_;
  std::vector<Column> columns_;
};

}  // namespace carom::detail
