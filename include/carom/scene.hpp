#pragma once
// What the user asked for, as plain data: the scene format of docs/scene-format.md after it was read, completed
// with every default, and checked. Nothing here is computed beyond what the file says.

#include <carom/box.hpp>
#include <carom/effects.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace carom {

/// The scene is wrong. what() is one sentence: "file:line:column: what is wrong; what would be right", or without a place where
/// a program has put the scene together.
class SceneError : public std::runtime_error {
 public:
  SceneError(const Location& where, const std::string& sentence);
  [[nodiscard]] const Location& where() const { return where_; }
  /// what() without the place.
  [[nodiscard]] const std::string& sentence() const { return sentence_; }

 private:
  Location where_;
  std::string sentence_;
};

struct RandomPositions {};   ///< uniform without overlap, by random sequential addition
struct SquareLattice {};     ///< a rectangular lattice over the whole box
struct HexagonalLattice {};  ///< a triangular lattice over the whole box
struct ListedPositions {
  std::vector<Eigen::Vector2d> values;
};
struct FilePositions {
  std::string path;  ///< absolute; a scene's relative path is relative to the scene file
  std::vector<Eigen::Vector2d> values;
};
struct GrownPositions {           ///< random and dense: small disks grown to their size while they move and collide
  double packing_fraction = 0.0;  ///< of all disks of the scene together
};
using Positions = std::variant<RandomPositions, SquareLattice, HexagonalLattice, ListedPositions, FilePositions, GrownPositions>;

struct UniformVelocities {
  double maximum = 0.0;  ///< each component uniform in [-maximum, maximum]
};
struct MaxwellVelocities {
  double temperature = 0.0;  ///< kT, met exactly by the drawn sample unless keep_momentum
};
struct FixedSpeed {
  double speed = 0.0;  ///< in a random direction
};
struct ListedVelocities {
  std::vector<Eigen::Vector2d> values;
};
struct FileVelocities {  ///< the columns vx, vy of the file that gives the positions
  std::vector<Eigen::Vector2d> values;
};
struct AtRest {};
using Velocities = std::variant<AtRest, UniformVelocities, MaxwellVelocities, FixedSpeed, ListedVelocities, FileVelocities>;

/// One [[disks]] table.
struct Species {
  std::string name;
  std::int64_t count = 0;
  double radius = 0.0;         ///< of every disk, where `radii` is empty
  double mass = 0.0;           ///< of every disk, where `masses` is empty
  std::vector<double> radii;   ///< one per disk, from a file; else empty
  std::vector<double> masses;  ///< one per disk, from a file; else empty
  Positions positions;
  Velocities velocities;
  Location where;             ///< of the table
  Location positions_where;   ///< of the key `positions`
  Location velocities_where;  ///< of the key `velocities`

  [[nodiscard]] double radius_of(std::int64_t i) const { return radii.empty() ? radius : radii[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double mass_of(std::int64_t i) const { return masses.empty() ? mass : masses[static_cast<std::size_t>(i)]; }
};

/// What times in a block differ by, at the least, and its length over the shortest of them, at the most: so much doubles can
/// tell.
inline constexpr double least_log_base = 1.01, most_log_ratio = 1e12;

/// Samples in blocks of one length: at the beginning of each, and at block / base^(per_block - 1), ..., block / base^2,
/// block / base after it. A few samples so tell what happens over short times and over long ones.
struct SampleLog {
  double base = 0.0;           ///< at least least_log_base; base^(per_block - 1) at most most_log_ratio
  std::int64_t per_block = 0;  ///< samples of one block, >= 2
  double block = 0.0;          ///< its length: time, > 0
};

/// The [run] table. At least one of time and collisions is present.
struct Run {
  struct Equilibrate {
    std::optional<double> collisions_per_disk;  ///< exactly one of the two is present
    std::optional<double> time;
  };
  std::optional<double> time;
  std::optional<std::uint64_t> collisions;  ///< pair collisions
  // At most one of these three is present, and without them there are no samples.
  std::optional<double> sample_every;                    ///< time
  std::optional<std::uint64_t> sample_every_collisions;  ///< of pairs, > 0
  std::optional<SampleLog> sample_log;
  std::optional<Equilibrate> equilibrate;
  std::uint64_t seed = 1;
  bool keep_momentum = false;
  bool accept_overlap = false;  ///< disks given one by one may overlap each other, however deep

  [[nodiscard]] bool is_sampled() const { return sample_every || sample_every_collisions || sample_log; }
  void take_no_samples() {
    sample_every.reset();
    sample_every_collisions.reset();
    sample_log.reset();
  }
};

/// The [output] table.
struct Output {
  bool trajectory = true;
  bool xyz = false;
  bool csv = false;
  bool events = false;
  bool unwrapped = false;
};

/// One key of the [observe] table: something to measure while the run goes on. Which settings an observable has is said in
/// docs/scene-format.md; those that it has are present, but for `every`, which follows from the mean free time where it is
/// absent.
struct ObservableRequest {
  std::string name;                  ///< "radial_distribution"
  std::optional<double> every;       ///< time between samples, > 0
  std::optional<std::int64_t> bins;  ///< of its histogram, >= 2
  std::optional<double> range;       ///< how far the histogram reaches, > 0; in mean diameters for distances
  std::optional<double> largest;     ///< wave number, > 0; in inverse mean diameters
  std::optional<int> axis;           ///< 0 or 1
  Location where;
};

struct Scene {
  std::string title;
  Box box;
  std::vector<Species> species;
  Effects effects;
  Run run;
  Output output;
  std::vector<ObservableRequest> observe;  ///< in the order of docs/scene-format.md

  std::string source;                  ///< the file's path, or the name given to parse_scene
  std::string text;                    ///< the TOML text as it was read, before overrides
  std::vector<std::string> overrides;  ///< "run.time=2", in the order in which they were applied

  [[nodiscard]] std::int64_t disk_count() const;
  /// sum of pi r^2 over the area of the box
  [[nodiscard]] double packing_fraction() const;
};

/// Checks that a scene makes sense: that every number is finite and in its range, that lists have one entry per disk, that disks
/// fit in the box and given ones do not overlap, that effects can act together and in this box, that the run can come to its end,
/// and that what is to be observed has a meaning. Throws SceneError with the sentence with which load_scene() refuses a file that
/// says the same, without its place. load_scene(), parse_scene(), every make_simulation() and restore_simulation() check a scene
/// by it. What only files must say is not asked for: a program may leave species without names, and a run without an end where it
/// calls run_until() by itself. Whether lattices and random places have room for the disks is found where they are placed.
void check(const Scene& scene);

/// Reads, completes and checks a scene file. Each override is "dotted.key=value", its value in TOML syntax (a bare
/// word stands for a string); "disks.0.radius" is the first species' radius.
/// Throws SceneError for anything that the scene format does not allow, and where the file cannot be read.
Scene load_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from text. `source` names the text in messages; start files are looked for in `directory`.
Scene parse_scene(const std::string& text, const std::string& source = "scene", const std::vector<std::string>& overrides = {},
                  const std::string& directory = ".");

/// The scene as TOML with every default filled in. parse_scene of the result gives the same scene.
std::string resolved_toml(const Scene& scene);

}  // namespace carom
