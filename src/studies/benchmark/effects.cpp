// carom bench --effects: the cost of an effect at its neutral value, and where it acts. Three engines take turns on one gas: the
// lean engine without effects; the engine with all effects, this one at its neutral value; and the same engine with this effect
// acting. The results are ratios of their times per collision, so that other load of the machine meets all three.

#include "studies/benchmark/command.hpp"

#include "studies/benchmark/priced_effects.hpp"
#include "studies/benchmark/timed_engine.hpp"
#include "terminal/progress.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carom::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr double priced_packing_fractions[] = {0.3, 0.6};
constexpr int rounds = 7;
constexpr std::int64_t usual_disks = 10'000;

/// Collisions in a turn: some hundredths of a second.
constexpr std::uint64_t usual_effects_turn = 60'000;

struct Ratio {
  double median;
  double least;
  double most;
};

/// Turn by turn, how many times as long as the first a collision of the second takes.
Ratio ratio_of(const TimedEngine& lean, const TimedEngine& other) {
  std::vector<double> ratios;
  for (std::size_t turn = 0; turn < lean.rates().size(); ++turn) ratios.push_back(lean.rates()[turn] / other.rates()[turn]);
  std::sort(ratios.begin(), ratios.end());
  return {ratios[ratios.size() / 2], ratios.front(), ratios.back()};
}

/// Returns the gas as one of two species of equal disks, which begins as the gas does: what acts between species has some to act
/// on, and nothing else knows of them.
Scene of_two_species(Scene gas) {
  const State start = make_simulation(gas, "fast").state();
  std::vector<Species> halves;
  for (Eigen::Index begin = 0; const Eigen::Index end : {start.positions.cols() / 2, start.positions.cols()}) {
    Species& half = halves.emplace_back(gas.species.front());
    half.name = halves.size() == 1 ? "one half" : "other half";
    half.count = end - begin;
    ListedPositions positions;
    ListedVelocities velocities;
    for (Eigen::Index i = begin; i < end; ++i) {
      positions.values.emplace_back(start.positions.col(i));
      velocities.values.emplace_back(start.velocities.col(i));
    }
    half.positions = positions;
    half.velocities = velocities;
    begin = end;
  }
  gas.species = halves;
  return gas;
}

/// Times the lean engine, the general one with the effect at its neutral value, and one with the effect acting, in turns.
class EffectTiming {
 public:
  EffectTiming(const Scene& gas, const PricedEffect& effect, std::uint64_t turn) : effect_(effect), turn_(turn) {
    const auto run_up = std::max(10 * static_cast<std::uint64_t>(gas.disk_count()), turn);
    lean_.emplace(gas, "fast", run_up);
    if (effect.neutral) neutral_.emplace(with(gas, *effect.neutral), "general", run_up);
    if (effect.acting) acting_.emplace(with(gas, *effect.acting), "auto", run_up);
  }

  void take_turn() {
    for (TimedEngine* engine : engines()) engine->take_turn(turn_);
    // The order is reversed in turn: each finds the caches as the one before has left them.
    first_ = (first_ + 1) % 3;
  }

  /// Returns whether the neutral value has left the bits as they are.
  [[nodiscard]] bool same_bits() const { return !neutral_ || same_bits(lean_->state(), neutral_->state()); }

  /// Returns what is wrong with an answer, in one sentence; empty where all are right. Requires a turn.
  [[nodiscard]] std::string fault() const {
    if (!same_bits()) return fmt::format("{}: its neutral value leaves other bits than the engine without it", effect_.name);
    if (acting_ && same_bits(lean_->state(), acting_->state()))
      return fmt::format("{}: nothing shows that it acts", effect_.name);
    for (const std::optional<TimedEngine>* engine : {&lean_, &neutral_, &acting_})
      if (const std::string wrong = *engine ? (*engine)->fault() : ""; !wrong.empty())
        return fmt::format("{}: {}", effect_.name, wrong);
    return "";
  }

  [[nodiscard]] const TimedEngine& lean() const { return *lean_; }
  [[nodiscard]] std::optional<Ratio> neutral() const {
    return neutral_ ? std::optional(ratio_of(*lean_, *neutral_)) : std::nullopt;
  }
  [[nodiscard]] std::optional<Ratio> acting() const { return acting_ ? std::optional(ratio_of(*lean_, *acting_)) : std::nullopt; }
  [[nodiscard]] std::string acting_engine() const { return acting_ ? acting_->engine() : ""; }

 private:
  static Scene with(Scene gas, const Effects& effects) {
    gas.effects = effects;
    return gas;
  }

  static bool same_bits(const State& a, const State& b) {
    return a.time == b.time && a.positions == b.positions && a.remainders == b.remainders && a.velocities == b.velocities &&
           a.images == b.images;
  }

