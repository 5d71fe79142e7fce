#pragma once
// The effects that a scene may call for beyond straight flight between hard walls: plain data, one struct per table of the scene
// format. What is absent is not simulated. Every effect has a neutral value, at which it leaves the same bits as without it.

#include <carom/box.hpp>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace carom {

/// Where the user said something: a file with line and column (both from 1), or a command-line override (line 0).
struct Location {
  std::string source;
  int line = 0;
  int column = 0;
};

enum class CollisionRule { reversal, specular };

/// What contact of two disks does to them: the [collision] table.
struct Collision {
  CollisionRule rule = CollisionRule::specular;
  std::optional<double> restitution;    ///< e in [0, 1]; neutral: 1
  std::optional<double> roughness;      ///< beta in [-1, 1], turns spin on; neutral: -1 (smooth)
  std::optional<double> elastic_below;  ///< time >= 0 (TC model); neutral: 0
};

/// Uniform acceleration of all disks: the [gravity] table. Zero along periodic axes.
struct Gravity {
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();  ///< length / time^2; neutral: zero
  Location where;
};

/// One side of the box, one key of the [walls] table. Nothing set: a hard wall at rest.
struct WallProperties {
  std::optional<double> restitution;  ///< e in [0, 1]; neutral: 1
  std::optional<double> temperature;  ///< kT > 0 of a diffuse wall; there is no neutral value, and no restitution beside it
  std::optional<double> velocity;     ///< constant, along +x or +y whichever side it is; neutral: 0
  std::optional<double> mass;         ///< > 0: a piston, free to move across its axis
  std::optional<double> load;         ///< >= 0, inward force per unit length on the piston; present if mass is
  Location where;

  [[nodiscard]] bool present() const { return restitution || temperature || velocity || mass; }
};

/// A fixed disk.
struct DiskObstacle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;  ///< length, > 0
};
/// A fixed straight line, hard from both sides; its ends are corners of radius 0.
struct SegmentObstacle {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
};
/// One [[obstacles]] table.
struct Obstacle {
  std::variant<DiskObstacle, SegmentObstacle> shape;
  Location where;
};

/// All radii grow as radius (1 + rate t), t from the start of the measured run (Lubachevsky-Stillinger): the [growth] table.
struct Growth {
  double rate = 0.0;                       ///< 1 / time, >= 0; neutral: 0
  std::optional<double> packing_fraction;  ///< at which the run ends
  std::optional<double> reduced_pressure;  ///< (4 eta / pi) Z at which the run ends
  Location where;
};

/// Andersen: each disk's velocity is redrawn from the Maxwell distribution at this rate: the [thermostat] table.
struct Thermostat {
  double temperature = 0.0;  ///< kT > 0
  double rate = 0.0;         ///< 1 / time per disk, >= 0; neutral: 0
  Location where;
};

/// Lees-Edwards boundaries: the flow is v_x = rate y: the [shear] table.
struct Shear {
  double rate = 0.0;  ///< 1 / time; neutral: 0
  Location where;
};

/// A square well (depth > 0) or shoulder (depth < 0) round every disk: the [square_well] table.
struct SquareWell {
  double width = 0.0;  ///< outer diameter over hard diameter, > 1
  double depth = 0.0;  ///< energy; neutral: 0
  Location where;
};

struct Effects {
  Collision collision;
  std::optional<Gravity> gravity;
  std::array<WallProperties, 4> walls;  ///< left, right, bottom, top
  std::vector<Obstacle> obstacles;
  std::optional<Growth> growth;
  std::optional<Thermostat> thermostat;
  std::optional<Shear> shear;
  std::optional<SquareWell> square_well;

  /// Whether nothing is there but the collision rule and hard walls at rest: every other effect is absent or at its neutral
  /// value.
  [[nodiscard]] bool neutral() const { return acting().empty(); }
  /// The others: what is there at another value than its neutral one, in the words of names_of().
  [[nodiscard]] std::vector<std::string> acting() const;
  /// Whether any contact takes energy away, so that time may come to a stand (inelastic collapse).
  [[nodiscard]] bool dissipate() const;
};

/// Whether the total momentum along an axis stays what it was: the axis is periodic, and nothing beside the other disks (a
/// thermostat, an obstacle, a thermal wall) pushes a disk.
[[nodiscard]] bool keeps_momentum(const Box& box, const Effects& effects, int axis);

/// What acts, in the words of the scene format, in its order: "specular", "walls" (where an axis has them), "restitution", ...
/// Whatever the scene names acts, at its neutral value too.
[[nodiscard]] std::vector<std::string> names_of(const Effects& effects, bool walled);

/// The same without the rule and hard walls, joined by commas: what is there beyond them. Empty where nothing is named.
[[nodiscard]] std::string words_beyond_the_rule(const Effects& effects);

}  // namespace carom
