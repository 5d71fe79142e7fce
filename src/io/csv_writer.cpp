// Samples as a table.

#include "io/csv_writer.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

namespace carom {

CsvWriter::CsvWriter(std::filesystem::path path) : file_(std::move(path)) {
  file_.buffer() += "time,id,x,y,vx,vy\n";
  file_.end_record();
}

void CsvWriter::sample(const State& state) {
  const std::string time = fmt::format("{}", state.time);
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    fmt::format_to(std::back_inserter(file_.buffer()), "{},{},{},{},{},{}\n", time, i, state.positions(0, i),
                   state.positions(1, i), state.velocities(0, i), state.velocities(1, i));
    file_.end_line();
  }
  file_.end_record();
}

}  // namespace carom
