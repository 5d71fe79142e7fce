// carom info FILE: what a file that Carom wrote holds.

#include "cli/commands.hpp"
#include "io/info.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace carom::cli {

void add_info_command(CLI::App& program, Command& chosen) {
  CLI::App* command = program.add_subcommand("info", "Say what a file or a run directory holds");
  const auto path = std::make_shared<std::string>();
  command->add_option("file", *path, "A trajectory, table, summary or run directory")->required()->type_name("FILE");
  command->callback([path, &chosen] {
    chosen = [path] {
      std::error_code error;
      if (!std::filesystem::exists(*path, error)) throw UsageError(fmt::format("{}: there is no such file", *path));
      fmt::print("{}", describe_file(*path));
      return exit_done;
    };
  });
}

}  // namespace carom::cli
