#include "io/checkpoint.hpp"

#include "io/h5md_parts.hpp"
#include "io/hdf5_file.hpp"
#include "io/hdf5_stream.hpp"
#include "io/output_error.hpp"

#include <carom/version.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstddef>
#include <fstream>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace carom {

namespace fs = std::filesystem;
using detail::Hdf5Id;

namespace {

constexpr std::size_t head_bytes = 512;
/// Version of the format of the parts' contents; a program reads only its own.
constexpr std::uint64_t checkpoint_format = 6;

/// Returns the text before the HDF5 file, which is all of it, so that nothing in it can change unnoticed.
std::string head_for(std::uint64_t bytes, const XXH128_hash_t& sum) {
  std::string head = fmt::format(
      "carom checkpoint\nAn HDF5 file begins at byte 512.\nbytes {}\nxxh3-128 {:016x}{:016x} of bytes 512 to the end\n", bytes,
      sum.high64, sum.low64);
  head.resize(head_bytes, '\n');
  return head;
}

/// Returns what the head of a file must be; the head that the file has goes to `found`. Empty where it cannot be read.
std::string right_head(const fs::path& path, std::string& found) {
  std::ifstream in(path, std::ios::binary);
  found.resize(head_bytes);
  in.read(found.data(), static_cast<std::streamsize>(head_bytes));
  if (!in) return {};
  XXH3_state_t* sum = XXH3_createState();
  XXH3_128bits_reset(sum);
  std::vector<char> piece(std::size_t{1} << 20);
  std::uint64_t bytes = head_bytes;
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0) {
    XXH3_128bits_update(sum, piece.data(), static_cast<std::size_t>(in.gcount()));
    bytes += static_cast<std::uint64_t>(in.gcount());
  }
  const XXH128_hash_t digest = XXH3_128bits_digest(sum);
  XXH3_freeState(sum);
  return in.bad() ? std::string() : head_for(bytes, digest);
}

void write_facts(hid_t file, const CheckpointFacts& facts) {
  const Hdf5Id group = detail::create_group(file, "run");
  const hid_t run = group.get();
  detail::write_attribute(run, "format", checkpoint_format);
  detail::write_build(run);
  detail::write_attribute(run, "resolved_scene", facts.provenance.resolved_scene);
  detail::write_attribute(run, "scene_source", facts.scene_source);
  detail::write_attribute(run, "scene", facts.scene_text);
  if (!facts.overrides.empty()) detail::write_attribute(run, "overrides", facts.overrides);
  detail::write_attribute(run, "verify", facts.verify);
  detail::write_attribute(run, "checkpoint_every", facts.checkpoint_every);
  detail::write_attribute(run, "report", std::uint64_t{facts.report});
  detail::write_attribute(run, "command_line", facts.provenance.command_line);
  detail::write_attribute(run, "engine", facts.provenance.engine);
  if (facts.provenance.time_step) detail::write_attribute(run, "dt", *facts.provenance.time_step);
  if (facts.provenance.stiffness) detail::write_attribute(run, "stiffness", *facts.provenance.stiffness);
  detail::write_attribute(run, "time", facts.time);
  detail::write_attribute(run, "collisions", facts.collisions);
  detail::write_attribute(run, "finished", std::uint64_t{facts.finished});
  detail::write_attribute(run, "wall_seconds", facts.wall_seconds);
}

CheckpointFacts read_facts(hid_t file) {
  const auto text = [&](const char* name) { return detail::read_string_attribute(file, "run", name); };
  const auto number = [&](const char* name) -> std::optional<double> {
    const std::vector<double> values = detail::read_numbers_attribute(file, "run", name);
    return values.size() == 1 ? std::optional(values.front()) : std::nullopt;
  };
  return {.provenance = {.resolved_scene = text("resolved_scene"),
                         .command_line = text("command_line"),
                         .engine = text("engine"),
                         .time_step = number("dt"),
                         .stiffness = number("stiffness")},
          .scene_source = text("scene_source"),
          .scene_text = text("scene"),
          .overrides = detail::read_strings_attribute(file, "run", "overrides"),
          .time = number("time").value_or(0.0),
          .collisions = detail::read_unsigned_attribute(file, "run", "collisions"),
          .finished = detail::read_unsigned_attribute(file, "run", "finished") != 0,
          .wall_seconds = number("wall_seconds").value_or(0.0),
          .verify = detail::read_unsigned_attribute(file, "run", "verify"),
          .checkpoint_every = text("checkpoint_every"),
          .report = detail::read_unsigned_attribute(file, "run", "report") != 0};
}

