// Checks of [observe]: which observables have no meaning in a scene, and why.

#include "scene/checks.hpp"
#include "scene/effect_traits.hpp"
#include "scene/known_keys.hpp"
#include "scene/number_keys.hpp"
#include "scene/observables_known.hpp"
#include "scene/wave_vectors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace carom::detail {
namespace {

[[noreturn]] void refuse_observable(const ObservableRequest& request, const std::string& why) {
  throw Refusal("observe." + request.name, fmt::format("observe.{} {}", request.name, why));
}

bool one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Green and Kubo's formulas are about smooth disks that keep their energy and momentum.
std::string_view what_spoils_transport(const Scene& scene) {
  const Effects& effects = scene.effects;
  if (!scene.box.periodic(0) || !scene.box.periodic(1)) return "walls take momentum; take boundary = \"periodic\"";
  if (effects.collision.rule == CollisionRule::reversal)
    return "the rule \"reversal\" does not keep angular momentum, and its gas has no viscosity in that sense; take rule = "
           "\"specular\"";
  return first_reason(effects, &EffectTraits::why_no_transport);
}

bool equal_masses(const Scene& scene) {
  double first = 0.0;
  for (const Species& species : scene.species) {
    for (std::int64_t i = 0; i < species.count; ++i) {
      if (first == 0.0) first = species.mass_of(i);
      if (species.mass_of(i) != first) return false;
      if (species.masses.empty()) break;
    }
  }
  return true;
}

bool all_disks_are_equal(const Scene& scene) {
  const std::vector<std::string> acting = scene.effects.acting();
  const bool are_additive = std::find(acting.begin(), acting.end(), "non_additivity") == acting.end();
  return equal_masses(scene) && radii_of(scene).equal() && are_additive;
}

void check_settings(const ObservableRequest& request, bool is_circle) {
  constexpr std::int64_t most_bins = 100'000;
  const std::string path = "observe." + request.name;
  const KnownObservable* known = find_observable(request.name);
  if (known == nullptr) throw Refusal(path, unknown_key_sentence(request.name, "observe", names_of_observables()));
  if (request.every && !keys::observe_every.holds(*request.every))
    refuse_number(path + ".every", *request.every, keys::observe_every);
  const auto require = [&](std::string_view setting, const std::optional<double>& value, double otherwise) {
    const std::string example = example_of(setting, otherwise);
    const NumberKey key{setting, example, Range::above_zero};
    if (value && !key.holds(*value)) refuse_number(fmt::format("{}.{}", path, setting), *value, key);
  };
  if (known->takes_list) {
    const std::string list = fmt::format("{}.{}", path, known->largest_key),
                      example = example_of(known->largest_key, *known->largest);
    const NumberKey key{known->largest_key, example, Range::above_zero};
    if (request.wave_numbers.size() > most_wave_numbers)
      throw Refusal(list,
                    fmt::format("{} is a list of {}; it must be {}", list, request.wave_numbers.size(), expected_wave_numbers()));
    for (std::size_t n = 0; n < request.wave_numbers.size(); ++n)
      if (!key.holds(request.wave_numbers[n])) refuse_number(fmt::format("{}.{}", list, n), request.wave_numbers[n], key);
  }
  require(known->range_key, request.range, known->range.value_or(1.0));
  require(known->largest_key, request.largest, known->largest.value_or(1.0));
  if (request.bins && !(*request.bins >= 2 && *request.bins <= most_bins))
    throw Refusal(path + ".bins", fmt::format("{}.bins is {}; it must be a whole number from 2 to {}, such as bins = {}", path,
                                              *request.bins, most_bins, known->bins.value_or(2)));
  constexpr std::int64_t most_cells = 10'000;
  if (request.cells) {
    const auto [nx, ny] = *request.cells;
    if (nx < 1 || ny < 1 || nx > most_cells || ny > most_cells || nx * ny > most_cells)
      throw Refusal(path + ".cells",
                    fmt::format("{}.cells is [{}, {}]; it must be two whole numbers from 1 on, of {} cells at most, "
                                "such as cells = [10, 10]",
                                path, nx, ny, most_cells));
  }
  if (request.disks && *request.disks < 1)
    throw Refusal(path + ".disks", fmt::format("{}.disks is {}; it follows one disk of each species at least, such as disks = {}",
                                               path, *request.disks, known->disks.value_or(1)));
  if (request.axis && *request.axis != 0 && *request.axis != 1 && !(is_circle && *request.axis == radial_axis))
    throw Refusal(path + ".axis", fmt::format("{}.axis is {}; it must be 0 or 1{}", path, *request.axis,
                                              is_circle ? ", or 2 for the radius" : ""));
}

void check_disks(const Scene& scene, const ObservableRequest& request) {
  const std::int64_t least = request.name == "hexatic" ? 7
                             : one_of(request.name, {"collision_rate", "contact_values", "free_flight", "radial_distribution",
                                                     "structure_factor", "viscosity", "heat_conductivity"})
                                 ? 2
                                 : 1;
  if (scene.disk_count() >= least) return;
  refuse_observable(request, fmt::format("needs at least {} disk{}, and the scene has {}; remove it, or add disks", least,
                                         least == 1 ? "" : "s", scene.disk_count()));
}

void check_collisions(const Scene& scene, const ObservableRequest& request) {
  if (!one_of(request.name, {"contact_values", "free_flight", "viscosity", "heat_conductivity"})) return;
  for (const EffectTraits& effect : all_effects())
    if (effect.changes_velocities_in_flight && effect.acts(scene.effects))
      refuse_observable(request, fmt::format("follows disks from collision to collision, and {} changes their velocities in "
                                             "between; remove one of the two",
                                             effect.title));
}

/// Clusters have a meaning between walls and for disks that grow, but are not found where images slide past each other.
void check_clusters(const Scene& scene, const ObservableRequest& request) {
  if (request.name != "clusters") return;
  if (const std::string_view why = first_reason(scene.effects, &EffectTraits::why_no_structure, &EffectTraits::changes_radii);
      !why.empty())
    refuse_observable(request, std::string(why));
  if (!request.range) return;
  const double diameter = mean_diameter(scene);
  for (int axis = 0; axis < 2; ++axis)
    if (scene.box.periodic(axis) && *request.range * diameter > scene.box.lengths()[axis])
      refuse_observable(request, fmt::format("has a gap of {:.6g} mean diameters, and the periodic box is {:.6g} of them long in "
                                             "{}, so that every disk would be near its own image; make the gap smaller",
                                             *request.range, scene.box.lengths()[axis] / diameter, axis_names[axis]));
}

/// Wave vectors are whole numbers of waves in the box. Columns have names by six digits of k, and no two have the same vectors.
void check_wave_numbers(const Scene& scene, const ObservableRequest& request) {
  if (request.name != "intermediate_scattering") return;
  std::vector<double> numbers = request.wave_numbers;
  if (numbers.empty() && request.largest) numbers.push_back(*request.largest);
  constexpr double most_waves = 1e6;
  const double diameter = mean_diameter(scene);
  const double largest = 2.0 * std::numbers::pi * most_waves * diameter / scene.box.lengths().maxCoeff();
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const double k = numbers[n];
    if (k > largest)
      refuse_observable(request,
                        fmt::format("has k = {:.6g}, more than a million waves in the box; take k up to {:.6g}", k, largest));
    const std::vector<Eigen::Vector2d> vectors = wave_vectors_near(k / diameter, scene.box.lengths());
    for (std::size_t before = 0; before < n; ++before) {
      const double other = numbers[before];
      const std::string path = fmt::format("observe.{}.k.{}", request.name, n);
      if (fmt::format("{:.6g}", k) == fmt::format("{:.6g}", other))
        throw Refusal(path, fmt::format("observe.{}.k has {:.6g} twice, in six digits; remove one", request.name, k));
      if (same_wave_vectors(vectors, wave_vectors_near(other / diameter, scene.box.lengths())))
        throw Refusal(path,
                      fmt::format("observe.{}.k has {:.6g} and {:.6g}, which have the same wave vectors in this box; remove "
                                  "one",
                                  request.name, other, k));
    }
  }
}

