#include "theory/run_theory.hpp"

#include "core/all_equal.hpp"
#include "observe/equilibrium.hpp"
#include "observe/observed_run.hpp"
#include "scene/fixed_shapes.hpp"
#include "theory/barometer.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/finite_fluid.hpp"
#include "theory/kinetic.hpp"
#include "theory/microcanonical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace carom {

namespace {

constexpr double pi = std::numbers::pi;
using theory::densest_finite, theory::densest_fluid, theory::is_wide, theory::many_dense_disks;
constexpr int line_points = 200;

/// Returns Z of a fluid of so many equal disks; nothing where no equation of state is good to 0.2 %.
std::optional<Expected> expected_Z(double eta, std::int64_t disks) {
  const std::optional<theory::FluidZ> Z = theory::fluid_Z(eta, disks);
  if (!Z) return {};
  return Expected{Z->value, Z->of_so_many ? fmt::format("Kolafa & Rottner, N = {}", disks)
                                          : std::string("Kolafa & Rottner, infinitely many disks")};
}

/// Returns g at contact of so many equal disks, which follows from their Z.
Expected contact_value_of(const Expected& Z, double eta, std::int64_t disks) {
  const auto N = static_cast<double>(disks);
  return {(Z.value - 1.0) * N / (2.0 * eta * (N - 1.0)), Z.source};
}

/// Even steps over the first column of a table, beginning above zero.
std::vector<double> steps_over(const Table& table) {
  const std::vector<double>& x = table.columns.front().values;
  std::vector<double> steps;
  if (x.empty()) return steps;
  for (int k = 1; k <= line_points; ++k) steps.push_back(x.back() * k / line_points);
  return steps;
}

/// Returns the contact value that "g_big_small", "g_rate" or any other of contact_values names, of smooth disks in a periodic box
/// of this packing fraction on which nothing else acts; nothing of others.
std::optional<Expected> contact_value(const std::string& scalar, const TheorySource& of, double eta) {
  const Scene& scene = of.scene;
  const std::vector<double>& radius = of.disks.radius;
  const bool is_fluid = scene.box.periodic(0) && scene.box.periodic(1) && scene.effects.neutral() &&
                        scene.effects.collision.rule == CollisionRule::specular && eta <= densest_fluid;
  if (!is_fluid || radius.size() < 3 || !is_wide(scene.box, 2.0 * *std::max_element(radius.begin(), radius.end()), eta))
    return {};
  const ObservedRun run{scene, of.disks};
  std::vector<double> counts(run.species_count()), radii(run.species_count());
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const auto species = static_cast<std::size_t>(of.disks.species[i]);
    if (counts[species] > 0.0 && radius[i] != radii[species]) return {};  // g is a mean over sizes there
    radii[species] = radius[i];
    counts[species] += 1.0;
  }
  for (std::size_t a = 0; a < counts.size(); ++a)
    for (std::size_t b = a; b < counts.size(); ++b) {
      const std::string pair = run.suffix(a) + run.suffix(b);
      if (scalar != "g" + pair && scalar != "g_rate" + pair) continue;
      if (a == b && counts[a] < 2.0) return {};  // there is no such pair
      if (all_equal(radius)) {                   // it follows from Z, whatever masses and names are
        const auto disks = static_cast<std::int64_t>(radius.size());
        const std::optional<Expected> Z = expected_Z(eta, disks);
        return Z ? std::optional(contact_value_of(*Z, eta, disks)) : std::nullopt;
      }
      std::vector<theory::Component> gas;
      for (std::size_t s = 0; s < counts.size(); ++s)
        gas.push_back({.density = counts[s] / scene.box.area(), .radius = radii[s]});
      return Expected{theory::contact_value(gas, radii[a], radii[b]), "of the form of scaled particle theory, approximate"};
    }
  return {};
}

}  // namespace

