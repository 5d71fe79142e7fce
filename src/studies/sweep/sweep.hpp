#pragma once
// Many runs of one scene: a grid or a list of changes to it, and for each of them several seeds. Plain data, read from a sweep
// file (docs/sweeps.md), and the names of points.

#include <carom/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// One set of changes to the scene.
struct SweepPoint {
  std::string name;                 ///< "radius=0.1_count=200"; that of its directory, too
  std::vector<std::string> values;  ///< one per key of the sweep, in TOML; empty where the scene's own stays
  std::vector<Location> places;     ///< place of each value in the file
  Location where;                   ///< place of the point as a whole
};

/// A point that is left out, because its scene is that of a point before it.
struct RepeatedPoint {
  std::string name;
  std::string of;  ///< name of the point that stays
};

struct Sweep {
  std::string source;      ///< the sweep file's path
  std::string text;        ///< text of the sweep file
  std::string scene_path;  ///< as `carom run` would be given it
  std::string scene_text;
  Location scene_where;
  std::vector<std::string> shared;      ///< changes at every point, as overrides: "run.time=2"
  std::vector<Location> shared_places;  ///< place of each of these
  std::vector<std::string> keys;        ///< keys that change, "disks.0.radius", in the order of the file
  std::vector<SweepPoint> points;       ///< each with a scene of its own
  std::vector<RepeatedPoint> repeated;  ///< what the file lists besides
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> table;      ///< numbers of summary.json that the results are to hold; empty: the usual ones
  std::vector<Location> table_places;  ///< place of each of these
  bool drawn = true;                   ///< some point's runs differ from seed to seed

  /// Runs are numbered point by point, the seeds of one after each other.
  [[nodiscard]] std::size_t run_count() const { return points.size() * seeds.size(); }
  [[nodiscard]] const SweepPoint& point_of(std::size_t run) const { return points[run / seeds.size()]; }
  [[nodiscard]] std::uint64_t seed_of(std::size_t run) const { return seeds[run % seeds.size()]; }
  /// Below the directory of the sweep: "radius=0.1_count=200/seed=3"
  [[nodiscard]] std::filesystem::path directory_of(std::size_t run) const;
  /// Returns the overrides that make the scene of this run: "disks.0.radius=0.1", "run.seed=3"
  [[nodiscard]] std::vector<std::string> overrides_of(std::size_t run) const;
  /// Returns the changes of a point, without a seed.
  [[nodiscard]] std::vector<std::string> changes_of(const SweepPoint& point) const;
  /// Returns the scene of a run. Throws SceneError, which load_sweep() has ruled out.
  [[nodiscard]] Scene scene_of(std::size_t run) const;
};

/// The files in a sweep's directory besides its points; no point may have one of these names.
inline constexpr std::array<std::string_view, 5> sweep_products = {"runs.csv", "sweep.csv", "columns.csv", "sweep.h5",
                                                                   "report.html"};

/// Returns the shortest endings that still tell dotted keys apart: "radius" for "disks.0.radius" where no other key ends so, else
/// "0.radius" and "1.radius".
[[nodiscard]] std::vector<std::string> short_keys(const std::vector<std::string>& keys);

/// Returns text such as "radius=0.1_boundary=periodic" from short keys and values in TOML. What file systems or shells may mind
/// becomes "-", and a long value its beginning and a hash of all of it. Absent values (empty) are left out; "scene" where all
/// are.
[[nodiscard]] std::string point_name(const std::vector<std::string>& short_keys, const std::vector<std::string>& values);

/// Returns whether a user may call a point so: letters, digits and . _ = + -, a letter or a digit first, at most 100 of them.
[[nodiscard]] bool is_point_name(std::string_view name);

/// Reads the file at `path` and the scene that it names; the scene of every point is read and checked. Throws SceneError: one
/// sentence with the place in the sweep file. Of points that have one scene, whatever they are called, the first one stays.
/// `overrides` change the scene at every point, "run.time=2", after what the file says for all.
[[nodiscard]] Sweep load_sweep(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace carom
