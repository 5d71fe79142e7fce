// Transport coefficients from the fluctuations of a flux that flies along with the disks and jumps over from disk to disk at
// collisions. Its integral over time, Helfand's moment G, is known exactly: it grows evenly between collisions and jumps at each
// by r_ij times what disk i got. From G on a grid come
//   Green-Kubo:        the running integral of <J(0) J(t)>, J the mean flux over a step, the increase of G over its time;
//   Einstein-Helfand:  <(G(t) - G(0))^2> / 2 t.
// Both are averages over time, of two components that isotropy makes equal.
//
// Velocities are relative to the common motion. kT is that of the start, which collisions keep: a run with changes has
// the correlation of the flux alone.

#include "observe/blocking.hpp"
#include "observe/equilibrium.hpp"
#include "observe/followers.hpp"
#include "observe/mechanics.hpp"
#include "observe/multiple_tau.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

/// A coefficient, its flux, and what leads from the integral of <J J> to it.
struct TransportCoefficient {
  std::string name, unit, unit_of_flux;
  Eigen::Vector2d (*flow)(double mass, const Eigen::Vector2d& velocity);  ///< the flux that one disk carries
  FluxSum* FluxSums::*sum;                                                ///< the sum of what collisions transfer
  double part;                                                            ///< fraction of this sum that the flux is
  double (*factor)(double kT, double area);
};

class Transport final : public SavedObservable<Transport>, public FluxFollower {
 public:
  Transport(const ObservableRequest& request, const ObservedRun& run, TransportCoefficient coefficient);

  [[nodiscard]] double step() const override { return 0.0; }  ///< no samples: it takes its own steps, by the clock
  [[nodiscard]] bool follows_collisions() const override { return true; }
  void start(const State& state) override;
  void ask(FluxSums& sums) override { sums.*coefficient_.sum = &sum_; }
  [[nodiscard]] double until() const override { return next_; }
  void reach(double time) override { tick(time); }
  [[nodiscard]] Measurement finish(double time, const Totals& totals) override;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(kT_, next_, ticks_, sum_.change, sum_.moment, sum_.since, flow_, moment_, noted_, products_, moments_, mean_flux_);
  }

 private:
  void tick(double time);

  TransportCoefficient coefficient_;
  double kT_ = 0.0;
  double next_ = step_;
  std::uint64_t ticks_ = 0;
  FluxSum sum_;                                     ///< since the last tick
  std::array<Blocking, 2> mean_flux_;               ///< over each step
  Eigen::Vector2d flow_ = Eigen::Vector2d::Zero();  ///< the part of the flux that flies
  Eigen::Vector2d moment_ = Eigen::Vector2d::Zero(), noted_ = Eigen::Vector2d::Zero();
  MultipleTau products_{2, MultipleTau::Pairs::products}, moments_{2, MultipleTau::Pairs::squared_differences};
};

std::string at_lag(double lag) {
  char text[160];
  std::snprintf(text, sizeof text, "at lag %.4g, the longest below half the time that sound takes through the box", lag);
  return text;
}

/// Returns the last row that `until` allows and whose error is known; null where there is none.
const MultipleTau::Row* longest_row(const std::vector<MultipleTau::Row>& rows, double until) {
  const MultipleTau::Row* best = nullptr;
  for (const MultipleTau::Row& row : rows)
    if (row.lag > 0.0 && row.lag <= until && row.estimate().error) best = &row;
  return best;
}

Scalar coefficient(std::string name, const std::string& unit, double step, double factor, const MultipleTau::Row* row) {
  Scalar scalar{.name = std::move(name), .unit = unit};
  if (row == nullptr) {
    scalar.note = "the run is too short";
    return scalar;
  }
  scalar.note = at_lag(step * (row->integral ? row->lag + 0.5 * row->width : row->lag));
  row->fill(scalar, step, factor);
  return scalar;
}