RunTheory::RunTheory(const RunReport& report, std::optional<TheorySource> source)
    : report_(report), kT_(report.temperature_mean), eta_(report.packing_fraction) {
  if (source && source->disks.count() == static_cast<std::size_t>(report.disks)) source_.emplace(*source);
  if (!source_) {
    why_not_Z_ = "No theory is given: the disks of the scene are in no file of the run.";
    return;
  }
  const Scene& scene = source_->scene;
  const Disks& disks = source_->disks;
  if (!scene.changes.empty()) {
    why_not_Z_ = "No theory is given: what acts changes during the run.";
    return;
  }
  const bool is_moving = report_.measured && kT_ > 0.0 && std::isfinite(kT_);
  const bool is_equal = disks.count() > 2 && all_equal(disks.radius) && all_equal(disks.mass);
  const bool is_periodic = scene.box.periodic(0) && scene.box.periodic(1);
  const bool is_narrow = is_equal && is_periodic && !is_wide(scene.box, 2.0 * disks.radius.front(), eta_);
  is_plain_ = is_moving && is_equal && is_periodic && scene.effects.neutral() && !is_narrow;
  is_smooth_ = is_plain_ && scene.effects.collision.rule == CollisionRule::specular;
  if (disks.count() > 0) {
    mass_ = disks.mass.front();  // of all, wherever they are used
    sigma_ = 2.0 * disks.radius.front();
  }
  if (is_moving) {
    unit_of_time_ = sigma_ * std::sqrt(mass_ / kT_);
    find_velocities();
  }
  if (is_plain_)
    find_Z();
  else if (is_narrow)
    why_not_Z_ = "No theory is given: the box is so narrow that disks meet images of their own neighbours.";
  else
    why_not_Z_ =
        "No theory is given: equations of state hold for three or more equal elastic disks in a periodic box on which nothing "
        "else acts.";
}

void RunTheory::find_Z() {
  Z_ = expected_Z(eta_, report_.disks);
  if (Z_) return;
  if (eta_ <= densest_fluid) {
    why_not_Z_ = fmt::format(
        "No theory is given: above a packing fraction of {:g}, the equation of state of infinitely many disks is good to 0.2 % "
        "from {} disks on.",
        densest_finite, many_dense_disks);
  } else {
    why_not_Z_ =
        fmt::format("No theory is given: the equation of state of the fluid ends at a packing fraction of {:g}.", densest_fluid);
  }
}

void RunTheory::find_velocities() {
  const Effects& effects = source_->scene.effects;
  const Box& box = source_->scene.box;
  const Eigen::Vector2d falls = effects.acceleration();
  const bool flows = (box.periodic(0) && falls[0] != 0.0) || (box.periodic(1) && falls[1] != 0.0);
  if (effects.collision.rule != CollisionRule::specular || source_->disks.count() < 3 || flows ||
      !why_no_Z(effects, &detail::EffectTraits::only_varies_density).empty())
    return;
  const bool is_fixed =
      !temperature_fluctuates(effects) && !detail::any_acting(effects, &detail::EffectTraits::has_energy_of_disk_positions);
  const ObservedRun run{source_->scene, source_->disks};
  const bool x = run.conserves_momentum(0), y = run.conserves_momentum(1);
  conserved_axes_ = (x ? 1 : 0) + (y ? 1 : 0);
  // With a momentum along one axis, or an angular one, the law of few disks is another than those two.
  constexpr std::int64_t many = 100;  // from which on it differs by less than a per cent from that of infinitely many
  const bool is_between = is_fixed && (x != y || keeps_turning(source_->scene));
  if (is_between && report_.disks < many) return;
  const Eigen::Vector2d common = report_.momentum_initial.cwiseProduct(Eigen::Vector2d(x ? 1.0 : 0.0, y ? 1.0 : 0.0));
  const double energy = common.squaredNorm() / (2.0 * source_->disks.total_mass());
  moves_as_a_whole_ = energy > 1e-12 * static_cast<double>(report_.disks) * kT_;
  velocities_ = is_fixed && !is_between ? Velocities::fixed_energy : Velocities::maxwell;
  kT_ = effects.bath_temperature().value_or(kT_);
}

