#include "studies/validate/validation.hpp"

#include "core/seconds.hpp"
#include "studies/validate/in_threads.hpp"

#include <fmt/format.h>
#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

namespace carom {

namespace validation {

const std::vector<Trial>& all_trials() {
  static const std::vector<Trial> trials = [] {
    std::vector<Trial> list;
    add_maxwell_boltzmann(list);
    add_reversal(list);
    add_equation_of_state(list);
    add_single_file(list);
    add_collisions(list);
    add_lorentz_paths(list);
    add_transport(list);
    add_sound(list);
    add_lorentz_diffusion(list);
    add_cooling_fields_walls(list);
    add_flows(list);
    add_rough_gas(list);
    add_fluctuations(list);
    add_percolation(list);
    add_chaos(list);
    add_fixed_steps(list);
    return list;
  }();
  return trials;
}

}  // namespace validation

std::size_t Validation::checks() const {
  std::size_t sum = 0;
  for (const TrialResult& result : results)
    sum += static_cast<std::size_t>(std::count_if(result.checks.begin(), result.checks.end(),
                                                  [](const Check& check) { return check.judged != Judged::shown; }));
  return sum;
}

std::size_t Validation::failed() const {
  std::size_t sum = 0;
  for (const TrialResult& result : results)
    sum += static_cast<std::size_t>(
        std::count_if(result.checks.begin(), result.checks.end(), [](const Check& check) { return !check.holds(); }));
  return sum;
}

std::string group_in_one_word(std::string group) {
  std::replace(group.begin(), group.end(), ' ', '-');
  return group;
}

std::vector<validation::Trial> chosen_trials(const ValidateOptions& options) {
  std::vector<validation::Trial> trials;
  const auto& all = validation::all_trials();
  for (const std::string& name : options.only)
    if (std::none_of(all.begin(), all.end(), [&](const validation::Trial& trial) {
          return trial.name == name || trial.group == name || group_in_one_word(trial.group) == name;
        }))
      throw std::invalid_argument(name);
  const auto asked_for = [&](const std::string& name) {
    return std::find(options.only.begin(), options.only.end(), name) != options.only.end();
  };
  for (const validation::Trial& trial : all) {
    const bool with_its_group = options.only.empty() || asked_for(trial.group) || asked_for(group_in_one_word(trial.group));
    if (asked_for(trial.name) || (with_its_group && (options.full || !trial.only_full))) trials.push_back(trial);
  }
  return trials;
}

namespace {

/// The trials of one validation while they run on several threads.
class RunningTrials {
 public:
  RunningTrials(const ValidateOptions& options, const ValidateHooks& hooks, const Validation& before)
      : options_(options), hooks_(hooks), trials_(chosen_trials(options)), found_(trials_.size()) {
    for (std::size_t k = 0; k < trials_.size(); ++k) {
      const auto known = std::find_if(before.results.begin(), before.results.end(),
                                      [&](const TrialResult& result) { return result.trial == trials_[k].name; });
      if (known != before.results.end())
        found_[k] = *known, finished_ += trials_[k].length;
      else
        (trials_[k].on_all_processors ? alone_ : together_).push_back(k);
    }
  }

  /// Runs all trials that are not known. Returns false where ValidateHooks::proceed did.
  bool run() {
    const unsigned threads =
        options_.threads > 0 ? static_cast<unsigned>(options_.threads) : std::max(1U, std::thread::hardware_concurrency());
    return run(together_, threads) && run(alone_, 1);
  }

  /// Returns what has been found, in the order of the trials.
  [[nodiscard]] std::vector<TrialResult> results() const {
    std::vector<TrialResult> list;
    for (const std::optional<TrialResult>& result : found_)
      if (result) list.push_back(*result);
    return list;
  }

 private:
  bool run(const std::vector<std::size_t>& which, unsigned threads) {
    return validation::in_threads(
        which.size(), threads, [&] { return proceed(); },
        [&](std::size_t k, const std::function<bool()>& proceed) { run_one(which[k], proceed); });
  }