/// Half the time that sound takes through the box (Henderson's equation of state): beyond, a fluctuation meets its own image.
double sound_time(const ObservedRun& run) {
  const double mass = run.disks.total_mass() / static_cast<double>(run.disks.count());
  const double eta = std::min(run.scene.packing_fraction(), 0.85), free = 1.0 - eta;
  const double z = (1.0 + eta * eta / 8.0) / (free * free);
  const double slope = eta / 4.0 / (free * free) + 2.0 * z / free;
  const double speed = std::sqrt(run.energy_scale() / mass * (z + eta * slope + z * z));
  return speed > 0.0 ? 0.5 * run.scene.box.lengths().minCoeff() / speed : std::numeric_limits<double>::infinity();
}

/// Returns whether the mean flux differs from 0 by more than five standard errors.
bool flows_steadily(const Blocking& flux) {
  const std::optional<Blocking::Estimate> found = flux.estimate();
  return found && found->error && found->statistical_inefficiency && std::abs(found->mean) > 5.0 * *found->error;
}

Transport::Transport(const ObservableRequest& request, const ObservedRun& run, TransportCoefficient coefficient)
    : SavedObservable(request, run), coefficient_(std::move(coefficient)) {}

void Transport::start(const State& state) {
  const Eigen::Vector2d common = common_velocity(run_, state);
  kT_ = kinetic_temperature(run_.scene.box, run_.disks, state);
  for (std::size_t i = 0; i < run_.disks.count(); ++i)
    flow_ += coefficient_.flow(run_.disks.mass[i], state.velocities.col(static_cast<Eigen::Index>(i)) - common);
  moments_.add(std::array{0.0, 0.0});
}

/// Notes the moment at every grid time up to `time`.
void Transport::tick(double time) {
  for (int c = 0; c < 2; ++c) {
    flow_[c] += coefficient_.part * sum_.change[c].sum();
    moment_[c] += coefficient_.part * sum_.moment[c].sum();
    sum_.change[c] = sum_.moment[c] = {};
  }
  while (next_ <= time) {
    moment_ += (next_ - sum_.since) * flow_;
    sum_.since = next_;
    const Eigen::Vector2d mean = (moment_ - noted_) / step_;
    products_.add(std::array{mean.x(), mean.y()});
    for (std::size_t c = 0; c < 2; ++c) mean_flux_[c].add(mean[static_cast<Eigen::Index>(c)]);
    moments_.add(std::array{moment_.x(), moment_.y()});
    noted_ = moment_;
    next_ = static_cast<double>(++ticks_ + 1) * step_;
  }
}

