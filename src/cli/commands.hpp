#pragma once
// The program's commands: what each may be asked, and the function that does it.

#include "cli/scene_options.hpp"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::cli {

/// What the program's exit status says.
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,         ///< failed while running
  exit_usage = 2,          ///< the command line, the scene or the place for the results is wrong; nothing was run
  exit_invalid_state = 3,  ///< disks overlap
  exit_check_failed = 4,   ///< a physics check failed
  exit_interrupted = 130,  ///< stopped by a signal; what was done until then is saved
};

/// What the user asked for cannot be done as asked. what() is one sentence.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// How the program was called.
struct Invocation {
  std::string program;       ///< as a user at this place would type it
  std::string command_line;  ///< all of it, quoted for a shell
};

struct RunOptions {
  SceneOptions scene;
  std::string out;  ///< empty: the scene's name without its ending
  bool force = false;
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool verify_horizon = false;
  bool report = false;                  ///< make the page of the run too
  std::optional<std::uint64_t> verify;  ///< events from one check of the invariants to the next; absent: no checks
  std::string progress = "auto";
  std::string method = "exact";  ///< or a fixed-step method
  std::optional<double> dt;      ///< of a fixed-step method; absent: the sampling grid's
  std::optional<int> threads;    ///< 2: observables on one of their own; absent: where there is a second processor
  bool watch = false;
  std::optional<double> pace;                   ///< simulated time per second to watch; absent: as fast as the machine
  std::optional<std::string> checkpoint_every;  ///< "10min" or "1e8 collisions"; absent: only where the run is stopped
  std::optional<std::string> walltime;          ///< after which the run is stopped and saved
};
ExitCode run(const RunOptions& options, const Invocation& invocation);

struct ResumeOptions {
  std::string directory;                    ///< of a run
  std::optional<double> time;               ///< another end than the run's own
  std::optional<std::uint64_t> collisions;  ///< the same
  RunOptions run;                           ///< how to go on: what the checkpoint does not say
};
/// Goes on with a run that was interrupted or killed.
ExitCode resume(const ResumeOptions& options, const Invocation& invocation);
/// Goes on with a run that has come to its end, to a later one.
ExitCode extend(const ResumeOptions& options, const Invocation& invocation);

struct CheckOptions {
  SceneOptions scene;
  bool resolved = false;
};
ExitCode check(const CheckOptions& options);

struct HorizonCommandOptions {
  SceneOptions scene;
  std::optional<std::uint64_t> collisions;  ///< of pairs, for the exponent; absent: half a million, or 100 per disk
  bool json = false;
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode horizon(const HorizonCommandOptions& options);

struct InitOptions {
  std::string preset = "box";
  std::string file;  ///< empty: PRESET.toml; "-": standard output
  bool force = false;
  bool list = false;
};
ExitCode init(const InitOptions& options, const Invocation& invocation);

struct InfoOptions {
  std::string file;
  bool reproduce = false;  ///< print the commands that make the run again, in place of what it holds
};
ExitCode info(const InfoOptions& options, const Invocation& invocation);

struct VerifyOptions {
  std::string directory;  ///< of a finished run
  std::string progress = "auto";
};
ExitCode verify(const VerifyOptions& options, const Invocation& invocation);

/// Shell commands that make the run in `directory` again, in a directory with "-again" behind its name. Throws UsageError.
std::string reproduction(const std::string& directory, const Invocation& invocation);

struct AnalyzeOptions {
  std::string directory;                 ///< of a finished run
  std::vector<std::string> observables;  ///< "NAME" or "NAME={ ... }"; empty: those of the run's scene
  std::string out;                       ///< empty: RUN_DIR-analysis
  bool force = false;
  bool json = false;
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode analyze(const AnalyzeOptions& options, const Invocation& invocation);

struct PlayOptions {
  std::string directory;  ///< of a finished run
  std::string output;     ///< empty: player.html in it
};
ExitCode play(const PlayOptions& options);

struct ReportOptions {
  std::string directory;  ///< of a finished run
  std::string output;     ///< empty: report.html in it
};
ExitCode report(const ReportOptions& options);

struct MovieOptions {
  std::string directory;  ///< of a finished run
  std::string output;     ///< a film or a picture, which its ending says
  bool force = false;
  std::optional<double> fps;    ///< frames per second; absent: 30
  std::optional<double> speed;  ///< simulated time per second; absent: the film lasts 10 s
  std::optional<double> from;   ///< simulated times; absent: the whole run
  std::optional<double> to;
  std::optional<double> at;      ///< of a picture; absent: the last sample
  std::optional<double> trails;  ///< time
  std::string trails_of;         ///< a species; empty: of all
  std::string size;              ///< WxH or the longer side; empty: 1080, of a GIF 480
  std::string colour;            ///< empty: species where there are several, else speed
  bool dark = false;
  bool velocities = false;
  bool bare = false;  ///< no caption
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode movie(const MovieOptions& options);

struct BenchOptions {
  bool json = false;
  bool effects = false;                     ///< the price of each effect, in place of how fast the engines are
  bool large = false;                       ///< a million disks too
  std::vector<std::int64_t> disks;          ///< empty: 1000, 10000, 100000
  std::optional<std::uint64_t> collisions;  ///< in a turn of the textbook engine; absent: 200000, or one per disk
};
ExitCode bench(const BenchOptions& options);

struct HardCasesOptions {
  std::vector<std::string> cases;  ///< names of the corpus or files; empty: all that do not take long
  std::string family;              ///< empty: all
  std::string engine = "auto";     ///< one engine alone
  bool takes_long = false;
  bool list = false;
  std::string show;  ///< the text of this case
  bool json = false;
  bool markdown = false;
  std::string page;          ///< an HTML file to write besides; empty: none
  std::string method;        ///< a fixed-step method in the place of the engines
  std::optional<double> dt;  ///< of it; absent: from each case's speeds
};
ExitCode hardcases(const HardCasesOptions& options, const Invocation& invocation);

struct ValidateCommandOptions {
  bool quick = false;  ///< what it is without --full
  bool full = false;
  std::int64_t seed = 1;
  std::vector<std::string> only;  ///< names of trials; empty: all
  std::string out;                ///< empty: validation
  bool list = false;
  bool force = false;
  bool resume = false;
  bool json = false;
  bool markdown = false;
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode validate(const ValidateCommandOptions& options, const Invocation& invocation);

struct CompareCommandOptions {
  SceneOptions scene;
  std::string out;          ///< empty: the scene's name without its ending, and "-compare"
  std::vector<double> dts;  ///< empty: the usual ladder
  std::int64_t seeds = 8;
  double longest = 0.5;             ///< seconds
  std::optional<std::string> play;  ///< METHOD[:DT], or empty: make the page on which that flies beside exact events
  bool no_costs = false;
  bool force = false;
  bool resume = false;
  bool json = false;
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode compare(const CompareCommandOptions& options, const Invocation& invocation);

struct SweepCommandOptions {
  std::string path;              ///< of the sweep file
  std::string out;               ///< empty: the sweep file's name without its ending
  std::optional<int> threads;    ///< runs at a time; absent: one per processor, under MPI one per process
  std::string checkpoint_every;  ///< of each run, "10min" or "1e8 collisions"; empty: only when it is stopped
  bool force = false;
  bool list = false;  ///< print the commands of the runs that are still to do, in place of running them
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode sweep(const SweepCommandOptions& options, const Invocation& invocation);

}  // namespace carom::cli
