// Samples as a table.

#include "io/csv_writer.hpp"

#include "io/csv_cell.hpp"

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
    std::string& text = file_.buffer();
    text += time;
    fmt::format_to(std::back_inserter(text), ",{}", i);
    const auto add = [&text](double value) {
      text += ',';
      append_csv_cell(text, value);
    };
    for (const double coordinate : state.positions.col(i)) add(coordinate);
    for (const double component : state.velocities.col(i)) add(component);
    if (rough_) add(state.spins.size() > 0 ? state.spins[i] : 0.0);
    file_.buffer() += '\n';
    file_.end_line();
  }
  file_.end_record();
}

}  // namespace carom
