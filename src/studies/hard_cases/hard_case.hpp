#pragma once
// A hard case as plain data: a scene with exact numbers, what must hold when it is run, why it is hard and where it comes from.
// The corpus is tests/hard_cases, one file per case; docs/hard-cases.md says how to read, run and add one.

#include <carom/state.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// A collision that must happen: its time and the two partners.
struct ExpectedEvent {
  double time = 0.0;
  std::int32_t disk = 0;
  std::int32_t partner = 0;  ///< a higher id, a Wall, or first_obstacle - k
};

/// A number that must come out, to within `bound`, relative to itself where it is not 0.
struct ExpectedNumber {
  double value = 0.0;
  double bound = 0.0;
};

/// When a sample would be taken, however far beyond the end of the run.
struct LateSample {
  std::uint64_t number = 0;
  double time = 0.0;
};

/// The expectations of a hard case. An expectation that is absent is not checked. Bounds are those of double precision, and 2^29
/// times as wide in single.
struct Expectations {
  std::optional<std::string> refused;       ///< the scene is refused with a sentence that holds this
  std::string stopped;                      ///< to_string(StopReason)
  std::vector<std::int32_t> stopped_disks;  ///< disks that a run names where it jammed or collapsed; empty: not checked
  std::optional<ExpectedNumber> stop_time;

  std::optional<std::uint64_t> pair, wall, obstacle, well;  ///< collisions and passages, exactly
  std::optional<std::uint64_t> boundaries;                  ///< wall and pair together, where their order is rounding's
  std::vector<ExpectedEvent> events;                        ///< the first of them
  double event_ulps = 0.0;                                  ///< tolerance of event times, in units in the last place
  std::uint64_t same_events = 10'000;                       ///< number of first events that are the same in every engine

  double overlap = 1e-12;          ///< deepest, in contact distances, at samples and ends
  std::optional<double> energy;    ///< relative drift that nothing explains
  std::optional<double> momentum;  ///< change over sum of m |v|
  Eigen::Matrix4Xd final_state;    ///< x, y, vx, vy of every disk; no columns: not asked
  double final_within = 0.0;       ///< positions in box lengths, velocities in the largest speed at the start; 0: every bit
  std::optional<double> returns;   ///< bound as for `final`: the end is the start
  /// bound as for `final`: with velocities reversed at the end, the same time leads back to the start
  std::optional<double> reversed;
  std::optional<double> relabelled;  ///< bound as for `final`: disks in another order end at the same positions
  std::optional<std::uint64_t> samples;
  std::optional<double> last_sample;      ///< time of the last sample, exactly
  std::optional<LateSample> late_sample;  ///< exactly
  std::optional<ExpectedNumber> Z;  ///< Z to within five standard errors of the run itself, and the bound relative to the value
};

struct HardCase {
  std::string name;                  ///< the file's stem
  std::string family;                ///< one of hard_case_families()
  std::string title;                 ///< the statement of the case
  std::string why;                   ///< it is hard
  std::string source;                ///< source of the case or of its answer
  std::vector<std::string> engines;  ///< engines to run; empty: every engine that covers the scene
  int bits = 24;                     ///< the fewest of a number with which the answer is the one expected
  bool takes_long = false;
  std::string file;   ///< or where the text came from
  std::string text;   ///< text of the file as it was read
  std::string scene;  ///< text without [case] and [expect], with unchanged line numbers
  Expectations expect;
};

/// Returns all families: "contact", "coincidence", "scale", "density", "long-time", "many-events", "exact"
const std::vector<std::string>& hard_case_families();

/// Reads a case. Throws SceneError where it is not one.
HardCase read_hard_case(const std::string& text, const std::string& file);
HardCase load_hard_case(const std::string& path);

/// Returns the corpus as it was when the library was built, ordered by family, then name.
const std::vector<HardCase>& hard_case_corpus();

/// One thing that was checked, in one engine.
struct CaseCheck {
  std::string what;  ///< "overlap", "final", "same events"
  std::string engine;
  double value = 0.0;  ///< measured, 0 being perfect
  double bound = 0.0;
  bool holds = true;
  bool invariant = false;  ///< whether the check is one of every scene, and not an expectation of this case
  std::string remark;      ///< what was found and what was expected, where the check fails
};

struct CaseVerdict {
  std::string name, family, title;
  std::vector<std::string> engines;
  std::vector<CaseCheck> checks;
  double seconds = 0.0;

  [[nodiscard]] bool holds() const;
  [[nodiscard]] bool keeps_invariants() const;
  /// Returns the check that is nearest to its bound or beyond it; null where there is none.
  [[nodiscard]] const CaseCheck* worst() const;
};

/// Runs a case in every engine that it asks for and that covers it, or in `engine` alone. Never throws for what the case does.
/// `proceed` is asked several times a second; false interrupts the runs, which then fail for having been.
CaseVerdict run_hard_case(const HardCase& hard_case, const std::string& engine = "auto",
                          const std::function<bool()>& proceed = {});

}  // namespace carom
