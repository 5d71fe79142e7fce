#pragma once
// trajectory.h5md: samples and events in one HDF5 file, streamed, so that memory does not grow with the run, and readable
// up to the last flush whatever ends the run (see hdf5_file.hpp).

#include "io/event_log.hpp"
#include "io/h5md_frames.hpp"
#include "io/hdf5_file.hpp"
#include "io/output_error.hpp"
#include "io/provenance.hpp"

#include <carom/observe.hpp>
#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <vector>

namespace carom {

/// Every function throws OutputError where the file cannot be written. After that the file stays as it is.
class H5mdWriter {
 public:
  /// Creates the file. It always has the groups of the samples, and /events where scene.output.events asks for it.
  H5mdWriter(std::filesystem::path path, const Scene& scene, const Disks& disks, const Provenance& provenance);
  /// Goes on with a file that is there, from where save() was called: what was written after that is cut off.
  H5mdWriter(std::filesystem::path path, const Scene& scene, const Disks& disks, const Provenance& provenance,
             std::istream& saved);
  ~H5mdWriter();  ///< writes what is left as far as that goes; only close() says whether it went well
  H5mdWriter(const H5mdWriter&) = delete;
  H5mdWriter& operator=(const H5mdWriter&) = delete;

  /// The beginning of the measured run, for the event log; `temperature` is what observables refer to (ObservedRun::temperature).
  void start(const State& state, double temperature);
  /// Says which effects act from now on; before it is called, all of the scene's do.
  void set_effects(const Effects& acting) {
    if (frames_) frames_->set_effects(acting);
  }
  /// A state, and the totals up to then.
  void sample(std::uint64_t k, const State& state, const Totals& totals) { sample(k, state, totals, state.positions); }
  /// Writes a sample with other positions, unwrapped ones, in place of those of `state`.
  void sample(std::uint64_t k, const State& state, const Totals& totals, const Eigen::Matrix2Xd& positions);
  void events(std::span<const Event> events);  ///< nothing where scene.output.events is not set
  /// Writes the results of observables; to be called once, at the end.
  void measurements(const std::vector<Measurement>& observables);
  void flush();  ///< writes all samples so far to the file, where they survive a kill
  void close();
  /// Flushes, and writes how far the file has come.
  void save(std::ostream& out);

  [[nodiscard]] std::uint64_t safe_samples() const { return safe_samples_; }  ///< number of samples up to the last flush
  [[nodiscard]] std::size_t buffered_bytes() const;  ///< all memory that holds data, without HDF5's own caches

 private:
  H5mdWriter(std::filesystem::path path, const Scene& scene, const Disks& disks, const Provenance& provenance,
             std::istream* saved);
  template <class Action>
  void guard(Action action);

  std::filesystem::path path_;
  Disks disks_;
  detail::Hdf5File file_;  // before the identifiers, which need it until they are closed
  detail::Hdf5Id h5_;
  std::optional<detail::H5mdFrames> frames_;
  std::optional<detail::EventLog> events_;
  std::uint64_t safe_samples_ = 0;
  std::uint64_t safe_events_ = 0;
  std::uint64_t bytes_at_flush_ = 0;
};

}  // namespace carom