Measurement Transport::finish(double time, const Totals&) {
  if (time >= next_) tick(time);
  const auto& [name, unit, unit_of_flux, flow, sum, part, factor_of] = coefficient_;
  const double step = step_, factor = factor_of(kT_, run_.scene.box.area()), longest = sound_time(run_);
  const std::vector<MultipleTau::Row> correlations = products_.rows(), moments = moments_.rows();
  Measurement found{.name = name};
  found.scalars.push_back(coefficient("green_kubo", unit, step, factor * step, longest_row(correlations, longest / step)));
  const MultipleTau::Row* last = longest_row(moments, longest / step);
  found.scalars.push_back(
      coefficient("einstein_helfand", unit, step, last == nullptr ? 0.0 : factor / (2.0 * step * last->lag), last));

  const bool is_one_gas = why_not_one_gas(run_.scene).empty();
  if (!is_one_gas)
    found.note = why_not_one_gas(run_.scene);
  else if (std::ranges::any_of(mean_flux_, flows_steadily))
    found.note =
        "the flux has a mean that is not zero, as the stress of a strained crystal: its growth is no transport coefficient";
  if (!found.note.empty())
    for (Scalar& scalar : found.scalars) scalar = {.name = scalar.name, .unit = unit, .note = found.note};
  if (found.note.empty()) found.note = MultipleTau::note_on_errors(moments);
  Table table{.name = name};
  Column lags{"lag", "time", {}}, flux{"correlation", unit_of_flux, {}}, flux_error{"correlation_error", unit_of_flux, {}};
  Column until{"integral_to", "time", {}}, integral{"green_kubo", unit, {}}, integral_error{"green_kubo_error", unit, {}};
  Column helfand{"einstein_helfand", unit, {}}, helfand_error{"einstein_helfand_error", unit, {}};
  ColumnComparison of_flux, of_integral, of_helfand;
  for (const MultipleTau::Row& row : correlations) {
    lags.values.push_back(step * row.lag);
    flux.values.push_back(row.pairs.mean);
    flux_error.values.push_back(row.pairs.error.value_or(unknown));
    of_flux.add(row.halves);
    until.values.push_back(step * (row.lag + 0.5 * row.width));
    integral.values.push_back(factor * step * row.integral->mean);
    of_integral.add(row.integral_halves, factor * step);
    integral_error.values.push_back(row.integral->error ? factor * step * *row.integral->error : unknown);
    const auto same =
        std::find_if(moments.begin(), moments.end(), [&](const MultipleTau::Row& other) { return other.lag == row.lag; });
    const bool there = same != moments.end();
    const double scale = there ? factor / (2.0 * step * same->lag) : unknown;
    of_helfand.add(there ? same->halves : std::nullopt, scale);
    helfand.values.push_back(there ? scale * same->pairs.mean : unknown);
    helfand_error.values.push_back(there && same->pairs.error ? scale * *same->pairs.error : unknown);
  }
  table.columns = {lags, flux, flux_error};
  of_flux.put(table, flux.name);
  if (is_one_gas) {
    for (const Column& column : {until, integral, integral_error, helfand, helfand_error}) table.columns.push_back(column);
    of_integral.put(table, integral.name);
    of_helfand.put(table, helfand.name);
  }
  found.tables.push_back(std::move(table));
  return found;
}

}  // namespace

/// Shear viscosity from the fluctuations of the momentum flux: eta = (1 / A kT) times the integral of <J_xy(0) J_xy(t)>, with
/// J_xy = sum m v_x v_y + the jumps r_x (impulse)_y at collisions. (J_xx - J_yy) / 2 fluctuates alike and counts as well.
MadeObservable make_viscosity(const ObservableRequest& request, const ObservedRun& run) {
  const auto flow = [](double mass, const Eigen::Vector2d& v) {
    return Eigen::Vector2d(mass * v.x() * v.y(), 0.5 * mass * (v.x() * v.x() - v.y() * v.y()));
  };
  const auto factor = [](double kT, double area) { return kT > 0.0 ? 1.0 / (area * kT) : 0.0; };
  return std::make_unique<Transport>(
      request, run, TransportCoefficient{"viscosity", "mass / time", "energy^2", flow, &FluxSums::momentum, 0.5, factor});
}

/// Heat conductivity from the fluctuations of the energy flux: lambda = (1 / A kT^2) times the integral of <J(0) J(t)> of one
/// component, J = sum (m v^2 / 2) v + the jumps r_ij (energy that disk i got from j) at collisions. For disks of one mass,
/// relative to their common motion.
MadeObservable make_heat_conductivity(const ObservableRequest& request, const ObservedRun& run) {
  const auto flow = [](double mass, const Eigen::Vector2d& v) { return Eigen::Vector2d(0.5 * mass * v.squaredNorm() * v); };
  const auto factor = [](double kT, double area) { return kT > 0.0 ? 1.0 / (area * kT * kT) : 0.0; };
  return std::make_unique<Transport>(
      request, run,
      TransportCoefficient{"heat_conductivity", "1 / time", "energy^2 length^2 / time^2", flow, &FluxSums::energy, 0.25, factor});
}

}  // namespace carom
