// The sentences of output errors.

#include "io/output_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace carom::detail {

namespace {

std::string_view advice_for(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "free some space there, or write elsewhere with --out";
    case EFBIG:
      return "write less (a larger run.sample_every, fewer products), or raise the limit on file sizes (ulimit -f)";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a directory that you may write to with --out";
    case ENOTDIR:
    case EEXIST:
      return "a file is in the way: choose another directory with --out";
    case EMFILE:
    case ENFILE:
      return "too many files are open: close some, or raise the limit (ulimit -n)";
    default:
      return "check the disk, or choose another directory with --out";
  }
}

}  // namespace

OutputError system_error(const std::filesystem::path& path, std::string_view action, int error_number, std::string_view kept) {
  return OutputError(fmt::format("{}: cannot {}: {}; {}{}{}", path.string(), action,
                                 std::generic_category().message(error_number), kept, kept.empty() ? "" : "; ",
                                 advice_for(error_number)));
}

}  // namespace carom::detail
