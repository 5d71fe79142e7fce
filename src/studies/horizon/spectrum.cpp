#include "studies/horizon/spectrum.hpp"

#include "io/json.hpp"
#include "studies/horizon/event_rates.hpp"
#include "studies/horizon/lyapunov.hpp"
#include "text/numbers.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace carom {

namespace {

constexpr std::size_t fewest_blocks = 8, most_blocks = 32;

/// A direction that grows by g hides what shrinks as much but for a relative g^2 of the rounding. One contact of small disks or
/// shapes far apart may add a thousandfold to this.
constexpr double largest_growth = 100.0;

/// The tangent space of a trajectory, in units in which the metric is that of the masses.
class TangentSpace {
 public:
  TangentSpace(const Scene& scene, const Simulation& simulation, double length, double speed)
      : disks_(static_cast<Eigen::Index>(simulation.disks().count())), length_(length), speed_(speed), root_mass_(disks_) {
    const double mean = simulation.disks().total_mass() / static_cast<double>(disks_);
    for (Eigen::Index i = 0; i < disks_; ++i)
      root_mass_[i] = std::sqrt(simulation.disks().mass[static_cast<std::size_t>(i)] / mean);
    // Column c is a coordinate, and column 4 N - 1 - c its velocity.
    basis_ = Eigen::MatrixXd::Zero(4 * disks_, 4 * disks_);
    for (Eigen::Index c = 0; c < 2 * disks_; ++c) {
      basis_(c, c) = 1.0;
      basis_(2 * disks_ + c, 4 * disks_ - 1 - c) = 1.0;
    }
    for (Eigen::Index c = 0; c < 4 * disks_; ++c) {
      const auto [dr, dv] = difference(c);
      flows_.emplace_back(scene.box, simulation.disks(), scene.effects, simulation.state(), dr, dv);
    }
  }

  /// Returns whether a vector has become so long in this event that the vectors should be made orthogonal.
  bool follow(const Event& event) {
    double longest = 0.0;
    for (TangentFlow& flow : flows_) {
      flow.follow(event);
      for (const std::int32_t i : {event.disk, event.partner})
        if (i >= 0) longest = std::max(longest, root_mass_[i] * flow.norm_of(i, length_, speed_));
    }
    return longest > largest_growth;
  }

  /// Makes the vectors orthogonal again; returns the logarithms of what each has grown by, apart from those before it.
  Eigen::VectorXd decompose(double time) {
    for (Eigen::Index c = 0; c < 4 * disks_; ++c) {
      TangentFlow& flow = flows_[static_cast<std::size_t>(c)];
      flow.advance(time);
      const Eigen::Matrix2Xd dr = flow.dr(), dv = flow.dv();
      for (Eigen::Index i = 0; i < disks_; ++i) {
        basis_.block<2, 1>(2 * i, c) = dr.col(i) * (root_mass_[i] / length_);
        basis_.block<2, 1>(2 * (disks_ + i), c) = dv.col(i) * (root_mass_[i] / speed_);
      }
    }
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis_);
    const Eigen::VectorXd diagonal = qr.matrixQR().diagonal();
    basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(4 * disks_, 4 * disks_);
    for (Eigen::Index c = 0; c < 4 * disks_; ++c) {
      if (diagonal[c] < 0.0) basis_.col(c) *= -1.0;
      const auto [dr, dv] = difference(c);
      flows_[static_cast<std::size_t>(c)].set(dr, dv);
    }
    return diagonal.cwiseAbs().array().log();
  }

 private:
  [[nodiscard]] std::pair<Eigen::Matrix2Xd, Eigen::Matrix2Xd> difference(Eigen::Index c) const {
    Eigen::Matrix2Xd dr(2, disks_), dv(2, disks_);
    for (Eigen::Index i = 0; i < disks_; ++i) {
      dr.col(i) = basis_.block<2, 1>(2 * i, c) * (length_ / root_mass_[i]);
      dv.col(i) = basis_.block<2, 1>(2 * (disks_ + i), c) * (speed_ / root_mass_[i]);
    }
    return {dr, dv};
  }

  Eigen::Index disks_;
  double length_, speed_;
  Eigen::VectorXd root_mass_;
  Eigen::MatrixXd basis_;  ///< coordinates of all disks above velocities
  std::vector<TangentFlow> flows_;
};

