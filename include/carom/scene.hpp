#pragma once
// A scene: what is to be simulated, as plain data. It is the scene format of docs/scene-format.md after it was read, completed
// with every default, and checked. Nothing here is computed beyond what the file says.

#include <carom/box.hpp>
#include <carom/changes.hpp>
#include <carom/effects.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace carom {

/// The place of a value: a file with line and column (both from 1), or a command-line override (line 0).
struct Location {
  std::string source = {};
  int line = 0;
  int column = 0;
};

/// Thrown for a scene that is wrong. what() is one sentence, "file:line:column: what is wrong; what would be right", without the
/// place where a program has made the scene.
class SceneError : public std::runtime_error {
 public:
  SceneError(const Location& where, const std::string& sentence);
  [[nodiscard]] const Location& where() const { return where_; }
  /// Returns what() without the place.
  [[nodiscard]] const std::string& sentence() const { return sentence_; }

 private:
  Location where_;
  std::string sentence_;
};

/// A rectangle in which disks are to lie.
struct RectangleRegion {
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();
};
/// A circle in which disks are to lie.
struct CircleRegion {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;  ///< length, > 0
};
struct RandomPositions {  ///< uniform without overlap, by random sequential addition
  /// Where the disks of the species lie, none of them across its edge; absent: in the whole box.
  std::optional<std::variant<RectangleRegion, CircleRegion>> region = {};
};
struct SquareLattice {};     ///< a rectangular lattice over the whole box
struct HexagonalLattice {};  ///< a triangular lattice over the whole box
struct ListedPositions {     ///< one centre per disk
  std::vector<Eigen::Vector2d> values = {};
};
struct FilePositions {    ///< the columns x, y of a file
  std::string path = {};  ///< absolute; a scene's relative path is relative to the scene file
  std::vector<Eigen::Vector2d> values = {};
};
struct GrownPositions {           ///< random and dense: small disks that grew to their size while they moved and collided
  double packing_fraction = 0.0;  ///< of all disks of the scene together
};
using Positions = std::variant<RandomPositions, SquareLattice, HexagonalLattice, ListedPositions, FilePositions, GrownPositions>;

struct UniformVelocities {  ///< each component uniform in [-maximum, maximum]
  double maximum = 0.0;
};
struct MaxwellVelocities {   ///< a Maxwell distribution
  double temperature = 0.0;  ///< kT; the drawn sample has it exactly, unless keep_momentum
};
struct FixedSpeed {  ///< one speed in random directions
  double speed = 0.0;
};
struct ListedVelocities {  ///< one velocity per disk
  std::vector<Eigen::Vector2d> values = {};
};
struct FileVelocities {  ///< the columns vx, vy of the file of positions
  std::vector<Eigen::Vector2d> values = {};
};
struct AtRest {};  ///< zero velocity
using Velocities = std::variant<AtRest, UniformVelocities, MaxwellVelocities, FixedSpeed, ListedVelocities, FileVelocities>;

/// A kind of disks: one [[disks]] table.
struct Species {
  std::string name = {};
  std::int64_t count = 0;           ///< number of disks
  double radius = 0.0;              ///< length, > 0; of every disk, where `radii` is empty
  double mass = 0.0;                ///< > 0; of every disk, where `masses` is empty
  std::vector<double> radii = {};   ///< one per disk where they differ; else empty
  std::vector<double> masses = {};  ///< one per disk where they differ; else empty
  Positions positions = {};
  Velocities velocities = {};
  bool radii_are_drawn = false;  ///< whether the reader drew `radii` by a law, so that another seed gives others

