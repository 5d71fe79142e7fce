// Runs one case in all its engines and gathers the verdict.

#include "studies/hard_cases/hard_case.hpp"

#include "core/seconds.hpp"
#include "studies/hard_cases/checks.hpp"
#include "studies/hard_cases/run.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

namespace carom {

namespace {

/// A case that is not said to take long has come to its end by then; one that has not never will.
constexpr std::uint64_t most_events = 200'000'000;

CaseCheck refusal(const HardCase& hard_case, const std::string& engine, const std::string& sentence) {
  const auto& expected = hard_case.expect.refused;
  const bool holds = expected && sentence.find(*expected) != std::string::npos;
  return {.what = "refused",
          .engine = engine,
          .value = holds ? 0.0 : 1.0,
          .holds = holds,
          .remark = holds      ? ""
                    : expected ? fmt::format("\"{}\" in place of \"{}\"", sentence, *expected)
                               : sentence};
}

CaseCheck no_refusal(const HardCase& hard_case, const std::string& engine) {
  return {.what = "refused",
          .engine = engine,
          .value = 1.0,
          .holds = false,
          .remark = fmt::format("it ran; expected was \"{}\"", *hard_case.expect.refused)};
}

bool asks_for(const HardCase& hard_case, const std::string& engine, const std::string& only) {
  if (only != "auto" && engine != only) return false;
  if (hard_case.engines.empty()) return bits_of_engine(engine) >= hard_case.bits;
  return std::find(hard_case.engines.begin(), hard_case.engines.end(), engine) != hard_case.engines.end();
}

void append(std::vector<CaseCheck>& all, std::vector<CaseCheck> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

class Trial {
 public:
  Trial(const HardCase& hard_case, CaseVerdict& verdict, const std::function<bool()>& proceed)
      : hard_case_(hard_case), verdict_(verdict), proceed_(proceed) {}

  void run(const std::string& only) {
    try {
      const Scene scene = parse_scene(hard_case_.scene, hard_case_.file);
      for (const std::string& engine : engine_names())
        if (asks_for(hard_case_, engine, only)) run_in(engine, scene);
      append(verdict_.checks, checks_of_order(hard_case_, runs_));
    } catch (const SceneError& error) {
      verdict_.checks.push_back(refusal(hard_case_, "scene", error.what()));
    }
  }

 private:
  void run_in(const std::string& engine, const Scene& scene) {
    try {
      const std::uint64_t most = hard_case_.takes_long ? std::numeric_limits<std::uint64_t>::max() : most_events;
      const std::uint64_t kept = std::max<std::uint64_t>(hard_case_.expect.same_events, hard_case_.expect.events.size());
      EngineRun run =
          run_in_engine(scene, engine, {.events = kept, .most_events = most, .look_for_faults = true, .proceed = proceed_});
      verdict_.engines.push_back(engine);
      if (hard_case_.expect.refused) return verdict_.checks.push_back(no_refusal(hard_case_, engine));
      append(verdict_.checks, checks_of_run(hard_case_, scene, run));
      append(verdict_.checks, checks_of_reruns(hard_case_, scene, run));
      runs_.push_back(std::move(run));
    } catch (const std::invalid_argument& error) {
      // The engine does not cover the scene; that is a failure only where it was asked for by name.
      if (!hard_case_.engines.empty()) verdict_.checks.push_back(refusal(hard_case_, engine, error.what()));
    } catch (const std::exception& error) {
      verdict_.checks.push_back(refusal(hard_case_, engine, error.what()));
      verdict_.engines.push_back(engine);
    }
  }

  const HardCase& hard_case_;
  CaseVerdict& verdict_;
  const std::function<bool()>& proceed_;
  std::vector<EngineRun> runs_;
};

}  // namespace

bool CaseVerdict::holds() const {
  return std::all_of(checks.begin(), checks.end(), [](const CaseCheck& check) { return check.holds; });
}

bool CaseVerdict::keeps_invariants() const {
  return std::all_of(checks.begin(), checks.end(), [](const CaseCheck& check) { return check.holds || !check.invariant; });
}

const CaseCheck* CaseVerdict::worst() const {
  const auto badness = [](const CaseCheck& check) {
    if (!check.holds) return std::numeric_limits<double>::infinity();
    return check.bound > 0.0 ? check.value / check.bound : 0.0;
  };
  const auto worse = [&](const CaseCheck& a, const CaseCheck& b) { return badness(a) < badness(b); };
  const auto worst = std::max_element(checks.begin(), checks.end(), worse);
  return worst == checks.end() ? nullptr : &*worst;
}

CaseVerdict run_hard_case(const HardCase& hard_case, const std::string& engine, const std::function<bool()>& proceed) {
  const auto began = std::chrono::steady_clock::now();
  CaseVerdict verdict{.name = hard_case.name, .family = hard_case.family, .title = hard_case.title, .engines = {}, .checks = {}};
  Trial(hard_case, verdict, proceed).run(engine);
  verdict.seconds = seconds_since(began);
  return verdict;
}

}  // namespace carom