  void run_one(std::size_t k, const std::function<bool()>& proceed) {
    {
      const std::scoped_lock lock(mutex_);
      running_[k] = 0.0;
    }
    const auto start = std::chrono::steady_clock::now();
    TrialResult result{.trial = trials_[k].name};
    try {
      if (!proceed()) throw validation::Interrupted{};
      const auto has_done = [this, k](double fraction) {
        const std::scoped_lock lock(mutex_);
        running_[k] = std::max(running_[k], fraction);
      };
      result = trials_[k].run({.full = options_.full, .seed = options_.seed, .proceed = proceed, .has_done = has_done});
    } catch (const validation::Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      result.checks.push_back({.name = "trials that ran to their end",
                               .theory = fmt::format("it ended with an error: {}", error.what()),
                               .expected = 1.0,
                               .measured = {0.0, 0.0}});
    }
    result.seconds = seconds_since(start);
    const std::scoped_lock lock(mutex_);
    if (hooks_.done) hooks_.done(result);
    found_[k] = std::move(result);
    running_.erase(k);
    finished_ += trials_[k].length;
  }

  bool proceed() {
    if (!hooks_.proceed) return true;
    std::string doing;
    double fraction;
    {
      const std::scoped_lock lock(mutex_);
      if (!running_.empty()) doing = trials_[running_.begin()->first].name;
      double done = finished_, all = 0.0;
      for (const auto& [k, part] : running_) done += part * trials_[k].length;
      for (const validation::Trial& trial : trials_) all += trial.length;
      fraction = done / all;
    }
    return hooks_.proceed(doing, fraction);
  }

  const ValidateOptions& options_;
  const ValidateHooks& hooks_;
  const std::vector<validation::Trial> trials_;
  std::vector<std::size_t> together_, alone_;  ///< numbers of the trials that are not known
  std::mutex mutex_;                           ///< of what follows
  std::vector<std::optional<TrialResult>> found_;
  std::map<std::size_t, double> running_;  ///< how much of each trial that runs is done, from 0 to 1
  double finished_ = 0.0;                  ///< lengths of the trials that are
};

}  // namespace

Validation validate(const ValidateOptions& options, const ValidateHooks& hooks, const Validation& before) {
  RunningTrials trials(options, hooks, before);
  const bool complete = trials.run();
  return {.options = options, .results = trials.results(), .complete = complete};
}

std::string group_of(const TrialResult& result) {
  for (const validation::Trial& trial : validation::all_trials())
    if (trial.name == result.trial) return trial.group;
  return {};
}

std::vector<GroupFit> group_fits(const Validation& validation) {
  std::vector<GroupFit> fits;
  for (const TrialResult& result : validation.results) {
    const auto check =
        std::find_if(result.checks.begin(), result.checks.end(), [](const Check& one) { return one.calibrates(); });
    if (check == result.checks.end()) continue;
    const std::string group = group_of(result);
    if (fits.empty() || fits.back().group != group) fits.push_back({.group = group});
    ++fits.back().trials;
    fits.back().mean_square += check->z() * check->z();
  }
  constexpr std::size_t fewest = 5;  // fewer say little: the mean of three lies between 0.07 and 3.1
  fits.erase(std::remove_if(fits.begin(), fits.end(), [](const GroupFit& fit) { return fit.trials < fewest; }), fits.end());
  for (GroupFit& fit : fits) {
    const auto trials = static_cast<double>(fit.trials);
    const boost::math::chi_squared chi_squared(trials);
    fit.mean_square /= trials;
    fit.least = quantile(chi_squared, 0.025) / trials;
    fit.most = quantile(chi_squared, 0.975) / trials;
  }
  return fits;
}

namespace {

/// Returns a value with as many decimals as the second digit of the error has.
std::string number(double value, double error) {
  if (!std::isfinite(value)) return "no number";
  if (!(error > 0.0) || !std::isfinite(error)) return fmt::format("{:.6g}", value);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 12);
  return fmt::format("{:.{}f}", value, decimals);
}

std::string verdict_of(const Check& check) {
  switch (check.judged) {
    case Judged::agrees:
      return !check.fits() ? "FAILS" : check.too_uncertain() ? "TOO UNCERTAIN" : "agrees";
    case Judged::disagrees:
      return check.fits() ? "FITS, and must not" : "fails, as it must";
    case Judged::shown:
      return check.fits() ? "consistent (not judged)" : "differs (not judged)";
  }
  return {};
}

std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

}  // namespace

