// Samples and events in one file.

#include "io/h5md_writer.hpp"

#include "core/archive.hpp"
#include "io/h5md_parts.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace carom {

namespace {

// The most bytes that a killed run may lose, which also bounds the index that waits in memory for the flush.
constexpr std::uint64_t most_bytes_between_flushes = std::uint64_t{1} << 28;

std::string kept_sentence(std::uint64_t samples, std::uint64_t events) {
  if (samples == 0 && events == 0) return {};
  if (events == 0) return fmt::format("its first {} samples are readable", samples);
  if (samples == 0) return fmt::format("its first {} events are readable", events);
  return fmt::format("its first {} samples and {} events are readable", samples, events);
}

}  // namespace

template <class Action>
void H5mdWriter::guard(Action action) {
  const detail::SilentHdf5 silent;
  std::string reason;
  if (file_.error() == 0) {
    try {
      action();
    } catch (const detail::Hdf5Error& error) {
      reason = error.what();
    }
  }
  const std::string kept = kept_sentence(safe_samples_, safe_events_);
  if (file_.error() != 0) throw detail::system_error(path_, "write", file_.error(), kept);
  if (!reason.empty())
    throw OutputError(fmt::format("{}: cannot write: {}{}{}", path_.string(), reason, kept.empty() ? "" : "; ", kept));
}

H5mdWriter::H5mdWriter(std::filesystem::path path, const Scene& scene, const Disks& disks, const Provenance& provenance)
    : H5mdWriter(std::move(path), scene, disks, provenance, nullptr) {}

H5mdWriter::H5mdWriter(std::filesystem::path path, const Scene& scene, const Disks& disks, const Provenance& provenance,
                       std::istream& saved)
    : H5mdWriter(std::move(path), scene, disks, provenance, &saved) {}

H5mdWriter::H5mdWriter(std::filesystem::path path, const Scene& scene, const Disks& disks, const Provenance& provenance,
                       std::istream* saved)
    : path_(std::move(path)), disks_(disks) {
  guard([&] {
    h5_ = saved != nullptr ? file_.reopen(path_, *saved) : file_.create(path_);
    detail::write_h5md_header(h5_.get());
    detail::write_parameters(h5_.get(), scene, provenance);
    frames_.emplace(h5_.get(), scene, disks_);
    if (scene.output.events) events_.emplace(h5_.get());
    if (saved == nullptr) return;
    LoadingArchive archive(*saved);
    archive(*frames_);
    if (events_) archive(*events_);
  });
  flush();
}

void H5mdWriter::save(std::ostream& out) {
  flush();
  file_.save_index(out);
  SavingArchive archive(out);
  archive(*frames_);
  if (events_) archive(*events_);
}

H5mdWriter::~H5mdWriter() {
  try {
    close();
  } catch (const std::exception&) {
    // the file is as it was at the last flush, and a destructor cannot report the error
  }
  const detail::SilentHdf5 silent;
  events_.reset();
  frames_.reset();
  h5_.reset();
}

void H5mdWriter::start(const State& state, double temperature) {
  guard([&] {
    detail::write_reference_temperature(h5_.get(), temperature);
    if (events_) events_->start(state);
  });
}

void H5mdWriter::sample(std::uint64_t k, const State& state, const Totals& totals, const Eigen::Matrix2Xd& positions) {
  guard([&] { frames_->append(k, disks_, state, totals, positions); });
  if (file_.bytes_written() - bytes_at_flush_ > most_bytes_between_flushes) flush();
}

void H5mdWriter::events(std::span<const Event> events) {
  if (!events_) return;
  guard([&] { events_->append(events); });
  if (file_.bytes_written() - bytes_at_flush_ > most_bytes_between_flushes) flush();
}

void H5mdWriter::measurements(const std::vector<Measurement>& observables) {
  guard([&] { detail::write_measurements(h5_.get(), observables); });
}

void H5mdWriter::flush() {
  guard([&] {
    frames_->write();
    if (events_) events_->write();
    detail::checked(H5Fflush(h5_.get(), H5F_SCOPE_LOCAL));
  });
  safe_samples_ = frames_->written();
  safe_events_ = events_ ? events_->written() : 0;
  bytes_at_flush_ = file_.bytes_written();
}

void H5mdWriter::close() {
  if (!h5_) return;
  guard([&] {
    frames_->close();
    if (events_) events_->close();
    h5_.close();
  });
}

std::size_t H5mdWriter::buffered_bytes() const {
  return frames_->buffered_bytes() + (events_ ? events_->buffered_bytes() : 0) + file_.held_bytes();
}

}  // namespace carom
