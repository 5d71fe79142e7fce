#include "io/partial_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace carom {

namespace fs = std::filesystem;

PartialFile::PartialFile(fs::path path) : path_(std::move(path)), partial_(path_.string() + ".partial") {
  std::error_code error;
  if (fs::exists(path_, error) && !fs::is_regular_file(path_, error))
    throw OutputError(fmt::format("{}: this is no file that could be replaced; name another one", path_.string()));
  if (!std::ofstream(partial_, std::ios::binary)) throw detail::system_error(path_, "write", errno);
}

PartialFile::~PartialFile() {
  std::error_code ignored;
  if (!published_) fs::remove(partial_, ignored);
}

void PartialFile::write(std::string_view bytes) const {
  std::ofstream file(partial_, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw detail::system_error(path_, "write", errno);
}

void PartialFile::publish() {
  std::error_code error;
  fs::rename(partial_, path_, error);
  if (error) throw detail::system_error(path_, "write", error.value());
  published_ = true;
}

}  // namespace carom
