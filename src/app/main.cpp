// The program carom: does what the command line asks, and turns what went wrong into one sentence on stderr and an exit
// code. Nothing escapes. The same with MPI is the program carom-mpi, to which carom hands over under mpirun and srun.

#include "app/arguments.hpp"
#if CAROM_HAS_MPI
#include "app/mpi_processes.hpp"
#endif
#include "terminal/processes.hpp"
#include "terminal/standard_output.hpp"

#include <fmt/format.h>
#include <carom/scene.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace {

using namespace carom::cli;

ExitCode complain(ExitCode code, const char* sentence) {
  std::fprintf(stderr, "carom: %s\n", sentence);
  return code;
}

ExitCode run_program(int argc, char** argv) {
  try {
    return parse_arguments(argc, argv)();
  } catch (const carom::SceneError& error) {
    return complain(exit_usage, error.what());
  } catch (const UsageError& error) {
    return complain(exit_usage, error.what());
  } catch (const std::invalid_argument& error) {  // what the library refuses, such as an engine that does not cover the scene
    return complain(exit_usage, error.what());
  } catch (const std::bad_alloc&) {
    return complain(exit_failed, "there is not enough memory");
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = error.path1().empty() ? "the current directory" : error.path1().string();
    return complain(exit_usage, (path + ": " + error.code().message()).c_str());
  } catch (const std::system_error& error) {  // of fmt::print, which says nothing of where
    constexpr std::string_view of_printing = "cannot write to file: ";
    const std::string_view sentence = error.what();
    if (!sentence.starts_with(of_printing)) return complain(exit_failed, error.what());
    return complain(exit_failed, fmt::format("cannot write to standard output: {}", sentence.substr(of_printing.size())).c_str());
  } catch (const std::exception& error) {
    return complain(exit_failed, error.what());
  } catch (...) {
    return complain(exit_failed, "an unknown error ended the program");
  }
}

/// A closed standard stream would hand its number to the next file opened, and progress would be written into results.
void open_standard_streams() {
  for (int descriptor = open("/dev/null", O_RDWR); descriptor >= 0; descriptor = open("/dev/null", O_RDWR)) {
    if (descriptor <= STDERR_FILENO) continue;
    close(descriptor);
    return;
  }
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
#if CAROM_HAS_MPI
  set_process_joiner(join_by_mpi);
#else
  continue_as_carom_mpi(argv);
#endif
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is then an error like a full disk, with a sentence
  const ExitCode code = run_program(argc, argv);
  try {
    flush_output();
  } catch (const std::runtime_error& error) {
    if (code == exit_done) return complain(exit_failed, error.what());
  }
  return code;
}
