#include "io/partial_file.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace carom {

namespace fs = std::filesystem;

PartialFile::PartialFile(fs::path path) : path_(std::move(path)), partial_(path_.string() + ".partial") {
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