  /// Returns radius and mass of disk i of this species, 0 <= i < count.
  [[nodiscard]] double radius_of(std::int64_t i) const { return radii.empty() ? radius : radii[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double mass_of(std::int64_t i) const { return masses.empty() ? mass : masses[static_cast<std::size_t>(i)]; }
};

/// Bounds of a SampleLog: the least ratio of one time in a block to the one before it, and the largest ratio of the length of a
/// block to its shortest time. Beyond these, times in double precision cannot be told apart.
inline constexpr double least_log_base = 1.01, most_log_ratio = 1e12;

/// Samples in blocks of equal length: at the beginning of each, and at block / base^(per_block - 1), ..., block / base^2,
/// block / base after it. Few samples then cover both short and long times.
struct SampleLog {
  double base = 0.0;           ///< ratio of successive times, >= least_log_base; base^(per_block - 1) <= most_log_ratio
  std::int64_t per_block = 0;  ///< number of samples in a block, >= 2
  double block = 0.0;          ///< length of a block: time, > 0
};

/// How long a scene runs and what it samples: the [run] table. At least one of `time` and `collisions` is present.
struct Run {
  struct Equilibrate {                               ///< the run before the measured one
    std::optional<double> collisions_per_disk = {};  ///< exactly one of the two is present
    std::optional<double> time = {};
    /// Returns the number of pair collisions at which it ends with so many disks; none where it ends at a time, and where there
    /// are more than 2^63.
    [[nodiscard]] std::optional<std::uint64_t> pair_collisions(std::int64_t disks) const;
  };
  std::optional<double> time = {};               ///< end of the measured run
  std::optional<std::uint64_t> collisions = {};  ///< number of pair collisions at which it ends
  // At most one of these three is present. Without them there are no samples.
  std::optional<double> sample_every = {};                    ///< time, > 0
  std::optional<std::uint64_t> sample_every_collisions = {};  ///< number of pair collisions, > 0
  std::optional<SampleLog> sample_log = {};
  std::optional<Equilibrate> equilibrate = {};
  std::uint64_t seed = 1;       ///< seed of all random numbers
  bool keep_momentum = false;   ///< whether drawn velocities stay as drawn; else their momentum and temperature are adjusted
  bool accept_overlap = false;  ///< whether disks that are given one by one may overlap each other, however deeply

  [[nodiscard]] bool is_sampled() const { return sample_every || sample_every_collisions || sample_log; }
  void take_no_samples() {
    sample_every.reset();
    sample_every_collisions.reset();
    sample_log.reset();
  }
};

/// The files that a run writes: the [output] table.
struct Output {
  bool trajectory = true;  ///< trajectory.h5md
  bool xyz = false;        ///< trajectory.xyz
  bool csv = false;        ///< samples.csv
  bool events = false;     ///< all collisions, in trajectory.h5md
  bool unwrapped = false;  ///< positions continue past periodic edges
};

/// An observable that the scene asks for: one key of the [observe] table. docs/scene-format.md says which settings an observable
/// has; these are present, except `every`, which follows from the mean free time where it is absent.
struct ObservableRequest {
  std::string name = {};                                  ///< "radial_distribution"
  std::optional<double> every = {};                       ///< time between samples, > 0
  std::optional<std::int64_t> bins = {};                  ///< number of bins of its histogram, >= 2
  std::optional<double> range = {};                       ///< upper end of the histogram, > 0; in mean diameters for distances
  std::optional<double> largest = {};                     ///< largest wave number, > 0; in inverse mean diameters
  std::optional<int> axis = {};                           ///< 0 or 1, or in a circular box 2: the radius
  std::optional<std::int64_t> disks = {};                 ///< how many disks of each species it follows, >= 1
  std::optional<std::array<std::int64_t, 2>> cells = {};  ///< numbers of cells along x and y, >= 1
  /// Several wave numbers in place of `largest`, at most 32, each > 0; in inverse mean diameters. Empty: `largest` holds.
  std::vector<double> wave_numbers = {};
};

/// All that is to be simulated.
struct Scene {
  std::string title = {};
  Box box = {};
  std::vector<Species> species = {};
  Effects effects = {};
  Run run = {};
  Output output = {};
  std::vector<ObservableRequest> observe = {};  ///< in the order of docs/scene-format.md
  /// What changes during the measured run, in order of time: effects and the scale of velocities, no disk.
  std::vector<Change> changes = {};

  std::string source = {};                  ///< the file's path, or the name given to parse_scene
  std::string text = {};                    ///< the TOML text as it was read, before overrides
  std::vector<std::string> overrides = {};  ///< "run.time=2", in the order in which they were applied

  /// Returns the number of disks of all species.
  [[nodiscard]] std::int64_t disk_count() const;
  /// Returns the sum of pi r^2 of all disks over the area of the box.
  [[nodiscard]] double packing_fraction() const;
};

/// Checks that a scene is valid: that every number is finite and in its range, that lists have one entry per disk, that disks fit
/// in the box and listed ones do not overlap, that effects can act together and in this box, that the run can end, and that the
/// observables have a meaning. Throws SceneError with the sentence, without its place, by which load_scene() refuses a file of
/// the same content. load_scene(), parse_scene(), make_simulation() and restore_simulation() call it.
///
/// A program may leave out what only files need: names of species, and the end of a run that it advances by run_until(). Whether
/// lattices and random positions have room for the disks is checked where they are placed.
void check(const Scene& scene);

/// One value for each disk of a scene, in the order of its species; absent values stay the scene's own.
struct DiskArrays {
  std::vector<Eigen::Vector2d> positions = {};   ///< length; required
  std::vector<Eigen::Vector2d> velocities = {};  ///< length / time; absent where empty
  std::vector<double> radii = {};                ///< length, > 0; absent where empty
  std::vector<double> masses = {};               ///< mass, > 0; absent where empty
};

/// Returns the scene with its disks at these places. A scene of one species takes any number of disks; with several species their
/// counts stay, and the arrays are divided among them. `text` of what is returned is its resolved_toml(). Throws SceneError where
/// arrays have other lengths than the positions, or as check(), which it calls.
Scene with_disks(Scene scene, const DiskArrays& disks);

/// Reads, completes and checks a scene file. Each override is "dotted.key=value" with a value in TOML syntax (a bare word stands
/// for a string); "disks.0.radius" is the radius of the first species. Throws SceneError for anything that the scene format does
/// not allow, and where the file cannot be read.
Scene load_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// Reads, completes and checks a scene in TOML text, as load_scene() does. `source` names the text in messages; start files are
/// searched in `directory`. Throws SceneError.
Scene parse_scene(const std::string& text, const std::string& source = "scene", const std::vector<std::string>& overrides = {},
                  const std::string& directory = ".");

/// Returns the scene as TOML with every default filled in. parse_scene() of the result gives the same scene.
std::string resolved_toml(const Scene& scene);

}  // namespace carom