void check_structure(const Scene& scene, const ObservableRequest& request) {
  if (!one_of(request.name, {"contact_values", "radial_distribution", "structure_factor", "hexatic", "intermediate_scattering"}))
    return;
  if (!scene.box.periodic(0) || !scene.box.periodic(1))
    refuse_observable(request,
                      "is that of a uniform system, and walls disturb it; take boundary = \"periodic\", or observe "
                      "density_profile");
  if (const std::string_view why = first_reason(scene.effects, &EffectTraits::why_no_structure); !why.empty())
    refuse_observable(request, std::string(why));
  if (!request.range) return;
  const double diameter = mean_diameter(scene);
  const double half = 0.5 * scene.box.lengths().minCoeff() / diameter;
  if (*request.range > half * (1.0 + touching))
    refuse_observable(request, fmt::format("reaches {:.6g} mean diameters, but half of the box is {:.6g}; make range smaller, or "
                                           "the box larger",
                                           *request.range, half));
}

}  // namespace

void check_observe(const Scene& scene) {
  for (const ObservableRequest& request : scene.observe) {
    check_settings(request, scene.box.is_circle);
    check_disks(scene, request);
    check_collisions(scene, request);
    check_structure(scene, request);
    check_clusters(scene, request);
    check_wave_numbers(scene, request);
    if (request.every) check_step(scene, fmt::format("observe.{}.every", request.name), *request.every);
    if (request.name == "wall_fluxes" && scene.box.periodic(0) && scene.box.periodic(1))
      refuse_observable(request, "measures fluxes through walls, and this box is periodic; remove it, or give an axis walls");
    if (const std::string_view why = first_reason(scene.effects, &EffectTraits::why_no_displacements);
        !why.empty() && one_of(request.name, {"mean_square_displacement", "intermediate_scattering", "overlap", "non_gaussian",
                                              "van_hove", "velocity_autocorrelation"}))
      refuse_observable(request, std::string(why));
    if (!one_of(request.name, {"viscosity", "heat_conductivity"})) continue;
    if (const std::string_view why = what_spoils_transport(scene); !why.empty())
      refuse_observable(request, fmt::format("has no meaning here: {}", why));
    if (request.name == "heat_conductivity" && !all_disks_are_equal(scene))
      refuse_observable(request,
                        "is measured for disks of one mass and size only: in a mixture heat also goes with diffusion; "
                        "remove it, or make all disks equal");
  }
}

}  // namespace carom::detail
