#include "pages/film_writer.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>  // sigaction is POSIX, not C++
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace carom {

namespace {

constexpr auto poll_interval = std::chrono::milliseconds(10);

constexpr const char* pixel_format = std::endian::native == std::endian::little ? "bgr0" : "0rgb";

/// Colours as screens of today expect them, and sampled so that every player shows them.
const std::vector<std::string> for_screens = {"-vf",
                                              "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
                                              "-colorspace",
                                              "bt709",
                                              "-color_primaries",
                                              "bt709",
                                              "-color_trc",
                                              "bt709"};

/// Constant quality: flat colours stay flat, and thin lines thin.
std::vector<std::string> encoding(FilmFormat format) {
  std::vector<std::string> words;
  switch (format) {
    case FilmFormat::mp4:
      words = {"-c:v", "libx264", "-preset", "fast", "-crf", "20", "-movflags", "+faststart", "-f", "mp4"};
      break;
    case FilmFormat::webm:
      words = {"-c:v", "libvpx-vp9", "-b:v", "0",       "-crf", "30", "-deadline",
               "good", "-cpu-used",  "5",    "-row-mt", "1",    "-f", "webm"};
      break;
    case FilmFormat::gif:
      // A palette for each frame: one for all would have ffmpeg hold the whole film in memory first.
      return {"-filter_complex",
              "split[a][b];[a]palettegen=stats_mode=single:reserve_transparent=0[p];[b][p]paletteuse=new=1:dither=none",
              "-loop",
              "0",
              "-f",
              "gif"};
  }
  words.insert(words.begin(), for_screens.begin(), for_screens.end());
  return words;
}

std::vector<std::string> command_line(const std::filesystem::path& file, const FilmShape& shape) {
  std::vector<std::string> words = {"ffmpeg",
                                    "-hide_banner",
                                    "-nostdin",
                                    "-y",
                                    "-loglevel",
                                    "error",
                                    "-f",
                                    "rawvideo",
                                    "-pixel_format",
                                    pixel_format,
                                    "-video_size",
                                    fmt::format("{}x{}", shape.width, shape.height),
                                    "-framerate",
                                    fmt::format("{}", shape.fps),
                                    "-i",
                                    "pipe:0"};
  for (std::string& word : encoding(shape.format)) words.push_back(std::move(word));
  words.push_back("file:" + file.string());  // or a colon in the name would be read as a protocol
  return words;
}

/// SIGPIPE would end this program before it could say why.
class IgnoredPipeSignal {
 public:
  IgnoredPipeSignal() {
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &ignore, &before_);
  }
  ~IgnoredPipeSignal() { sigaction(SIGPIPE, &before_, nullptr); }
  IgnoredPipeSignal(const IgnoredPipeSignal&) = delete;
  IgnoredPipeSignal& operator=(const IgnoredPipeSignal&) = delete;

 private:
  struct sigaction before_ = {};
};

/// Returns the first line that ffmpeg has written, or nothing.
std::string first_line(std::FILE* file) {
  std::rewind(file);
  std::string line;
  for (int c = std::fgetc(file); c != EOF && c != '\n' && line.size() < 300; c = std::fgetc(file)) line += static_cast<char>(c);
  return line;
}

}  // namespace

std::optional<std::filesystem::path> find_program(std::string_view name) {
  const char* const path = std::getenv("PATH");
  std::string_view places = path == nullptr ? std::string_view("/usr/local/bin:/usr/bin:/bin") : std::string_view(path);
  for (bool more = true; more;) {
    const std::size_t colon = places.find(':');
    more = colon != std::string_view::npos;
    const std::filesystem::path place = places.substr(0, colon);
    if (more) places.remove_prefix(colon + 1);
    const std::filesystem::path program = (place.empty() ? "." : place) / name;
    std::error_code error;
    if (std::filesystem::is_regular_file(program, error) && ::access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

FilmWriter::FilmWriter(const PartialFile& file, const FilmShape& shape, std::function<bool()> keep_going)
    : path_(file.path()),
      partial_(file.partial_name()),
      format_(shape.format),
      keep_going_(std::move(keep_going)),
      complaints_(std::tmpfile()) {
  const auto program = find_program("ffmpeg");
  if (!program) throw OutputError("there is no program ffmpeg, which films are made with; install the package ffmpeg");
  if (!complaints_) throw detail::system_error(P_tmpdir, "write a temporary file", errno);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw detail::system_error(path_, "write", errno);
  ::fcntl(ends[1], F_SETFL, O_NONBLOCK);
  try {
    process_.emplace(*program, command_line(file.partial_name(), shape),
                     ChildProcess::Options{.input = ends[0], .errors = ::fileno(complaints_.get()), .own_group = true});
  } catch (const std::system_error& error) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw OutputError(
        fmt::format("{}: cannot be started: {}; check that it runs by itself", program->string(), error.code().message()));
  }
  ::close(ends[0]);
  pipe_ = ends[1];
}

FilmWriter::~FilmWriter() { close_pipe(); }

void FilmWriter::close_pipe() {
  if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
}

void FilmWriter::fail() {
  close_pipe();
  for (int tries = 0; !process_->has_ended() && tries < 100; ++tries)
    std::this_thread::sleep_for(poll_interval);  // it may still be saying why
  process_.reset();
  const std::string words = first_line(complaints_.get());
  throw OutputError(fmt::format("{}: ffmpeg could not write this film{}{}; check the disk, and that this ffmpeg is complete",
                                path_.string(), words.empty() ? " and does not say why" : ": ", words));
}

bool FilmWriter::frame(std::span<const std::uint32_t> pixels) {
  const IgnoredPipeSignal ignored;
  const auto bytes = std::as_bytes(pixels);
  for (std::size_t written = 0; written < bytes.size();) {
    const ssize_t count = ::write(pipe_, bytes.data() + written, bytes.size() - written);
    if (count >= 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN) {
      if (!keep_going_()) return false;
      pollfd room{.fd = pipe_, .events = POLLOUT, .revents = 0};
      ::poll(&room, 1, 100);  // milliseconds: the longest delay of Ctrl-C
    } else if (errno != EINTR) {
      fail();
    }
  }
  return keep_going_();
}

bool FilmWriter::finish() {
  close_pipe();
  while (!process_->has_ended()) {
    if (!keep_going_()) return false;
    std::this_thread::sleep_for(poll_interval);
  }
  const int status = process_->wait();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !is_whole()) fail();
  return true;
}

/// Whether ffmpeg, which ends with 0 where its last bytes did not fit on the disk, has written the whole film. Of an MP4 it does
/// not say so either: but its index is moved to the front at the very end, behind the first box.
bool FilmWriter::is_whole() const {
  if (format_ != FilmFormat::mp4) return first_line(complaints_.get()).empty();
  std::ifstream film(partial_, std::ios::binary);
  std::array<unsigned char, 8> box{};
  const auto read_box = [&] { return static_cast<bool>(film.read(reinterpret_cast<char*>(box.data()), box.size())); };
  if (!read_box()) return false;
  std::uint32_t size = 0;
  for (std::size_t k = 0; k < 4; ++k) size = size << 8 | box[k];
  film.seekg(size);
  return read_box() && std::equal(box.begin() + 4, box.end(), "moov");
}

}  // namespace carom