/// A stretch between two decompositions.
struct Stretch {
  double time = 0.0;
  std::uint64_t pairs = 0;
  Eigen::VectorXd logs;
};

/// Returns the standard error of the mean rate of `grown` over the stretches, by blocks; nothing where they are too few.
template <class Grown>
std::optional<double> error_of_rate(const std::vector<Stretch>& stretches, double time, double rate, Grown&& grown) {
  const std::size_t blocks = std::min(most_blocks, stretches.size() / 10);
  if (blocks < fewest_blocks) return {};
  double squares = 0.0;
  for (std::size_t b = 0; b < blocks; ++b) {
    double surplus = 0.0;
    for (std::size_t k = b * stretches.size() / blocks; k < (b + 1) * stretches.size() / blocks; ++k)
      surplus += grown(stretches[k]) - rate * stretches[k].time;
    squares += surplus * surplus;
  }
  const auto n = static_cast<double>(blocks);
  return std::sqrt(squares * n / (n - 1.0)) / time;
}

LyapunovSpectrum spectrum_of(const std::vector<Stretch>& stretches, Eigen::Index disks) {
  Eigen::VectorXd grown = Eigen::VectorXd::Zero(4 * disks);
  double time = 0.0;
  LyapunovSpectrum spectrum;
  for (const Stretch& one : stretches) grown += one.logs, time += one.time, spectrum.collisions += one.pairs;
  const Eigen::VectorXd rates = grown / time;
  // Those that are nearly equal may come in another order.
  std::vector<Eigen::Index> order(static_cast<std::size_t>(4 * disks));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return rates[a] > rates[b]; });
  for (const Eigen::Index c : order) {
    spectrum.exponents.push_back(rates[c]);
    spectrum.errors.push_back(error_of_rate(stretches, time, rates[c], [&](const Stretch& one) { return one.logs[c]; }));
  }
  for (auto first = spectrum.exponents.begin(), last = spectrum.exponents.end(); first < last; ++first)
    spectrum.pairing = std::max(spectrum.pairing, std::abs(*first + *--last));
  const auto positive = [&](const Eigen::VectorXd& values) {
    double sum = 0.0;
    for (Eigen::Index c = 0; c < values.size(); ++c)
      if (rates[c] > 0.0) sum += values[c];
    return sum;
  };
  spectrum.entropy = positive(rates);
  spectrum.entropy_error =
      error_of_rate(stretches, time, spectrum.entropy, [&](const Stretch& one) { return positive(one.logs); });
  spectrum.collision_rate = 2.0 * static_cast<double>(spectrum.collisions) / static_cast<double>(disks) / time;
  return spectrum;
}

}  // namespace

std::optional<LyapunovSpectrum> measure_spectrum(const Scene& scene, const State& start, const SpectrumOptions& options) {
  const Eigen::Index disks = start.positions.cols();
  const EventRates rates = measure_event_rates(scene, start);
  if (!(rates.collision_rate > 0.0) || rates.stuck || disks == 0 || scene.effects.dissipate()) return {};
  const auto count = static_cast<double>(disks);
  constexpr std::uint64_t usual = 20'000;
  const std::uint64_t asked = options.collisions > 0 ? options.collisions : usual;
  // A collision of disks stretches and shrinks two directions. So many of them may pass by without a decomposition, where none
  // stretches far (largest_growth).
  const double interval = std::max(2.0, 0.5 * count) / (count * rates.collision_rate);

  Simulation simulation = make_simulation(scene, start);
  TangentSpace space(scene, simulation, std::sqrt(scene.box.area() / count),
                     std::sqrt(start.velocities.squaredNorm() / (2.0 * count)));
  simulation.record_events(true);
  std::vector<Stretch> stretches;
  std::uint64_t pairs = 0;
  const double patience = 4.0 * 2.0 * static_cast<double>(asked) / count / rates.collision_rate;
  for (double from = 0.0; pairs < asked && from < patience;) {
    if (options.proceed && !options.proceed(static_cast<double>(pairs) / static_cast<double>(asked))) return {};
    const double to = from + interval;
    if (simulation.run_until(to, {.collisions = pairs + stall_limit(simulation.disks().count())}) != StopReason::time) break;
    Eigen::VectorXd logs = Eigen::VectorXd::Zero(4 * disks);
    for (const Event& event : simulation.take_events())
      if (space.follow(event)) logs += space.decompose(event.time);
    const std::uint64_t more = simulation.totals().pair - pairs;
    stretches.push_back({to - from, more, logs + space.decompose(to)});
    if (!stretches.back().logs.allFinite()) return {};
    pairs += more;
    from = to;
  }
  constexpr std::size_t fewest = 40;
  stretches.erase(stretches.begin(), stretches.begin() + static_cast<std::ptrdiff_t>(stretches.size() / 5));
  if (stretches.size() < fewest || pairs == 0) return {};
  return spectrum_of(stretches, disks);
}

