#include "theory/kinetic.hpp"

#include "core/reduced_mass.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/microcanonical.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/ellint_2.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace carom::theory {

namespace {

/// The contact values of a gas, by the harmonic mean of two radii.
struct ContactForm {
  double bare = 1.0, crowding = 0.0, ratio = 0.0;
  explicit ContactForm(std::span<const Component> gas) {
    double radii = 0.0, squares = 0.0;  // per area
    for (const Component& kind : gas) {
      radii += kind.density * kind.radius;
      squares += kind.density * kind.radius * kind.radius;
    }
    const double eta = std::numbers::pi * squares;
    if (!(eta > 0.0)) return;
    bare = 1.0 / (1.0 - eta);
    crowding = contact_value(eta) - bare;  // g - 1 / (1 - eta) of equal disks
    ratio = radii / squares;
  }
  [[nodiscard]] double of(double radius_i, double radius_j) const {
    return bare + crowding * (2.0 * radius_i * radius_j / (radius_i + radius_j)) * ratio;
  }
};

}  // namespace

double contact_value(std::span<const Component> gas, double radius_i, double radius_j) {
  return ContactForm(gas).of(radius_i, radius_j);
}

double collision_rate(std::span<const Component> gas, double kT) {
  const ContactForm g(gas);
  double rate = 0.0;
  for (const Component& i : gas)
    for (const Component& j : gas) {
      const double sigma = i.radius + j.radius, mass = reduced_mass(i.mass, j.mass);
      if (!(sigma > 0.0)) continue;
      rate += 0.5 * i.density * j.density * sigma * g.of(i.radius, j.radius) * std::sqrt(2.0 * std::numbers::pi * kT / mass);
    }
  return rate;
}

namespace {

constexpr double pi = std::numbers::pi;
const double sqrt_pi = std::sqrt(pi);

double density(double eta) { return 4.0 * eta / pi; }

/// Returns the mean of f(speed, rate) over flights: of a speed there are as many as disks of it collide.
template <class Function>
double over_flights(Function f) {
  const auto at_speed = [&](double v) {
    const double rate = relative_rate(v);
    return v * std::exp(-0.5 * v * v) * rate * f(v, rate);
  };
  double sum = 0.0;
  for (int panel = 0; panel < 5; ++panel)  // up to ten thermal velocities
    sum += boost::math::quadrature::gauss<double, 30>::integrate(at_speed, 2.0 * panel, 2.0 * (panel + 1));
  return sum;
}

}  // namespace

double contact_value(double eta) { return (kolafa_rottner(eta) - 1.0) / (2.0 * eta); }

double disk_collision_rate(double Z) { return 4.0 / sqrt_pi * (Z - 1.0); }

double disk_collision_rate(double eta, std::int64_t disks) {
  return disk_collision_rate(kolafa_rottner_finite(eta, disks)) * Microcanonical(disks, true).speed_factor();
}

double mean_free_path(double eta) { return 1.0 / (2.0 * std::numbers::sqrt2 * density(eta) * contact_value(eta)); }

double enskog_diffusion(double eta) { return 1.02704 / (2.0 * sqrt_pi * density(eta) * contact_value(eta)); }

double enskog_viscosity(double eta) {
  const double g = contact_value(eta), b = 2.0 * eta;
  return 1.02195 / (2.0 * sqrt_pi) * (1.0 / g + b + 0.8729 * b * b * g);
}

double enskog_conductivity(double eta) {
  const double g = contact_value(eta), b = 2.0 * eta;
  return 1.02968 * 2.0 / sqrt_pi * (1.0 / g + 1.5 * b + (9.0 / 16.0 + 1.0 / (1.02968 * pi)) * b * b * g);
}

double relative_rate(double speed) {
  // The mean of a Rice distribution: sqrt(pi / 2) e^-q ((1 + 2 q) I0(q) + 2 q I1(q)) with q = v^2 / 4.
  const double q = 0.25 * speed * speed;
  return std::exp(-q) * ((1.0 + 2.0 * q) * boost::math::cyl_bessel_i(0, q) + 2.0 * q * boost::math::cyl_bessel_i(1, q)) /
         std::numbers::sqrt2;
}

