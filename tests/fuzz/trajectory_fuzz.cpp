// Bytes as a text file that a run may have left behind, whole, cut short or damaged: it is described or refused in a sentence.
// Not as an HDF5 file: HDF5 1.10 itself leaks memory over some damaged files, and over others it never comes to an end.

#include "app/info.hpp"
#include "support/temporary_directory.hpp"

#include <carom/scene.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  // The first byte says what the file is called.
  constexpr const char* names[] = {"summary.json", "trajectory.xyz", "samples.csv"};
  static const carom::test::TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / names[data[0] % 3];
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  try {
    (void)carom::describe_file(file);
  } catch (const carom::OutputError&) {
  } catch (const carom::SceneError&) {
  }
  std::filesystem::remove(file);
  return 0;
}
