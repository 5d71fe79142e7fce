// Samples as a table.

#include "io/csv_writer.hpp"

#include "text/csv_cell.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

namespace carom {

CsvWriter::CsvWriter(std::filesystem::path path, bool rough) : file_(std::move(path)), rough_(rough) {
  file_.buffer() += rough_ ? "time,id,x,y,vx,vy,spin\n" : "time,id,x,y,vx,vy\n";
  file_.end_record();
}

void CsvWriter::sample(const State& state) {
  const std::string time = csv_cell(state.time);
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    const auto out = std::back_inserter(file_.buffer());
    // As csv_cell() writes them.
    fmt::format_to(out, "{},{},{:#},{:#},{:#},{:#}", time, i, state.positions(0, i), state.positions(1, i),
                   state.velocities(0, i), state.velocities(1, i));
    if (rough_) fmt::format_to(out, ",{:#}", state.spins.size() > 0 ? state.spins[i] : 0.0);
    file_.buffer() += '\n';
    file_.end_line();
  }
  file_.end_record();
}

}  // namespace carom