  /// Returns the three in the order of this turn.
  std::vector<TimedEngine*> engines() {
    std::vector<TimedEngine*> all;
    for (std::optional<TimedEngine>* engine : {&lean_, &neutral_, &acting_})
      if (*engine) all.push_back(&**engine);
    std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first_ % all.size()), all.end());
    return all;
  }

  const PricedEffect& effect_;
  std::uint64_t turn_;
  std::size_t first_ = 0;
  std::optional<TimedEngine> lean_, neutral_, acting_;
};

struct Price {
  std::string effect;
  std::string value;
  bool walled = false;
  double packing_fraction = 0.0;
  double lean_seconds = 0.0;  ///< per collision
  std::optional<Ratio> neutral, acting;
  std::string acting_engine;
};

Json json_of(const std::optional<Ratio>& ratio) {
  if (!ratio) return nullptr;
  return {{"ratio", ratio->median}, {"least", ratio->least}, {"most", ratio->most}};
}

Json json_of(const Price& price) {
  return {{"effect", price.effect},
          {"value", price.value},
          {"box", price.walled ? "walls" : "periodic"},
          {"packing_fraction", price.packing_fraction},
          {"lean_seconds_per_collision", price.lean_seconds},
          {"neutral", json_of(price.neutral)},
          {"acting", json_of(price.acting)},
          {"acting_engine", price.acting ? Json(price.acting_engine) : Json(nullptr)}};
}

void print_heading(std::int64_t disks) {
  fmt::print("{}\n\n", measured_on());
  fmt::print(
      "Time of a pair collision on one core, {} equal disks, as a ratio to that of the engine without effects on the same gas:\n"
      "the effect at its neutral value (the bits are the same), and acting. Medians of {} turns.\n\n"
      "| box      | packing fraction | effect                      |  neutral |   acting | acting at                       |\n"
      "|----------|------------------|-----------------------------|----------|----------|---------------------------------|\n",
      grouped(static_cast<std::uint64_t>(disks)), rounds);
  std::fflush(stdout);
}

void print_row(const Price& price) {
  const auto words = [](const std::optional<Ratio>& ratio) { return ratio ? fmt::format("{:.2f}", ratio->median) : "-"; };
  fmt::print("| {:<8} | {:<16} | {:<27} | {:>8} | {:>8} | {:<31} |\n", price.walled ? "walls" : "periodic",
             price.packing_fraction, price.effect, words(price.neutral), words(price.acting),
             price.acting_engine == "textbook" ? price.value + " (textbook)" : price.value);
  std::fflush(stdout);
}

std::int64_t disks_of(const BenchOptions& options) {
  if (options.large || options.disks.size() > 1)
    throw UsageError("--effects: it is measured at one size; give --disks once, or not");
  if (options.collisions == 0) throw UsageError("--collisions 0: a speed needs some collisions");
  const std::int64_t disks = options.disks.empty() ? usual_disks : options.disks.front();
  if (disks < 16 || disks > 10'000'000) throw UsageError(fmt::format("--disks {}: it can be 16 to 10,000,000", disks));
  return disks;
}

}  // namespace

ExitCode bench_effects(const BenchOptions& options) {
  const std::int64_t disks = disks_of(options);
  const std::uint64_t turn = options.collisions.value_or(std::max(usual_effects_turn, static_cast<std::uint64_t>(disks)));
  const StatusLine status;
  Json json = measured_on_json();
  json["disks"] = disks;
  json["turns"] = rounds;
  json["rows"] = Json::array();
  json["failed"] = Json::array();
  if (!options.json) print_heading(disks);
  for (const bool walled : {false, true}) {
    for (const double packing_fraction : priced_packing_fractions) {
      Scene gas = bench_scene(disks, packing_fraction);
      if (walled) gas.box.boundary = {Boundary::walls, Boundary::walls};
      gas = of_two_species(std::move(gas));
      for (const PricedEffect& effect : priced_effects(gas)) {
        status.show(fmt::format("packing fraction {}: {}", packing_fraction, effect.name));
        EffectTiming timing(gas, effect, turn);
        for (int k = 0; k < rounds && timing.same_bits(); ++k) timing.take_turn();
        status.show("");
        if (const std::string fault = timing.fault(); !fault.empty()) {
          json["failed"].push_back(fault);
          fmt::print(stderr, "carom: {}; its price says nothing\n", fault);
          continue;
        }
        const Price price{.effect = effect.name,
                          .value = effect.value,
                          .walled = walled,
                          .packing_fraction = packing_fraction,
                          .lean_seconds = 1.0 / timing.lean().median_rate(),
                          .neutral = timing.neutral(),
                          .acting = timing.acting(),
                          .acting_engine = timing.acting_engine()};
        json["rows"].push_back(json_of(price));
        if (!options.json) print_row(price);
      }
    }
  }
  if (options.json) fmt::print("{}\n", json.dump(2));
  return json["failed"].empty() ? exit_done : exit_check_failed;
}

}  // namespace carom::cli
