// carom info FILE: what a file that Carom wrote holds.

#include "cli/commands.hpp"
#include "io/info.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace carom::cli {

void add_info_command(CLI::App& program, Command& chosen) {
  CLI::App* command = program.add_subcommand("info", "Say what a file or a run directory holds");
  const auto path = std::make_shared<std::string>();
  command->add_option("file", *path, "A trajectory, table, summary or run directory")->required()->type_name("FILE");
  command->callback([path, &chosen] {
    chosen = [path] {
      try {
        fmt::print("{}", describe_file(*path));
      } catch (const OutputError& error) {
        throw UsageError(error.what());
      }
      return exit_done;
    };
  });
}

}  // namespace carom::cli
