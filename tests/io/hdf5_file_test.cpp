// The file under HDF5: when the index reaches the disk, in which order, and what a failure leaves.

#include "io/hdf5_file.hpp"

#include "io/hand_made_run.hpp"
#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <span>

#include <sys/resource.h>
#include <sys/wait.h>

namespace carom::test {
namespace {

using detail::Hdf5File;

std::vector<std::byte> bytes(std::size_t count, char value) {
  return std::vector<std::byte>(count, static_cast<std::byte>(value));
}

std::string read(Hdf5File& file, std::uint64_t address, std::size_t size) {
  std::string text(size, '?');
  file.read(address, size, std::as_writable_bytes(std::span(text)).data());
  return text;
}

class Hdf5FileTest : public ::testing::Test {
 protected:
  Hdf5FileTest() { file_.open(path_.c_str(), true); }
  ~Hdf5FileTest() override { file_.close(); }
  void index(std::uint64_t address, std::size_t size, char value) { file_.hold_index(address, size, bytes(size, value).data()); }
  void data(std::uint64_t address, std::size_t size, char value) { file_.write_data(address, size, bytes(size, value).data()); }

  TemporaryDirectory temporary_;
  std::filesystem::path path_ = temporary_.path() / "file";
  Hdf5File file_;
};

TEST_F(Hdf5FileTest, TheIndexReachesTheDiskAtTheFlushAndDataAtOnce) {
  data(0, 4, 'd');
  index(4, 4, 'i');
  EXPECT_EQ(text_of(path_), "dddd");
  EXPECT_EQ(read(file_, 2, 4), "ddii");
  EXPECT_GT(file_.held_bytes(), 0u);
  file_.commit_index();
  EXPECT_EQ(text_of(path_), "ddddiiii");
  EXPECT_EQ(file_.held_bytes(), 0u);
}

TEST(Hdf5FileClosed, OpensHoweverManyGroupsAndColumnsItHolds) {
  // As it closes a file, HDF5 gives back what is left of its last block of index, and then writes the superblock once more.
  const detail::SilentHdf5 silent;
  const TemporaryDirectory temporary;
  const std::vector<double> column(100, 1.5);
  for (std::size_t groups = 0; groups <= 40; ++groups) {
    const std::filesystem::path path = temporary.path() / "file";
    {
      Hdf5File file;
      detail::Hdf5Id opened = file.create(path);
      detail::checked(H5Fflush(opened.get(), H5F_SCOPE_GLOBAL));
      for (std::size_t k = 0; k < groups; ++k) {
        const detail::Hdf5Id group = detail::create_group(opened.get(), "group" + std::to_string(k));
        detail::write_fixed(group.get(), "column", std::span<const double>(column));
      }
      opened.close();
      EXPECT_EQ(file.error(), 0);
    }
    EXPECT_NO_THROW(detail::Hdf5Id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose)) << groups << " groups";
  }
}

TEST_F(Hdf5FileTest, WritesThatOverlapAcrossPagesAreReadInTheirOrder) {
  index(4000, 300, 'a');
  data(4090, 10, 'b');
  index(4095, 2, 'c');
  const std::string expected = std::string(90, 'a') + "bbbbbccbbb" + std::string(200, 'a');
  EXPECT_EQ(read(file_, 4000, 300), expected);
  file_.commit_index();
  EXPECT_EQ(read(file_, 4000, 300), expected);
  EXPECT_EQ(text_of(path_), std::string(4000, '\0') + expected);
}

TEST_F(Hdf5FileTest, PastTheEndThereAreZeros) {
  data(0, 2, 'd');
  EXPECT_EQ(read(file_, 0, 4), std::string("dd\0\0", 4));
  EXPECT_EQ(file_.error(), 0);
}

TEST_F(Hdf5FileTest, ACommitThatFailsLeavesTheOldIndexUntouched) {
  // New parts come before the old ones that point to them: when there is no room for the new, the old still stands.
  index(0, 10, 'o');
  file_.commit_index();
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{20'000, 20'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    index(0, 10, 'n');
    index(30'000, 10, 'n');
    file_.commit_index();
    const bool failed = file_.error() == EFBIG;
    data(100, 10, 'x');
    file_.commit_index();
    const bool still_reads_back = read(file_, 0, 10) == "nnnnnnnnnn";
    ::_exit(failed && still_reads_back ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(text_of(path_), "oooooooooo");
}

}  // namespace
}  // namespace carom::test