double relative_rate(double speed, std::int64_t disks) {
  const auto N = static_cast<double>(disks);
  // The others have the momentum -v, so a mean velocity of -v / (N - 1), and the energy that is left.
  const double left = N - 1.0 - 0.5 * speed * speed * N / (N - 1.0);
  if (left <= 0.0) return 0.0;
  const Microcanonical others(disks - 1, true);
  const double mean_square = 2.0 * left / (N - 1.0), away = speed * N / (N - 1.0);
  const auto at = [&](double u) {
    const double sum = away + u;
    // The mean of |away - u| over the directions of u.
    const double mean = sum > 0.0 ? 2.0 / pi * sum * boost::math::ellint_2(std::min(1.0, 2.0 * std::sqrt(away * u) / sum)) : 0.0;
    return mean * others.speed_density(u, mean_square);
  };
  const double fastest = std::min(12.0, std::sqrt(mean_square * (N - 2.0)));
  double sum = 0.0;
  // The elliptic integral has a weak singularity where u = away.
  for (const auto& [from, to] : {std::pair(0.0, std::min(away, fastest)), std::pair(std::min(away, fastest), fastest)})
    for (int panel = 0; panel < 4; ++panel) {
      const double width = 0.25 * (to - from);
      if (width > 0.0)
        sum += boost::math::quadrature::gauss<double, 30>::integrate(at, from + panel * width, from + (panel + 1) * width);
    }
  return sum / (sqrt_pi * Microcanonical(disks, true).speed_factor());
}

double mean_relative_rate(double from, double to, std::int64_t disks) {
  using Rule = boost::math::quadrature::gauss<double, 10>;
  const Microcanonical law(disks, true);
  const double mean_square = 2.0 * (static_cast<double>(disks) - 1.0) / static_cast<double>(disks);
  const auto weight = [&](double v) { return law.speed_density(v, mean_square); };
  const auto weighted = [&](double v) { return weight(v) * relative_rate(v, disks); };
  return Rule::integrate(weighted, from, to) / Rule::integrate(weight, from, to);
}

double path_ahead() {
  // Flights are weighted with the rate at their speed, instants with the speeds themselves.
  return over_flights([](double v, double rate) { return v / (rate * rate); }) / std::sqrt(pi / 2.0);
}

double flights_longer_within(double time, double run) {
  const double longer = flights_longer_than(time);
  // The integral of the share from `time` on is the mean time by which flights are longer.
  const double beyond = over_flights([&](double, double rate) { return std::exp(-rate * time) / rate; });
  return (longer * (run - time) - beyond) / (run - 1.0);
}

double flights_longer_than(double time) {
  return over_flights([&](double, double rate) { return std::exp(-rate * time); });
}

double flight_time_density(double time) {
  return over_flights([&](double, double rate) { return rate * std::exp(-rate * time); });
}

double flight_length_density(double length) {
  return over_flights([&](double v, double rate) { return rate / v * std::exp(-rate * length / v); });
}

double instantaneous_viscosity(double eta, std::int64_t disks) {
  const double Z = kolafa_rottner_finite(eta, disks);
  return density(eta) * disk_collision_rate(Z) / 8.0 * Microcanonical(disks, true).moment_factor(3.0);
}

double instantaneous_conductivity(double eta, std::int64_t disks) {
  const double Z = kolafa_rottner_finite(eta, disks), N = static_cast<double>(disks);
  return density(eta) * disk_collision_rate(Z) / 4.0 * (1.0 - 2.0 / N) * Microcanonical(disks, true).moment_factor(5.0);
}

namespace {

/// Enskog's longitudinal viscosity, shear and bulk, over the mass density.
double longitudinal_viscosity(double eta) {
  const double rho = density(eta), bulk_viscosity = rho * (kolafa_rottner(eta) - 1.0) / sqrt_pi;
  return (enskog_viscosity(eta) + bulk_viscosity) / rho;
}

/// The shear and sound waves of a square periodic box, with Enskog's coefficients.
class SlowModes {
 public:
  SlowModes(double eta, std::int64_t disks) : disks_(static_cast<double>(disks)) {
    const double Z = kolafa_rottner(eta), rho = density(eta);
    const double D = enskog_diffusion(eta), viscosity = enskog_viscosity(eta), conductivity = enskog_conductivity(eta);
    const double stiffness = 1.0 / structure_factor_at_zero(eta);  // d P / d rho at constant temperature
    // A disk's heat capacity is 1 at constant volume and 1 + Z^2 / stiffness at constant pressure.
    const double excess = Z * Z / stiffness;
    const double damping = 0.5 * (longitudinal_viscosity(eta) + excess * conductivity / (rho * (1.0 + excess)));
    sound_ = sound_speed(eta);
    shear_ = D + viscosity / rho;
    wave_ = D + damping;
    unit_ = 2.0 * pi / std::sqrt(disks_ / rho);
  }

