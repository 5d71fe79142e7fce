#pragma once
// The effects that a scene may have beyond free flight between hard walls at rest: plain data, one struct per table of the scene
// format. An effect that is absent is not simulated. Every effect has a neutral value, at which the run has the same bits as
// without the effect.

#include <carom/box.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace carom {

/// The part of the relative velocity that a collision of two disks reverses: all of it, or its component along the line of
/// centres.
enum class CollisionRule { reversal, specular };

/// The collision of two disks: the [collision] table.
struct Collision {
  CollisionRule rule = CollisionRule::specular;
  std::optional<double> restitution = {};    ///< e in [0, 1]; neutral: 1
  std::optional<double> roughness = {};      ///< beta in [-1, 1]; present: disks have spin; neutral: -1 (smooth)
  std::optional<double> elastic_below = {};  ///< contact time of the TC model, >= 0; neutral: 0
};

/// Gravity, a uniform acceleration of all disks: the [gravity] table. It is zero along periodic axes, unless a thermal wall or a
/// thermostat takes the momentum and the heat that the disks gain.
struct Gravity {
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();  ///< length / time^2; neutral: zero
};

/// How a wall moves within a period: inward as the sine of time, or inward at constant velocity and back at once.
enum class WaveForm { sine, sawtooth };

/// The motion of a wall that vibrates with an amplitude: the table `vibration` of a wall. At the start of the run, or of the
/// change that sets it, the wall is where it was before, `phase` into a period.
struct Oscillation {
  WaveForm form = WaveForm::sine;
  double amplitude = 0.0;  ///< half of the way between the outermost and the innermost position; length, >= 0; neutral: 0
  double frequency = 0.0;  ///< periods in a unit of time, >= 0; neutral: 0
  /// Part of a period in [0, 1]. A sine begins it in the middle, at its fastest inward; a sawtooth at its outermost position.
  double phase = 0.0;

  /// Returns whether the wall moves at all.
  [[nodiscard]] bool moves() const { return amplitude > 0.0 && frequency > 0.0; }
  [[nodiscard]] bool operator==(const Oscillation& other) const = default;
};

/// The properties of one wall: one key of the [walls] table. Without any of them it is a hard wall at rest.
struct WallProperties {
  std::optional<double> restitution = {};  ///< e in [0, 1]; neutral: 1
  std::optional<double> temperature = {};  ///< kT > 0 of a thermal wall; it has no neutral value and excludes `restitution`
  std::optional<double> velocity = {};     ///< constant velocity along +x or +y, whichever side it is; neutral: 0
  std::optional<double> mass = {};         ///< mass > 0 of a piston, a wall that moves freely along its normal
  std::optional<double> load = {};         ///< inward force per unit length on the piston, >= 0; present if `mass` is
  /// Velocity of the surface of a thermal wall along itself, towards +x or +y; present only if `temperature` is; neutral: 0
  std::optional<double> tangential_velocity = {};
  /// Speed >= 0 of a wall that vibrates infinitely fast with no amplitude: disks are hit as if it moved inward at this speed, and
  /// it stays where it is. Excludes `temperature`, `velocity` and `mass`; neutral: 0
  std::optional<double> vibration = {};
  /// Vibration with an amplitude. Excludes `vibration`, `temperature`, `velocity` and `mass`
  std::optional<Oscillation> oscillation = {};

  /// Returns whether the scene names any property of this wall.
  [[nodiscard]] bool present() const {
    return restitution || temperature || velocity || tangential_velocity || vibration || oscillation || mass;
  }
};

/// A fixed disk.
struct DiskObstacle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;  ///< length, > 0
};
/// A fixed straight segment, hard on both sides; its ends are points.
struct SegmentObstacle {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
};
/// A fixed circular arc, hard on both sides; its ends are points. It runs counterclockwise from the direction `from` to the
/// direction `to` as seen from its centre.
struct ArcObstacle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;  ///< length, > 0
  double from = 0.0;    ///< degrees; 0 is along +x, 90 along +y
  double to = 0.0;      ///< degrees, above `from` by 360 at most: then it is a full circle, without ends
};
/// A fixed obstacle: one [[obstacles]] table.
using Obstacle = std::variant<DiskObstacle, SegmentObstacle, ArcObstacle>;

/// A circle that holds the disks: box.circle.
struct Circle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;  ///< length, > 0
};

/// Growth of all radii as radius (1 + rate t), t from the start of the measured run (Lubachevsky-Stillinger): the [growth] table.
struct Growth {
  double rate = 0.0;                            ///< 1 / time, >= 0; neutral: 0
  std::optional<double> packing_fraction = {};  ///< packing fraction at which the run ends
  std::optional<double> reduced_pressure = {};  ///< reduced pressure (4 eta / pi) Z at which the run ends
};

/// The Andersen thermostat, which redraws the velocity of each disk from the Maxwell distribution: the [thermostat] table.
struct Thermostat {
  double temperature = 0.0;  ///< kT > 0
  double rate = 0.0;         ///< mean number of redraws per disk and time, >= 0; neutral: 0
};

/// Run-and-tumble motion, which redraws the direction of the velocity of each disk at random times and leaves its speed: the
/// [tumbling] table.
struct Tumbling {
  double rate = 0.0;  ///< mean number of tumbles per disk and time, >= 0; neutral: 0
};

/// Brownian motion, which redraws the velocities of all disks at once from the Maxwell distribution, `rate` times in a unit of
/// time and at equal steps (Scala, Voigtmann & De Michele 2007): the [brownian] table.
struct Brownian {
  double temperature = 0.0;  ///< kT > 0
  double rate = 0.0;         ///< 1 / time, >= 0; neutral: 0
};

