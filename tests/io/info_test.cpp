// carom info: what it says of every kind of file, and of files that are broken or foreign.

#include "app/info.hpp"

#include "io/hand_made_run.hpp"
#include "io/run_writer.hpp"
#include "observe/effects_report.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <hdf5.h>
#include <fstream>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string refusal_to_describe(const fs::path& path) {
  return refusal<OutputError>([&] { return describe_file(path); });
}

class Info : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_.output = {.trajectory = true, .xyz = true, .csv = true, .events = true};
    RunWriter writer(RunDirectory(out_, false), scene_, hand_made_disks(scene_), provenance());
    for (std::uint64_t k = 0; k < 6; ++k) writer.sample(k, state_at(k, scene_), {});
    writer.events(events_up_to(9));
    writer.finish(hand_made_report(scene_));
  }
  /// A copy that ends after `bytes` (or, where negative, so many bytes before the end).
  fs::path cut(const std::string& name, std::ptrdiff_t bytes) {
    const std::string whole = text_of(out_ / name);
    const auto size = static_cast<std::size_t>(bytes >= 0 ? bytes : static_cast<std::ptrdiff_t>(whole.size()) + bytes);
    write_text(temporary_.path() / name, whole.substr(0, size));
    return temporary_.path() / name;
  }

  TemporaryDirectory temporary_;
  fs::path out_ = temporary_.path() / "out";
  Scene scene_ = scene_of(3, 2);
};

TEST_F(Info, DescribesATrajectory) {
  const std::string text = describe_file(out_ / "trajectory.h5md");
  EXPECT_THAT(text, AllOf(HasSubstr("trajectory, H5MD 1.1"), HasSubstr("carom "),
                          HasSubstr("Hand-made: größer & kleiner (hand_made.toml)"), HasSubstr("18446744073709551615"),
                          HasSubstr("5: 3 large, 2 small"), HasSubstr("by hand")));
  EXPECT_THAT(text, AllOf(HasSubstr("4 x 2.5 from (-1, 10); x periodic, y walls"), HasSubstr("6, from time 0 to 0.5, every 0.1"),
                          HasSubstr("9 collisions in /events"), HasSubstr("size")));
}

TEST_F(Info, TheStateHashOfATrajectoryIsThatOfItsLastSample) {
  EXPECT_THAT(describe_file(out_ / "trajectory.h5md"),
              HasSubstr("state hash  " + state_hash(state_at(5, scene_)) + ", of the last sample\n"));
  const auto described = [&](const std::string& name, const Scene& scene) {
    RunWriter writer(RunDirectory(temporary_.path() / name, false), scene, hand_made_disks(scene), provenance());
    for (std::uint64_t k = 0; k < 3; ++k) writer.sample(k, state_with_effects_at(k, scene), {});
    writer.finish(hand_made_report(scene));
    return describe_file(temporary_.path() / name / "trajectory.h5md");
  };
  Scene rough = scene_with_effects(3, 2);
  EXPECT_THAT(described("rough", rough), HasSubstr("state hash  " + state_hash(state_with_effects_at(2, rough))));
  rough.output.unwrapped = true;
  EXPECT_THAT(described("unwrapped", rough), Not(HasSubstr("state hash")));
}

TEST_F(Info, DescribesExtendedXyz) {
  EXPECT_THAT(describe_file(out_ / "trajectory.xyz"),
              AllOf(HasSubstr("extended XYZ"), HasSubstr("4 0 0 0 2.5 0 0 0 0.06 from (-1 10 -0.03)"), HasSubstr("T F F"),
                    HasSubstr("6, from time 0 to 0.5"), HasSubstr("disks       5\n")));
}

TEST_F(Info, DescribesATableOfSamples) {
  EXPECT_THAT(describe_file(out_ / "samples.csv"),
              AllOf(HasSubstr("table of samples"), HasSubstr("6, from time 0 to 0.5"), HasSubstr("disks       5\n")));
}

TEST_F(Info, DescribesASummary) {
  EXPECT_THAT(describe_file(out_ / "summary.json"), AllOf(HasSubstr("summary of a run"), HasSubstr("hand_made.toml"),
                                                          HasSubstr("1000 pair, 20 wall"), HasSubstr("stopped by time")));
}

TEST_F(Info, PrintsNumbersOfASummaryAsARunDoes) {
  RunReport report = hand_made_report(scene_);
  report.packing_fraction = 0.30000000000000004;
  report.Z = 2.0589395739024647, report.Z_error = 0.008453176660596298;
  report.time = 1.0 / 3.0;
  RunWriter writer(RunDirectory(temporary_.path() / "other", false), scene_, hand_made_disks(scene_), provenance());
  writer.finish(report);
  EXPECT_THAT(describe_file(temporary_.path() / "other" / "summary.json"),
              AllOf(HasSubstr("packing fraction 0.3\n"), HasSubstr("Z           2.0589 ± 0.0085\n"),
                    HasSubstr("time        0.333333, ")));
}

