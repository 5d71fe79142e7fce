#pragma once
// All files of one run: what scene.output asks for, and the summary.

#include "io/csv_writer.hpp"
#include "io/h5md_writer.hpp"
#include "io/provenance.hpp"
#include "io/run_directory.hpp"
#include "io/xyz_writer.hpp"
#include "observe/run_report.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carom {

/// Every function throws OutputError where a file cannot be written; its sentence says what is kept. Whatever happens, a
/// file under its own name is whole, and DIR/NAME.partial is readable up to about the last second.
class RunWriter {
 public:
  /// Opens all files, so that what cannot be written is known before the simulation starts. trajectory.h5md is written
  /// where samples, events or observables are asked for. Without run.sample_every and run.sample_log there are no samples, and no
  /// file for them.
  RunWriter(const RunDirectory& directory, const Scene& scene, const Disks& disks, const Provenance& provenance);
  /// Continues the files of a run from where save() was called, whether they have their own names or are still .partial. Whatever
  /// was written later is cut off; summary, tables and pages, which the end of a run writes, are removed.
  RunWriter(const RunDirectory& directory, const Scene& scene, const Disks& disks, const Provenance& provenance,
            std::istream& saved);
  /// Throws OutputError where a file that the constructor above would go on with is missing, or shorter than when save() was
  /// called. Changes nothing.
  static void require_files(const RunDirectory& directory, const Scene& scene, std::istream& saved);
  /// Without finish(), keeps the files as .partial, or removes them where nothing has happened yet.
  ~RunWriter();
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;

  /// The measured run begins; `temperature` is what observables refer to (ObservedRun::temperature). What is analysed afterwards
  /// needs both.
  void start(const State& state, double temperature);
  /// Says which effects act from now on; before it is called, all of the scene's do, those of its changes too.
  void set_effects(const Effects& acting);
  /// A state, and the totals up to then.
  void sample(std::uint64_t k, const State& state, const Totals& totals);
  void events(std::span<const Event> events);

  /// Completes all files, gives them their names, the summary last, and returns these. Call it once; also for a run that
  /// was interrupted, whose files then hold all that happened.
  std::vector<std::string> finish(const RunReport& report);

  /// Brings all files to the disk and writes how far each has come.
  void save(std::ostream& out);

  [[nodiscard]] std::size_t buffered_bytes() const;  ///< all memory that holds data, without HDF5's own caches

 private:
  RunWriter(const RunDirectory& directory, const Scene& scene, const Disks& disks, const Provenance& provenance,
            std::istream* saved);
  void flush_now_and_then();
  void discard_partials() const noexcept;

  RunDirectory directory_;
  Box box_;
  bool trajectory_;
  bool unwrapped_;
  Provenance provenance_;
  std::vector<std::string> products_;  ///< names of the files in the order of run_products, without the summary
  bool holds_data_ = false;
  bool finished_ = false;
  State unwrapped_state_;  // kept from sample to sample for its memory
  std::chrono::steady_clock::time_point last_flush_;

  std::optional<H5mdWriter> h5md_;
  std::optional<XyzWriter> xyz_;
  std::optional<CsvWriter> csv_;
};

}  // namespace carom
