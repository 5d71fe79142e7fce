// Full disks and killed runs, played in child processes: a limit on the size of files stands for the full disk.

#include "app/info.hpp"
#include "io/h5md_reader.hpp"
#include "io/hand_made_run.hpp"
#include "io/run_writer.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <functional>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int ended_with_output_error = 7;

/// Runs `action` in a child process that ends in the ordinary way, exit handlers included. An OutputError's sentence goes
/// to `message`, and the exit code says that there was one. Returns what waitpid reports.
int in_child(const fs::path& message, const std::function<void()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    int code = 0;
    try {
      action();
    } catch (const OutputError& error) {
      write_text(message, error.what());
      code = ended_with_output_error;
    } catch (...) {
      code = 99;
    }
    std::exit(code);  // runs HDF5's own exit handler, which is where a full disk is known to crash
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

void limit_file_size(rlim_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

/// How many samples the file holds; they must be those of the scene, bit for bit.
std::size_t readable_samples(const fs::path& path, const Scene& scene) {
  const H5Reader file(path);
  if (!file.opens()) {
    ADD_FAILURE() << path << " does not open";
    return 0;
  }
  const std::vector<double> positions = file.doubles("/particles/trajectory/position/value");
  const std::vector<double> times = file.doubles("/particles/trajectory/velocity/time");
  const auto disks = static_cast<std::size_t>(scene.disk_count());
  const std::size_t samples = file.extents("/particles/trajectory/position/value")[0];
  EXPECT_EQ(samples, times.size());
  for (std::size_t k = 0; k < samples; ++k) {
    const State state = state_at(k, scene);
    for (std::size_t i = 0; i < disks; ++i) {
      const std::size_t at = 3 * (k * disks + i);
      if (positions[at] != state.positions(0, static_cast<Eigen::Index>(i)) ||
          positions[at + 1] != state.positions(1, static_cast<Eigen::Index>(i))) {
        ADD_FAILURE() << "sample " << k << " disk " << i;
        return k;
      }
    }
  }
  return samples;
}

/// The size limits are chosen so that the failing write meets the buffers in different states.
class FullDisk : public ::testing::TestWithParam<rlim_t> {};

TEST_P(FullDisk, EndsAnH5mdWriterWithOneSentenceAndKeepsItsFlushedSamples) {
  const TemporaryDirectory temporary;
  const fs::path path = temporary.path() / "t.h5md";
  Scene scene = scene_of(20, 20);
  scene.output.events = true;
  const fs::path message = temporary.path() / "message";
  const fs::path safe = temporary.path() / "safe";
  const int status = in_child(message, [&] {
    limit_file_size(GetParam());
    H5mdWriter writer(path, scene, hand_made_disks(scene), provenance());
    for (std::uint64_t k = 0; k < 100'000; ++k) {
      writer.sample(k, state_at(k, scene), {});
      writer.events(events_up_to(50));
      if (k % 37 != 0) continue;
      writer.flush();
      write_text(safe, std::to_string(writer.safe_samples()));
    }
  });
  ASSERT_TRUE(WIFEXITED(status)) << "killed by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), ended_with_output_error);
  const std::string kept = text_of(safe);
  if (GetParam() > 1'000'000) {
    ASSERT_GT(std::stoi(kept), 0);
  }
  if (!kept.empty() && kept != "0") {
    EXPECT_THAT(text_of(message), AllOf(HasSubstr(path.string() + ": cannot write: File too large"), HasSubstr(kept + " samples"),
                                        HasSubstr("readable")));
    EXPECT_EQ(std::to_string(readable_samples(path, scene)), kept);
  }
}

INSTANTIATE_TEST_SUITE_P(FullDisk, FullDisk, ::testing::Values(1, 5'000, 50'000, 300'001, 1'000'000, 1'500'003, 3'000'000));

TEST(FullDiskOfARun, StopsTheRunAndKeepsWholeSamplesInEveryPartialFile) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(20, 20);
  scene.output = {.trajectory = true, .xyz = true, .csv = true, .events = true};
  const fs::path message = temporary.path() / "message";
  const fs::path out = temporary.path() / "out";
  const int status = in_child(message, [&] {
    limit_file_size(2'000'000);  // the text files reach it first
    const RunDirectory directory(out, false);
    RunWriter writer(directory, scene, hand_made_disks(scene), provenance());
    for (std::uint64_t k = 0; k < 100'000; ++k) writer.sample(k, state_at(k, scene), {});
    writer.finish(hand_made_report(scene));
  });
  ASSERT_TRUE(WIFEXITED(status)) << "killed by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), ended_with_output_error);
  EXPECT_THAT(text_of(message), AllOf(HasSubstr(".partial: cannot write: File too large"), HasSubstr("readable")));
  EXPECT_FALSE(fs::exists(out / "summary.json"));
  EXPECT_FALSE(fs::exists(out / "trajectory.h5md"));
  EXPECT_GT(readable_samples(out / "trajectory.h5md.partial", scene), 0u);
  for (const char* name : {"trajectory.xyz.partial", "samples.csv.partial"}) {
    const std::string content = text_of(out / name);
    EXPECT_GT(content.size(), 100'000u) << name;
    EXPECT_EQ(content.back(), '\n') << name;
    EXPECT_THAT(describe_file(out / name), AllOf(HasSubstr("samples"), ::testing::Not(HasSubstr("cut short")))) << name;
  }
}

/// After a write that failed the file has a gap. Who caught that failure, and went on, must not end with a whole run.
TEST(FullDiskOfARun, IsNotForgottenByWhatComesLater) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(20, 20);
  scene.output = {.trajectory = false, .csv = true};
  const fs::path message = temporary.path() / "message";
  const fs::path out = temporary.path() / "out";
  const int status = in_child(message, [&] {
    limit_file_size(300'000);
    RunWriter writer(RunDirectory(out, false), scene, hand_made_disks(scene), provenance());
    for (std::uint64_t k = 0; k < 1000; ++k) {
      writer.sample(k, state_at(k, scene), {});
      try {
        std::ostringstream saved;
        if (k % 10 == 9) writer.save(saved);
      } catch (const OutputError&) {
        limit_file_size(3'000'000);  // there is room again
      }
    }
    writer.finish(hand_made_report(scene));
  });
  ASSERT_TRUE(WIFEXITED(status)) << "killed by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), ended_with_output_error);
  EXPECT_THAT(text_of(message), HasSubstr("samples.csv.partial: cannot write: File too large"));
  EXPECT_FALSE(fs::exists(out / "summary.json"));
}

TEST(FullDiskOfARun, IsNoticedWhenOnlyTheSummaryIsTooMuch) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(1, 0);
  scene.output = {.trajectory = false};
  const fs::path message = temporary.path() / "message";
  const fs::path out = temporary.path() / "out";
  const int status = in_child(message, [&] {
    limit_file_size(100);
    RunWriter writer(RunDirectory(out, false), scene, hand_made_disks(scene), provenance());
    writer.finish(hand_made_report(scene));
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), ended_with_output_error);
  EXPECT_FALSE(fs::exists(out / "summary.json"));
}

TEST(KilledRun, LeavesWhatWasFlushedReadable) {
  // Killed at many different moments; every time the file must open with at least what the writer had called safe.
  for (int moment = 0; moment < 12; ++moment) {
    const TemporaryDirectory temporary;
    Scene scene = scene_of(20, 20);
    scene.output.events = true;
    const fs::path path = temporary.path() / "t.h5md";
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      H5mdWriter writer(path, scene, hand_made_disks(scene), provenance());
      for (std::uint64_t k = 0;; ++k) {
        writer.sample(k, state_at(k, scene), {});
        writer.events(events_up_to(50));
        if (k % 10 == 9) writer.flush();
        const std::uint64_t safe = writer.safe_samples();
        if (safe > 0 && ::write(pipe[1], &safe, sizeof safe) < 0) ::_exit(1);
      }
    }
    ::close(pipe[1]);
    std::uint64_t safe = 0;
    const auto enough = static_cast<std::uint64_t>(10 + 170 * moment);
    while (safe<enough&& ::read(pipe[0], &safe, sizeof safe)> 0) {
    }
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    for (std::uint64_t late = 0; ::read(pipe[0], &late, sizeof late) > 0;) safe = late;
    ::close(pipe[0]);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_GE(safe, enough);
    EXPECT_GE(readable_samples(path, scene), safe);
    EXPECT_THAT(describe_file(path), HasSubstr("samples"));
  }
}

TEST(KilledRun, IsNotOverwrittenWithoutForce) {
  const TemporaryDirectory temporary;
  const Scene scene = scene_of(2, 2);
  const pid_t child = ::fork();
  if (child == 0) {
    RunWriter writer(RunDirectory(temporary.path(), false), scene, hand_made_disks(scene), provenance());
    writer.sample(0, state_at(0, scene), {});
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_THROW(RunDirectory(temporary.path(), false), OutputError);
  EXPECT_TRUE(fs::exists(temporary.path() / "trajectory.h5md.partial"));
  EXPECT_NO_THROW(RunDirectory(temporary.path(), true));
}

}  // namespace
}  // namespace carom::test
