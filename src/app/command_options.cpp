// The commands and their options, as the parser wants them told. With arguments.cpp the only file that includes the parser, which
// takes longer to compile than the rest of the program together. Options that mean the same are called the same in all commands.

#include "app/command_options.hpp"

#include "studies/analysis/command.hpp"
#include "studies/benchmark/command.hpp"
#include "studies/compare/command.hpp"
#include "studies/diff/command.hpp"
#include "studies/hard_cases/command.hpp"
#include "studies/horizon/command.hpp"
#include "studies/sweep/command.hpp"
#include "studies/validate/command.hpp"

#include "studies/hard_cases/hard_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <carom/simulation.hpp>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>

namespace carom::cli {

namespace {

/// Accepts numbers from 0 on: the parser would take -1 for 2^64 - 1.
CLI::Validator countable() { return CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()).description(""); }

void add_scene_options(CLI::App& command, SceneOptions& scene) {
  command.add_option("scene", scene.path, "The scene file (TOML)")->required()->type_name("SCENE");
  command.add_option("--set", scene.overrides, "Override one key of the scene, e.g. --set run.time=2; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--seed", scene.seed, "Seed of the random numbers: short for --set run.seed=N")->type_name("N");
  command.add_option("--time", scene.time, "Simulated time at which the run ends: short for --set run.time=T")->type_name("T");
  command.add_flag("--accept-overlap", scene.accept_overlap, "Accept overlaps between disks that the scene lists one by one");
  command.add_option("--engine", scene.engine, fmt::format("Use this engine: {}", fmt::join(engine_names(), ", ")))
      ->type_name("ENGINE");
}

void add_output_options(CLI::App& command, SceneOptions& scene) {
  command.add_flag("--no-trajectory", scene.no_trajectory, "Do not write trajectory.h5md");
  command.add_flag("--xyz", scene.xyz, "Write trajectory.xyz too");
  command.add_flag("--csv", scene.csv, "Write samples.csv too");
  command.add_flag("--events", scene.events, "Store every collision in trajectory.h5md");
  command.add_flag("--unwrapped", scene.unwrapped, "Let positions continue past periodic edges");
}

void add_progress(CLI::App& command, std::string& when) {
  command.add_option("--progress", when, "A progress line on stderr: auto (on a terminal), always or never")->type_name("WHEN");
}

void add_threads(CLI::App& command, RunOptions& options) {
  command
      .add_option("--threads", options.threads,
                  "Number of cores that compute the run, to the same bits, or auto (default): one, and from 50,000 disks on all "
                  "that are free. With 1, observables have no thread of their own either")
      ->type_name("N");
}

void add_saving(CLI::App& command, RunOptions& options) {
  command
      .add_option("--checkpoint-every", options.checkpoint_every,
                  "Save a checkpoint for carom resume at this interval, such as 10min or \"1e8 collisions\", and at the end")
      ->type_name("HOW_OFTEN");
  command
      .add_option("--walltime", options.walltime, "Stop and save the run after this duration: 90s, 10min, 1h30min or 01:30:00")
      ->type_name("DURATION");
}

void add_run(CLI::App& program, Action& action, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("run", "Run a scene and write its results");
  const auto options = std::make_shared<RunOptions>();
  add_scene_options(*command, options->scene);
  add_output_options(*command, options->scene);
  command->add_option("-o,--out", options->out, "Directory for the results (default: the scene's name without its ending)")
      ->type_name("DIR");
  command->add_flag("--force", options->force, "Replace the results that the directory holds");
  command->add_flag("--json", options->json, "Print summary.json instead of the text summary");
  command->add_flag("-q,--quiet", options->quiet, "Print no summary and no progress");
  command->add_flag("-v,--verbose", options->verbose, "Describe the simulation on stderr first");
  command
      ->add_option("--method", options->method,
                   fmt::format("exact (from event to event), or a fixed-step method to compare with: {}",
                               fmt::join(fixed_step_names(), ", ")))
      ->type_name("METHOD");
  command->add_option("--dt", options->dt, "Time step of a fixed-step method (default: the scene's run.sample_every)")
      ->type_name("DT");
  command
      ->add_option("--stiffness", options->stiffness,
                   "Stiffness of the springs of --method soft, force per overlap (default: 30 steps in the shortest contact)")
      ->type_name("K");
  command
      ->add_option("--verify", options->verify,
                   "Check the engine's invariants every K events, and end the run where one is broken")
      ->type_name("K")
      ->check(countable());
  command->add_flag("--verify-horizon", options->verify_horizon,
                    "Also measure how long the trajectory is right, by repeating its beginning in 24 to 113 bits");
  command->add_flag("--report", options->report, "Also write report.html, as carom report does");
  command->add_flag("--watch", options->watch, "Show the run live (a progress line where stderr is no terminal)");
  command->add_option("--pace", options->pace, "With --watch: simulated time per second (default: as fast as the machine can)")
      ->type_name("TIME");
  command
      ->add_option("--changes", options->changes,
                   "Make the changes of this file at their times, as the playground lists them; writes samples.csv at most")
      ->type_name("FILE.toml");
  add_threads(*command, *options);
  add_saving(*command, *options);
  add_progress(*command, options->progress);
  command->callback([&action, options, invocation] { action = [options, invocation] { return run(*options, invocation); }; });
}

using Resumption = ExitCode (*)(const ResumeOptions&, const Invocation&);
void add_resumption(CLI::App& program, Action& action, const Invocation& invocation, const char* name, const char* about,
                    Resumption resumption) {
  CLI::App* command = program.add_subcommand(name, about);
  const auto options = std::make_shared<ResumeOptions>();
  command->add_option("directory", options->directory, "The directory that carom run has written")
      ->type_name("RUN_DIR")
      ->required();
  CLI::Option* time = command->add_option("--time", options->time, "Simulated time at which the run is to end")->type_name("T");
  command
      ->add_option("--collisions", options->collisions,
                   "Number of pair collisions, from its beginning, at which the run is to end")
      ->type_name("N")
      ->check(countable())
      ->excludes(time);
  RunOptions& how = options->run;
  command->add_flag("--json", how.json, "Print summary.json instead of the text summary");
  command->add_flag("-q,--quiet", how.quiet, "Print no summary and no progress");
  command->add_flag("--report", how.report, "Also write report.html, as carom report does");
  command->add_flag("--watch", how.watch, "Show the run live (a progress line where stderr is no terminal)");
  add_threads(*command, how);
  add_saving(*command, how);
  add_progress(*command, how.progress);
  command->callback([&action, options, invocation, resumption] {
    action = [options, invocation, resumption] { return resumption(*options, invocation); };
  });
}

void add_check(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("check", "Check a scene; print what it simulates and what it costs");
  const auto options = std::make_shared<CheckOptions>();
  add_scene_options(*command, options->scene);
  add_output_options(*command, options->scene);
  command->add_flag("--resolved", options->resolved, "Print the scene with every default filled in");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing about a valid scene; only the exit code tells");
  command->callback([&action, options] { action = [options] { return check(*options); }; });
}

void add_horizon(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("horizon", "Measure how long a scene's trajectory is right, in 24 to 113 bits");
  const auto options = std::make_shared<HorizonCommandOptions>();
  add_scene_options(*command, options->scene);
  command
      ->add_option("--collisions", options->collisions,
                   "Number of collisions for the Lyapunov exponent (default: 500000, or 100 per disk)")
      ->type_name("N")
      ->check(countable());
  command->add_flag("--spectrum", options->spectrum, "Measure all Lyapunov exponents instead, of up to 256 disks");
  command->add_flag("--json", options->json, "Print JSON instead of the table");
  command->add_flag("-q,--quiet", options->quiet, "Print only the conclusion, and no progress");
  add_progress(*command, options->progress);
  command->callback([&action, options] { action = [options] { return horizon(*options); }; });
}

void add_compare(CLI::App& program, Action& action, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("compare", "Compare error and cost of exact events and fixed time steps");
  const auto options = std::make_shared<CompareCommandOptions>();
  add_scene_options(*command, options->scene);
  command->add_option("-o,--out", options->out, "Directory for the results (default: the scene's name and -compare)")
      ->type_name("DIR");
  command
      ->add_option(
          "--dt", options->dts,
          "A time step to compare (default: three per decade about the mean free time); may be repeated. A single one is "
          "the short study of seconds: one start, and no other sizes and packing fractions")
      ->type_name("DT")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--seeds", options->seeds,
                   "Number of starts: the scene's seed and those after it (default: 8; 1 with a single --dt)")
      ->type_name("N");
  command
      ->add_option(
          "--longest", options->longest,
          "Seconds that one run of a fixed-step method may take (default: 0.3); a longer one is cut short, or left out and named")
      ->type_name("SECONDS");
  command
      ->add_option(
          "--stiffness", options->stiffness,
          "Stiffness of the springs of the method soft, force per overlap (default: such that the shortest contact takes "
          "30 steps)")
      ->type_name("K");
  command
      ->add_option("--play", options->play,
                   fmt::format("Also write side_by_side.html: a fixed-step method ({}; default guarded) beside exact events, "
                               "to watch. Give it after SCENE; without DT it is one of the study's",
                               fmt::join(fixed_step_names(), ", ")))
      ->type_name("[METHOD[:DT]]")
      ->expected(0, 1);
  CLI::Option* trajectory =
      command
          ->add_option("--trajectory", options->trajectory,
                       "Instead compare this trajectory of your own with exact events: .npy (frames, disks, 2 or 4), .csv (time, "
                       "disk, x, y) or .h5md")
          ->type_name("FILE");
  command->add_option("--every", options->every, "Time between the frames of an .npy trajectory")
      ->type_name("DT")
      ->needs(trajectory);
  command->add_flag("--no-costs", options->no_costs, "Do not measure cost against size and packing fraction");
  command->add_flag("--force", options->force, "Replace the results that the directory holds");
  command->add_flag("--resume", options->resume, "Continue an interrupted comparison");
  command->add_flag("--json", options->json, "Print compare.json instead of the table");
  command->add_flag("-q,--quiet", options->quiet, "Print only the conclusions, and no progress");
  add_progress(*command, options->progress);
  for (const char* of_the_study :
       {"--out", "--dt", "--seeds", "--longest", "--stiffness", "--play", "--no-costs", "--force", "--resume"})
    trajectory->excludes(command->get_option(of_the_study));
  command->callback([&action, options, invocation] { action = [options, invocation] { return compare(*options, invocation); }; });
}