std::string why_no_spectrum(const Scene& scene) {
  if (scene.disk_count() < 2)
    return fmt::format("{} has {}, and exponents are measured over collisions of pairs of disks; take two or more", scene.source,
                       counted(static_cast<std::uint64_t>(scene.disk_count()), "disk"));
  if (scene.disk_count() <= most_disks_of_a_spectrum) return {};
  return fmt::format("{} has {} disks, and the exponents of at most {} are measured; take fewer disks", scene.source,
                     scene.disk_count(), most_disks_of_a_spectrum);
}

std::string spectrum_json(const LyapunovSpectrum& spectrum, const Scene& scene) {
  using detail::Json;
  Json json;
  json["carom"] = detail::build_json();
  json["scene"] = scene.source;
  json["seed"] = scene.run.seed;
  json["disks"] = scene.disk_count();
  Json& found = json["lyapunov_spectrum"];
  found["exponents"] = spectrum.exponents;
  found["errors"] = Json::array();
  for (const std::optional<double>& error : spectrum.errors) found["errors"].push_back(detail::number(error));
  found["entropy"] = spectrum.entropy;
  found["entropy_error"] = detail::number(spectrum.entropy_error);
  found["pairing"] = spectrum.pairing;
  found["collision_rate"] = spectrum.collision_rate;
  found["collisions"] = spectrum.collisions;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);  // a path need not be UTF-8
}

std::string spectrum_text(const LyapunovSpectrum& spectrum, const Scene& scene) {
  const double vanishing = 1e-9 * spectrum.collision_rate;
  const auto number = [&](double value, const std::optional<double>& error) {
    return std::abs(value) < vanishing ? "0" : with_error(value, error.value_or(0.0));
  };
  std::string text = fmt::format("{}\n{}, packing fraction {:.4g}; seed {}; {} collisions, {:.4g} per time of each disk\n\n",
                                 scene.title.empty() ? scene.source : scene.title,
                                 counted(static_cast<std::uint64_t>(scene.disk_count()), "disk"), scene.packing_fraction(),
                                 scene.run.seed, grouped(spectrum.collisions), spectrum.collision_rate);
  constexpr std::size_t most_lines = 64;
  const std::size_t half = spectrum.exponents.size() / 2, lines = std::min(half, most_lines);
  text += "Lyapunov exponents, 1 / time in scene units:\n";
  for (std::size_t k = 0; k < lines; ++k)
    text += fmt::format("  {:4}  {:>20}    {:4}  {:>20}\n", k + 1, number(spectrum.exponents[k], spectrum.errors[k]),
                        2 * half - k, number(spectrum.exponents[2 * half - 1 - k], spectrum.errors[2 * half - 1 - k]));
  if (lines < half) text += fmt::format("  and {} more, which --json has\n", 2 * (half - lines));
  text += fmt::format("\nKolmogorov-Sinai entropy, the sum of the positive ones: {} per time, {:.4g} per collision\n",
                      number(spectrum.entropy, spectrum.entropy_error),
                      2.0 * spectrum.entropy / (spectrum.collision_rate * static_cast<double>(scene.disk_count())));
  const bool is_paired = spectrum.pairing < 1e-6 * spectrum.collision_rate;
  if (is_paired)
    return text +
           fmt::format("Exponents 1 and {}, 2 and {}, ... have the sum 0 to {:.1g}.\n", 2 * half, 2 * half - 1, spectrum.pairing);
  const bool is_hamiltonian = scene.effects.collision.rule == CollisionRule::specular;
  return text + fmt::format("Exponents 1 and {}, 2 and {}, ... have sums of up to {:.2g}: {}.\n", 2 * half, 2 * half - 1,
                            spectrum.pairing,
                            is_hamiltonian ? "rounding leaves them, where single contacts stretch differences many thousandfold"
                                           : "they would be 0 at any time if the dynamics were that of a Hamiltonian");
}

}  // namespace carom
