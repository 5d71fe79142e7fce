// carom movie: films and pictures as other programs see them, and what is refused.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <signal.h>

#include <cstdlib>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class MovieCommand : public ProgramTest {
 protected:
  MovieCommand() : ProgramTest(fifty_disks) {}
  void run_scene(const std::vector<std::string>& more = {"--events"}) {
    std::vector<std::string> words = {"run", "gas.toml", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(carom(words).exit_code, 0);
  }
  /// And nothing was written.
  void refused(const std::vector<std::string>& arguments, const std::string& sentence) {
    ProgramTest::refused(arguments, sentence);
    for (const auto& entry : fs::directory_iterator(directory_.path()))
      EXPECT_THAT(entry.path().filename(), ::testing::AnyOf("gas", "gas.toml", "bin", "mine.png")) << arguments.back();
  }
  /// With only the programs of the directory bin.
  Outcome carom_with_own_programs(std::vector<std::string> arguments, const std::function<void(pid_t)>& meanwhile = {}) {
    arguments.insert(arguments.begin(), {"/usr/bin/env", "PATH=" + file("bin").string(), CAROM_PROGRAM});
    return run_program(directory_.path(), arguments, meanwhile);
  }
  /// A program that takes the place of ffmpeg.
  void make_ffmpeg(const std::string& script) {
    fs::create_directory(file("bin"));
    write_text(file("bin/ffmpeg"), "#!/bin/sh\n" + script);
    fs::permissions(file("bin/ffmpeg"), fs::perms::owner_all);
  }
};

class MovieFilm : public MovieCommand, public ::testing::WithParamInterface<const char*> {};

