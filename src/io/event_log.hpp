#pragma once
// The group /events of trajectory.h5md: every collision in full precision.

#include "io/growing_dataset.hpp"

#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace carom::detail {

class EventLog {
 public:
  /// Creates the group. Throws Hdf5Error, as every function here.
  explicit EventLog(hid_t file);

  /// Writes positions and velocities before the first event. A start that is already in the file stays.
  void start(const State& state);
  void append(std::span<const Event> events);
  void write();  ///< hands complete chunks to HDF5
  void close();  ///< hands everything to HDF5

  /// Saves or loads the lengths of all columns, for core/archive.hpp.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(time_, time_remainder_, disk_, partner_, velocity_, partner_velocity_);
  }

  [[nodiscard]] std::uint64_t written() const { return time_.written_rows(); }
  [[nodiscard]] std::size_t buffered_bytes() const;

 private:
  explicit EventLog(Hdf5Id group);

  Hdf5Id group_;
  GrowingDataset<double> time_;
  GrowingDataset<double> time_remainder_;
  GrowingDataset<std::int32_t> disk_;
  GrowingDataset<std::int32_t> partner_;
  GrowingDataset<double> velocity_;
  GrowingDataset<double> partner_velocity_;
};

}  // namespace carom::detail
