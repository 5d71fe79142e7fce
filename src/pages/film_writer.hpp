#pragma once
// Films: frames go as bare pixels through a pipe to the program ffmpeg, which encodes them and writes the file.

#include "io/child_process.hpp"
#include "io/partial_file.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace carom {

enum class FilmFormat { mp4, gif, webm };

struct FilmShape {
  FilmFormat format = FilmFormat::mp4;
  int width = 0, height = 0;  ///< pixels; even, but for GIF
  double fps = 30.0;          ///< frames per second
};

/// Returns the path of a program that is found on PATH.
[[nodiscard]] std::optional<std::filesystem::path> find_program(std::string_view name);

class FilmWriter {
 public:
  /// Starts ffmpeg, which writes the partial file, whatever that is called. `keep_going` is asked now and then while ffmpeg is
  /// waited for. Throws OutputError where it cannot be started.
  FilmWriter(const PartialFile& file, const FilmShape& shape, std::function<bool()> keep_going);
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;
  ~FilmWriter();  ///< kills ffmpeg, unless finish() has returned

  /// One picture: rows from the top, in each pixel 0xRRGGBB. False where it was not to go on. Throws OutputError with ffmpeg's
  /// words where it has given up.
  [[nodiscard]] bool frame(std::span<const std::uint32_t> pixels);
  /// Waits until the file is complete. False where it was not to go on. Throws OutputError.
  [[nodiscard]] bool finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail();
  void close_pipe();

  [[nodiscard]] bool is_whole() const;

  std::filesystem::path path_;     ///< for messages
  std::filesystem::path partial_;  ///< what ffmpeg writes
  FilmFormat format_;
  std::function<bool()> keep_going_;
  std::unique_ptr<std::FILE, CloseFile> complaints_;  ///< standard error of ffmpeg
  int pipe_ = -1;
  std::optional<ChildProcess> process_;  ///< ffmpeg
};

}  // namespace carom
