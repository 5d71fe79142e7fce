#include "studies/study_directory.hpp"

#include "io/text_file.hpp"
#include "terminal/command.hpp"

#include <array>

namespace carom::cli {

RunDirectory open_study(const std::filesystem::path& path, bool force, bool resume, std::span<const std::string_view> products,
                        LockHolder holder) {
  if (force && resume) throw UsageError("--force begins anew and --resume goes on with what is there: give one of them");
  try {
    // A study that is resumed finds its finished parts in the directory; any other file is refused.
    static constexpr std::array<std::string_view, 0> none = {};
    return resume ? RunDirectory(path, false, none, holder) : RunDirectory(path, force, products, holder);
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
}

void write_product(const RunDirectory& directory, std::string_view product, const std::string& text) {
  detail::TextFile file(directory.partial_name(product));
  file.buffer() += text;
  file.end_record();
  file.close();
  directory.publish(product);
}

}  // namespace carom::cli