std::vector<RunTheory::Kind> RunTheory::kinds(const std::string& suffix) const {
  const ObservedRun run{source_->scene, source_->disks};
  std::map<double, double> counts;
  for (std::size_t i = 0; i < source_->disks.count(); ++i) {
    const auto species = static_cast<std::size_t>(source_->disks.species[i]);
    const bool counted = suffix.empty() || (species < run.species_count() && run.suffix(species) == suffix);
    if (counted) counts[source_->disks.mass[i]] += 1.0;
  }
  std::vector<Kind> found;
  for (const auto& [mass, count] : counts) found.push_back({mass, count});
  return found;
}

double RunTheory::velocity_density(const Kind& kind, double x, bool of_energy) const {
  const double all_mass = source_->disks.total_mass();
  // Along an axis on which momentum is conserved, a disk has less than kT / 2, the less the heavier it is.
  const double mean = kT_ * (1.0 - 0.5 * conserved_axes_ * kind.mass / all_mass);
  if (velocities_ == Velocities::maxwell) {
    const double energy = of_energy ? x : 0.5 * kind.mass * x * x;
    return std::exp(-energy / mean) / mean * (of_energy ? 1.0 : kind.mass * x);
  }
  const theory::Microcanonical law(report_.disks, conserved_axes_ == 2);
  return of_energy ? law.energy_density(x, mean) : law.speed_density(x, 2.0 * mean / kind.mass);
}

std::vector<TheoryCurve> RunTheory::velocity_curves(const Table& table, const std::string& column) const {
  if (velocities_ == Velocities::unknown || moves_as_a_whole_) return {};
  constexpr std::size_t most_kinds = 50;  // of masses; each is a term of every point
  const std::vector<Kind> all = kinds(column.substr(std::string("density").size()));
  if (all.empty() || all.size() > most_kinds) return {};
  double disks = 0.0;
  for (const Kind& kind : all) disks += kind.count;
  TheoryCurve law{.name = velocities_ == Velocities::fixed_energy ? fmt::format("law for {} disks", report_.disks)
                                                                  : std::string("Maxwell and Boltzmann")};
  for (const double x : steps_over(table)) {
    double density = 0.0;
    for (const Kind& kind : all) density += kind.count / disks * velocity_density(kind, x, table.name == "energies");
    law.x.push_back(x);
    law.y.push_back(density);
  }
  return {law};
}

std::vector<TheoryCurve> RunTheory::flight_curves(const Table& table) const {
  if (!is_smooth_ || eta_ > densest_finite) return {};
  const double free_time = unit_of_time_ / theory::disk_collision_rate(eta_, report_.disks);
  const double free_path = free_time * std::sqrt(kT_ / mass_);  // thermal velocities times mean free times
  const bool of_times = table.name == "free_times";
  if (!of_times && moves_as_a_whole_) return {};
  const double scale = of_times ? free_time : free_path;
  const double mean = of_times ? 1.0 : std::sqrt(0.5 * pi);
  TheoryCurve law{.name = "dilute gas, summed over speeds"}, plain{.name = "exponential", .dashed = true};
  for (const double x : steps_over(table)) {
    const double s = x / scale;
    law.x.push_back(x);
    law.y.push_back((of_times ? theory::flight_time_density(s) : theory::flight_length_density(s)) / scale);
    plain.x.push_back(x);
    plain.y.push_back(std::exp(-s / mean) / (mean * scale));
  }
  return {law, plain};
}

