#pragma once
// DIR/checkpoint.h5: all that a run needs to go on as if it had never been interrupted. An HDF5 file behind 512 bytes of text
// that say how long the file is and what its checksum is (128 bits of XXH3), so that any change of it is detected before
// anything is read. It is written beside the last one, and takes its name when it is safe on the disk; the last one stays, as
// DIR/checkpoint-previous.h5.

#include "io/hdf5_handle.hpp"
#include "io/provenance.hpp"
#include "io/run_directory.hpp"

#include <carom/state.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace carom {

/// Facts about the run of a checkpoint.
struct CheckpointFacts {
  Provenance provenance;
  std::string scene_source;  ///< name of the scene's file, as the user gave it
  std::string scene_text;    ///< text of the scene, as it was read
  std::vector<std::string> overrides;
  double time = 0.0;
  std::uint64_t collisions = 0;
  bool finished = false;  ///< the run had come to its end
  double wall_seconds = 0.0;
  std::uint64_t verify = 0;  ///< options of the run besides its scene: RunOptions of the program
  std::string checkpoint_every;
  bool report = false;
};

/// A part of the state, under a name of its own.
struct CheckpointPart {
  std::string name;
  std::function<void(std::ostream& out)> write;
};

/// Writes a checkpoint. Throws OutputError; the earlier checkpoints are then still there. `state` is for readers that open the
/// file with other programs.
void write_checkpoint(const RunDirectory& directory, const CheckpointFacts& facts, const State& state,
                      const std::vector<CheckpointPart>& parts);

/// One that is sound to the last bit, open to be read.
class Checkpoint {
 public:
  /// The newest that is. Throws OutputError where a directory has none, or this program cannot go on from it because another one
  /// has written it.
  explicit Checkpoint(const std::filesystem::path& directory);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const CheckpointFacts& facts() const { return facts_; }
  /// Returns what is wrong with a newer checkpoint that was skipped; empty where none was.
  [[nodiscard]] const std::string& damage() const { return damage_; }
  [[nodiscard]] bool has(const std::string& part) const;
  /// Calls `read` with the part as a stream. Throws OutputError where there is none of that name.
  void read(const std::string& part, const std::function<void(std::istream& in)>& read) const;

 private:
  std::filesystem::path path_;
  std::string damage_;
  detail::Hdf5Id file_;
  CheckpointFacts facts_;
};

/// Returns what is wrong with a checkpoint file; empty where nothing is.
[[nodiscard]] std::string checkpoint_damage(const std::filesystem::path& path);

/// Facts of a sound file. Throws OutputError.
[[nodiscard]] CheckpointFacts checkpoint_facts(const std::filesystem::path& path);

}  // namespace carom