  /// Returns the sum of f(rate of shear waves, rate of sound waves, frequency of sound) over all wave vectors but 0, over twice
  /// the number of disks. Waves that have died out by `earliest` are left out.
  template <class F>
  [[nodiscard]] double sum(double earliest, F&& f) const {
    // exp(-40) is left out.
    const auto reach = static_cast<std::int64_t>(6.5 / (unit_ * std::sqrt(std::min(shear_, wave_) * earliest))) + 2;
    double sum = 0.0;
    for (std::int64_t i = -reach; i <= reach; ++i)
      for (std::int64_t j = -reach; j <= reach; ++j) {
        const double k2 = unit_ * unit_ * static_cast<double>(i * i + j * j);
        if (k2 > 0.0) sum += f(shear_ * k2, wave_ * k2, sound_ * std::sqrt(k2));
      }
    return sum / (2.0 * disks_);
  }

 private:
  double disks_, sound_, shear_, wave_, unit_;
};

}  // namespace

std::complex<double> sound_wave(double eta, double k) {
  // Waves of density n, velocity u along k and temperature T, in units of rho, sqrt(kT / m) and T:
  //   lambda n = -i k u,  lambda u = -i k (stiffness n + Z T) - b u,  lambda T = -i k Z u - a T.
  const double Z = kolafa_rottner(eta), stiffness = 1.0 / structure_factor_at_zero(eta);
  const double a = enskog_conductivity(eta) / density(eta) * k * k, b = longitudinal_viscosity(eta) * k * k;
  const double from_density = stiffness * k * k, from_temperature = Z * Z * k * k;
  std::complex<double> lambda(0.0, sound_speed(eta) * k);
  for (int step = 0; step < 50; ++step) {  // Newton's, from the wave without damping
    const std::complex<double> value = (lambda * (lambda + b) + from_density) * (lambda + a) + from_temperature * lambda;
    const std::complex<double> slope =
        (2.0 * lambda + b) * (lambda + a) + lambda * (lambda + b) + from_density + from_temperature;
    const std::complex<double> change = value / slope;
    lambda -= change;
    if (std::abs(change) <= 1e-15 * std::abs(lambda)) break;
  }
  return lambda;
}

double velocity_correlation_of_modes(double eta, std::int64_t disks, double t) {
  return SlowModes(eta, disks).sum(t, [t](double a, double b, double w) {
    return std::exp(-a * t) + std::cos(w * t) * std::exp(-b * t);
  });
}

double diffusion_growth(double eta, std::int64_t disks, double from, double to) {
  return SlowModes(eta, disks).sum(from, [from, to](double a, double b, double w) {
    const auto to_and_fro = [&](double t) {
      return std::exp(-b * t) * (w * std::sin(w * t) - b * std::cos(w * t)) / (b * b + w * w);
    };
    return (std::exp(-a * from) - std::exp(-a * to)) / a + to_and_fro(to) - to_and_fro(from);
  });
}

double cooling_sonine(double e) { return 16.0 * (1.0 - e) * (1.0 - 2.0 * e * e) / (57.0 - 25.0 * e + 30.0 * e * e * (1.0 - e)); }

double haff_rate(double e, double eta, std::int64_t disks) {
  const auto N = static_cast<double>(disks);
  const double loss = 1.0 - e * e;
  // The disks share (N - 1) kT. A collision takes kT loss of it on average, with twice the square of that as mean square: the
  // mean of T^-1/2 grows by 3/2 loss / N more than in small steps.
  return loss / 4.0 * disk_collision_rate(kolafa_rottner_finite(eta, disks)) * N / (N - 1.0) *
         (1.0 + 3.0 / 16.0 * cooling_sonine(e)) * Microcanonical(disks, true).moment_factor(3.0) * (1.0 + 1.5 * loss / N);
}

double shear_instability(double e, double eta) {
  // k^2 = (2 pi)^2 rho / N, and rho nu is the viscosity.
  const double rate = (1.0 - e * e) / 4.0 * disk_collision_rate(kolafa_rottner(eta));
  return 4.0 * pi * pi * enskog_viscosity(eta) / rate;
}

double haff_slowing(double e, double eta, std::int64_t disks) {
  const double N = static_cast<double>(disks), limit = shear_instability(e, eta);
  const double longest = 2.0 * pi * mean_free_path(eta) / std::sqrt(N / density(eta));  // k of the longest wave, times the path
  const auto reach = static_cast<std::int64_t>(1.0 / longest);
  double excess = 0.0;
  for (std::int64_t i = -reach; i <= reach; ++i)
    for (std::int64_t j = -reach; j <= reach; ++j) {
      const auto square = static_cast<double>(i * i + j * j);
      if (square > 0.0 && square * longest * longest < 1.0) excess += N / (square * limit - N);
    }
  return 1.5 * excess / (2.0 * N);
}

double cooling_kurtosis(double e) { return 2.0 * (1.0 + cooling_sonine(e)); }

}  // namespace carom::theory