std::vector<TheoryCurve> RunTheory::density_curves(const Table& table) const {
  const Scene& scene = source_->scene;
  if (scene.box.is_circle) return {};  // its strips and rings differ in width
  const int axis = table.columns.front().name == "x" ? 0 : 1;
  const int across = 1 - axis;
  const std::vector<double>& x = table.columns.front().values;
  if (x.empty()) return {};
  const bool periodic = scene.box.periodic(axis), falls = scene.effects.acceleration()[axis] != 0.0;
  if (periodic && fixed_shapes(scene.effects).empty()) {
    const double density = static_cast<double>(report_.disks) / scene.box.area();
    TheoryCurve uniform{.name = "uniform"};
    uniform.x = {scene.box.lower[axis], scene.box.upper[axis]};
    uniform.y = {density, density};
    return {uniform};
  }
  const Disks& disks = source_->disks;
  const bool is_equal = disks.count() > 0 && all_equal(disks.radius) && all_equal(disks.mass);
  const bool is_hard = std::ranges::none_of(std::array{"square_well", "stepped_potential", "non_additivity"},
                                            [&](const char* name) { return detail::effect_named(name).acts(scene.effects); });
  // Beside an acceleration along the other axis, the profile of neither is that of one alone.
  const bool falls_along_it = falls && scene.effects.acceleration()[across] == 0.0;
  if (!falls_along_it || !is_equal || !is_hard || velocities_ == Velocities::unknown) return {};
  const double g = scene.effects.acceleration()[axis], radius = disks.radius.front();
  const double height = scene.box.lengths()[axis] - 2.0 * radius;
  const double width = scene.box.lengths()[across] - (scene.box.periodic(across) ? 0.0 : 2.0 * radius);
  constexpr std::size_t steps = 400;
  const std::vector<double> density = theory::barometer(disks.mass.front() * std::abs(g) / kT_,
                                                        static_cast<double>(report_.disks) / width, radius, height, steps);
  const double area = pi * radius * radius;
  if (!(density.front() * area <= densest_fluid)) return {};  // no fluid at the floor
  TheoryCurve law{.name = "hydrostatics"};
  for (std::size_t k = 0; k < steps; ++k) {
    const double above = radius + height * (static_cast<double>(k) + 0.5) / static_cast<double>(steps);
    law.x.push_back(g < 0.0 ? scene.box.lower[axis] + above : scene.box.upper[axis] - above);
    law.y.push_back(density[k] * width / scene.box.lengths()[across]);  // densities of the profile are over all of a strip
  }
  return {law};
}

std::vector<TheoryCurve> RunTheory::curves(const Table& table, const std::string& column) const {
  if (!source_ || table.columns.empty()) return {};
  if (table.name == "speeds" || table.name == "energies") return velocity_curves(table, column);
  if (table.name == "free_times" || table.name == "free_paths") return flight_curves(table);
  if (table.name == "density_profile" && column == "density") return density_curves(table);
  if (!is_smooth_ || eta_ > densest_fluid) return {};
  const double D = theory::enskog_diffusion(eta_) * sigma_ * sigma_ / unit_of_time_;
  TheoryCurve law{.name = "Enskog", .dashed = true};
  if (table.name == "velocity_autocorrelation" && column == "correlation") {
    const double square = 2.0 * kT_ / mass_ * (1.0 - 1.0 / static_cast<double>(report_.disks));
    const double rate = kT_ / (mass_ * D);
    for (int k = 0; k <= line_points; ++k) {  // over three decades of a logarithmic axis
      law.x.push_back(8.0 / rate * std::pow(10.0, -3.0 + 3.0 * k / line_points));
      law.y.push_back(square * std::exp(-rate * law.x.back()));
    }
    return {law};
  }
  if (table.name == "mean_square_displacement" && column == "msd") {
    const std::vector<double>& x = table.columns.front().values;
    for (const double t : x)
      if (t > 0.0) {
        law.x.push_back(t);
        law.y.push_back(4.0 * D * t);
      }
    return {law};
  }
  return {};
}