/// Lees-Edwards boundaries with the flow v_x = rate y: the [shear] table.
struct Shear {
  double rate = 0.0;  ///< 1 / time; neutral: 0
};

/// A square well (depth > 0) or shoulder (depth < 0) round every disk: the [square_well] table.
struct SquareWell {
  double width = 0.0;  ///< outer over hard diameter, > 1
  double depth = 0.0;  ///< energy; neutral: 0
};

/// One step of a stepped pair potential.
struct PotentialStep {
  double width = 0.0;   ///< outer over hard diameter, > 1
  double energy = 0.0;  ///< potential energy of a pair nearer than that, and not within a narrower step; energy
};

/// A stepped pair potential round the hard core of every disk: the [stepped_potential] table. It is neutral where the energies of
/// all steps are 0.
struct SteppedPotential {
  std::vector<PotentialStep> steps = {};  ///< at least one; their widths rise
};

/// Every velocity decays as dv/dt = -rate v: the [drag] table.
struct Drag {
  double rate = 0.0;  ///< 1 / time, >= 0; neutral: 0
};

/// Non-additive diameters: disks of two different species touch at (1 + delta) times the sum of their radii, disks of one species
/// at twice their radius. The [non_additivity] table.
struct NonAdditivity {
  /// The delta of two species, in the place of that of all.
  struct Pair {
    std::array<std::int64_t, 2> species = {};  ///< indices into Scene::species, different from each other
    double delta = 0.0;                        ///< > -1

    bool operator==(const Pair&) const = default;
  };
  double delta = 0.0;            ///< > -1, of all pairs of different species that `pairs` does not name; neutral: 0
  std::vector<Pair> pairs = {};  ///< each pair of species once at most

  /// Returns the delta of two species; 0 where they are the same.
  [[nodiscard]] double between(std::int64_t one, std::int64_t other) const;
};

/// All effects of a scene.
struct Effects {
  Collision collision = {};
  std::optional<Gravity> gravity = {};
  std::array<WallProperties, 4> walls = {};  ///< left, right, bottom, top
  std::vector<Obstacle> obstacles = {};
  std::optional<Circle> circle = {};  ///< present where Box::is_circle: put_in_circle() sets both
  std::optional<Growth> growth = {};
  std::optional<Thermostat> thermostat = {};
  std::optional<Tumbling> tumbling = {};
  std::optional<Brownian> brownian = {};
  std::optional<Shear> shear = {};
  std::optional<SquareWell> square_well = {};
  std::optional<SteppedPotential> stepped_potential = {};
  std::optional<Drag> drag = {};
  std::optional<NonAdditivity> non_additivity = {};

  /// Returns whether nothing acts but the collision rule and hard walls at rest: every other effect is absent or at its neutral
  /// value.
  [[nodiscard]] bool neutral() const { return acting().empty(); }
  /// Returns the names, as by names_of(), of all effects that are not at their neutral value.
  [[nodiscard]] std::vector<std::string> acting() const;
  /// Returns whether any contact dissipates energy, so that inelastic collapse is possible.
  [[nodiscard]] bool dissipate() const;

  // Numbers of single effects; neutral where the scene does not name the effect.

  /// Returns the acceleration of all disks in flight; length / time^2, zero without gravity.
  [[nodiscard]] Eigen::Vector2d acceleration() const;
  /// Returns the rate at which all radii grow, in units of the first radii; 1 / time, 0 where disks keep their size.
  [[nodiscard]] double growth_rate() const;
  /// Returns the rate of the flow v_x = rate y; 1 / time, 0 without a flow.
  [[nodiscard]] double shear_rate() const;
  /// Returns kT of the bath that redraws velocities, of single disks or of all; empty without a bath.
  [[nodiscard]] std::optional<double> bath_temperature() const;
  /// Returns the steps of the pair potential beyond the hard core, of [stepped_potential] or [square_well], the innermost first.
  /// Neighbouring steps of one energy are one step, and the last has another energy than 0. Empty where disks are but hard.
  [[nodiscard]] std::vector<PotentialStep> potential_steps() const;
  /// Returns the rate at which all velocities decay; 1 / time, 0 without drag.
  [[nodiscard]] double drag_rate() const;
};

/// Encloses the disks in a circle in the place of walls: sets the box to the square round it, and the effect.
void put_in_circle(Box& box, Effects& effects, const Circle& circle);

/// Returns whether the total momentum along `axis` is conserved: the axis is periodic, and no effect acts that changes the
/// momentum of the disks (a thermostat, tumbles, obstacles, thermal walls, drag, shear, growth, or gravity along this axis).
[[nodiscard]] bool conserves_momentum(const Box& box, const Effects& effects, int axis);

/// Returns whether motion of the centre of mass along `axis` is heat, a part of the temperature: the axis has walls, or
/// obstacles, a thermostat or thermal walls exchange momentum with the disks at random. Where it is none, N disks have N - 1
/// degrees of freedom along the axis. Drag, growth and shear change momentum without making it heat.
[[nodiscard]] bool centre_of_mass_is_thermal(const Box& box, const Effects& effects, int axis);

/// Returns the names of all effects in the words and order of the scene format: "specular", "walls" (where `walled`),
/// "restitution", ... Effects at their neutral value are included.
[[nodiscard]] std::vector<std::string> names_of(const Effects& effects, bool walled);

/// Returns names_of() without the collision rule and hard walls, joined by commas; empty where there are no others.
[[nodiscard]] std::string words_beyond_the_rule(const Effects& effects);

}  // namespace carom
