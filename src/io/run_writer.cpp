// The files of one run, opened, fed and completed together.

#include "io/run_writer.hpp"

#include "core/archive.hpp"
#include "io/hdf5_file.hpp"
#include "io/observable_output.hpp"
#include "io/summary.hpp"
#include "io/text_file.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

namespace carom {

namespace {

constexpr const char* h5md_name = "trajectory.h5md";
constexpr const char* xyz_name = "trajectory.xyz";
constexpr const char* csv_name = "samples.csv";
constexpr const char* summary_name = "summary.json";

// A killed run loses no more than this. A flush takes about a millisecond.
constexpr auto time_between_flushes = std::chrono::seconds(1);

/// The growing files that a scene asks for.
struct Wanted {
  bool h5md, xyz, csv;
};
Wanted wanted_by(const Scene& scene) {
  const bool samples = scene.run.is_sampled();
  return {.h5md = (scene.output.trajectory && samples) || scene.output.events || !scene.observe.empty(),
          .xyz = scene.output.xyz && samples,
          .csv = scene.output.csv && samples};
}

/// The sizes in bytes of the text files at a checkpoint; 0 where a file is not written. RunWriter::save() writes them first.
struct TextSizes {
  std::uint64_t xyz = 0, csv = 0;
};
TextSizes read_text_sizes(std::istream& saved) {
  LoadingArchive archive(saved);
  TextSizes sizes;
  archive(sizes.xyz, sizes.csv);
  return sizes;
}

/// Throws OutputError where a file of the run is missing or has fewer bytes. It may have its own name, or be .partial still.
void require_file(const RunDirectory& directory, const char* name, std::uint64_t bytes) {
  for (const std::filesystem::path& path : {directory.final_name(name), directory.partial_name(name)}) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error) continue;
    if (size >= bytes) return;
    throw detail::cut_short(path, size, bytes);
  }
  throw OutputError(fmt::format("{}: this file of the run is missing; put it back, and the run can go on",
                                directory.final_name(name).string()));
}

}  // namespace

RunWriter::RunWriter(const RunDirectory& directory, const Scene& scene, const Disks& disks, const Provenance& provenance)
    : RunWriter(directory, scene, disks, provenance, nullptr) {}

RunWriter::RunWriter(const RunDirectory& directory, const Scene& scene, const Disks& disks, const Provenance& provenance,
                     std::istream& saved)
    : RunWriter(directory, scene, disks, provenance, &saved) {}

RunWriter::RunWriter(const RunDirectory& directory, const Scene& scene, const Disks& disks, const Provenance& provenance,
                     std::istream* saved)
    : directory_(directory),
      box_(scene.box),
      trajectory_(scene.output.trajectory),
      unwrapped_(scene.output.unwrapped && (box_.periodic(0) || box_.periodic(1))),
      provenance_(provenance),
      last_flush_(std::chrono::steady_clock::now()) {
  const auto [h5md, xyz, csv] = wanted_by(scene);
  const bool rough = scene.effects.collision.roughness.has_value();
  const auto open = [&](const char* name) {
    products_.emplace_back(name);
    return directory_.partial_name(name);
  };
  holds_data_ = saved != nullptr;
  try {
    if (saved == nullptr) {
      if (h5md) h5md_.emplace(open(h5md_name), scene, disks, provenance);
      if (xyz) xyz_.emplace(open(xyz_name), scene, disks);
      if (csv) csv_.emplace(open(csv_name), rough);
    } else {
      directory_.take_back();
      const TextSizes sizes = read_text_sizes(*saved);
      if (h5md) h5md_.emplace(open(h5md_name), scene, disks, provenance, *saved);
      if (xyz) xyz_.emplace(open(xyz_name), scene, disks, sizes.xyz);
      if (csv) csv_.emplace(open(csv_name), rough, sizes.csv);
    }
  } catch (...) {
    if (!holds_data_) discard_partials();
    throw;
  }
}

void RunWriter::require_files(const RunDirectory& directory, const Scene& scene, std::istream& saved) {
  const auto [h5md, xyz, csv] = wanted_by(scene);
  const TextSizes sizes = read_text_sizes(saved);
  if (h5md) require_file(directory, h5md_name, detail::Hdf5File::saved_size(saved));
  if (xyz) require_file(directory, xyz_name, sizes.xyz);
  if (csv) require_file(directory, csv_name, sizes.csv);
}

void RunWriter::save(std::ostream& out) {
  if (xyz_) xyz_->flush();
  if (csv_) csv_->flush();
  {
    SavingArchive archive(out);
    archive(xyz_ ? xyz_->written() : 0, csv_ ? csv_->written() : 0);
  }
  if (h5md_) h5md_->save(out);
  for (const std::string& product : products_) directory_.synchronise_partial(product);
  last_flush_ = std::chrono::steady_clock::now();
}

RunWriter::~RunWriter() {
  if (!finished_ && !holds_data_) discard_partials();
}

void RunWriter::discard_partials() const noexcept {
  std::error_code ignored;  // what cannot be removed does no harm
  for (const std::string& product : products_) std::filesystem::remove(directory_.partial_name(product), ignored);
}

void RunWriter::start(const State& state, double temperature) {
  if (h5md_) h5md_->start(state, temperature);
}

void RunWriter::set_effects(const Effects& acting) {
  if (h5md_) h5md_->set_effects(acting);
}

void RunWriter::sample(std::uint64_t k, const State& state, const Totals& totals) {
  const State* written = &state;
  if (unwrapped_) {
    unwrapped_state_ = state;
    unwrapped_state_.positions += (state.images.cast<double>().array().colwise() * box_.lengths().array()).matrix();
    written = &unwrapped_state_;
  }
  holds_data_ = true;
  if (h5md_ && trajectory_) h5md_->sample(k, state, totals, written->positions);
  if (xyz_) xyz_->sample(*written);
  if (csv_) csv_->sample(*written);
  flush_now_and_then();
}

void RunWriter::events(std::span<const Event> events) {
  if (!h5md_) return;
  holds_data_ = true;
  h5md_->events(events);
  flush_now_and_then();
}

void RunWriter::flush_now_and_then() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_flush_ < time_between_flushes) return;
  if (h5md_) h5md_->flush();
  if (xyz_) xyz_->flush();
  if (csv_) csv_->flush();
  last_flush_ = std::chrono::steady_clock::now();
}

std::vector<std::string> RunWriter::finish(const RunReport& report) {
  holds_data_ = true;
  if (h5md_) h5md_->measurements(report.observables);
  if (h5md_) h5md_->close();
  if (xyz_) xyz_->close();
  if (csv_) csv_->close();
  for (const Measurement& measured : report.observables) {
    for (const Table& table : measured.tables) {
      products_.push_back(table_file(table));
      write_table(directory_.partial_name(products_.back()), table);
    }
  }
  products_.emplace_back(summary_name);
  detail::TextFile summary(directory_.partial_name(summary_name));
  summary.buffer() = summary_json(report, provenance_) + "\n";
  summary.close();
  for (const std::string& product : products_) directory_.publish(product);
  finished_ = true;
  return products_;
}

std::size_t RunWriter::buffered_bytes() const {
  return (h5md_ ? h5md_->buffered_bytes() : 0) + (xyz_ ? xyz_->buffered_bytes() : 0) + (csv_ ? csv_->buffered_bytes() : 0);
}

}  // namespace carom