std::vector<TheoryMark> RunTheory::marks(const Table& table, const std::string& column) const {
  if (!source_) return {};
  if (table.name == "h_function") {
    for (const Measurement& measured : report_.observables)
      for (const Scalar& scalar : measured.scalars)
        if (measured.name == "h_function" && scalar.name == "maxwell_expected" && scalar.value)
          return {{.value = *scalar.value, .label = "Maxwell, as many disks in these bins"}};
    return {};
  }
  if (table.name == "radial_distribution" && is_plain_) return {{.on_first_column = true, .value = sigma_, .label = "contact"}};
  if (table.name == "structure_factor" && is_plain_ && eta_ <= densest_fluid)
    return {{.value = theory::structure_factor_at_zero(eta_), .label = "S(0), equation of state"}};
  if (!is_smooth_ || eta_ > densest_fluid) return {};
  if (column == "diffusion")
    return {{.value = theory::enskog_diffusion(eta_) * sigma_ * sigma_ / unit_of_time_, .label = "Enskog"}};
  if (column == "green_kubo")
    if (const auto expected = of(table.name, "green_kubo")) return {{.value = expected->value, .label = "Enskog"}};
  return {};
}

std::optional<Expected> RunTheory::of(const std::string& observable, const std::string& scalar) const {
  const std::string name = observable + "." + scalar;
  if (velocities_ == Velocities::fixed_energy && !moves_as_a_whole_ && observable == "velocity_moments" &&
      source_->species == 1 && all_equal(source_->disks.mass)) {
    const bool conserves_momentum = conserved_axes_ == 2;
    const theory::Microcanonical law(report_.disks, conserves_momentum);
    const double square = 2.0 * kT_ / mass_ * (conserves_momentum ? 1.0 - 1.0 / static_cast<double>(report_.disks) : 1.0);
    const std::string source = fmt::format("law for {} disks", report_.disks);
    if (scalar == "speed") return Expected{0.5 * std::sqrt(pi * square) * law.speed_factor(), source};
    if (scalar == "v2") return Expected{square, source};
    if (scalar == "v4") return Expected{law.kurtosis() * square * square, source};
    if (scalar == "vx3" || scalar == "vy3") return Expected{0.0, "symmetry"};
    if (scalar == "kurtosis") return Expected{law.kurtosis(), source};
    if (scalar == "kurtosis_x" || scalar == "kurtosis_y") return Expected{law.axis_kurtosis(), source};
  }
  if (observable == "contact_values" && source_ && source_->scene.changes.empty() && report_.measured && kT_ > 0.0)
    return contact_value(scalar, *source_, eta_);
  if (!Z_) return {};
  if (name == "pressure.Z") return Z_;
  if (name == "pressure.reduced") return Expected{4.0 * eta_ / pi * Z_->value, Z_->source};
  const double disks = static_cast<double>(report_.disks);
  if (name == "radial_distribution.contact") return contact_value_of(*Z_, eta_, report_.disks);
  if (!is_smooth_) return {};
  if (name == "pressure.Z_rate") return Z_;
  if (observable == "viscosity")
    return Expected{theory::enskog_viscosity(eta_) * std::sqrt(mass_ * kT_) / sigma_, "Enskog, without correlations"};
  if (observable == "heat_conductivity")
    return Expected{theory::enskog_conductivity(eta_) * std::sqrt(kT_ / mass_) / sigma_, "Enskog, without correlations"};
  if (eta_ > densest_finite) return {};
  const double rate = theory::disk_collision_rate(eta_, report_.disks) / unit_of_time_;
  if (name == "collision_rate.rate") return Expected{rate, Z_->source};
  if (name == "free_flight.mean_free_time") return Expected{1.0 / rate, Z_->source};
  if (name == "free_flight.mean_free_path" && !moves_as_a_whole_)
    return Expected{sigma_ * theory::mean_free_path(eta_) * (theory::kolafa_rottner(eta_) - 1.0) / (Z_->value - 1.0) *
                        std::sqrt(1.0 - 1.0 / disks),
                    Z_->source};
  return {};
}

}  // namespace carom
