#pragma once
// The words of the [observe] table: which observables there are, and which settings each has.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace carom::detail {

/// A setting that an observable has carries its default; one that it has not is absent.
struct KnownObservable {
  std::string_view name;
  std::string_view example;  ///< what the key could look like
  std::optional<std::int64_t> bins = {};
  std::optional<double> range = {};
  std::optional<double> largest = {};
  std::optional<int> axis = {};
};

/// In the order of docs/scene-format.md, which is that of all results.
inline constexpr std::array<KnownObservable, 16> known_observables = {{
    {"temperature", "temperature = true"},
    {"pressure", "pressure = true"},
    {"collision_rate", "collision_rate = true"},
    {.name = "free_flight", .example = "free_flight = { bins = 100 }", .bins = 100},
    {.name = "speeds", .example = "speeds = { bins = 100 }", .bins = 100},
    {"velocity_moments", "velocity_moments = true"},
    {.name = "radial_distribution", .example = "radial_distribution = { range = 5.0, bins = 250 }", .bins = 250, .range = 5.0},
    {.name = "structure_factor", .example = "structure_factor = { largest = 20.0 }", .largest = 20.0},
    {.name = "hexatic", .example = "hexatic = { range = 10.0, bins = 100 }", .bins = 100, .range = 10.0},
    {.name = "density_profile", .example = "density_profile = { axis = \"y\", bins = 100 }", .bins = 100, .axis = 1},
    {"mean_square_displacement", "mean_square_displacement = true"},
    {"velocity_autocorrelation", "velocity_autocorrelation = true"},
    {"viscosity", "viscosity = true"},
    {"heat_conductivity", "heat_conductivity = true"},
    {"h_function", "h_function = true"},
    {"wall_fluxes", "wall_fluxes = true"},
}};

/// Null where there is no observable of that name.
constexpr const KnownObservable* find_observable(std::string_view name) {
  for (const KnownObservable& known : known_observables)
    if (known.name == name) return &known;
  return nullptr;
}

}  // namespace carom::detail
