#pragma once
// The numbers of the scene format: the range of each by itself, and an example. The reader of files and the checks of a Scene use
// the same entries, so that both refuse the same numbers in the same words.

#include <carom/scene.hpp>

#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace carom::detail {

/// The range of a number. Every number must be finite as well.
enum class Range { any, zero_or_more, above_zero, within };

struct NumberKey {
  std::string_view name;     ///< name of the key in its table: "restitution"
  std::string_view example;  ///< example of the key: "restitution = 0.9"
  Range range = Range::any;
  double least = 0.0, most = 0.0;  ///< limits of Range::within, both included

  [[nodiscard]] bool holds(double value) const;
  /// Returns text such as "a finite number above zero, such as mass = 1.0"
  [[nodiscard]] std::string expected() const;
};

/// Throws Refusal for a number at `path` that is out of its range.
[[noreturn]] void refuse_number(const std::string& path, double value, const NumberKey& key);

/// Throws Refusal where a number of `table` is out of the range of its key; one that is absent is in range.
void require(const std::string& table, const std::optional<double>& value, const NumberKey& key);
/// Throws Refusal where a component of the pair at `path` is not finite.
void require_pair(const std::string& path, const Eigen::Vector2d& pair, std::string_view example);

namespace keys {

inline constexpr std::string_view limits_example[] = {"x = [-1.0, 1.0]", "y = [-1.0, 1.0]"};
inline constexpr std::string_view circle_example = "{ centre = [0.0, 0.0], radius = 1.0 }";
inline constexpr NumberKey circle_radius{"radius", circle_example, Range::above_zero};
inline constexpr std::string_view count_example = "count = 64";
inline constexpr NumberKey aspect{"aspect", "aspect = 1.0", Range::above_zero};

inline constexpr NumberKey radius{"radius", "radius = 0.03", Range::above_zero};
inline constexpr std::string_view lognormal_example = "radius = { lognormal = { mean = 0.5, deviation = 0.05 } }";
inline constexpr NumberKey radius_mean{"mean", lognormal_example, Range::above_zero};
inline constexpr NumberKey radius_deviation{"deviation", lognormal_example, Range::zero_or_more};
inline constexpr std::string_view uniform_radii_example = "radius = { uniform = [0.4, 0.6] }";
inline constexpr NumberKey radius_limit{"uniform", uniform_radii_example, Range::above_zero};
inline constexpr NumberKey mass{"mass", "mass = 1.0", Range::above_zero};
inline constexpr NumberKey mass_per_area{"per_area", "mass = { per_area = 1.0 }", Range::above_zero};
inline constexpr NumberKey packing_fraction{"packing_fraction", "packing_fraction = 0.5", Range::above_zero};
inline constexpr NumberKey grown_fraction{"packing_fraction", "{ packing_fraction = 0.7 }", Range::above_zero};
inline constexpr std::string_view position_example = "[0.5, 0.5]", velocity_example = "[1.0, 0.0]";
inline constexpr std::string_view rectangle_example = "{ random = { x = [-1.0, 0.0], y = [-1.0, 1.0] } }";
inline constexpr std::string_view region_circle_example = "{ random = { centre = [0.0, 0.0], radius = 0.5 } }";
inline constexpr NumberKey region_radius{"radius", region_circle_example, Range::above_zero};
inline constexpr NumberKey uniform{"uniform", "{ uniform = 1.0 }", Range::zero_or_more};
inline constexpr NumberKey start_temperature{"temperature", "{ temperature = 1.0 }", Range::zero_or_more};
inline constexpr NumberKey speed{"speed", "{ speed = 1.0 }", Range::zero_or_more};

inline constexpr NumberKey restitution{"restitution", "restitution = 0.9", Range::within, 0.0, 1.0};
inline constexpr NumberKey roughness{"roughness", "roughness = 0.5", Range::within, -1.0, 1.0};
inline constexpr NumberKey elastic_below{"time", "{ time = 1e-6 }", Range::zero_or_more};

inline constexpr NumberKey delta{"delta", "delta = -0.2"};

inline constexpr std::string_view acceleration_example = "acceleration = [0.0, -1.0]";

inline constexpr NumberKey wall_restitution{"restitution", "{ restitution = 0.8 }", Range::within, 0.0, 1.0};
inline constexpr NumberKey wall_temperature{"temperature", "{ temperature = 2.0 }", Range::above_zero};
inline constexpr NumberKey wall_velocity{"velocity", "{ velocity = -0.1 }"};
inline constexpr NumberKey tangential_velocity{"tangential_velocity", "{ temperature = 1.0, tangential_velocity = 0.5 }"};
inline constexpr NumberKey vibration{"vibration", "{ vibration = 0.5 }", Range::zero_or_more};
inline constexpr std::string_view oscillation_example = R"({ form = "sine", amplitude = 0.1, frequency = 2.0 })";
inline constexpr NumberKey oscillation_amplitude{"amplitude", oscillation_example, Range::zero_or_more};
inline constexpr NumberKey oscillation_frequency{"frequency", oscillation_example, Range::zero_or_more};
inline constexpr NumberKey oscillation_phase{"phase", "phase = 0.25", Range::within, 0.0, 1.0};
inline constexpr NumberKey piston_mass{"mass", "{ mass = 10.0, load = 5.0 }", Range::above_zero};
inline constexpr NumberKey piston_load{"load", "{ mass = 10.0, load = 5.0 }", Range::zero_or_more};

inline constexpr std::string_view disk_example = "{ centre = [0.0, 0.0], radius = 0.3 }";
inline constexpr std::string_view segment_example = "{ from = [0.0, -1.0], to = [0.0, -0.1] }";
inline constexpr NumberKey obstacle_radius{"radius", disk_example, Range::above_zero};
inline constexpr std::string_view arc_example = "{ centre = [0.0, 0.0], radius = 0.5, from = 0, to = 180 }";
inline constexpr NumberKey arc_radius{"radius", arc_example, Range::above_zero};
inline constexpr NumberKey arc_from{"from", arc_example};
inline constexpr NumberKey arc_to{"to", arc_example};

inline constexpr NumberKey growth_rate{"rate", "rate = 0.01", Range::zero_or_more};
inline constexpr NumberKey until_fraction{"packing_fraction", "{ packing_fraction = 0.84 }", Range::above_zero};
inline constexpr NumberKey until_pressure{"pressure", "{ pressure = 1e6 }", Range::above_zero};

inline constexpr NumberKey bath_temperature{"temperature", "temperature = 1.0", Range::above_zero};
inline constexpr NumberKey bath_rate{"rate", "rate = 0.1", Range::zero_or_more};

inline constexpr NumberKey shear_rate{"rate", "rate = 0.05"};

inline constexpr NumberKey well_width{"width", "width = 1.5", Range::above_zero};
inline constexpr NumberKey well_depth{"depth", "depth = 1.0"};

inline constexpr std::string_view steps_example = "steps = [{ width = 1.2, energy = 1.0 }, { width = 1.6, energy = -0.5 }]";
inline constexpr NumberKey step_width{"width", "{ width = 1.2, energy = 1.0 }", Range::above_zero};
inline constexpr NumberKey step_energy{"energy", "{ width = 1.2, energy = 1.0 }"};

inline constexpr NumberKey run_time{"time", "time = 5.0", Range::zero_or_more};
inline constexpr NumberKey sample_every{"sample_every", "sample_every = 0.001", Range::above_zero};
inline constexpr std::string_view counted_example = "sample_every = { collisions = 1000 }";
inline constexpr std::string_view log_example = "sample_log = { base = 1.3, per_block = 50 }";
inline constexpr NumberKey log_base{"base", log_example, Range::within, least_log_base, most_log_ratio};
inline constexpr NumberKey log_block{"block", "block = 100.0", Range::above_zero};
inline constexpr NumberKey equilibrate_collisions{"collisions_per_disk", "{ collisions_per_disk = 50 }", Range::zero_or_more};
inline constexpr NumberKey equilibrate_time{"time", "{ time = 2.0 }", Range::zero_or_more};

inline constexpr NumberKey observe_every{"every", "every = 0.05", Range::above_zero};

}  // namespace keys

}  // namespace carom::detail
