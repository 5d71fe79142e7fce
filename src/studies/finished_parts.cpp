#include "studies/finished_parts.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstddef>
#include <fstream>
#include <system_error>
#include <utility>

namespace carom::detail {

using Json = nlohmann::ordered_json;

FinishedParts::FinishedParts(std::filesystem::path path, PartWords words, const std::string& key,
                             const std::vector<std::string>& before)
    : path_(std::move(path)), words_(std::move(words)) {
  const std::filesystem::path final_path = std::exchange(path_, path_.string() + ".partial");
  {
    std::ofstream file(path_, std::ios::trunc);
    if (!file) throw system_error(path_, "write it", errno);
  }
  add(Json{{"study", key}}.dump());
  for (const std::string& line : before) add(line);
  std::error_code error;
  std::filesystem::rename(path_, final_path, error);
  if (error) throw system_error(final_path, "write it", error.value());
  path_ = final_path;
}

void FinishedParts::add(const std::string& line) {
  std::ofstream file(path_, std::ios::app);
  file << line << '\n' << std::flush;
  if (!file)
    throw system_error(path_, "write it", errno,
                       fmt::format("finished {}s are kept, and the same command with --resume goes on", words_.part));
}

void read_finished_parts(const std::filesystem::path& path, const PartWords& words, const std::string& key,
                         const std::function<void(const Json& part)>& take) {
  std::ifstream file(path);
  if (!file && errno == ENOENT)
    throw OutputError(
        fmt::format("{}: there is no such file, so that no {} is finished to go on from; leave out --resume to begin",
                    path.string(), words.part));
  if (!file) throw system_error(path, "read it", errno);
  bool ours = false;
  std::size_t line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    const Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded()) continue;  // the line that was being written when the study was killed
    try {
      if (json.contains("study")) {
        ours = json["study"] == key;
      } else {
        take(json);
      }
    } catch (const Json::exception&) {
      throw OutputError(fmt::format("{}:{}: this is no {} that carom has written; take the line out, or begin anew with --force",
                                    path.string(), line_number, words.part));
    }
  }
  if (!ours)
    throw OutputError(
        fmt::format("{}: these {}s are of another {}, other options or another build of carom; give the same again, or "
                    "begin anew with --force",
                    path.string(), words.part, words.of));
}

}  // namespace carom::detail
