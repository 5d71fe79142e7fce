#pragma once
// The commands that are of one scene or one run: what each may be asked, and the function that does it.

#include "terminal/command.hpp"
#include "terminal/scene_options.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

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
  std::string method = "exact";     ///< or a fixed-step method
  std::optional<double> dt;         ///< time step of a fixed-step method; absent: that of the sampling grid
  std::optional<double> stiffness;  ///< of the springs of the method soft; absent: such that a contact takes 30 steps
  std::string threads = "auto";     ///< as threads_in() reads it
  bool watch = false;
  std::optional<double> pace;                   ///< simulated time per second to watch; absent: as fast as the machine
  std::optional<std::string> checkpoint_every;  ///< "10min" or "1e8 collisions"; absent: only where the run is stopped
  std::optional<std::string> walltime;          ///< after which the run is stopped and saved
  std::string changes;                          ///< file of changes to make on the way; empty: none
};
ExitCode run(const RunOptions& options, const Invocation& invocation);

/// Runs the scene with the changes of options.changes at their times, up to run.time, and prints how it ended. Writes samples.csv
/// where the scene samples and asks for it, and nothing else. Throws UsageError for options that only other runs have; SceneError
/// where the list or one of its changes is wrong, before or during the run.
ExitCode run_with_changes(const RunOptions& options);

struct ResumeOptions {
  std::string directory;                    ///< directory of a run
  std::optional<double> time;               ///< another end than the run's own
  std::optional<std::uint64_t> collisions;  ///< number of pair collisions at which the run is to end
  RunOptions run;                           ///< options that the checkpoint does not hold
};
/// Goes on with a run that was interrupted or killed.
ExitCode resume(const ResumeOptions& options, const Invocation& invocation);
/// Goes on with a run that has come to its end, to a later one.
ExitCode extend(const ResumeOptions& options, const Invocation& invocation);

struct CheckOptions {
  SceneOptions scene;
  bool resolved = false;
  bool quiet = false;
};
ExitCode check(const CheckOptions& options);

struct InitOptions {
  std::string preset = "box";
  std::string file;  ///< empty: PRESET.toml; "-": standard output
  bool force = false;
  bool list = false;
  bool quiet = false;
};
ExitCode init(const InitOptions& options, const Invocation& invocation);

struct InfoOptions {
  std::string file;
  bool reproduce = false;  ///< print the commands that make the run again, in place of what it holds
};
ExitCode info(const InfoOptions& options, const Invocation& invocation);

struct VerifyOptions {
  std::string directory;  ///< directory of a finished run
  bool json = false;
  bool quiet = false;
  std::string progress = "auto";
};
ExitCode verify(const VerifyOptions& options, const Invocation& invocation);

/// Shell commands that make the run in `directory` again, in a directory with "-again" behind its name. Throws UsageError.
std::string reproduction(const std::string& directory, const Invocation& invocation);

struct PlayOptions {
  std::string directory;  ///< directory of a finished run
  std::string output;     ///< empty: player.html in it
  bool open = false;      ///< open the page in a browser too
  bool quiet = false;
};
ExitCode play(const PlayOptions& options);

struct PlaygroundOptions {
  std::vector<std::string> scenes;  ///< scene files to put into the page, before its own
  std::string output;               ///< empty: playground.html
  bool open = false;                ///< open the page in a browser too
  bool quiet = false;
};
ExitCode playground(const PlaygroundOptions& options);

struct ReportOptions {
  std::string directory;  ///< directory of a finished run
  std::string output;     ///< empty: report.html in it
  bool open = false;      ///< open the page in a browser too
  bool quiet = false;
};
ExitCode report(const ReportOptions& options);

struct MovieOptions {
  std::string directory;  ///< directory of a finished run
  std::string output;     ///< a film or a picture, which its ending says; empty: movie.mp4 in it, or picture.png
  bool force = false;
  std::optional<double> fps;    ///< frames per second; absent: 30
  std::optional<double> speed;  ///< simulated time per second; absent: the film lasts 10 s
  std::optional<double> from;   ///< simulated times; absent: the whole run
  std::optional<double> to;
  std::optional<double> at;      ///< time of a picture; absent: the last sample
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

}  // namespace carom::cli
