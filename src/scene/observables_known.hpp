#pragma once
// The words of the [observe] table: which observables there are, and which settings each has.

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom::detail {

/// A setting that an observable has carries its default; one that it has not is absent.
struct KnownObservable {
  std::string_view name;
  std::string_view example;  ///< example of the key
  double step = 0.0;         ///< default step in mean free times; 0: the observable has no samples
  std::optional<std::int64_t> bins = {};
  std::optional<double> range = {};
  std::optional<double> largest = {};
  std::string_view range_key = "range";      ///< what a scene calls ObservableRequest::range
  std::string_view largest_key = "largest";  ///< and ObservableRequest::largest
  bool takes_list = false;                   ///< whether ObservableRequest::wave_numbers may be in its place
  std::optional<int> axis = {};
  std::optional<std::int64_t> disks = {};
  std::optional<std::array<std::int64_t, 2>> cells = {};
};

/// What ObservableRequest::axis may be, and its words: along x or y, or from the centre of a circular box.
inline constexpr int radial_axis = 2;
inline constexpr std::array<std::string_view, 3> axis_words = {"x", "y", "radius"};

/// All observables, in the order of docs/scene-format.md, which is that of all results.
inline constexpr std::array<KnownObservable, 25> known_observables = {{
    {.name = "temperature", .example = "temperature = true", .step = 4.0},
    {.name = "pressure", .example = "pressure = true", .step = 16.0},
    {.name = "collision_rate", .example = "collision_rate = true", .step = 16.0},
    {.name = "contact_values", .example = "contact_values = true", .step = 16.0},
    {.name = "free_flight", .example = "free_flight = { bins = 100 }", .bins = 100},
    {.name = "speeds", .example = "speeds = { bins = 100 }", .step = 4.0, .bins = 100},
    {.name = "velocity_moments", .example = "velocity_moments = true", .step = 4.0},
    {.name = "radial_distribution",
     .example = "radial_distribution = { range = 5.0, bins = 250 }",
     .step = 16.0,
     .bins = 250,
     .range = 5.0},
    {.name = "structure_factor", .example = "structure_factor = { largest = 20.0 }", .step = 32.0, .largest = 20.0},
    {.name = "hexatic", .example = "hexatic = { range = 10.0, bins = 100 }", .step = 16.0, .bins = 100, .range = 10.0},
    {.name = "voronoi", .example = "voronoi = { bins = 100 }", .step = 16.0, .bins = 100},
    {.name = "clusters", .example = "clusters = { gap = 0.1 }", .step = 16.0, .range = 0.1, .range_key = "gap"},
    {.name = "density_profile", .example = "density_profile = { axis = \"y\", bins = 100 }", .step = 4.0, .bins = 100, .axis = 1},
    {.name = "fields", .example = "fields = { cells = [10, 10] }", .step = 1.0, .cells = {{10, 10}}},
    {.name = "mean_square_displacement", .example = "mean_square_displacement = { disks = 1000 }", .step = 0.25, .disks = 1000},
    {.name = "intermediate_scattering",
     .example = "intermediate_scattering = { k = 6.3, disks = 1000 }",
     .step = 0.5,
     .largest = 6.3,
     .largest_key = "k",
     .takes_list = true,
     .disks = 1000},
    {.name = "overlap", .example = "overlap = { range = 0.3, disks = 1000 }", .step = 0.5, .range = 0.3, .disks = 1000},
    {.name = "non_gaussian", .example = "non_gaussian = { disks = 1000 }", .step = 0.5, .disks = 1000},
    {.name = "van_hove",
     .example = "van_hove = { range = 5.0, bins = 100, disks = 1000 }",
     .step = 0.5,
     .bins = 100,
     .range = 5.0,
     .disks = 1000},
    {.name = "velocity_autocorrelation", .example = "velocity_autocorrelation = { disks = 1000 }", .step = 0.25, .disks = 1000},
    {.name = "viscosity", .example = "viscosity = true", .step = 0.25},
    {.name = "heat_conductivity", .example = "heat_conductivity = true", .step = 0.25},
    {.name = "h_function", .example = "h_function = true", .step = 0.25},
    {.name = "wall_fluxes", .example = "wall_fluxes = true", .step = 16.0},
    {.name = "work", .example = "work = true", .step = 1.0},
}};

/// Null where there is no observable of that name.
constexpr const KnownObservable* find_observable(std::string_view name) {
  for (const KnownObservable& known : known_observables)
    if (known.name == name) return &known;
  return nullptr;
}

inline std::vector<std::string_view> names_of_observables() {
  std::vector<std::string_view> names;
  for (const KnownObservable& known : known_observables) names.push_back(known.name);
  return names;
}

/// The most numbers that ObservableRequest::wave_numbers may have.
inline constexpr std::size_t most_wave_numbers = 32;

/// Returns what a list of wave numbers may be.
inline std::string expected_wave_numbers() {
  return fmt::format("a finite number above zero, or a list of 1 to {} of them, such as k = 6.3 or k = [1.0, 3.5, 6.3]",
                     most_wave_numbers);
}

/// Returns an example of a setting: "range = 5.0".
inline std::string example_of(std::string_view setting, double otherwise) {
  return fmt::format("{} = {:.1f}", setting, otherwise);
}

}  // namespace carom::detail