void write_state(hid_t file, const State& state) {
  const Hdf5Id group = detail::create_group(file, "state");
  detail::write_attribute(group.get(), "about", std::string("one row per disk and axis: x and y of disk 0, of disk 1, ..."));
  const auto put = [&](const char* name, const Eigen::Matrix2Xd& values) {
    detail::write_fixed(group.get(), name, std::span(values.data(), static_cast<std::size_t>(values.size())));
  };
  put("position", state.positions);
  put("velocity", state.velocities);
  put("image", state.images.cast<double>());
}

/// Everything but the head. Failures of the disk are in `under`, and are not thrown.
void write_body(detail::Hdf5File& under, const fs::path& path, const CheckpointFacts& facts, const State& state,
                const std::vector<CheckpointPart>& parts) {
  Hdf5Id file = under.create_behind(head_bytes, path);
  write_facts(file.get(), facts);
  write_state(file.get(), state);
  const Hdf5Id group = detail::create_group(file.get(), "parts");
  for (const CheckpointPart& part : parts) {
    detail::Hdf5OutputStream out(group.get(), part.name);
    part.write(out);
    out.close();
  }
}

void write_head(const fs::path& path) {
  std::string ignored;
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file << right_head(path, ignored);
  file.close();
  if (!file) throw OutputError(fmt::format("{}: cannot write the checkpoint's head", path.string()));
}

Hdf5Id open(const fs::path& path) {
  const detail::SilentHdf5 silent;
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
}

}  // namespace

void write_checkpoint(const RunDirectory& directory, const CheckpointFacts& facts, const State& state,
                      const std::vector<CheckpointPart>& parts) {
  const detail::SilentHdf5 silent;
  const fs::path partial = directory.partial_name(checkpoint_name);
  std::error_code ignored;
  try {
    detail::Hdf5File under;
    std::string reason;
    try {
      write_body(under, partial, facts, state, parts);
    } catch (const detail::Hdf5Error& error) {
      reason = error.what();
    }
    if (under.error() != 0) throw detail::system_error(partial, "write", under.error());
    if (!reason.empty()) throw OutputError(fmt::format("{}: cannot write: {}", partial.string(), reason));
    write_head(partial);
  } catch (...) {
    fs::remove(partial, ignored);
    throw;
  }
  fs::rename(directory.final_name(checkpoint_name), directory.final_name(previous_checkpoint_name), ignored);
  directory.publish(checkpoint_name);
}

std::string checkpoint_damage(const fs::path& path) {
  std::string found;
  const std::string right = right_head(path, found);
  if (right.empty()) return "it is shorter than any checkpoint";
  if (!found.starts_with("carom checkpoint\n")) return "it does not begin like a checkpoint";
  return found == right ? "" : "its checksum is wrong";
}

CheckpointFacts checkpoint_facts(const fs::path& path) {
  try {
    return read_facts(open(path).get());
  } catch (const detail::Hdf5Error& error) {
    throw OutputError(fmt::format("{}: HDF5 cannot read this checkpoint: {}", path.string(), error.what()));
  }
}

Checkpoint::Checkpoint(const fs::path& directory) {
  for (const std::string_view name : {checkpoint_name, previous_checkpoint_name}) {
    const fs::path candidate = directory / name;
    std::error_code error;
    if (!fs::exists(candidate, error)) continue;
    const std::string damage = checkpoint_damage(candidate);
    if (damage.empty()) {
      path_ = candidate;
      break;
    }
    damage_ += fmt::format("{}{}: {}", damage_.empty() ? "" : "; ", candidate.string(), damage);
  }
  if (path_.empty())
    throw OutputError(
        damage_.empty()
            ? fmt::format("{}: there is no checkpoint from which a run could go on; --checkpoint-every has a run saved",
                          directory.string())
            : fmt::format("{}, and there is no other checkpoint from which the run could go on", damage_));
  file_ = open(path_);
  const auto text = [&](const char* name) { return detail::read_string_attribute(file_.get(), "run", name); };
  if (detail::read_unsigned_attribute(file_.get(), "run", "format") != checkpoint_format ||
      text("version") != build_info().version || text("commit") != build_info().commit)
    throw OutputError(fmt::format(
        "{}: carom {} ({}) has written this checkpoint, and only that one can go on from it to the last bit; this is {} ({})",
        path_.string(), text("version"), text("commit"), build_info().version, build_info().commit));
  facts_ = read_facts(file_.get());
}

bool Checkpoint::has(const std::string& part) const { return !detail::extents_of(file_.get(), "parts/" + part).empty(); }

void Checkpoint::read(const std::string& part, const std::function<void(std::istream& in)>& read) const {
  const detail::SilentHdf5 silent;
  try {
    detail::Hdf5InputStream in(file_.get(), "parts/" + part);
    read(in);
  } catch (const detail::Hdf5Error& error) {
    throw OutputError(fmt::format("{}: cannot read the part {}: {}", path_.string(), part, error.what()));
  }
}

}  // namespace carom