TEST_P(MovieFilm, HasTheFramesSizeAndLengthThatWereAskedFor) {
  if (run_program(directory_.path(), {"ffprobe", "-version"}).exit_code != 0) GTEST_SKIP() << "there is no ffprobe here";
  run_scene();
  const std::string name = std::string("film.") + GetParam();
  const bool is_gif = name == "film.gif";
  const Outcome outcome = carom({"movie", "gas", "-o", name, "--fps", "20", "--speed", "5", "--from", "0.5", "--size", "64x51"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out,
              AllOf(StartsWith(name + "  "), HasSubstr("7 frames at 20 per second"), HasSubstr("times 0.5 to 2, exact")));
  EXPECT_FALSE(fs::exists(file(name + ".partial")));
  const Outcome probe =
      run_program(directory_.path(), {"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                      "stream=width,height,nb_read_frames:format=duration", "-of", "json", name});
  ASSERT_EQ(probe.exit_code, 0) << probe.err;
  const auto probed = nlohmann::json::parse(probe.out);
  const auto& stream = probed.at("streams").at(0);
  EXPECT_EQ(stream.at("nb_read_frames"), "7");  // 1.5 of time at 5 / 20 a frame, both ends included
  EXPECT_EQ(stream.at("width"), 64);
  EXPECT_EQ(stream.at("height"), is_gif ? 51 : 52);
  // GIF counts hundredths of a second, WebM thousandths.
  EXPECT_NEAR(std::atof(probed.at("format").at("duration").get<std::string>().c_str()), 7.0 / 20.0, is_gif ? 0.011 : 0.0011);
}

INSTANTIATE_TEST_SUITE_P(Formats, MovieFilm, ::testing::Values("mp4", "webm", "gif"),
                         [](const auto& name) { return std::string(name.param); });

TEST_F(MovieCommand, DrawsPicturesAndSaysOfWhen) {
  run_scene();
  for (const std::string ending : {"png", "svg", "pdf"}) {
    const Outcome outcome = carom({"movie", "gas", "-o", "picture." + ending, "--at", "1.3", "--trails", "0.5", "--size", "200"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, IsEmpty());
    EXPECT_THAT(outcome.out, AllOf(StartsWith("picture." + ending), HasSubstr("time 1.3, exact")));
  }
  // Walls are 3 pixels thick and margins 13, letters 22 and their line 33: 1080 - 26 - 33 = 1021 for the square box, and 26.
  EXPECT_THAT(carom({"movie", "gas", "-o", "last.png"}).out, HasSubstr("1047 x 1080, time 2, exact"));
}

TEST_F(MovieCommand, SaysWhenItInterpolates) {
  run_scene({});
  refused({"movie", "gas", "-o", "coloured.svg", "--colour", "collisions"},
          "the collisions of gas are not known: the run kept no event log (carom run --events)");
  const Outcome outcome = carom({"movie", "gas", "-o", "picture.png", "--size", "64", "-q"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, HasSubstr("between samples the disks are drawn on straight lines: the run kept no event log"));
}

TEST_F(MovieCommand, SaysWhatNoEventLogHolds) {
  for (const std::string events : {"output.events=false", "output.events=true"}) {
    run_scene({"--force", "--set", "thermostat.temperature=1.0", "--set", "thermostat.rate=1.0", "--set", events});
    refused({"movie", "gas", "-o", "coloured.svg", "--colour", "collisions"},
            "the collisions of gas are not known: the thermostat changes velocities between collisions");
  }
}

TEST_F(MovieCommand, SaysWhereSamplesEndBeforeTheRun) {
  run_scene({"--set", "run.sample_every=0.75"});
  refused({"movie", "gas", "-o", "a.png", "--at", "1.8"},
          "--at 1.8: its samples go from time 0 to 1.5, and the run to 2; to draw its end, run the scene with --events");
  run_scene({"--force", "--events", "--set", "run.sample_every=0.75"});
  EXPECT_EQ(carom({"movie", "gas", "-o", "a.png", "--at", "1.8", "--size", "64"}).exit_code, 0);
  fs::remove(file("a.png"));
  run_scene({"--force", "--events", "--set", "run.sample_every=0.75", "--set", "thermostat.temperature=1.0", "--set",
             "thermostat.rate=1.0"});
  refused({"movie", "gas", "-o", "a.png", "--at", "1.8"}, "run the scene with a sample_every of which its time is a multiple");
}

TEST_F(MovieCommand, RefusesWhatIsNoFinishedRun) {
  refused({"movie", "nowhere", "-o", "a.png"}, "nowhere: there is no such directory");
  refused({"movie", "gas.toml", "-o", "a.png"}, "gas.toml: this is a file; name the run directory");
  refused({"movie", ".", "-o", "a.png"}, "no finished run");
  run_scene();
  fs::rename(file("gas/trajectory.h5md"), file("gas/trajectory.h5md.partial"));
  refused({"movie", "gas", "-o", "a.png"}, "this run still goes on, or was ended from outside");
  fs::rename(file("gas/trajectory.h5md.partial"), file("gas/trajectory.h5md"));
  fs::resize_file(file("gas/trajectory.h5md"), fs::file_size(file("gas/trajectory.h5md")) / 2);
  refused({"movie", "gas", "-o", "a.png"}, "it is damaged or cut short");
}

TEST_F(MovieCommand, RefusesOptionsThatCannotBe) {
  run_scene();
  make_ffmpeg("exit 1\n");  // so that the answers are the same where there is none
  const auto film = [&](const std::vector<std::string>& more, const std::string& sentence) {
    std::vector<std::string> words = {"movie", "gas", "-o", "film.mp4"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = carom_with_own_programs(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, AllOf(StartsWith("carom: "), HasSubstr(sentence)));
    EXPECT_FALSE(fs::exists(file("film.mp4")) || fs::exists(file("film.mp4.partial")));
  };
  film({"--from", "1.5", "--to", "0.5"}, "--from 1.5 is after --to 0.5");
  film({"--from", "-1"}, "--from -1: the run goes from time 0 to 2");
  film({"--to", "2.5"}, "--to 2.5: the run goes from time 0 to 2");
  film({"--to", "nan"}, "--to nan: the run goes from time 0 to 2");
  film({"--fps", "0"}, "--fps 0: it must be from 0.1 to 240");
  film({"--fps", "inf"}, "--fps inf: it must be from 0.1 to 240");
  film({"--speed", "0"}, "--speed 0: it must be a simulated time above zero");
  film({"--speed", "1e-9"}, "the film would have 6e+10 frames");
  film({"--speed", "1e-300"}, "the film would have 6e+301 frames");
  film({"--at", "1"}, "--at: this is the time of a picture");
  for (const char* const size : {"0", "15", "8193", "64x", "x64", "64x0", "-64", "big", "64 x 64", "99999999999"})
    film({"--size", size}, std::string("--size ") + size + ": it can be the longer side or WIDTHxHEIGHT");
  film({"--colour", "red"}, "--colour red: it can be speed, species, collisions, id, psi6, psi6_angle, neighbours or plain");
  film({"--trails", "0"}, "--trails 0: it must be a simulated time above zero");
  film({"--trails-of", "disks0"}, "--trails-of: give --trails TIME too");
  film({"--trails", "1", "--trails-of", "pollen"}, "--trails-of pollen: this run has no such species; it has disks0");
  film({"--progress", "often"}, "--progress often: it can be auto, always or never");
  refused({"movie", "gas", "-o", "film.avi"}, "-o film.avi: the name must end in .mp4, .webm or .gif for a film");
  refused({"movie", "gas", "-o", "a.png", "--fps", "10"}, "--fps: a picture shows one time");
  refused({"movie", "gas", "-o", "a.png", "--at", "3"}, "--at 3: the run goes from time 0 to 2");
  refused({"movie", "gas", "-o", "no/such/place.png"}, "no/such/place.png: cannot write");
}

TEST_F(MovieCommand, WritesIntoTheRunByDefault) {
  run_scene();
  EXPECT_THAT(carom({"movie", "gas", "--at", "1", "--size", "64"}).out, StartsWith("gas/picture.png  "));
  refused({"movie", "gas", "--at", "1"}, "gas/picture.png: this file is there already; replace it with --force");
}

TEST_F(MovieCommand, ReplacesAFileOnlyWhenForced) {
  run_scene();
  write_text(file("mine.png"), "mine");
  refused({"movie", "gas", "-o", "mine.png"}, "mine.png: this file is there already; replace it with --force");
  EXPECT_EQ(text_of(file("mine.png")), "mine");
  EXPECT_EQ(carom({"movie", "gas", "-o", "mine.png", "--force", "--size", "64"}).exit_code, 0);
  EXPECT_THAT(text_of(file("mine.png")), StartsWith("\x89PNG"));
}

TEST_F(MovieCommand, WithoutFfmpegNamesThePackage) {
  run_scene();
  fs::create_directory(file("bin"));
  const Outcome outcome = carom_with_own_programs({"movie", "gas", "-o", "film.mp4"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("install the package ffmpeg"));
  EXPECT_FALSE(fs::exists(file("film.mp4")));
  EXPECT_EQ(carom_with_own_programs({"movie", "gas", "-o", "picture.svg"}).exit_code, 0) << "pictures need no ffmpeg";
}

TEST_F(MovieCommand, WhatFfmpegSaysWhenItGivesUpIsPassedOn) {
  run_scene();
  for (const std::string script :
       {"echo 'Unknown encoder' >&2; exit 1\n", "/bin/cat > /dev/null; echo 'Unknown encoder' >&2; exit 1\n"}) {
    make_ffmpeg(script);  // at once, and at the end
    const Outcome outcome = carom_with_own_programs({"movie", "gas", "-o", "film.mp4", "--size", "480", "--fps", "2"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err,
                AllOf(StartsWith("carom: film.mp4: ffmpeg could not write this film: Unknown encoder"), HasSubstr("\n")));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
    EXPECT_FALSE(fs::exists(file("film.mp4")) || fs::exists(file("film.mp4.partial")));
  }
}

/// On a full disk ffmpeg ends with 0: of an MP4 without a word and without an index, of others with one.
TEST_F(MovieCommand, AFilmThatIsCutShortTakesTheNameOfNone) {
  run_scene();
  write_text(file("old"), "kept");
  const std::string to_file = " > \"$(for last; do :; done; echo \"${last#file:}\")\"; ";
  for (const auto& [film, script] : {std::pair{"film.mp4", "printf '\\000\\000\\000\\010ftyp\\000\\000\\000\\010mdat'" + to_file},
                                     std::pair{"film.webm", "echo film" + to_file + "echo 'No space left on device' >&2"}}) {
    make_ffmpeg("/bin/cat > /dev/null; " + script + "\nexit 0\n");
    fs::copy_file(file("old"), file(film));
    const Outcome outcome = carom_with_own_programs({"movie", "gas", "-o", film, "--force", "--size", "64", "--fps", "1"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("ffmpeg could not write this film"), HasSubstr("check the disk")));
    EXPECT_EQ(text_of(file(film)), "kept");
    EXPECT_FALSE(fs::exists(file(std::string(film) + ".partial")));
  }
}

TEST_F(MovieCommand, CtrlCEndsFfmpegAndLeavesNoFile) {
  run_scene();
  make_ffmpeg("echo $$ > started.new; /bin/mv started.new started; exec /bin/sleep 60\n");  // never reads a frame
  pid_t encoder = 0;
  const Outcome outcome = carom_with_own_programs({"movie", "gas", "-o", "film.webm"}, [&](pid_t program) {
    EXPECT_TRUE(wait_until([&] { return fs::exists(file("started")); }));
    encoder = static_cast<pid_t>(std::atol(text_of(file("started")).c_str()));
    kill(program, SIGINT);
  });
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.err, HasSubstr("interrupted; no film was written"));
  EXPECT_FALSE(fs::exists(file("film.webm")) || fs::exists(file("film.webm.partial")));
  ASSERT_GT(encoder, 0);
  EXPECT_EQ(kill(encoder, 0), -1);
}

TEST_F(MovieCommand, ProgressGoesToStandardError) {
  run_scene();
  make_ffmpeg("/bin/cat > /dev/null; echo film > \"$(for last; do :; done; echo \"${last#file:}\")\"\n");
  const Outcome outcome =
      carom_with_own_programs({"movie", "gas", "-o", "film.webm", "--size", "64", "--progress", "always", "--fps", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("drawing frame 1 of 11"));
  EXPECT_THAT(outcome.out, StartsWith("film.webm  "));
}

}  // namespace
}  // namespace carom::test