CheckRow row_of(const Check& check) {
  CheckRow row{.name = check.name, .theory = check.theory, .source = check.source};
  const double value = check.measured.value, error = check.measured.error;
  row.measured = error > 0.0 && std::isfinite(value) ? number(value, error) + " ± " + number(error, error) : number(value, 0.0);
  row.expected = check.equivalent ? "see theory" : number(check.expected, error);
  if (!check.equivalent && check.reference_error > 0.05 * error)
    row.expected = number(check.expected, check.error()) + " ± " + number(check.reference_error, check.reference_error);
  const auto in_errors = [&](double deviation) {
    if (std::isfinite(deviation)) return check.error() > 0.0 || check.equivalent ? fmt::format("{:+.1f}", deviation) : "equal";
    return std::string(std::isfinite(value) && std::isfinite(error) ? "not equal" : "unknown");
  };
  row.z = in_errors(check.z());
  if (!check.equivalent && check.expected != 0.0 && std::isfinite(value))
    row.per_cent = fmt::format("{:+.2g} %", 100.0 * (value / check.expected - 1.0));
  if (check.allowance > 0.0) {
    row.allowance = fmt::format("{:.2g}: {}", check.allowance, check.allowance_for);
    row.beyond = std::isfinite(check.deviation()) ? fmt::format("{:+.1f}", check.deviation()) : in_errors(check.deviation());
  }
  row.verdict = verdict_of(check);
  return row;
}

std::string sentence_of(const Check& check) {
  const CheckRow row = row_of(check);
  const bool statistic = check.equivalent.has_value(), counted = check.error() > 0.0 || statistic;
  std::string text = fmt::format("{}: {}, ", row.name, row.measured);
  text += statistic ? "theory: " + row.theory : "expected " + row.expected;
  text += counted ? "; z = " + row.z : "; " + (row.z == "equal" ? "exactly equal" : row.z);
  if (!row.per_cent.empty() && row.z != "equal") text += fmt::format(" ({})", row.per_cent);
  if (check.allowance > 0.0)
    text += counted ? fmt::format(", {} beyond the allowance of {:.2g}", row.beyond, check.allowance)
                    : fmt::format(", {} the allowance of {:.2g}", check.fits() ? "within" : "beyond", check.allowance);
  if (check.too_uncertain()) text += fmt::format(", and the error is to be at most {:.2g}", check.largest_error);
  return text;
}

std::string sentence_of(const GroupFit& fit) {
  return fmt::format("chi squared per trial {:.2f} ({} trials; {:.2f} to {:.2f} in 19 of 20 cases)", fit.mean_square, fit.trials,
                     fit.least, fit.most);
}

std::string summary_of(const Validation& validation) {
  const std::size_t failed = validation.failed();
  double seconds = 0.0;
  for (const TrialResult& result : validation.results) seconds += result.seconds;
  const auto counted = [](std::size_t number, const char* thing) {
    return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
  };
  return fmt::format("{} in {}, seed {}: {}; {:.0f} s of trials", counted(validation.checks(), "check"),
                     counted(validation.results.size(), "trial"), validation.options.seed,
                     failed == 0 ? "all hold" : fmt::format("{} FAIL", failed), seconds);
}

std::string validation_markdown(const Validation& validation) {
  std::string text, group;
  for (const TrialResult& result : validation.results) {
    for (const validation::Trial& trial : validation::all_trials()) {
      if (trial.name != result.trial || trial.group == group) continue;
      group = trial.group;
      text += fmt::format(
          "\n### {}\n\n| what | theory | expected | measured | z | per cent | allowance | z beyond it | verdict |\n"
          "|---|---|---|---|---|---|---|---|---|\n",
          group);
    }
    for (const Check& check : result.checks) {
      const CheckRow row = row_of(check);
      text +=
          fmt::format("| {} | {}; {} | {} | {} | {} | {} | {} | {} | {} |\n", cell(row.name), cell(row.theory), cell(row.source),
                      row.expected, row.measured, row.z, row.per_cent, cell(row.allowance), row.beyond, row.verdict);
    }
  }
  text += "\n" + summary_of(validation) + ".\n";
  for (const GroupFit& fit : group_fits(validation)) text += fmt::format("{}: {}.\n", fit.group, sentence_of(fit));
  return text;
}

}  // namespace carom
