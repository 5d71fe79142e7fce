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
      return "free some space there";
    case EFBIG:
      return "write less (a larger run.sample_every, fewer products), or raise the limit on file sizes (ulimit -f)";
    case EACCES:
    case EPERM:
    case EROFS:
      return "see that you may write there";
    case ENOTDIR:
    case EEXIST:
      return "a file is in the way: move it";
    case EMFILE:
    case ENFILE:
      return "too many files are open: close some, or raise the limit (ulimit -n)";
    default:
      return "check the disk";
  }
}

}  // namespace

OutputError system_error(const std::filesystem::path& path, std::string_view action, int error_number, std::string_view kept) {
  return OutputError(fmt::format("{}: cannot {}: {}; {}{}{}", path.string(), action,
                                 std::generic_category().message(error_number), kept, kept.empty() ? "" : "; ",
                                 advice_for(error_number)));
}

OutputError cut_short(const std::filesystem::path& path, std::uint64_t bytes, std::uint64_t wanted) {
  return OutputError(fmt::format("{}: the file has {} bytes and must have {} for the run to go on; it was changed or cut",
                                 path.string(), bytes, wanted));
}

}  // namespace carom::detail
