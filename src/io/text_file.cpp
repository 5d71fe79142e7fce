// Buffered text that reports every failure.

#include "io/text_file.hpp"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace carom::detail {

namespace {
// Large enough that the cost of a system call disappears, small enough to fit into the processor's cache.
constexpr std::size_t full_buffer = std::size_t{1} << 18;
}  // namespace

TextFile::TextFile(std::filesystem::path path) : path_(std::move(path)) {
  buffer_.reserve(full_buffer + full_buffer / 4);
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw system_error(path_, "create it", errno);
}

TextFile::TextFile(std::filesystem::path path, std::uint64_t kept)
    : path_(std::move(path)), written_(kept), record_end_(kept), written_record_end_(kept) {
  buffer_.reserve(full_buffer + full_buffer / 4);
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw system_error(path_, "open it", errno);
  const off_t size = ::lseek(descriptor_, 0, SEEK_END), end = static_cast<off_t>(kept);
  const int error =
      size < 0 || (size >= end && (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) < 0)) ? errno : 0;
  if (error == 0 && size >= end) return;
  ::close(std::exchange(descriptor_, -1));
  if (error != 0) throw system_error(path_, "cut it back to where the run is to go on", error);
  throw cut_short(path_, static_cast<std::uint64_t>(size), kept);
}

TextFile::~TextFile() {
  if (descriptor_ < 0) return;
  try {
    close();
  } catch (const OutputError&) {
    // fail() has cut the file back to whole records, and a destructor cannot report the error
  }
}

void TextFile::end_line() {
  if (buffer_.size() >= full_buffer) flush();
}

void TextFile::end_record() {
  record_end_ = written_ + buffer_.size();
  end_line();
}

void TextFile::flush() {
  if (failed_ != 0) throw failure();  // what came after the failure is not in the file, whatever has become of the disk
  std::size_t done = 0;
  while (done < buffer_.size() && descriptor_ >= 0) {
    const ssize_t count = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (count < 0 && errno != EINTR) fail(errno);
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  written_ += done;
  written_record_end_ = record_end_;
  buffer_.clear();
}

void TextFile::close() {
  flush();
  if (descriptor_ < 0) return;
  if (::close(std::exchange(descriptor_, -1)) != 0) throw system_error(path_, "write it to its end", errno);
}

void TextFile::fail(int error_number) {
  // A torn last record would only make readers stumble. If even the cut fails, the first error is still the one to report.
  whole_ = ::ftruncate(descriptor_, static_cast<off_t>(written_record_end_)) == 0;
  ::close(std::exchange(descriptor_, -1));
  buffer_.clear();
  failed_ = error_number;
  throw failure();
}

OutputError TextFile::failure() const {
  return system_error(path_, "write", failed_, whole_ && written_record_end_ > 0 ? "what it holds is whole and readable" : "");
}

}  // namespace carom::detail