TEST_F(Info, DescribesARunDirectoryFileByFile) {
  EXPECT_THAT(describe_file(out_), AllOf(HasSubstr("trajectory.h5md: "), HasSubstr("trajectory.xyz: "),
                                         HasSubstr("samples.csv: "), HasSubstr("summary.json: ")));
}

TEST_F(Info, DescribesWhatIsWholeInADirectoryWithADamagedFile) {
  write_text(out_ / "checkpoint.h5", "carom checkpoint\nand no more");
  try {
    (void)describe_file(out_);
    ADD_FAILURE() << "the damaged checkpoint was described";
  } catch (const PartlyDescribed& partly) {
    EXPECT_THAT(partly.what(), HasSubstr("checkpoint.h5: this checkpoint is damaged"));
    EXPECT_THAT(partly.text, AllOf(HasSubstr("trajectory.h5md: "), HasSubstr("summary.json: ")));
  }
}

TEST_F(Info, DescribesARunDirectoryWithoutASample) {
  // A run that ends while it equilibrates, or that is killed at once, leaves a file of no frames.
  write_text(out_ / "trajectory.xyz", "");
  fs::rename(out_ / "samples.csv", out_ / "samples.csv.partial");
  write_text(out_ / "samples.csv.partial", "");
  EXPECT_THAT(describe_file(out_), AllOf(HasSubstr("trajectory.xyz: no sample was written"), HasSubstr("summary.json: "),
                                         HasSubstr("samples.csv.partial: no sample was written")));
}

TEST_F(Info, DescribesAScene) {
  EXPECT_THAT(describe_file(fs::path(CAROM_SOURCE_DIR) / "docs/scenes/box.toml"),
              AllOf(HasSubstr("scene, Disks in a square box"), HasSubstr("64 gas"), HasSubstr("reversal")));
}

TEST_F(Info, DescribesWhatEffectsLeftInAllFiles) {
  Scene scene = scene_with_effects(3, 2);
  scene.output = {.trajectory = true, .xyz = true, .csv = true, .events = false};
  const fs::path out = temporary_.path() / "effects";
  RunWriter writer(RunDirectory(out, false), scene, hand_made_disks(scene), provenance());
  for (std::uint64_t k = 0; k < 5; ++k) writer.sample(k, state_with_effects_at(k, scene), {});
  RunReport report = hand_made_report(scene);
  report.of_effects = effects_report(scene, hand_made_disks(scene), report.totals, state_with_effects_at(4, scene));
  report.of_effects.spin_temperature = 1.25;
  writer.finish(report);
  EXPECT_THAT(
      describe_file(out / "trajectory.h5md"),
      AllOf(HasSubstr("effects     specular, walls, restitution, roughness"),
            HasSubstr("4 x 2.5 from (-1, 10); x periodic, y walls; at the end 4 x 5.5"), HasSubstr("radii       1.25 times"),
            HasSubstr("bonds, kinetic_energy, packing_fraction"), HasSubstr("spin, ")));
  EXPECT_THAT(describe_file(out / "summary.json"), AllOf(HasSubstr("temperature 1.25"), HasSubstr("dissipated"),
                                                         HasSubstr("growth      scale 1.25, packing_fraction "),
                                                         HasSubstr("square_well bonds 8"), HasSubstr("pressure on bottom ")));
  EXPECT_THAT(describe_file(out / "samples.csv"), AllOf(HasSubstr("vx,vy,spin"), HasSubstr("5, from time 0 to 0.4")));
}

TEST_F(Info, SaysOfAPartialFileThatItIsIncomplete) {
  fs::rename(out_ / "trajectory.h5md", out_ / "trajectory.h5md.partial");
  EXPECT_THAT(describe_file(out_ / "trajectory.h5md.partial"), AllOf(HasSubstr("6, from time"), HasSubstr("incomplete")));
  fs::rename(out_ / "samples.csv", out_ / "samples.csv.partial");
  EXPECT_THAT(describe_file(out_), HasSubstr("samples.csv.partial: table of samples"));
  std::ofstream(out_ / "checkpoint.h5.partial") << "what a run was writing when it was killed";
  EXPECT_THAT(describe_file(out_), HasSubstr("samples.csv.partial: table of samples"));
}

TEST_F(Info, CountsOnlyWholeSamplesOfATextThatIsCutShort) {
  EXPECT_THAT(describe_file(cut("trajectory.xyz", -5)), AllOf(HasSubstr("5, from time 0 to 0.4\n"), HasSubstr("cut short")));
  EXPECT_THAT(describe_file(cut("samples.csv", -5)), AllOf(HasSubstr("5, from time 0 to 0.4\n"), HasSubstr("cut short")));
  EXPECT_THAT(refusal_to_describe(cut("trajectory.xyz", 60)), HasSubstr("not hold one whole sample"));
  EXPECT_THAT(describe_file(cut("samples.csv", 18)), HasSubstr("samples     none"));
}