void add_sweep(CLI::App& program, Action& action, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("sweep", "Run a scene with many values and seeds; collect the results in one table");
  const auto options = std::make_shared<SweepCommandOptions>();
  command->add_option("sweep", options->path, "The sweep file (TOML)")->required()->type_name("SWEEP");
  command
      ->add_option("--set", options->overrides,
                   "Override one key of the scene at every point, as [set] does, e.g. --set run.time=2; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("-o,--out", options->out, "Directory for the results (default: the sweep file's name without its ending)")
      ->type_name("DIR");
  command
      ->add_option("--threads", options->threads,
                   "Number of runs at a time, under mpirun per process (default: one per processor, under mpirun one)")
      ->type_name("N");
  command
      ->add_option("--checkpoint-every", options->checkpoint_every,
                   "Save checkpoints of the runs at this interval, such as 10min or \"1e8 collisions\". Ctrl-C, SIGTERM, SIGHUP, "
                   "SIGXCPU and SIGUSR1 always save them")
      ->type_name("HOW_OFTEN");
  command->add_flag("--force", options->force, "Replace runs that were made with another scene");
  command->add_flag("--list", options->list, "Print the commands of all unfinished runs, and run nothing");
  command->add_flag("--json", options->json, "Print the points with their numbers as JSON instead of the table");
  command->add_flag("-q,--quiet", options->quiet, "Print no summary and no progress");
  add_progress(*command, options->progress);
  command->callback([&action, options, invocation] { action = [options, invocation] { return sweep(*options, invocation); }; });
}

void add_validate(CLI::App& program, Action& action, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("validate", "Compare the engine with kinetic theory and the literature");
  const auto options = std::make_shared<ValidateCommandOptions>();
  command->add_flag("--quick", options->quick, "One to two minutes on two cores; the default");
  command->add_flag("--full", options->full,
                    "Twenty times as many collisions, and seven more trials: one to two hours on two cores");
  command->add_option("--seed", options->seed, "Seed of all random numbers (default: 1)")->type_name("N");
  command->add_option("--only", options->only, "Run only this trial, or this group of trials; may be repeated")
      ->type_name("TRIAL")
      ->allow_extra_args(false);
  command->add_option("--threads", options->threads, "Number of trials at a time (default: one per processor)")->type_name("N");
  command->add_option("-o,--out", options->out, "Directory for the results (default: validation)")->type_name("DIR");
  command->add_flag("--list", options->list, "List the trials and run none");
  command->add_flag("--force", options->force, "Replace the results that the directory holds");
  command->add_flag("--resume", options->resume, "Continue an interrupted validation");
  command->add_flag("--json", options->json, "Print validation.json instead of the text");
  command->add_flag("--markdown", options->markdown, "Print the tables of docs/validation.md instead of the text");
  command->add_flag("-q,--quiet", options->quiet, "Print only the verdict, and no progress");
  add_progress(*command, options->progress);
  command->callback(
      [&action, options, invocation] { action = [options, invocation] { return validate(*options, invocation); }; });
}

void add_init(CLI::App& program, Action& action, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("init", "Write a commented scene to start from");
  const auto options = std::make_shared<InitOptions>();
  command->add_option("preset", options->preset, "Name of the preset (default: box)")->type_name("PRESET");
  command->add_option("-o,--out,--output", options->file, "The file to write (default: PRESET.toml; - for standard output)")
      ->type_name("FILE");
  command->add_flag("--force", options->force, "Replace the file if it exists");
  command->add_flag("--list", options->list, "List the presets");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing");
  command->callback([&action, options, invocation] { action = [options, invocation] { return init(*options, invocation); }; });
}

void add_info(CLI::App& program, Action& action, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("info", "Describe a file or run directory");
  const auto options = std::make_shared<InfoOptions>();
  command->add_option("file", options->file, "A trajectory, table, summary, scene or run directory")
      ->required()
      ->type_name("FILE");
  command->add_flag("--reproduce", options->reproduce, "Print the commands that repeat the run of this directory");
  command->callback([&action, options, invocation] { action = [options, invocation] { return info(*options, invocation); }; });
}

void add_verify(CLI::App& program, Action& action, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("verify", "Repeat a finished run and compare the results to the last bit");
  const auto options = std::make_shared<VerifyOptions>();
  command->add_option("directory", options->directory, "The directory that carom run has written")
      ->required()
      ->type_name("RUN_DIR");
  command->add_flag("--json", options->json, "Print JSON instead of the text");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing and no progress; only the exit code tells");
  add_progress(*command, options->progress);
  command->callback([&action, options, invocation] { action = [options, invocation] { return verify(*options, invocation); }; });
}

void add_diff(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("diff", "Compare two runs of the same disks: are they equal, and where do they part");
  const auto options = std::make_shared<DiffCommandOptions>();
  command->add_option("first", options->first, "A directory that carom run has written, or a trajectory.h5md")
      ->required()
      ->type_name("RUN_A");
  command->add_option("second", options->second, "The run to compare it with")->required()->type_name("RUN_B");
  command->add_flag("--json", options->json, "Print JSON instead of the table");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing; only the exit code tells");
  command->footer(
      "Exit codes: 0 where the runs are equal to the last bit, 1 where they differ,\n2 where they cannot be compared.");
  command->callback([&action, options] { action = [options] { return diff(*options); }; });
}

void add_play(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("play", "Write a page that replays a run (exactly, if its events are stored)");
  const auto options = std::make_shared<PlayOptions>();
  command->add_option("directory", options->directory, "The directory that carom run has written")
      ->required()
      ->type_name("RUN_DIR");
  command->add_option("-o,--out,--output", options->output, "The file to write (default: player.html in that directory)")
      ->type_name("FILE.html");
  command->add_flag("--open", options->open, "Open the page in a browser too (xdg-open)");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing");
  command->callback([&action, options] { action = [options] { return play(*options); }; });
}

void add_playground(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("playground", "Write a page in which scenes run live, and can be changed");
  const auto options = std::make_shared<PlaygroundOptions>();
  command->add_option("scenes", options->scenes, "Scene files to put into the page, before its own")->type_name("SCENE");
  command->add_option("-o,--out,--output", options->output, "The file to write (default: playground.html)")
      ->type_name("FILE.html");
  command->add_flag("--open", options->open, "Open the page in a browser too (xdg-open)");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing");
  command->callback([&action, options] { action = [options] { return playground(*options); }; });
}

void add_analyze(CLI::App& program, Action& action, const Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("analyze", "Measure observables of a finished run from its stored samples and events");
  const auto options = std::make_shared<AnalyzeOptions>();
  command->add_option("directory", options->directory, "The directory that carom run has written")
      ->required()
      ->type_name("RUN_DIR");
  command
      ->add_option("observables", options->observables,
                   "Observables with settings, as in the table [observe] (default: those of the run's scene)")
      ->type_name("OBSERVABLE[={ every = 0.1 }]");
  command->add_option("-o,--out", options->out, "Directory for the results (default: RUN_DIR-analysis)")->type_name("DIR");
  command->add_flag("--force", options->force, "Replace results that are there");
  command->add_flag("--json", options->json, "Print JSON instead of the table");
  command->add_flag("-q,--quiet", options->quiet, "Print no table and no progress");
  add_progress(*command, options->progress);
  command->callback([&action, options, invocation] { action = [options, invocation] { return analyze(*options, invocation); }; });
}

void add_report(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("report", "Write one page about a run: events, accuracy, observables and a replay");
  const auto options = std::make_shared<ReportOptions>();
  command->add_option("directory", options->directory, "The directory that carom run has written")
      ->required()
      ->type_name("RUN_DIR");
  command->add_option("-o,--out,--output", options->output, "The file to write (default: report.html in that directory)")
      ->type_name("FILE.html");
  command->add_flag("--open", options->open, "Open the page in a browser too (xdg-open)");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing");
  command->callback([&action, options] { action = [options] { return report(*options); }; });
}

void add_movie(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("movie", "Draw a run as a film (mp4, webm, gif) or a picture (png, svg, pdf)");
  const auto options = std::make_shared<MovieOptions>();
  command->add_option("directory", options->directory, "The directory that carom run has written")
      ->required()
      ->type_name("RUN_DIR");
  command
      ->add_option(
          "-o,--out,--output", options->output,
          "The file to write, ending in .mp4, .webm, .gif, .png, .svg or .pdf (default: movie.mp4 in that directory; picture.png "
          "with --at)")
      ->type_name("FILE");
  command->add_flag("--force", options->force, "Replace the file if it exists");
  command->add_option("--size", options->size, "Pixels: the longer side, or width x height (default: 1080, of a GIF 480)")
      ->type_name("N|WxH");
  command->add_option("--fps", options->fps, "Frames per second of the film (default: 30)")->type_name("N");
  command->add_option("--speed", options->speed, "Simulated time per second of the film (default: such that it lasts 10 s)")
      ->type_name("TIME");
  command->add_option("--from", options->from, "Simulated time at which the film begins (default: that of the run)")
      ->type_name("TIME");
  command->add_option("--to", options->to, "Simulated time at which the film ends (default: that of the run)")->type_name("TIME");
  command->add_option("--at", options->at, "Simulated time of a picture (default: the last sample)")->type_name("TIME");
  command
      ->add_option(
          "--colour,--color", options->colour,
          "Colour disks by speed, species, collisions, id, psi6 (sixfold order), psi6_angle or neighbours (defects), or plain "
          "(default: by species if there are several, else by speed)")
      ->type_name("COLOUR");
  command->add_option("--trails", options->trails, "Draw the paths of the last TIME of simulated time")->type_name("TIME");
  command->add_option("--trails-of", options->trails_of, "Draw only the paths of this species")->type_name("SPECIES");
  command->add_flag("--velocities", options->velocities, "Draw velocities as arrows");
  command->add_flag("--dark", options->dark, "Dark background");
  command->add_flag("--bare", options->bare, "No clock and no colour legend");
  command->add_flag("-q,--quiet", options->quiet, "Print no summary and no progress");
  add_progress(*command, options->progress);
  command->callback([&action, options] { action = [options] { return movie(*options); }; });
}

void add_bench(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("bench", "Measure the speed of both engines on this machine");
  const auto options = std::make_shared<BenchOptions>();
  command->add_flag("--json", options->json, "Print JSON instead of the table");
  command->add_flag("--effects", options->effects, "Measure what each effect costs, at its neutral value and where it acts");
  command
      ->add_option("--threads", options->threads,
                   "Measure how much faster one run of 100000 disks is on N cores (default: on all) than on one")
      ->type_name("[N]")
      ->expected(0, 1);
  command->add_flag("--large", options->large, "Also measure a million disks, which takes some minutes");
  command->add_option("--disks", options->disks, "Number of disks (default: 1000, 10000 and 100000); may be repeated")
      ->type_name("N")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--collisions", options->collisions,
          "Collisions per measurement of the textbook engine (default: 200000, or one per disk); the fast engine makes four "
          "times as many")
      ->type_name("N")
      ->check(countable());
  command->callback([&action, options] { action = [options] { return bench(*options); }; });
}

void add_hardcases(CLI::App& program, Action& action, const Invocation& invocation) {
  CLI::App* command = program.add_subcommand("hardcases", "Run the corpus of hard cases and report which hold");
  const auto options = std::make_shared<HardCasesOptions>();
  command->add_option("cases", options->cases, "Names of cases, or files of your own (default: all that do not take long)")
      ->type_name("CASE|FILE.toml");
  command->add_option("--family", options->family, fmt::format("Run only this family: {}", fmt::join(hard_case_families(), ", ")))
      ->type_name("FAMILY");
  command->add_option("--engine", options->engine, "Run only this engine (default: all that cover a case)")->type_name("ENGINE");
  command->add_flag("--long", options->takes_long, "Also run cases that take minutes");
  command->add_flag("--list", options->list, "List the cases");
  command->add_option("--show", options->show, "Print the text of a case")->type_name("CASE");
  command->add_flag("--json", options->json, "Print JSON instead of the table");
  command->add_flag("--markdown", options->markdown, "Print Markdown instead of the table");
  command->add_option("--page", options->page, "Also write the result as one HTML page")->type_name("FILE.html");
  command
      ->add_option("--method", options->method,
                   fmt::format("Run the cases by a fixed-step method instead: {}", fmt::join(fixed_step_names(), ", ")))
      ->type_name("METHOD");
  command->add_option("--dt", options->dt, "Its time step (default: the fastest disk goes a twentieth of the smallest diameter)")
      ->type_name("DT");
  command->callback(
      [&action, options, invocation] { action = [options, invocation] { return hardcases(*options, invocation); }; });
}

/// Sorts the commands by purpose.
void add_groups(CLI::App& program) {
  const auto put = [&](const char* group, std::initializer_list<const char*> names) {
    for (const char* name : names) program.get_subcommand(name)->group(group);
  };
  put("Scenes and runs", {"init", "check", "run", "resume", "extend", "info", "verify", "playground"});
  put("Results of a run", {"analyze", "diff", "play", "report", "movie"});
  put("Studies", {"horizon", "compare", "sweep", "bench", "hardcases", "validate"});
}

}  // namespace

void add_commands(CLI::App& program, Action& action, const Invocation& invocation) {
  add_init(program, action, invocation);
  add_check(program, action);
  add_run(program, action, invocation);
  add_resumption(program, action, invocation, "resume", "Continue a run that was interrupted or killed, to the same bits",
                 &resume);
  add_resumption(program, action, invocation, "extend", "Continue a finished run to a later end", &extend);
  add_info(program, action, invocation);
  add_verify(program, action, invocation);
  add_playground(program, action);
  add_analyze(program, action, invocation);
  add_diff(program, action);
  add_play(program, action);
  add_report(program, action);
  add_movie(program, action);
  add_horizon(program, action);
  add_compare(program, action, invocation);
  add_sweep(program, action, invocation);
  add_bench(program, action);
  add_hardcases(program, action, invocation);
  add_validate(program, action, invocation);
  add_groups(program);
}

}  // namespace carom::cli