/// Describes every one of the contents in a child process, which ends without any cleaning up: HDF5 1.10 leaks what it has
/// opened in some damaged files. Each must give a description or a sentence that names the file. Returns what went wrong.
std::string descriptions_of(const std::vector<std::string>& contents, const fs::path& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    for (std::size_t i = 0; i < contents.size(); ++i) {
      write_text(path, contents[i]);
      std::string told;
      told += refusal<OutputError>([&] { told = describe_file(path); });
      if (told.find(path.filename().string() + ": ") == std::string::npos) ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) return fmt::format("killed by signal {}", WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : "a sentence does not name the file";
}

TEST_F(Info, EveryTruncationOfATrajectoryIsASentenceOrADescription) {
  const std::string whole = text_of(out_ / "trajectory.h5md");
  std::vector<std::string> contents;
  for (std::size_t size = 1; size < whole.size(); size += 1 + whole.size() / 97) contents.push_back(whole.substr(0, size));
  EXPECT_EQ(descriptions_of(contents, temporary_.path() / "cut.h5md"), "");
  EXPECT_THAT(refusal_to_describe(cut("trajectory.h5md", static_cast<std::ptrdiff_t>(whole.size() / 2))),
              AllOf(HasSubstr("cannot open this file"), HasSubstr("cut short")));
}

TEST_F(Info, ATrajectoryWithFlippedBytesIsNoCrash) {
  const std::string whole = text_of(out_ / "trajectory.h5md");
  std::vector<std::string> contents;
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 101) {
    contents.push_back(whole);
    contents.back()[at] = static_cast<char>(whole[at] ^ 0x5a);
  }
  EXPECT_EQ(descriptions_of(contents, temporary_.path() / "damaged.h5md"), "");
}

TEST_F(Info, EmptyFilesAreNamedAsEmpty) {
  for (const char* name : {"t.h5md", "t.xyz", "t.csv", "t.json", "t.toml", "t"}) {
    write_text(temporary_.path() / name, "");
    EXPECT_THAT(refusal_to_describe(temporary_.path() / name), AllOf(HasSubstr(name), HasSubstr("empty")));
  }
}

TEST_F(Info, ForeignFilesAreNamedAsSuch) {
  const fs::path directory = temporary_.path();
  write_text(directory / "t.h5md", "not HDF5 at all");
  EXPECT_THAT(refusal_to_describe(directory / "t.h5md"), HasSubstr("not an HDF5 file"));
  write_text(directory / "t.xyz", "3\ncomment\nC 0 0 0\nC 0 0 0\nC 0 0 0\n");
  EXPECT_THAT(refusal_to_describe(directory / "t.xyz"), HasSubstr("not extended XYZ as Carom writes it"));
  write_text(directory / "t.csv", "a,b\n1,2\n");
  EXPECT_THAT(refusal_to_describe(directory / "t.csv"), HasSubstr("time,id,x,y,vx,vy"));
  write_text(directory / "t.json", "{\"some\": 1}");
  EXPECT_THAT(refusal_to_describe(directory / "t.json"), HasSubstr("not the summary of a run"));
  write_text(directory / "t.json", "{\"carom\": ");
  EXPECT_THAT(refusal_to_describe(directory / "t.json"), HasSubstr("not whole JSON"));
  write_text(directory / "t.json", "{\"carom\": 1e999}");
  EXPECT_THAT(refusal_to_describe(directory / "t.json"), HasSubstr("beyond the range of doubles"));
  write_text(directory / "t.json", "{\"carom\": 3}");
  EXPECT_THAT(refusal_to_describe(directory / "t.json"), HasSubstr("not the summary of a run"));
  write_text(directory / "t.png", "\x89PNG");
  EXPECT_THAT(refusal_to_describe(directory / "t.png"), HasSubstr("does not know this kind of file"));

  const hid_t file = H5Fcreate((directory / "foreign.h5md").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  EXPECT_THAT(refusal_to_describe(directory / "foreign.h5md"), HasSubstr("Carom did not write"));
}

TEST_F(Info, GarbageInAnyTextIsASentence) {
  std::string garbage;
  for (int i = 0; i < 100'000; ++i) garbage += static_cast<char>((i * 7919 + i / 13) % 256);
  for (const char* name : {"t.h5md", "t.xyz", "t.csv", "t.json"}) {
    write_text(temporary_.path() / name, garbage);
    EXPECT_THAT(refusal_to_describe(temporary_.path() / name), HasSubstr(name));
  }
}

TEST_F(Info, MissingFilesOtherDirectoriesAndPipesAreRefused) {
  EXPECT_THAT(refusal_to_describe(temporary_.path() / "missing"), HasSubstr("No such file"));
  fs::create_directory(temporary_.path() / "other");
  EXPECT_THAT(refusal_to_describe(temporary_.path() / "other"), HasSubstr("holds no results"));
  ASSERT_EQ(::mkfifo((temporary_.path() / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(refusal_to_describe(temporary_.path() / "pipe"), HasSubstr("neither a file nor a directory"));
}

}  // namespace
}  // namespace carom::test
